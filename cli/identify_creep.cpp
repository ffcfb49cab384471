// cli/identify_creep.cpp - `sinew identify creep`: shares and times of creep from a hold.
#include "cli/identify.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/actuator/creep.h"

namespace sinew::cli {

void add_identify_creep(Command identify, Action& action) {
  struct Options {
    DataOptions data;
    ResultOptions result;
  };
  auto options = std::make_shared<Options>();
  Command sub =
      identify.subcommand("creep",
                          "creep from force that goes on growing at one length; its shares and "
                          "times belong into an actuator's [creep]",
                          "sinew identify creep hold.csv");
  add_data_options(sub, options->data);
  sub.add_flag("--json", options->result.json, "print the report as JSON");
  sub.add_flag("--quiet", options->result.quiet, "only the report and errors");
  sub.add_flag("--force", options->result.force, "replace the page");
  add_report_options(sub, options->result);
  sub.callback([options, &action] {
    action = [options] {
      check_result_options(options->result);
      const std::vector<identify::Source> sources = sources_of(options->data);
      if (sources.size() != 1) config::fail({"data", 0, 0}, "", "several files", "one");
      const auto found =
          identify::identify_creep(identify::read_measured(sources[0], identify::creep_columns()));
      tell(found.report, "", options->data, options->result,
           {{"creep", {{"share", found.creep.share}, {"time_s", found.creep.time}}}});
      return ok;
    };
  });
}

}  // namespace sinew::cli
