// cli/identify_creep.cpp - `sinew identify creep`: creep and dry friction from fill, hold and vent.
#include "cli/identify.h"
#include "sinew/identify/task/creep_task.h"

namespace sinew::cli {

void add_identify_creep(Command identify, Action& action) {
  struct Options {
    DataOptions data;
    ResultOptions result;
  };
  auto options = std::make_shared<Options>();
  Command sub =
      identify.subcommand("creep",
                          "creep and dry friction from force at one length while the muscle is "
                          "filled, held and vented; they belong into an actuator's [creep] and "
                          "[hysteresis]",
                          "sinew identify creep hold.csv");
  add_data_options(sub, options->data);
  sub.add_flag("--json", options->result.json, "print the report as JSON");
  sub.add_flag("--quiet", options->result.quiet, "only the report and errors");
  sub.add_flag("--force", options->result.force, "replace the page");
  add_report_options(sub, options->result);
  sub.callback([options, &action] {
    action = [options] {
      check_result_options(options->result);
      const auto find = [&](host::Tally& tried) {
        return identify::find_creep(sources_of(options->data), &tried);
      };
      const auto found = watched(identify::creep_models().size(), options->result.quiet, find);
      tell(found.report, "", options->data, options->result, to_json(found));
      return ok;
    };
  });
}

}  // namespace sinew::cli
