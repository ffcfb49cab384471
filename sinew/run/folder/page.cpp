#include "sinew/run/folder/page.h"

#include "sinew/report/page/page.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::run {

std::string page_of(const RunFiles& run, const std::string& machine, const Notices& notices,
                    const std::string& units) {
  const ReadRun read = read_run(run, machine, "the page shows", notices);
  const analysis::Analysis analysis(read.table, analysis::read_machine(read.resolved), read.ended);
  return report::page(
      {.analysis = analysis, .resolved = read.resolved, .name = read.name, .units = units});
}

bool write_report(const OutputFolder& folder, const analysis::Analysis& logged,
                  const config::Node& values, const std::string& name, const Notices& notices,
                  const std::string& units) {
  if (!report::has_page()) {
    notices.note("no report.html: this sinew was built without npm; docs/dependencies.md");
    return false;
  }
  write_into(folder, report_name,
             report::page({.analysis = logged, .resolved = values, .name = name, .units = units}));
  return true;
}

}  // namespace sinew::run
