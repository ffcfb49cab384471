#include "sinew/identify/pair/pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/identify/contest/bounds.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"
#include "sinew/identify/pair/pair_law.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

namespace {

// --- fit of one law to all recordings of a pair ---

// Parameters are physics, then the rigs' sensors, then each recording's bias and start.
class PairProblem {
 public:
  // Both must outlive the problem. The first `fitted` recordings are fitted, 0: all; parameter
  // names depend on these alone.
  PairProblem(const PairLaw& law, std::span<const PairRecord> records, std::size_t fitted = 0);

  // Returns the parameters with their ranges. Start values are from a line of effort over position.
  const std::vector<Parameter>& parameters() const { return parameters_; }

  // Returns several starts, with large and small presliding and fade time.
  std::vector<std::vector<double>> starts() const;

  // Writes the effort at every sample of each recording, one after the other.
  void predict(std::span<const double> p, std::span<double> effort);
  // Writes predicted - measured effort at the rows of each recording, one after the other.
  void residuals(std::span<const double> p, std::span<const PairRows> rows,
                 std::vector<double>& out);

  // Returns the problem of fitting the rows of each recording.
  FitProblem fit(std::span<const PairRows> rows, const Constraints& constraints) const;

  // Returns all parameters: values of `known` where it has the name, the others fitted.
  std::vector<double> settled(std::span<const PairRows> rows, const Solution& known);

  // Return the physical values and the sensors that the parameters mean.
  PairValues values(std::span<const double> p) const;
  PairSensors sensors(std::span<const double> p, std::size_t record) const;

 private:
  struct Series {
    std::vector<double> pressure, effort;
    std::vector<double> key;  // parameters of `effort`, before bias and gain
  };

  void add_physics(double stiffness);
  void add_sensors(double stiffness, std::size_t fitted);
  void simulate(std::span<const double> p, std::size_t record);

  const PairLaw& law_;
  std::span<const PairRecord> records_;
  std::vector<Parameter> parameters_;
  std::vector<double PairValues::*> physics_;  // member of each of the first parameters
  std::vector<std::string> rigs_;
  std::vector<std::size_t> delay_, gain_;  // for each rig; gain 0: does not exist
  std::vector<std::size_t> bias_, start_;  // for each recording; start 0: does not exist
  std::vector<std::size_t> rig_;           // rig index of each recording
  std::vector<Series> series_;
  double range_ = 0, effort_ = 0, duration_ = 0;  // ranges of position, effort and time
};

// Largest likely delay of a sensor [s], a guess.
constexpr double most_delay = 0.1;

// Difference step, in parameter scales, that averages over the kinks where friction begins and ends
// to slip.
constexpr double smooth = 0.02;

// Kinks can stop progress, and then further steps gain nothing.
const SolverOptions pair_options{.correlated = true, .most_steps = 25, .difference = smooth};

double largest_size(std::span<const double> values) {
  return std::max(std::abs(largest(values)), std::abs(smallest(values)));
}

double range_of(std::span<const double> values) { return largest(values) - smallest(values); }

// Returns the direction of the first motion by a hundredth of the range.
double first_way(const PairRecord& r) {
  const double enough = 0.01 * range_of(r.at);
  for (const double x : r.at)
    if (std::abs(x - r.at[0]) > enough) return x > r.at[0] ? 1 : -1;
  return 1;
}

PairProblem::PairProblem(const PairLaw& law, std::span<const PairRecord> records,
                         std::size_t fitted)
    : law_(law), records_(records), series_(records.size()) {
  double stiffness = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const PairRecord& r = records[i];
    if (law.air && r.pressure.empty())
      throw Refusal(r.file, "no pressure", "one or two of the muscles that are sealed",
                    "names.pressure_1=NAME");
    series_[i].pressure = pair_pressure(r);
    series_[i].effort.resize(r.size());
    range_ = std::max(range_, range_of(r.at));
    effort_ = std::max(effort_, range_of(r.effort));
    duration_ = std::max(duration_, r.time.back() - r.time.front());
    stiffness += line_through(r.at, r.effort).slope() / static_cast<double>(records.size());
    if (std::ranges::find(rigs_, r.rig) == rigs_.end()) rigs_.push_back(r.rig);
    rig_.push_back(static_cast<std::size_t>(std::ranges::find(rigs_, r.rig) - rigs_.begin()));
  }
  stiffness = std::max(stiffness, 0.01 * effort_ / range_);
  add_physics(stiffness);
  add_sensors(stiffness, fitted > 0 ? fitted : records.size());
}

// Parameter scales correspond to a tenth of the effort.
void PairProblem::add_physics(double stiffness) {
  const bool rotary = records_[0].rotary;
  double fastest = 0, hardest = 0, pressure = 0, finest = range_, least = duration_;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const PairRecord& r = records_[i];
    fastest = std::max(fastest, largest_size(r.rate));
    hardest = std::max(hardest, largest_size(r.acceleration));
    pressure = std::max(pressure, range_of(series_[i].pressure));
    finest = std::min(finest, r.resolution);
    least = std::min(least, (r.time.back() - r.time.front()) / static_cast<double>(r.size()));
  }
  const double tenth = 0.1 * effort_;
  const auto add = [&](bool there, Parameter p, double PairValues::*place) {
    if (!there) return;
    p.high = p.high == unbounded ? 1e4 * std::max(p.start, p.scale) : p.high;
    parameters_.push_back(std::move(p));
    physics_.push_back(place);
  };
  const bool presliding =
      law_.friction == PairFriction::bristle || law_.friction == PairFriction::fading;
  const char *per_m = rotary ? "N m/rad" : "N/m", *per_v = rotary ? "N m s/rad" : "N s/m",
             *at = rotary ? "rad" : "m";
  add(law_.spring,
      {"stiffness", per_m, law_.air ? 0.5 * stiffness : stiffness, 0, unbounded, tenth / range_},
      &PairValues::stiffness);
  if (law_.air && !(pressure > 0))
    throw Refusal(records_[0].file, "pressures that do not change", "those of sealed muscles",
                  "the columns");
  add(law_.air,
      {"area", rotary ? "m3" : "m2",
       (law_.spring ? 0.5 : 1) * stiffness * range_ / std::max(pressure, 1.0), 0, unbounded,
       tenth / std::max(pressure, 1.0)},
      &PairValues::area);
  add(law_.viscous, {"viscous", per_v, 0.1 * tenth / fastest, 0, unbounded, tenth / fastest},
      &PairValues::viscous);
  add(law_.mass,
      {rotary ? "inertia" : "mass", rotary ? "kg m2" : "kg", 0.1 * tenth / hardest, 0, unbounded,
       tenth / hardest},
      &PairValues::mass);
  add(law_.friction != PairFriction::none,
      {"friction", rotary ? "N m" : "N", tenth, 0, unbounded, tenth}, &PairValues::friction);
  add(presliding,
      {"presliding", at, 0.01 * range_, std::min(finest, 1e-3 * range_), 2 * range_, 0.01 * range_,
       false, true},
      &PairValues::presliding);
  add(law_.friction == PairFriction::fading,
      {"fade_time", "s", 0.05 * duration_, 2 * least, 100 * duration_, 0.05 * duration_, false,
       true},
      &PairValues::fade_time);
}

void PairProblem::add_sensors(double stiffness, std::size_t fitted) {
  const bool one_rig = std::ranges::count(std::span(rig_).first(fitted), rig_[0]) ==
                       static_cast<std::ptrdiff_t>(fitted);
  // Returns "delay of RIG", or "delay" for a single rig.
  const auto named = [](const char* name, const std::string& whose, bool alone) {
    return alone ? std::string(name) : fmt::format("{} of {}", name, whose);
  };
  for (std::size_t i = 0; i < rigs_.size(); ++i) {
    delay_.push_back(parameters_.size());
    parameters_.push_back(
        {named("delay", rigs_[i], one_rig && i == 0), "s", 0, -most_delay, most_delay, 0.05, true});
    gain_.push_back(i == 0 ? 0 : parameters_.size());
    if (i > 0)
      parameters_.push_back({named("gain", rigs_[i], false), "1", 1, 0.01, 100, 0.1, true});
  }
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const PairRecord& r = records_[k];
    const bool one = fitted == 1 && k == 0;
    double bias = 0;
    for (std::size_t i = 0; i < r.size(); ++i)
      bias +=
          (r.effort[i] - (law_.spring ? stiffness * r.at[i] : 0)) / static_cast<double>(r.size());
    bias_.push_back(parameters_.size());
    parameters_.push_back({named("bias", r.file, one), r.rotary ? "N m" : "N", bias, -unbounded,
                           unbounded, 0.1 * effort_});
    const bool starts =
        law_.friction == PairFriction::bristle || law_.friction == PairFriction::fading;
    start_.push_back(starts ? parameters_.size() : 0);
    if (starts)
      parameters_.push_back({named("start", r.file, one), "1", 0.7 * first_way(r), -1, 1, 0.5});
  }
}

std::vector<std::vector<double>> PairProblem::starts() const {
  std::vector<std::vector<double>> out{starts_of(parameters_)};
  const auto vary = [&](double PairValues::*place, std::vector<double> values) {
    for (std::size_t i = 0; i < physics_.size(); ++i) {
      if (physics_[i] != place) continue;
      std::vector<std::vector<double>> more;
      for (const std::vector<double>& start : out)
        for (const double value : values) {
          more.push_back(start);
          more.back()[i] = std::clamp(value, parameters_[i].low, parameters_[i].high);
        }
      out = std::move(more);
    }
  };
  vary(&PairValues::presliding, {2e-4 * range_, 0.03 * range_});
  vary(&PairValues::fade_time, {0.05 * duration_, 0.5 * duration_});
  return out;
}

PairValues PairProblem::values(std::span<const double> p) const {
  PairValues out;
  for (std::size_t i = 0; i < physics_.size(); ++i) out.*physics_[i] = p[i];
  return out;
}

PairSensors PairProblem::sensors(std::span<const double> p, std::size_t record) const {
  const std::size_t rig = rig_[record];
  return {.bias = p[bias_[record]],
          .gain = gain_[rig] > 0 ? p[gain_[rig]] : 1,
          .delay = p[delay_[rig]],
          .start = start_[record] > 0 ? p[start_[record]] : 0};
}

// Does not simulate a recording again whose parameters are unchanged.
void PairProblem::simulate(std::span<const double> p, std::size_t record) {
  const PairSensors s = sensors(p, record);
  std::vector<double> key(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(physics_.size()));
  key.insert(key.end(), {s.start, s.delay});
  Series& series = series_[record];
  if (key == series.key) return;
  pair_effort(law_, values(p), s.start, s.delay, records_[record], series.pressure, series.effort);
  series.key = std::move(key);
}

void PairProblem::predict(std::span<const double> p, std::span<double> effort) {
  std::size_t row = 0;
  for (std::size_t k = 0; k < records_.size(); ++k) {
    simulate(p, k);
    const PairSensors s = sensors(p, k);
    for (const double each : series_[k].effort) effort[row++] = s.bias + s.gain * each;
  }
}

void PairProblem::residuals(std::span<const double> p, std::span<const PairRows> rows,
                            std::vector<double>& out) {
  out.clear();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    simulate(p, k);
    const PairSensors s = sensors(p, k);
    for (const std::size_t i : rows[k])
      out.push_back(s.bias + s.gain * series_[k].effort[i] - records_[k].effort[i]);
  }
}

std::vector<double> PairProblem::settled(std::span<const PairRows> rows, const Solution& known) {
  std::vector<double> all;
  std::vector<Parameter> own;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto at = std::ranges::find(known.estimates, parameters_[i].name, &Estimate::name);
    all.push_back(at == known.estimates.end() ? parameters_[i].start : at->value);
    if (at != known.estimates.end()) continue;
    own.push_back(parameters_[i]);
    place.push_back(i);
  }
  std::vector<double> made;
  const auto put = [&](std::span<const double> p) {
    for (std::size_t i = 0; i < place.size(); ++i) all[place[i]] = p[i];
    residuals(all, rows, made);
  };
  const auto model = [&](std::span<const double> p, std::span<double> r) {
    put(p);
    std::ranges::copy(made, r.begin());
    return true;
  };
  residuals(all, rows, made);
  FitProblem problem{.residuals = model,
                     .count = made.size(),
                     .parameters = own,
                     .options = {.difference = smooth}};
  put(least_squares_within(problem).values);
  return all;
}

FitProblem PairProblem::fit(std::span<const PairRows> rows, const Constraints& constraints) const {
  FitProblem out{.parameters = parameters_, .options = pair_options, .constraints = constraints};
  for (const PairRows& r : rows) out.count += r.size();
  out.residuals = [own = *this, rows = std::vector<PairRows>(rows.begin(), rows.end()),
                   made = std::vector<double>()](std::span<const double> p,
                                                 std::span<double> r) mutable {
    own.residuals(p, rows, made);
    std::ranges::copy(made, r.begin());
    return true;
  };
  return out;
}

using Selection = std::vector<PairRows>;  // one for each recording

constexpr const char* effort_of(bool rotary) { return rotary ? "torque" : "force"; }

double square_sum(const Solution& s) {
  return s.rms * s.rms * static_cast<double>(s.residuals.size());
}

// A law that was fitted, with its results.
struct Fitted {
  Fit fit;
  FitProblem thinned;  // for the thinned recordings, within the bounds that were widened
  Solution solution;   // for all samples
  std::vector<double> values;
};

class Pair {
 public:
  Pair(std::span<const PairRecord> records, const PairOptions& options) : options_(options) {
    for (const PairRecord& r : records) (r.held_out ? others_ : fitted_).push_back(r);
    if (fitted_.empty())
      throw Refusal("data", "every recording held out", "one at least to fit", "");
    for (const PairRecord& r : fitted_) {
      thinned_.push_back(pair_thinned(r));
      thinned_rows_.push_back(
          pair_rows(thinned_.back(), options.held_out_from, options.held_out_to, false));
      rows_.push_back(pair_rows(r, options.held_out_from, options.held_out_to, false));
      held_out_rows_.push_back(pair_rows(r, options.held_out_from, options.held_out_to, true));
      refuse_too_few(r, rows_.back());
      for (const double f : r.effort) full_scale_ = std::max(full_scale_, std::abs(f));
    }
  }

  // Fits the laws, each to thinned recordings first.
  std::vector<Fitted> fit(std::span<const PairLaw* const> laws) const {
    std::vector<Candidate> candidates;
    for (const PairLaw* law : laws) candidates.push_back(candidate_of(*law));
    Report report{.full_scale = full_scale_};
    fit_candidates(std::move(candidates), blocks_of_time(), report);
    std::vector<Fitted> out;
    for (Fit& fit : report.fits) out.push_back({.fit = std::move(fit)});
    host::side_by_side(out.size(), [&](std::size_t k) { fit_all_samples(*laws[k], out[k]); });
    return out;
  }

  // A delay shifts kinks across samples, so the residuals are rough in it and the slope at the
  // optimum gives too narrow an interval. The interval is widened to all delays of a grid for which
  // the other parameters leave an error that is hardly larger.
  void widen_delays(Fitted& fitted) const {
    constexpr double step = 0.02;
    for (std::size_t i = 0; i < fitted.values.size(); ++i) {
      Estimate& e = fitted.fit.parameters[i];
      if (!e.name.starts_with("delay") || !e.free || e.at_bound) continue;
      FitProblem thinned = fitted.thinned;
      start_at(fitted.values, thinned);
      const Solution best = least_squares(thinned);
      const double t = t_quantile(std::max(1, best.freedom));
      const double more = t * t * std::pow(best.standard_deviation, 2) * best.inflation;
      const auto [low, high] = std::pair(thinned.parameters[i].low, thinned.parameters[i].high);
      for (double delay = low; delay < high + 0.5 * step; delay += step) {
        if (delay > e.low && delay < e.high) continue;
        thinned.constraints =
            fitted.thinned.constraints.with_frozen(e.name, std::clamp(delay, low, high));
        if (square_sum(least_squares(thinned)) - square_sum(best) > more) continue;
        e.low = std::min(e.low, delay);
        e.high = std::max(e.high, delay);
      }
      e.identifiable = e.high - e.low < most_delay;
    }
  }

  // Returns the rows; recordings that are held out follow those that are fitted.
  Rows rows() const {
    Rows out{.x = "time", .x_unit = "s"};
    const auto add = [&](const PairRecord& r, const PairRows* unseen) {
      out.add(r.time, r.effort, r.file);
      out.held_out.resize(out.size(), unseen == nullptr);
      const std::size_t from = out.size() - r.size();
      for (std::size_t i = 0; unseen && i < unseen->size(); ++i)
        out.held_out[from + (*unseen)[i]] = true;
    };
    for (std::size_t k = 0; k < fitted_.size(); ++k) add(fitted_[k], &held_out_rows_[k]);
    for (const PairRecord& r : others_) add(r, nullptr);
    return out;
  }

  std::string held_out_is() const {
    std::string out;
    const double from = options_.held_out_from, to = options_.held_out_to;
    if (from <= to)
      out = !std::isfinite(to)     ? fmt::format("each recording from {:g} s on", from)
            : !std::isfinite(from) ? fmt::format("each recording up to {:g} s", to)
                                   : fmt::format("{:g} to {:g} s of each recording", from, to);
    for (const PairRecord& r : others_) out += (out.empty() ? "" : ", ") + r.file;
    return out;
  }

  std::span<const PairRecord> fitted() const { return thinned_; }
  std::span<const PairRows> fitted_rows() const { return thinned_rows_; }
  double full_scale() const { return full_scale_; }

 private:
  static void refuse_too_few(const PairRecord& r, const PairRows& rows) {
    constexpr std::size_t least = 50;
    if (rows.size() < least)
      throw Refusal(r.file, fmt::format("{} samples that are not held out", rows.size()),
                    fmt::format("at least {}", least), "another time to hold out");
  }

  // The effort follows the position: a viscous loss resembles an effort that leads it, k x(t +
  // c/k), so a delay below zero is left to constraints.
  Candidate candidate_of(const PairLaw& law) const {
    Candidate out{.model = law.name,
                  .law = law.law,
                  .source = law.source,
                  .search_tolerance = 0,
                  .options = pair_options,
                  .constraints = options_.constraints,
                  .may_be_at_bounds = true};
    try {
      PairProblem problem(law, thinned_);
      out.parameters = problem.parameters();
      for (Parameter& p : out.parameters)
        if (p.name.starts_with("delay") && !options_.constraints.of(p.name)) p.low = 0;
      out.starts = problem.starts();
      out.predict = [problem](std::span<const double> p, std::span<double> effort) mutable {
        problem.predict(p, effort);
        return true;
      };
    } catch (const Refusal& e) {
      out.refused = e.what();
    }
    return out;
  }

  // Each block of time is predicted from the others, in all thinned recordings together.
  Trial blocks_of_time() const {
    Trial out{.splits = std::vector<Split>(pair_blocks), .cross_validates = true};
    for (std::size_t k = 0; k < thinned_.size(); ++k) {
      const std::size_t first = out.measured.size();
      const auto add = [first](const PairRows& from, std::vector<std::size_t>& to) {
        for (const std::size_t i : from) to.push_back(first + i);
      };
      add(thinned_rows_[k], out.rows);
      for (std::size_t b = 0; b < pair_blocks; ++b) {
        add(pair_block(thinned_rows_[k], b, false), out.splits[b].fitted);
        add(pair_block(thinned_rows_[k], b, true), out.splits[b].held_out);
      }
      const std::vector<double>& effort = thinned_[k].effort;
      out.measured.insert(out.measured.end(), effort.begin(), effort.end());
    }
    return out;
  }

  // Fits all samples, from the solution for the thinned recordings and within its bounds.
  void fit_all_samples(const PairLaw& law, Fitted& out) const {
    if (!out.fit.refused.empty()) return;
    out.thinned = out.fit.refit->problem;
    try {
      PairProblem problem(law, fitted_);
      FitProblem all = problem.fit(rows_, out.thinned.constraints);
      all.parameters = out.thinned.parameters;
      start_at(out.fit.refit->solution.values, all);
      out.solution = least_squares(all);
      out.values = out.solution.values;
      out.fit.parameters = out.solution.estimates;
      score_samples(law, problem, out);
      judge(law, out.fit);
    } catch (const Refusal& e) {
      out.fit.refused = e.what();
    }
  }

  // Scores the fitted samples, and with those that are held out also held-out recordings, of which
  // only their own parameters - bias, start - are fitted.
  void score_samples(const PairLaw& law, PairProblem& problem, Fitted& out) const {
    Selection all;
    for (const PairRecord& r : fitted_) all.push_back(pair_rows(r, -unbounded, unbounded, true));
    std::vector<double>& residuals = out.fit.residuals;
    problem.residuals(out.values, all, residuals);
    for (const PairRecord& other : others_) {
      const std::vector<double> r = residuals_of_other(law, out, other);
      residuals.insert(residuals.end(), r.begin(), r.end());
    }
    const Rows shown = rows();
    std::array<std::vector<double>, 2> part, measured;  // fitted, and held out
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      part[shown.held_out[i]].push_back(residuals[i]);
      measured[shown.held_out[i]].push_back(shown.measured[i]);
    }
    out.fit.fit = score(part[0], full_scale_, measured[0]);
    if (part[1].empty()) return;
    // Errors on what was held out of every fit: they are larger than those on blocks of the fitted
    // time where the pair behaves differently.
    out.fit.held_out = score(part[1], full_scale_, measured[1]);
    out.fit.band = band_of(part[1]);
  }

  // Returns the residuals of another recording with the identified physics and sensors of its rig.
  // Its bias, its start, and the sensors of an unknown rig are fitted.
  std::vector<double> residuals_of_other(const PairLaw& law, const Fitted& known,
                                         const PairRecord& other) const {
    std::vector<PairRecord> all = fitted_;
    all.push_back(other);
    PairProblem problem(law, all, fitted_.size());
    Selection rows(fitted_.size());
    rows.push_back(pair_rows(other, -unbounded, unbounded, true));
    std::vector<double> r;
    problem.residuals(problem.settled(rows, known.solution), rows, r);
    return r;
  }

  // Notes implausible and undetermined parameters of the law.
  void judge(const PairLaw& law, Fit& fit) const {
    std::string at_bound, unknown;
    for (const Estimate& e : fit.parameters) {
      const bool physics = e.name == "stiffness" || e.name == "area" || e.name == "viscous" ||
                           e.name == "mass" || e.name == "inertia" || e.name == "friction" ||
                           e.name == "fade_time";
      if (e.free && e.at_bound && physics) at_bound += (at_bound.empty() ? "" : ", ") + e.name;
      if (e.free && (e.name == "stiffness" || e.name == "area") && !e.identifiable)
        unknown += (unknown.empty() ? "" : " and ") + e.name;
      if (e.name.starts_with("delay") && e.free && e.at_bound && e.value == 0)
        fit.notes.push_back(e.name +
                            ": the data push it below zero, where the effort would lead the "
                            "position; it stays 0. A loss that the law lacks looks like this; for "
                            "a position sensor that is late, freeze a delay below zero");
      if (e.name == "presliding" && e.free && (e.at_bound || !(e.low > 0)))
        fit.notes.push_back(
            "presliding: not distinguished from none; it slips within what the position resolves");
      if (e.name == "fade_time")
        fit.notes.push_back(
            "fade_time: how soon nothing is known of the friction of a pair that "
            "stands still; a property of the motion, not of a material");
    }
    if (!at_bound.empty()) fit.not_chosen = at_bound + " at the bound of its range";
    if (law.spring && law.air &&
        (!unknown.empty() || at_bound.find("stiffness") != at_bound.npos ||
         at_bound.find("area") != at_bound.npos))
      fit.not_chosen =
          "stiffness and area cannot be separated: the pressures follow the position; "
          "freeze one of them";
  }

  const PairOptions& options_;
  std::vector<PairRecord> fitted_, others_;
  Selection rows_, held_out_rows_;  // for the fitted recordings
  std::vector<PairRecord> thinned_;
  Selection thinned_rows_;
  double full_scale_ = 0;
};

std::vector<const PairLaw*> laws_of(std::string_view model, std::span<const PairRecord> records) {
  std::vector<const PairLaw*> out;
  const bool pressures =
      std::ranges::all_of(records, [](const PairRecord& r) { return !r.pressure.empty(); });
  for (const PairLaw& law : pair_laws())
    if (model.empty() ? pressures || !law.air : model == law.name) out.push_back(&law);
  if (out.empty()) throw std::invalid_argument(fmt::format("no model {}", model));
  return out;
}

void check_constraints(const Pair& pair, const Constraints& constraints, bool pressures) {
  if (constraints.empty()) return;
  std::vector<Parameter> all;
  for (const PairLaw& law : pair_laws()) {
    if (law.air && !pressures) continue;
    const PairProblem problem(law, pair.fitted());
    all.insert(all.end(), problem.parameters().begin(), problem.parameters().end());
  }
  if (pressures)
    for (Parameter& p : pair_air_parameters(pair.fitted())) all.push_back(std::move(p));
  constraints.check(all);
}

// Returns the stiffness with the part that the moving air adds.
PairStiffness stiffness_of(const PairLaw& law, const Fitted& fitted,
                           const std::optional<PairAir>& air) {
  const double per = air ? air->per_position : 0;
  const Solution& s = fitted.solution;
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(s.estimates, name, &Estimate::name) -
                                    s.estimates.begin());
  };
  const std::size_t n = s.values.size(), k = place("stiffness"), a = place("area");
  const auto cov = [&](std::size_t i, std::size_t j) { return s.covariance[i * n + j]; };
  PairStiffness out{.air = std::numeric_limits<double>::quiet_NaN()};
  double variance = 0;
  if (law.spring) out.value += s.values[k], variance += cov(k, k);
  if (law.air) {
    out.air = per * s.values[a];
    out.value += out.air;
    variance += per * per * cov(a, a);
  }
  if (law.spring && law.air) variance += 2 * per * cov(k, a);
  out.uncertainty = t_quantile(std::max(1, s.freedom)) * std::sqrt(std::max(variance, 0.0));
  return out;
}

void refuse_mixed(std::span<const PairRecord> records) {
  if (records.empty()) throw Refusal("data", "no recording", "one at least", "");
  for (const PairRecord& r : records)
    if (r.rotary != records[0].rotary)
      throw Refusal(r.file,
                    fmt::format("{}; {} has {}", effort_of(r.rotary), records[0].file,
                                effort_of(records[0].rotary)),
                    "recordings of slides, or of joints", "");
}

void add_separation_notes(const PairResult& found, Report& report) {
  if (found.sensors.size() == 1 || report.fits.empty())
    report.notes.push_back(
        "gain: that of one rig cannot be separated from its stiffness, friction and losses; it "
        "counts "
        "as 1");
  if (!found.air) return;
  const bool apart = found.law.air && found.law.spring;
  if (!apart)
    report.notes.push_back(
        fmt::format("elastic and trapped-air stiffness are known together only, {:.4g} {}: the "
                    "pressures follow "
                    "the position by {:.4g} Pa/{}; freeze area or stiffness to separate them",
                    found.stiffness.value, found.rotary ? "N m/rad" : "N/m",
                    found.air->per_position, found.rotary ? "rad" : "m"));
}

}  // namespace

std::vector<std::string> pair_models() { return names_of_laws(pair_laws()); }

PairResult identify_pair(std::span<const PairRecord> records, const PairOptions& options) {
  refuse_mixed(records);
  const Pair pair(records, options);
  const std::vector<const PairLaw*> laws = laws_of(options.model, records);
  const bool pressures = !records[0].pressure.empty();
  check_constraints(pair, options.constraints, pressures);

  PairResult out{.rotary = records[0].rotary};
  Report& report = out.report;
  report.set_subject("sealed pair that is moved", effort_of(out.rotary), out.rotary ? "N m" : "N",
                     fmt::format("the largest {}", effort_of(out.rotary)));
  report.full_scale = pair.full_scale();
  report.held_out_is = pair.held_out_is();
  report.not_shown = {
      "the pair at other trapped pressures, and faster or slower than it was moved"};
  for (const PairRecord& r : records)
    report.notes.insert(report.notes.end(), r.notes.begin(), r.notes.end());
  std::vector<Fitted> fitted = pair.fit(laws);
  for (Fitted& f : fitted) {
    // An effect may have size 0, and a bristle may be fully bent at the start.
    std::vector<std::string_view> allowed;
    for (const Estimate& e : f.fit.parameters)
      if (e.value == 0 || e.name.starts_with("start")) allowed.push_back(e.name);
    keep_off_bounds(f.fit, allowed);
    report.fits.push_back(f.fit);
  }
  report.rows = pair.rows();
  conclude(report);

  Fitted& best = fitted[report.chosen];
  best.fit = report.best();
  pair.widen_delays(best);
  report.fits[report.chosen] = best.fit;
  out.law = *laws[report.chosen];
  const PairProblem problem(out.law, pair.fitted());
  out.values = problem.values(best.values);
  for (std::size_t k = 0; k < pair.fitted().size(); ++k)
    out.sensors.push_back(
        {pair.fitted()[k].file, pair.fitted()[k].rig, problem.sensors(best.values, k)});
  if (pressures)
    out.air = identify_pair_air(pair.fitted(), pair.fitted_rows(), options.constraints);
  out.stiffness = stiffness_of(out.law, best, out.air);
  add_separation_notes(out, report);
  return out;
}

}  // namespace sinew::identify
