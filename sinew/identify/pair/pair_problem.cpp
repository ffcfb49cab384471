#include "sinew/identify/pair/pair_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

// A sensor that lags more is no sensor of this motion.
constexpr double most_delay = 0.1;

// Where kinks stop a search it would go on for long and win nothing.
constexpr int most_steps = 25;

// Friction that starts and ends to slip is a kink in everything; steps of the derivatives, in
// scales of the parameters, that see across it.
constexpr double smooth = 0.02;

double largest_size(std::span<const double> values) {
  return std::max(std::abs(largest(values)), std::abs(smallest(values)));
}

double range_of(std::span<const double> values) { return largest(values) - smallest(values); }

// Slope of the effort over the position.
double slope_of(const PairRecord& r) {
  double mx = 0, my = 0, xy = 0, xx = 0;
  const auto n = static_cast<double>(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) mx += r.at[i] / n, my += r.effort[i] / n;
  for (std::size_t i = 0; i < r.size(); ++i) {
    xy += (r.at[i] - mx) * (r.effort[i] - my);
    xx += (r.at[i] - mx) * (r.at[i] - mx);
  }
  return xy / xx;
}

// Which way it goes first by a hundredth of its range.
double first_way(const PairRecord& r) {
  const double enough = 0.01 * range_of(r.at);
  for (const double x : r.at)
    if (std::abs(x - r.at[0]) > enough) return x > r.at[0] ? 1 : -1;
  return 1;
}

}  // namespace

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
    stiffness += slope_of(r) / static_cast<double>(records.size());
    if (std::ranges::find(rigs_, r.rig) == rigs_.end()) rigs_.push_back(r.rig);
    rig_.push_back(static_cast<std::size_t>(std::ranges::find(rigs_, r.rig) - rigs_.begin()));
  }
  stiffness = std::max(stiffness, 0.01 * effort_ / range_);
  add_physics(stiffness);
  add_sensors(stiffness, fitted > 0 ? fitted : records.size());
}

// Scales are changes that are a tenth of the effort.
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
      {"presliding", at, 0.01 * range_, std::min(finest, 1e-3 * range_), 2 * range_, 0.01 * range_},
      &PairValues::presliding);
  add(law_.friction == PairFriction::fading,
      {"fade_time", "s", 0.05 * duration_, 2 * least, 100 * duration_, 0.05 * duration_},
      &PairValues::fade_time);
}

void PairProblem::add_sensors(double stiffness, std::size_t fitted) {
  const bool one_rig = std::ranges::count(std::span(rig_).first(fitted), rig_[0]) ==
                       static_cast<std::ptrdiff_t>(fitted);
  // "delay of a rig", or "delay" where it is the only one.
  const auto named = [](const char* name, const std::string& whose, bool alone) {
    return alone ? std::string(name) : fmt::format("{} of {}", name, whose);
  };
  for (std::size_t i = 0; i < rigs_.size(); ++i) {
    delay_.push_back(parameters_.size());
    parameters_.push_back(
        {named("delay", rigs_[i], one_rig && i == 0), "s", 0, -most_delay, most_delay, 0.05});
    gain_.push_back(i == 0 ? 0 : parameters_.size());
    if (i > 0) parameters_.push_back({named("gain", rigs_[i], false), "1", 1, 0.01, 100, 0.1});
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
  std::vector<double> first;
  for (const Parameter& p : parameters_) first.push_back(p.start);
  std::vector<std::vector<double>> out{first};
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

// A recording whose parameters have not changed since the last call is not simulated again.
void PairProblem::simulate(std::span<const double> p, std::size_t record) {
  const PairSensors s = sensors(p, record);
  std::vector<double> key(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(physics_.size()));
  key.insert(key.end(), {s.start, s.delay});
  Series& series = series_[record];
  if (key == series.key) return;
  pair_effort(law_, values(p), s.start, s.delay, records_[record], series.pressure, series.effort);
  series.key = std::move(key);
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
  put(least_squares(model, made.size(), own, {.difference = smooth}).values);
  return all;
}

Solution PairProblem::solve_with(std::span<const PairRows> rows, const std::vector<double>& start,
                                 const Wishes& wishes, std::size_t i, double value) {
  return solve(rows, {{start}}, wishes.with_frozen(parameters_[i].name, value), false);
}

// Their size is known from a start only.
bool PairProblem::scaled_by_start(std::size_t i) const {
  return i < physics_.size() &&
         (physics_[i] == &PairValues::presliding || physics_[i] == &PairValues::fade_time);
}

Solution PairProblem::solve(std::span<const PairRows> rows,
                            std::span<const std::vector<double>> starts, const Wishes& wishes,
                            bool correlated) {
  std::vector<double> made;
  std::size_t count = 0;
  for (const PairRows& r : rows) count += r.size();
  const auto model = [&](std::span<const double> p, std::span<double> r) {
    residuals(p, rows, made);
    std::ranges::copy(made, r.begin());
    return true;
  };
  std::optional<Solution> best;
  std::vector<Parameter> from = parameters_;
  for (const std::vector<double>& start : starts) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      from[i].start = std::clamp(start[i], from[i].low, from[i].high);
      if (scaled_by_start(i)) from[i].scale = from[i].start;
    }
    Solution s =
        least_squares(model, count, from, wishes,
                      {.correlated = correlated, .most_steps = most_steps, .difference = smooth});
    if (!best || s.rms < best->rms) best = std::move(s);
  }
  return std::move(*best);
}

}  // namespace sinew::identify
