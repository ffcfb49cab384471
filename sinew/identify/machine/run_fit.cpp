#include "sinew/identify/machine/run_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/write/writer.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/identify/machine/run_search.h"
#include "sinew/json/json.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

using experiment::Experiment;

constexpr double more_than_noise = 1.5;  // rms of the residuals, in units of the noise

std::vector<Parameter> parameters_of(const Experiment& e, const std::vector<std::string>& keys) {
  const std::vector<MachineNumber> all = machine_numbers(e);
  std::vector<Parameter> out;
  for (const std::string& key : keys) {
    const MachineNumber& n = *std::ranges::find(all, key, &MachineNumber::key);
    if (!std::isfinite(n.value))
      config::fail({"fit", 0, 0}, "", config::in_quotes(key) + ", of which its file has no value",
                   "a number with a value, from which the search begins", "to set one");
    out.push_back({.name = key,
                   .unit = n.unit,
                   .start = n.value,
                   .low = n.low,
                   .high = n.high,
                   .scale = machine_scale(e, n)});
  }
  return out;
}

void check_options(const RunFitOptions& options, const std::vector<std::string>& keys) {
  if (!is_share_held_out(options.hold_out))
    config::fail({"hold_out", 0, 0}, "", fmt::format("{:g} %", 100 * options.hold_out),
                 fmt::format("a share of the run, from 0 to below {:g} %", 100 * most_held_out),
                 "20 %");
  if (options.hold_out == 1 && !(options.fit.empty() && options.priors.empty()))
    config::fail({"hold_out", 0, 0}, "", "100 %, and numbers to fit", "one or the other",
                 "less, or no fit and prior");
  if (keys.empty() && options.hold_out < 1)
    config::fail({"freeze", 0, 0}, "", "all numbers that were to be fitted", "one to fit at least");
  for (const RunPrior& prior : options.priors)
    if (std::ranges::find(keys, prior.key) == keys.end())
      config::fail({"prior", 0, 0}, "", config::in_quotes(prior.key) + ", which is not fitted",
                   fmt::format("one of {}", fmt::join(keys, ", ")), "to fit it too");
}

// Writes the rows of the page, and the score of each channel.
void score_channels(const DrivenRun& run, double until, double from,
                    const std::vector<double>& mean, RunFitResult& out) {
  Rows& rows = out.report.rows;
  rows = {.x = "time", .x_unit = "s", .unit = "1"};
  std::vector<double> fitted, held_out;
  std::size_t sample = 0;
  for (const RunChannel& c : run.channels()) {
    std::vector<double> in, beyond;
    for (std::size_t i = 0; i < c.value.size(); ++i, ++sample) {
      const double t = run.time(sample), left = mean[sample] - c.value[i];
      if (t < from) continue;
      const bool held = t > until;
      (held ? beyond : in).push_back(left);
      (held ? held_out : fitted).push_back(left / c.noise);
      rows.at.push_back(t);
      rows.measured.push_back(c.value[i] / c.noise);
      rows.group.push_back(c.name);
      rows.held_out.push_back(held);
      out.report.fits[0].residuals.push_back(left / c.noise);
    }
    out.channels.push_back({c.name, c.unit, in.size() + beyond.size(), c.noise, score(in, 1).rmse,
                            score(beyond, 1).rmse});
  }
  out.report.fits[0].fit = score(fitted, 1);
  if (!held_out.empty()) out.report.fits[0].held_out = score(held_out, 1);
}

void add_channel_notes(const RunFitResult& out, Fit& fit) {
  for (const ChannelScore& c : out.channels)
    fit.notes.push_back(fmt::format(
        "{}: {:.3g} {} left of {:.3g} {} noise{}", c.name,
        fit.fit.points > 0 ? c.fitted : c.held_out, c.unit, c.noise, c.unit,
        c.held_out > 0 && fit.fit.points > 0 ? fmt::format(", held out {:.3g}", c.held_out) : ""));
}

// Warns of reasons to doubt the result.
void warn(const RunFitResult& out, Report& report, double rms) {
  if (rms > more_than_noise)
    report.warnings.push_back(fmt::format(
        "what is left is {:.3g} times the sensors' noise: this machine is not quite "
        "the one that was measured{}",
        rms,
        out.no_intervals.empty() ? ", and the intervals hold only a part of that difference" : ""));
  const Fit& fit = report.fits[0];
  if (fit.fit.points > 0 && fit.held_out && fit.held_out->rmse > 1.5 * fit.fit.rmse)
    report.warnings.push_back(
        fmt::format("the end of the run, held out, is missed by {:.3g} times the noise, what was "
                    "fitted by {:.3g}: something changed, or the fit follows what is not there",
                    fit.held_out->rmse, fit.fit.rmse));
  if (!out.no_intervals.empty())
    report.warnings.push_back("intervals are not given: " + out.no_intervals);
  for (const std::string& direction : out.undetermined)
    report.warnings.push_back("not determined by this run: " + direction);
}

// Removes intervals that would be wrong. In a hundred runs in the air derivatives over both steps
// agreed within 0.02, mostly within 0.001. In walks they differed by 0.03 to 0.9, and however small
// the difference, none of six searches ended at the true values: a single landing is enough.
// Residuals far above the noise are not noise, and do not show how far off the values are.
void judge_intervals(const DrivenRun& run, double until, RunFitResult& out, RunJudged& judged) {
  constexpr double smooth = 0.05;
  out.roughness = judged.roughness;
  out.rough = !(out.roughness <= smooth);
  out.landings = run.landings(out.machine, until);
  const bool is_far = judged.rms > far_above_noise;
  if (!out.rough && out.landings == 0 && !is_far) return;
  out.no_intervals =
      out.landings > 0
          ? fmt::format(
                "a foot comes down on the ground {} times, a little earlier or later with other "
                "numbers, and after each time everything lies elsewhere; the search ends near the "
                "optimum, and how near is not known. A run in the air has intervals",
                out.landings)
      : is_far
          ? fmt::format(
                "what is left is {:.3g} times the sensors' noise, and more than {:g} times it is "
                "not noise: the search ended in a wrong optimum, or something else than these "
                "numbers differs. Start values nearer to the truth, or more numbers to fit, may "
                "help",
                judged.rms, far_above_noise)
          : "the readings jump where a number changes a little; the search ends near the optimum, "
            "and how near is not known. Another run may have no such jumps";
  for (Estimate& e : judged.estimates) {
    e.remove_interval();
    if (!is_far) e.at_bound = false;
  }
}

// Values of the searched parameters, and the residuals there.
struct EvaluatedPoint {
  std::vector<double> p, residuals;
  bool is_evaluated = false;

  EvaluatedPoint(const RunResiduals& of, std::vector<double> numbers)
      : p(std::move(numbers)), residuals(of.count()), is_evaluated(of(p, residuals)) {}
};

// Returns whether the readings change if parameter i alone is changed.
bool moves_readings(const RunResiduals& residuals, const Parameter& one, std::size_t i,
                    const EvaluatedPoint& place) {
  constexpr double enough = 0.1;  // sum of squares, in units of the noise
  if (!place.is_evaluated) return false;
  std::vector<double> p = place.p, there(residuals.count());
  const std::vector<double>& at = place.residuals;
  const double from = p[i];
  for (const double step : {0.3, -0.3, 1.0}) {
    p[i] = from + step * one.scale;
    if (p[i] < one.low || p[i] > one.high || !residuals(p, there)) continue;
    double moved = 0;
    for (std::size_t k = 0; k < at.size(); ++k) moved += (there[k] - at[k]) * (there[k] - at[k]);
    if (moved > enough) return true;
  }
  return false;
}

// Returns the parameters that affect any reading; the others are listed in `without_effect`. The
// closing delay of a valve whose pulses are all lost has no effect, so dead times are tested a
// second time with all of them halved.
std::vector<Parameter> parameters_with_effect(const RunResiduals& residuals,
                                              const std::vector<Parameter>& all,
                                              std::vector<std::string>& without_effect) {
  std::vector<double> short_times;
  for (const Parameter& one : all)
    short_times.push_back(is_dead_time(one) ? std::max(one.low, 0.5 * one.start) : one.start);
  const EvaluatedPoint start(residuals, starts_of(all)), sooner(residuals, short_times);
  if (!start.is_evaluated)
    throw Refusal("the machine at the start of the search",
                  "that it does not get to the end of the run in finite numbers",
                  "a machine that can do what was recorded", "other start values");
  std::vector<Parameter> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (moves_readings(residuals, all[i], i, start) ||
        (is_dead_time(all[i]) && moves_readings(residuals, all[i], i, sooner)))
      out.push_back(all[i]);
    else
      without_effect.push_back(all[i].name + ": no reading depends on it");
  }
  return out;
}

// Fits the parameters to the run up to `until` [s]: writes the machine, the estimates and the
// effort of the search. Returns the rms of the residuals there, in units of the noise.
double search_numbers(const Experiment& e, const DrivenRun& run, const RunFitOptions& options,
                      double until, std::vector<Parameter> parameters, RunFitResult& out) {
  parameters = parameters_with_effect(RunResiduals(e, run, parameters, options, until), parameters,
                                      out.undetermined);
  if (parameters.empty())
    throw Refusal("the run", "readings that depend on none of the numbers",
                  "a run in which they matter", "other numbers to fit");
  const double beginning = std::min(until, std::max(options.from + 4, until / 3));
  const RunResiduals first(e, run, parameters, options, beginning);
  const RunResiduals whole(e, run, parameters, options, until);
  out.at_start =
      std::sqrt(2 * whole.cost(starts_of(parameters)) / static_cast<double>(whole.count()));
  const RunSearched found = search_run(first, whole, parameters, options, options.threads);
  RunJudged s = judge_run(whole, parameters, found, options.threads);
  for (std::string& direction : open_directions(s, parameters))
    out.undetermined.push_back(std::move(direction));
  out.machine = whole.machine(found.p);
  judge_intervals(run, until, out, s);
  out.report.fits[0].parameters = s.estimates;
  out.simulations = first.simulations() + whole.simulations();
  return s.rms;
}

}  // namespace

RunFitResult fit_run(const Experiment& e, const DrivenRun& run, const RunFitOptions& options) {
  RunFitResult out;
  const bool fits = options.hold_out < 1;
  out.machine = e;
  if (fits) out.keys = machine_keys(out.machine, options.fit);
  std::erase_if(out.keys, [&](const std::string& key) {
    return std::ranges::find(options.frozen, key) != options.frozen.end();
  });
  check_options(options, out.keys);
  const double until =
      fits ? options.from + (1 - options.hold_out) * (run.duration() - options.from) : -1;
  Report& report = out.report;
  report.set_subject(fmt::format("{} from a run of {:.4g} s", e.robot.name, run.duration()),
                     "readings", "1", "each sensor's noise");
  report.full_scale = 1;
  report.not_shown = {"what this run did not excite: other speeds, loads and pressures"};
  if (options.hold_out > 0)
    report.held_out_is = fits ? fmt::format("the run from {:.4g} s on", until)
                              : "all of the run; nothing was fitted";
  report.fits.push_back(
      {.model = "plant",
       .law = "the machine in simulation, driven by the recorded valve commands"});
  double rms = 0;
  if (fits) rms = search_numbers(e, run, options, until, parameters_of(out.machine, out.keys), out);
  std::vector<double> mean(run.samples());
  if (!run.predict(out.machine, mean, run.duration()) && !fits)
    throw Refusal("the machine, driven by the recorded valve commands",
                  "that it does not reach the end of the run in finite numbers",
                  "a machine that can do what was recorded", "other numbers");
  score_channels(run, until, options.from, mean, out);
  add_channel_notes(out, report.fits[0]);
  if (fits)
    report.fits[0].notes.push_back(fmt::format(
        "with the numbers as they stood {:.4g} times the noise was left; {} simulations",
        out.at_start, out.simulations));
  report.rule = "the only one";
  warn(out, report, rms);
  return out;
}

// --- the result as a robot's file and as JSON ---

namespace {

// Puts a node at a path such as "joint.hip.damping", creating the tables on the way.
void put_at(config::Node& root, std::string_view path, config::Node leaf) {
  const std::size_t dot = path.find('.');
  if (dot == path.npos) {
    root.put(std::move(leaf));
    return;
  }
  const std::string name(path.substr(0, dot));
  config::Node* table = root.find(name);
  if (!table) table = &root.put(config::make_table(name));
  put_at(*table, path.substr(dot + 1), std::move(leaf));
}

}  // namespace

std::string run_file(const RunFitResult& found, const std::string& source, config::Node robot) {
  for (const Estimate& e : found.report.best().parameters) {
    if (!e.identifiable) continue;
    const std::string key = e.name.substr(e.name.rfind('.') + 1);
    const std::string unit(units::difference_unit(e.unit));
    config::Node leaf = config::make_table(key);
    leaf.put(config::make_text("value", units::rounded_quantity(e.value, e.unit)));
    leaf.put(config::make_flag("fit", true));
    const bool told = std::isfinite(e.high - e.low);
    if (told)
      leaf.put(config::make_text("uncertainty",
                                 units::format_quantity(0.5 * (e.high - e.low), unit, unit, 3)));
    leaf.put(config::make_text("source", told ? source : source + "; how far off is not known"));
    put_at(robot, e.name, std::move(leaf));
  }
  return config::to_toml(robot);
}

Json describe(const RunFitResult& found) {
  Json out{{"simulations", found.simulations},
           {"rms_at_start", found.keys.empty() ? Json() : finite_or_null(found.at_start)},
           {"not_determined", found.undetermined},
           {"rough", found.rough},
           {"roughness", finite_or_null(found.roughness)},
           {"landings", found.landings},
           {"intervals", !found.keys.empty() && found.no_intervals.empty()}};
  if (!found.no_intervals.empty()) out["no_intervals_because"] = found.no_intervals;
  out["channels"] = Json::array();
  for (const ChannelScore& c : found.channels)
    out["channels"].push_back({{"channel", c.name},
                               {"unit", c.unit},
                               {"samples", c.samples},
                               {"noise", finite_or_null(c.noise)},
                               {"rms", found.keys.empty() ? Json() : finite_or_null(c.fitted)},
                               {"rms_held_out", finite_or_null(c.held_out)}});
  return out;
}

}  // namespace sinew::identify
