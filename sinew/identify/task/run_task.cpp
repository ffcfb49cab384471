#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/provenance.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/json/json.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"

namespace sinew::identify {

namespace {

// The text before and behind the first of the marks, without blanks; nothing where there is none.
std::optional<std::pair<std::string, std::string>> parted(
    std::string_view text, std::initializer_list<std::string_view> marks) {
  for (const std::string_view mark : marks)
    if (const std::size_t at = text.find(mark); at != text.npos)
      return std::pair{std::string(config::trimmed(text.substr(0, at))),
                       std::string(config::trimmed(text.substr(at + mark.size())))};
  return {};
}

// The number of that key; the setting names it.
const MachineNumber& number_of(const std::vector<MachineNumber>& all, const std::string& key,
                               const std::string& setting) {
  const auto number = std::ranges::find(all, key, &MachineNumber::key);
  if (number != all.end()) return *number;
  std::vector<std::string_view> keys;
  for (const MachineNumber& n : all) keys.push_back(n.key);
  config::fail({setting, 0, 0}, "", config::in_quotes(key), "a number's key of this robot",
               config::closest_in_quotes(key, keys));
}

// "key=value +- deviation", both with a unit.
RunPrior prior_of(const std::string& text, experiment::Experiment& e) {
  const auto named = parted(text, {"="});
  const auto told = parted(named ? named->second : "", {"±", "+/-", "+-"});
  if (!told)
    config::fail({"prior", 0, 0}, "", config::in_quotes(text),
                 "a key, its value and its standard deviation",
                 "\"joint.hip.damping=0.2 N m s/rad +- 0.05 N m s/rad\"");
  const std::vector<MachineNumber> all = machine_numbers(e);
  const MachineNumber& number = number_of(all, named->first, "prior");
  return {number.key,
          config::quantity_setting("prior", told->first, number.unit, e.air.atmosphere,
                                   {number.low, number.high, "as its field"}),
          config::quantity_setting("prior", told->second, config::difference_unit(number.unit),
                                   e.air.atmosphere, config::above_zero(unbounded, "a spread"))};
}

// The keys of "key=value", which are settings too.
std::vector<std::string> frozen_keys(const std::vector<std::string>& texts,
                                     const std::vector<std::string>& fit,
                                     experiment::Experiment& e) {
  const std::vector<MachineNumber> all = machine_numbers(e);
  std::vector<std::string> out;
  for (const std::string& text : texts) {
    const auto named = parted(text, {"="});
    out.push_back(number_of(all, named ? named->first : text, "freeze").key);
    if (std::ranges::find(fit, out.back()) != fit.end())
      config::fail({"freeze", 0, 0}, "", config::in_quotes(out.back()) + ", which is to be fitted",
                   "a number that is one or the other");
  }
  return out;
}

// Returns the share of the run that is held out, which `text` gave.
double share_of(const std::string& text, double share) {
  if (share >= 0 && share < most_held_out) return share;
  config::fail({"hold_out", 0, 0}, "", config::in_quotes(text),
               fmt::format("a share of the run, from 0 to below {:g} %", 100 * most_held_out),
               share > 1 && share < 100 * most_held_out
                   ? fmt::format("\"{:g} %\" or \"{:g}\"", share, share / 100)
                   : "\"20 %\"");
}

RunFitOptions options_of(const RunFitSettings& settings, experiment::Experiment& e) {
  RunFitOptions out{
      .fit = settings.fit, .threads = settings.threads, .progress = settings.progress};
  out.frozen = frozen_keys(settings.freeze, settings.fit, e);
  const SettingValues values(settings);
  out.hold_out = share_of(settings.hold_out, values.of(settings.hold_out));
  out.from = values.of(settings.from);
  for (const std::string& prior : settings.priors) out.priors.push_back(prior_of(prior, e));
  return out;
}

// Throws config::Error for a frozen number without its value.
std::vector<std::string> all_sets(const RunFitSettings& settings) {
  std::vector<std::string> out = settings.sets;
  for (const std::string& text : settings.freeze) {
    if (!parted(text, {"="}))
      config::fail({"freeze", 0, 0}, "", config::in_quotes(text), "a key and its value",
                   config::in_quotes(text + "=VALUE"));
    out.push_back(text);
  }
  return out;
}

}  // namespace

std::string RunFitFound::file(const std::string& out) const {
  return run_file(result, source, robot_over(base, out));
}

RunFitFound find(const SourceList&, const RunFitSettings& settings) {
  const run::RecordedRun run = run::recorded_run(settings.run);
  const std::string machine = run::machine_of(run, settings.machine).string();
  const config::Node root = config::compose(machine, all_sets(settings));
  experiment::Experiment e = run::buildable_robot(root, machine);
  if (!e.faults.empty())
    config::fail({machine, 0, 0}, "fault", "a run in which something broke",
                 "one of a machine that stays what it is", "a run without [[fault]]");
  const bool imported = root.find("imported") != nullptr;
  const RunFitOptions options = options_of(settings, e);
  const signals::Table recorded = log::read(run.log);
  const DrivenRun driven(e, recorded, imported, run.log.string());
  if (options.from >= driven.duration())
    config::fail({"from", 0, 0}, "", config::in_quotes(settings.from),
                 fmt::format("a time within the run of {:.4g} s", driven.duration()), "\"0 s\"");
  RunFitFound out{fit_run(e, driven, options), settings.base, "identified from " + settings.run};
  if (!recorded.complete)
    out.result.report.warnings.push_back(
        fmt::format("the log was cut off or is damaged: {:.4g} s of the run are in it, and the fit "
                    "is over these",
                    driven.duration()));
  if (!driven.coarse().empty())
    out.result.report.warnings.push_back(
        fmt::format("the recording knows when {} valves switch to one of its rows only, and pulses "
                    "are shorter: their duties, or edges at their own times, would tell",
                    driven.coarse().size()));
  if (!driven.rebuilt().empty())
    out.result.report.notes.push_back(
        fmt::format("edges were made from duties, as the low level makes them, of {} valves",
                    driven.rebuilt().size()));
  return out;
}

Json to_json(const RunFitFound& found) {
  Json out = to_json(found.result.report);
  out.update(describe(found.result));
  return out;
}

}  // namespace sinew::identify
