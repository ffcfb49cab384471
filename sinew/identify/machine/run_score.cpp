#include "sinew/identify/machine/run_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/numbers.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/machine/machine_numbers.h"

namespace sinew::identify {

namespace {

using experiment::Experiment;
using Of = RunChannel::Of;

// A quantity, its SI unit as measured and as a difference, and the measured object.
struct ScoredQuantity {
  Of of;
  const char *quantity, *unit, *difference, *each;
};
constexpr ScoredQuantity scored_quantities[] = {
    {Of::angle, "angle", "rad", "rad", "joint"},
    {Of::rate, "rate", "rad/s", "rad/s", "joint"},
    {Of::tension, "tension", "N", "N", "muscle"},
    {Of::pressure, "pressure", "Pa gauge", "Pa diff", "muscle"},
    {Of::lift, "lift", "m", "m", "body"}};

std::string scored_name(const Experiment& e, const RunChannel& c) {
  if (c.of == Of::lift) return "body";
  return c.of == Of::angle || c.of == Of::rate ? e.robot.joints[c.index].name
                                               : e.robot.muscles[c.index].name;
}

// Adds the samples of a channel, in the unit of its quantity, as one part of the report.
void add_scored(const Experiment& machine, const DrivenRun& run, std::size_t channel,
                std::size_t sample, const std::vector<double>& mean, double from, Report& out) {
  const RunChannel& c = run.channels()[channel];
  const double rest = c.of == Of::angle ? machine.robot.joints[c.index].rest_angle : 0;
  const std::string name = scored_name(machine, c);
  std::vector<double> measured, left;
  for (std::size_t i = 0; i < c.value.size(); ++i, ++sample) {
    if (run.time(sample) < from) continue;
    measured.push_back(rest + (c.value[i] - c.at_zero) / c.per_unit);
    left.push_back((mean[sample] - c.value[i]) / c.per_unit);
    out.rows.at.push_back(run.time(sample));
  }
  if (measured.empty()) return;
  const auto [least, most] = std::ranges::minmax(measured);
  out.full_scale = std::max(out.full_scale, most - least);
  out.errors[0].parts.push_back({.name = name, .score = score(left, 0, measured)});
  out.rows.measured.insert(out.rows.measured.end(), measured.begin(), measured.end());
  out.rows.group.insert(out.rows.group.end(), measured.size(), name);
  auto& residuals = out.fits[0].residuals;
  residuals.insert(residuals.end(), left.begin(), left.end());
}

// Writes the score of all parts, and each part's errors in percent of the full scale.
void conclude_score(Report& out) {
  std::vector<PartError>& parts = out.errors[0].parts;
  Score all = score(out.fits[0].residuals, out.full_scale);
  const auto mean = [&](double Score::*member) {
    double sum = 0;
    for (const PartError& p : parts) sum += p.score.*member / static_cast<double>(parts.size());
    return sum;
  };
  all.nrmse = mean(&Score::nrmse);
  all.correlation = mean(&Score::correlation);
  all.explained = mean(&Score::explained);
  out.fits[0].held_out = all;
  for (PartError& p : parts) {
    if (!(out.full_scale > 0)) continue;  // no motion
    p.score.rmse_percent = 100 * p.score.rmse / out.full_scale;
    p.score.max_percent = 100 * p.score.max / out.full_scale;
  }
}

}  // namespace

std::vector<Report> score_run(const Experiment& machine, const DrivenRun& run, double from,
                              const std::string& name) {
  std::vector<double> mean(run.samples());
  if (!run.predict(machine, mean, run.duration()))
    throw Refusal("the machine, driven by the valve commands of " + name,
                  "that it does not reach the end of the recording in finite numbers",
                  "a machine that can do what was recorded", "other numbers, or another recording");
  std::vector<Report> out;
  for (const ScoredQuantity& kind : scored_quantities) {
    Report report{
        .subject = fmt::format("{}, driven by the valve commands of {} alone", kind.quantity, name),
        .quantity = kind.quantity,
        .unit = kind.difference,
        .full_scale_is = fmt::format("the largest range of a {}", kind.each),
        .held_out_is = fmt::format("all of {}, {:.4g} s", name, run.duration())};
    report.fits.push_back(
        {.model = "plant",
         .law = "the machine in simulation, driven by the recorded valve commands"});
    report.rows = {.x = "time", .x_unit = "s", .unit = kind.unit};
    report.errors.push_back({.what = kind.each});
    std::size_t sample = 0;
    for (std::size_t c = 0; c < run.channels().size(); ++c) {
      if (run.channels()[c].of == kind.of) add_scored(machine, run, c, sample, mean, from, report);
      sample += run.channels()[c].value.size();
    }
    if (report.rows.size() == 0) continue;
    conclude_score(report);
    out.push_back(std::move(report));
  }
  if (out.empty())
    config::fail({"from", 0, 0}, "", fmt::format("{:g} s", from),
                 fmt::format("a time within the {:.4g} s of {}", run.duration(), name), "0 s");
  return out;
}

Experiment scored_machine(Experiment machine, Experiment recorded,
                          const std::vector<std::string>& keys, const std::string& name,
                          std::vector<std::string>& differing) {
  // Not part of the body: conditions of a recording, its sensors and its controller.
  constexpr std::array apart = {"start.", "air.", "sensor.", "converter.", "low_level.", "thesis."};
  const auto body = [&](const Experiment& e) {
    std::vector<MachineNumber> out = machine_numbers(e);
    std::erase_if(out, [&](const MachineNumber& n) {
      return std::ranges::any_of(apart, [&](const char* a) { return n.key.starts_with(a); });
    });
    return out;
  };
  const std::vector<MachineNumber> ours = body(machine), theirs = body(recorded);
  const auto lacking = [&](const auto& in, const auto& of, const char* whose) {
    for (const MachineNumber& n : of)
      if (std::ranges::find(in, n.key, &MachineNumber::key) == in.end())
        config::fail({name, 0, 0}, "", fmt::format("a machine {} {}", whose, n.key),
                     "a recording of the machine that was identified",
                     "one of the same joints, muscles, actuators and valves");
  };
  lacking(theirs, ours, "without");
  lacking(ours, theirs, "with another part,");
  for (const MachineNumber& n : ours) {
    const double there = std::ranges::find(theirs, n.key, &MachineNumber::key)->value;
    if (std::abs(n.value - there) > 1e-9 * std::abs(there) &&
        std::ranges::find(keys, n.key) == keys.end())
      differing.push_back(n.key);
  }
  recorded.robot = machine.robot;
  recorded.actuators = machine.actuators;
  recorded.valves = machine.valves;
  const experiment::Numbers there(recorded, keys);
  std::vector<std::string> common;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (there.has(i)) common.push_back(keys[i]);
  const std::vector<double> found = experiment::Numbers(machine, common).values();
  (void)experiment::Numbers(recorded, common).set_unbounded(recorded, found);
  return recorded;
}

}  // namespace sinew::identify
