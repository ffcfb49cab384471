#include "sinew/identify/task/run_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/fit/robot_over.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/identify/machine/run_file.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"

namespace sinew::identify {

namespace {

// "key=value +- deviation", both with a unit.
RunPrior prior_of(const std::string& text, experiment::Experiment& e) {
  const std::size_t equals = text.find('='), sign = text.find("+-");
  if (equals == text.npos || sign == text.npos || sign < equals)
    config::fail({"prior", 0, 0}, "", config::in_quotes(text),
                 "a key, its value and its standard deviation",
                 "\"joint.hip.damping=0.2 N m s/rad +- 0.05 N m s/rad\"");
  const std::string key = text.substr(0, equals);
  const std::vector<MachineNumber> all = machine_numbers(e);
  const auto number = std::ranges::find(all, key, &MachineNumber::key);
  if (number == all.end())
    config::fail({"prior", 0, 0}, key, "no number of this robot", "one of its keys", "sinew keys");
  std::string value = text.substr(equals + 1, sign - equals - 1), spread = text.substr(sign + 2);
  for (std::string* piece : {&value, &spread}) {
    piece->erase(0, piece->find_first_not_of(' '));
    piece->erase(piece->find_last_not_of(' ') + 1);
  }
  return {key,
          config::quantity_setting("prior", value, number->unit, e.air.atmosphere,
                                   {number->low, number->high, "as its field"}),
          config::quantity_setting("prior", spread, number->unit, e.air.atmosphere,
                                   config::above_zero(unbounded, "a spread"))};
}

}  // namespace

std::string RunFitFound::file(const std::string& out) const {
  return run_file(result, source, robot_over(base, out));
}

RunFitFound find_run_fit(const RunFitSettings& settings) {
  const run::RecordedRun run = run::recorded_run(settings.run);
  const std::string machine = run::machine_of(run, settings.machine).string();
  const config::Node root = config::compose(machine, settings.sets);
  experiment::Experiment e = run::buildable(root, machine);
  if (!e.faults.empty())
    config::fail({machine, 0, 0}, "fault", "a run in which something broke",
                 "one of a machine that stays what it is", "a run without [[fault]]");
  const bool imported = root.find("imported") != nullptr;
  RunFitOptions options{
      .fit = settings.fit, .threads = settings.threads, .progress = settings.progress};
  options.hold_out = config::quantity_setting("hold_out", settings.hold_out, "1");
  options.from = config::quantity_setting("from", settings.from, "s", units::atmosphere,
                                          config::from_zero(1e6, "a time of the run"));
  for (const std::string& prior : settings.priors) options.priors.push_back(prior_of(prior, e));

  const DrivenRun driven(e, log::read(run.log), imported, run.log.string());
  if (options.from >= driven.duration())
    config::fail({"from", 0, 0}, "", config::in_quotes(settings.from),
                 fmt::format("a time within the run of {:.4g} s", driven.duration()), "\"0 s\"");
  RunFitFound out{fit_run(e, driven, options), settings.base, "identified from " + settings.run};
  if (!driven.rebuilt().empty())
    out.result.report.notes.push_back(
        fmt::format("edges were made from duties, as the low level makes them, of {} valves",
                    driven.rebuilt().size()));
  return out;
}

nlohmann::ordered_json to_json(const RunFitFound& found) {
  nlohmann::ordered_json out = to_json(found.result.report);
  out.update(describe(found.result));
  return out;
}

}  // namespace sinew::identify
