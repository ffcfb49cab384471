#include "sinew/run/folder/page.h"

#include "sinew/config/compose.h"
#include "sinew/log/reader.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::run {

std::string page_of(const RecordedRun& run, const std::string& machine, const Notices& notices,
                    const std::string& units) {
  const config::Node resolved = config::compose(machine_of(run, machine).string());
  const signals::Table table = log::read(run.log);
  const std::string ended = ended_in(run.log);
  const analysis::Analysis analysis(table, analysis::read_machine(resolved), ended);
  std::string page = report::page(
      {.analysis = analysis, .resolved = resolved, .name = experiment_in(run.log), .units = units});
  if (!ended.empty())
    notices.warning(run.log.string() + ": the run was ended: " + ended +
                    "; the page shows it until then");
  if (!table.complete)
    notices.warning(run.log.string() +
                    " was cut off or is damaged; the page shows what stands before");
  return page;
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
