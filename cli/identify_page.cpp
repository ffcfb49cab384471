#include "cli/identify_page.h"

#include <fmt/format.h>

#include "cli/terminal.h"
#include "sinew/identify/page/fit_page.h"
#include "sinew/identify/task/tables.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

void leave_page(const std::string& title, const std::vector<const identify::Report*>& reports,
                const std::string& parameter_file, const DataOptions& data,
                const ResultOptions& options) {
  const std::string file = page_of(options);
  if (file.empty()) return;
  run::write_file(file, identify::page({.title = title,
                                        .version = SINEW_VERSION,
                                        .data = identify::words_of(sources_of(data)),
                                        .atmosphere = identify::atmosphere_setting(data.atmosphere),
                                        .reports = reports,
                                        .parameter_file = parameter_file}));
  Messages(options.quiet).note(fmt::format("{}: written", file));
}

}  // namespace sinew::cli
