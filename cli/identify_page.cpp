#include "cli/identify_page.h"

#include <fmt/format.h>

#include "cli/terminal.h"
#include "sinew/identify/page/fit_page.h"
#include "sinew/identify/task/tables.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

// "a.csv; force is F_N; F_N in N; only phase=fill"
std::vector<std::string> in_words(const DataOptions& data) {
  std::vector<std::string> out = data.files;
  for (const std::string& map : data.maps) out.push_back("column " + map);
  for (const std::string& unit : data.units) out.push_back("unit " + unit);
  for (const std::string& where : data.where) out.push_back("only rows with " + where);
  if (!data.columns.empty()) out.push_back("header " + data.columns);
  if (data.drop_incomplete) out.emplace_back("incomplete rows left out");
  return out;
}

}  // namespace

void leave_page(const std::string& title, const std::vector<const identify::Report*>& reports,
                const std::string& parameter_file, const DataOptions& data,
                const ResultOptions& options) {
  const std::string file = page_of(options);
  if (file.empty()) return;
  run::write_file(file, identify::page({.title = title,
                                        .version = SINEW_VERSION,
                                        .data = in_words(data),
                                        .atmosphere = identify::atmosphere_setting(data.atmosphere),
                                        .reports = reports,
                                        .parameter_file = parameter_file}));
  Messages(options.quiet).note(fmt::format("{}: written", file));
}

}  // namespace sinew::cli
