#include "sinew/identify/task/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/identify/machine/run_score.h"
#include "sinew/json/json.h"
#include "sinew/log/reader.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

namespace {

// Splits the text at the first of the marks and trims both parts; empty if there is no mark.
std::optional<std::pair<std::string, std::string>> parted(
    std::string_view text, std::initializer_list<std::string_view> marks) {
  for (const std::string_view mark : marks)
    if (const std::size_t at = text.find(mark); at != text.npos)
      return std::pair{std::string(units::trimmed(text.substr(0, at))),
                       std::string(units::trimmed(text.substr(at + mark.size())))};
  return {};
}

// Returns the number with this key. Throws config::Error that names the setting.
const MachineNumber& number_of(const std::vector<MachineNumber>& all, const std::string& key,
                               const std::string& setting) {
  const auto number = std::ranges::find(all, key, &MachineNumber::key);
  if (number != all.end()) return *number;
  std::vector<std::string_view> keys;
  for (const MachineNumber& n : all) keys.push_back(n.key);
  config::fail({setting, 0, 0}, "", config::in_quotes(key), "a number's key of this robot",
               config::closest_in_quotes(key, keys));
}

// Reads "key=value +- deviation", both with a unit.
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
          config::quantity_setting("prior", told->second, units::difference_unit(number.unit),
                                   e.air.atmosphere, config::above_zero(unbounded, "a spread"))};
}

// Returns the keys of "key=value" texts.
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

// Returns the share of the run that is held out. Throws config::Error, quoting `text`, if it is
// out of range.
double share_of(const std::string& text, double share) {
  if (is_share_held_out(share)) return share;
  config::fail({"hold_out", 0, 0}, "", config::in_quotes(text),
               fmt::format("a share of the run, from 0 to below {:g} %, or 100 % to fit nothing",
                           100 * most_held_out),
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

// Returns all settings of values. Throws config::Error for a frozen number without a value.
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

experiment::Experiment sound_machine(const config::Node& root, const std::string& file) {
  experiment::Experiment out = run::buildable_robot(root, file);
  if (!out.faults.empty())
    config::fail({file, 0, 0}, "fault", "a run in which something broke",
                 "one of a machine that stays what it is", "a run without [[fault]]");
  return out;
}

// A recording, and the machine that was run.
struct RecordedMachine {
  std::string name, file;
  config::Node root;
  experiment::Experiment machine;
  signals::Table recorded;
  DrivenRun driven;

  RecordedMachine(const std::string& folder, const run::RunFiles& run, const std::string& instead,
                  const std::vector<std::string>& sets)
      : name(folder),
        file(run::machine_of(run, instead).string()),
        root(config::compose(file, sets)),
        machine(sound_machine(root, file)),
        recorded(log::read(run.log)),
        driven(machine, recorded, root.find("imported") != nullptr, run.log.string()) {}

  // Warns about gaps of the recording.
  void warn(const char* of, Report& report) const {
    if (!recorded.complete)
      report.warnings.push_back(fmt::format(
          "the log was cut off or is damaged: {:.4g} s of the run are in it, and the {} "
          "is over these",
          driven.duration(), of));
    if (!driven.coarse().empty())
      report.warnings.push_back(
          fmt::format("the recording gives the edges of {} valves only to within one row, and "
                      "pulses are shorter: their duties, or edges at their own times, are needed",
                      driven.coarse().size()));
    if (!driven.rebuilt().empty())
      report.notes.push_back(
          fmt::format("edges were made from duties, as the low level makes them, of {} valves",
                      driven.rebuilt().size()));
  }
};

// Scores the result on another recording.
std::vector<Report> score_on(const RecordedMachine& other, double from, RunFitResult& out) {
  std::vector<std::string> differing;
  const experiment::Experiment machine =
      scored_machine(out.machine, other.machine, out.keys, other.name, differing);
  const std::vector<Report> score = score_run(machine, other.driven, from, other.name);
  Report& report = out.report;
  other.warn("score", report);
  if (differing.empty()) return score;
  constexpr std::size_t shown = 3;
  const std::size_t more = differing.size() > shown ? differing.size() - shown : 0;
  differing.resize(differing.size() - more);
  report.warnings.push_back(fmt::format(
      "{} has other values of {}{}, which were not fitted; the score is of the machine without "
      "them",
      other.name, fmt::join(differing, ", "), more > 0 ? fmt::format(" and {} more", more) : ""));
  return score;
}

// Prints the scores on a recording that was not fitted.
void put_score(const RunFitFound& found, const TextOptions& how, std::string& out) {
  using enum report::TextTable::Align;
  const std::span score = std::span(found.reports).subspan(1);
  if (score.empty()) return;
  const config::UnitsToShow chosen = how.units;
  // Without a choice, the units of a protractor and a gauge.
  const auto shown = [&](const std::string& unit) {
    if (chosen.is_requested) return chosen.units.of(unit);
    if (unit == "Pa diff") return units::ShownUnit{"kPa", 1e-3};
    if (unit == "m") return units::ShownUnit{"mm", 1e3};
    if (unit == "N") return units::ShownUnit{"N", 1};
    return units::ShownUnit{unit == "rad" ? "deg" : "deg/s", 180 / std::numbers::pi};
  };
  report::TextTable table({"score", "", "rms", "", "nrmse", "r", "R2"},
                          {left, left, right, left, right, right, right});
  for (const Report& part : score) {
    const units::ShownUnit unit = shown(part.unit);
    const auto add = [&](const std::string& name, const Score& s) {
      table.add({part.quantity, name, fmt::format("{:.4g}", unit.of(s.rmse)), unit.name,
                 digits(s.nrmse, "{:.4f}"), digits(s.correlation, "{:.5f}"),
                 digits(s.explained, "{:.5f}")});
    };
    const auto& parts = part.errors[0].parts;
    for (const PartError& one : parts) add(one.name, one.score);
    if (parts.size() > 1) add(fmt::format("all {}", parts.size()), *part.best().held_out);
  }
  put(out, "\nopen loop, by the valve commands alone: {}\n{}", score[0].held_out_is, table.text());
}

void add_json(const RunFitResult& result, std::span<const Report> score, Json& out) {
  out.update(describe(result));
  for (const Report& part : score) {
    const Json all = to_json(part);
    out["score"].push_back({{"quantity", part.quantity},
                            {"unit", part.unit},
                            {"of", part.held_out_is},
                            {"all", all["held_out"]},
                            {"parts", all["errors"][0]["parts"]}});
  }
}

}  // namespace

RunFitFound find(const SourceList&, const RunFitSettings& settings) {
  RecordedMachine run(settings.run, run::run_files(settings.run), settings.machine,
                      all_sets(settings));
  const RunFitOptions options = options_of(settings, run.machine);
  if (options.from >= run.driven.duration())
    config::fail({"from", 0, 0}, "", config::in_quotes(settings.from),
                 fmt::format("a time within the run of {:.4g} s", run.driven.duration()),
                 "\"0 s\"");
  std::optional<RecordedMachine> other;
  if (!settings.score.empty()) {  // tested before the fit, which is slow
    const run::RunFiles its = run::run_files(settings.score);
    if (std::filesystem::equivalent(its.log, run::run_files(settings.run).log))
      config::fail({"score", 0, 0}, "", config::in_quotes(settings.score) + ", which is fitted",
                   "a run that nothing is fitted to", "another one, or hold_out=\"100 %\"");
    const bool described = std::filesystem::exists(its.resolved);
    other.emplace(settings.score, its, described ? "" : settings.machine,
                  std::vector<std::string>());
    std::vector<std::string> differing;
    (void)scored_machine(run.machine, other->machine, {}, other->name, differing);
    if (options.from >= other->driven.duration())
      config::fail(
          {"from", 0, 0}, "", config::in_quotes(settings.from),
          fmt::format("a time within {} of {:.4g} s", other->name, other->driven.duration()),
          "\"0 s\"");
  }
  RunFitResult result = fit_run(run.machine, run.driven, options);
  run.warn("fit", result.report);
  std::vector<Report> score;
  if (other)
    score = score_on(*other, options.from, result);
  else if (options.hold_out == 1)
    score = score_run(result.machine, run.driven, options.from, settings.run);
  RunFitFound out(std::move(result));
  out.reports.insert(out.reports.end(), score.begin(), score.end());
  add_json(out.result, score, out.json);
  prints(out, put_score);
  out.files = {{[found = out.result, base = settings.base,
                 source = "identified from " + settings.run](const std::string& at) {
    if (found.keys.empty())
      throw Refusal("the run", "that it was held out whole, so that nothing was identified",
                    "a part that is fitted, for a file", "no file, or to hold out less");
    return run_file(found, source, robot_over(base, at));
  }}};
  return out;
}

}  // namespace sinew::identify
