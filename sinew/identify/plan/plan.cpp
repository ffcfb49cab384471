#include "sinew/identify/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

constexpr int length_candidates = 14, pressure_candidates = 12;  // approximate numbers
constexpr int places_along = 11, places_up = 7;                  // numbers of places in the region
constexpr double pulls_above = 0.01;  // share of the largest force; below it a reading may be slack

// Returns the largest of 1, 2, 5 times a power of ten that does not exceed `most`.
double round_step(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  const double times = most / power;
  return power * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

}  // namespace

std::vector<double> round_steps(double low, double high, int count) {
  const double step = round_step((high - low) / (count - 1));
  std::vector<double> out{high};
  // The first step below the end is to a multiple of the step.
  for (double x = step * std::ceil(high / step - 1.0 + 1e-9); x > low - 1e-9 * step;
       x = step * std::round(x / step - 1.0))
    if (high - x > 0.5 * step) out.push_back(x);
  if (out.back() - low >= 0.5 * step) out.push_back(low);
  std::ranges::reverse(out);
  return out;
}

DesignSpace::DesignSpace(const ExpectedMuscle& muscle, const PlanRegion& region,
                         const PlanOptions& options)
    : muscle_(muscle),
      options_(options),
      law_(options.law_error * muscle.scales.full_scale),
      lengths_(round_steps(region.shortest, region.longest, length_candidates)),
      pressures_(round_steps(region.lowest, region.highest, pressure_candidates)) {
  for (int i = 0; i < places_along; ++i)
    for (int k = 0; k < places_up; ++k) {
      const double x = i / (places_along - 1.0), y = k / (places_up - 1.0);
      const double length = region.shortest + x * (region.longest - region.shortest);
      const double pressure = region.lowest + y * (region.highest - region.lowest);
      if (expected_force(muscle, length, pressure) > 0)
        places_.push_back(slopes_at(muscle, length, pressure));
    }
}

std::vector<double> DesignSpace::even_pressures(double length, std::size_t count) const {
  std::vector<double> pull;
  for (const double p : pressures_)
    if (expected_force(muscle_, length, p) > pulls_above * muscle_.scales.full_scale)
      pull.push_back(p);
  if (pull.size() <= count) return pull;
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(pull[(i * (pull.size() - 1) + (count - 1) / 2) / (count - 1)]);
  return out;
}

// Errors common to a mount's readings: of its length, and of the law's form there.
PlannedReading DesignSpace::reading(double length, double pressure, Branch branch) const {
  PlannedReading out{.slopes = slopes_at(muscle_, length, pressure, branch), .shared = {0, 0}};
  if (expected_force(muscle_, length, pressure, branch) > 0)
    out.shared = {options_.length_error * slope_over_length(muscle_, length, pressure), law_};
  return out;
}

const PlannedReading& DesignSpace::candidate(double length, double pressure, Branch branch) const {
  const auto key = std::tuple(length, pressure, branch);
  const auto known = readings_.find(key);
  if (known != readings_.end()) return known->second;
  return readings_.emplace(key, reading(length, pressure, branch)).first->second;
}

Information DesignSpace::before() const { return Information(deviations_before(muscle_)); }

Information DesignSpace::of(double length, std::span<const double> pressures) const {
  std::vector<PlannedReading> readings;
  for (const double p : pressures) readings.push_back(candidate(length, p, Branch::fill));
  for (const double p : pressures)
    if (p != pressures.back()) readings.push_back(candidate(length, p, Branch::vent));
  return Information::of_mount(readings, options_.noise, muscle_.free_parameters.size());
}

Information DesignSpace::of(const MeasuredMount& mount) const {
  std::vector<PlannedReading> readings;
  for (const StaticPoint& p : mount.points)
    readings.push_back(reading(p.length, p.pressure, p.branch));
  return Information::of_mount(readings, options_.noise, muscle_.free_parameters.size());
}

PlanError DesignSpace::error(const Information& information) const {
  double sum = 0, most = 0;
  for (const double variance : information.variances(places_)) {
    sum += variance / static_cast<double>(places_.size());
    most = std::max(most, variance);
  }
  const double full = muscle_.scales.full_scale;
  return {.rms = std::sqrt(sum + law_ * law_) / full,
          .half_width = 1.96 * std::sqrt(most + law_ * law_) / full};
}

namespace {

constexpr std::string_view richest = "saturating-effectiveness";
constexpr double likely_threshold = 5e4, most_threshold = 0.3;  // [Pa], share of the top pressure
constexpr double likely_share = 0.2;  // saturating tension, share of the largest force

std::vector<FreeParameter> free_parameters_to_fit(const StaticScales& scales, bool branches) {
  std::vector<FreeParameter> out;
  for (const StaticModel& model : static_models())
    if (model.name == richest) out = free_parameters_of(model, scales);
  if (branches) out.push_back(FreeParameter::half_width);
  return out;
}

StaticPoint point_at(const ExpectedMuscle& m, double length, double pressure, Branch branch) {
  return {.length = length,
          .pressure = pressure,
          .rest_length = m.scales.rest_length,
          .branch = branch};
}

}  // namespace

ExpectedMuscle muscle_by_size(double rest_length, double diameter, double top_pressure,
                              double atmosphere) {
  ExpectedMuscle out;
  StaticScales& s = out.scales;
  s = {.rest_length = rest_length, .top_pressure = top_pressure, .atmosphere = atmosphere};
  // Braid: the likely thread, and the turns that give the diameter at the rest length.
  const double b = prior_of(FreeParameter::thread_length, s)->mean;
  const double turns = std::sqrt(b * b - rest_length * rest_length) / (std::numbers::pi * diameter);
  const double acts = std::min(likely_threshold, most_threshold * top_pressure);
  s.full_scale = (top_pressure - acts) * (3 * rest_length * rest_length - b * b) /
                 (4 * std::numbers::pi * turns * turns);
  out.setting = setting_of(s);
  actuator::Actuator& a = out.setting.actuator;
  a.braid = {b, turns};
  a.effectiveness.threshold = acts;
  a.bladder.stiffness = prior_of(FreeParameter::stiffness, s)->mean;
  a.bladder.saturating_tension = likely_share * s.full_scale;
  a.bladder.saturation_length = prior_of(FreeParameter::saturation_length, s)->mean;
  a.hysteresis.half_width = parameter_of(FreeParameter::half_width, s).start;
  out.free_parameters = free_parameters_to_fit(s, true);
  return out;
}

ExpectedMuscle muscle_by_actuator(const actuator::Actuator& actuator, double rest_length,
                                  double top_pressure, double atmosphere) {
  ExpectedMuscle out;
  StaticScales& s = out.scales;
  s = {.rest_length = rest_length, .top_pressure = top_pressure, .atmosphere = atmosphere};
  s.full_scale = actuator::tension(actuator, rest_length, 0, top_pressure, atmosphere);
  if (!(s.full_scale > 0))
    throw Refusal("actuator", "a muscle that does not pull at its rest length",
                  "one that does at the highest pressure", "another rest_length, or pressure");
  // The actuator's own law, without ends, which no static law has, and without limits of validity.
  const StaticSetting plain = setting_of(s);
  out.setting.actuator = actuator;
  actuator::Actuator& a = out.setting.actuator;
  a.long_end = plain.actuator.long_end;
  a.effectiveness.valid_from = plain.actuator.effectiveness.valid_from;
  a.effectiveness.valid_to = plain.actuator.effectiveness.valid_to;
  a.bladder.valid_from = plain.actuator.bladder.valid_from;
  a.bladder.valid_to = plain.actuator.bladder.valid_to;
  if (!(a.bladder.rest_length > 0)) a.bladder.rest_length = rest_length;
  if (!(a.bladder.saturation_length > 0))
    a.bladder.saturation_length = plain.actuator.bladder.saturation_length;
  out.setting.end_loss = (1 - a.effectiveness.scale) * rest_length;
  out.free_parameters = free_parameters_to_fit(s, true);
  return out;
}

FittedMuscle muscle_by_points(std::span<const StaticPoint> points, double atmosphere,
                              const std::optional<actuator::Braid>& braid) {
  bool branches = false;
  for (const StaticPoint& p : points) {
    branches |= p.branch == Branch::vent;
    if (std::abs(p.rest_length - points.front().rest_length) > 1e-6)
      throw Refusal("rest_length",
                    fmt::format("muscles of {:.4g} and {:.4g} mm", 1e3 * points.front().rest_length,
                                1e3 * p.rest_length),
                    "points of one muscle: a plan is for one",
                    "where=\"rest_length=250\", or the file of one");
  }
  FittedMuscle out;
  out.muscle.scales = scales_of({points.begin(), points.end()}, atmosphere, braid);
  out.muscle.free_parameters = free_parameters_to_fit(out.muscle.scales, branches);
  const StaticFit fit = fit_static(out.muscle.free_parameters, points, out.muscle.scales);
  out.muscle.setting = fit.setting;
  out.scatter = fit.scatter;
  return out;
}

double expected_force(const ExpectedMuscle& m, double length, double pressure, Branch branch) {
  return predicted(m.setting, m.scales, point_at(m, length, pressure, branch));
}

double free_length(const ExpectedMuscle& m) {
  double slack = 0.4 * m.scales.rest_length, taut = m.scales.rest_length;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (slack + taut);
    (expected_force(m, middle, m.scales.top_pressure) > 0 ? taut : slack) = middle;
  }
  return taut;
}

std::vector<double> slopes_at(const ExpectedMuscle& m, double length, double pressure,
                              Branch branch) {
  const StaticPoint point = point_at(m, length, pressure, branch);
  std::vector<double> out;
  StaticSetting moved = m.setting;
  for (const FreeParameter free_parameter : m.free_parameters) {
    constexpr double share = 1e-3;
    double& value = value_of(moved, free_parameter);
    const double was = value, step = share * parameter_of(free_parameter, m.scales).scale;
    value = was + step;
    const double above = predicted(moved, m.scales, point);
    value = was - step;
    const double below = predicted(moved, m.scales, point);
    value = was;
    out.push_back((above - below) / (2 * share));
  }
  return out;
}

double slope_over_length(const ExpectedMuscle& m, double length, double pressure) {
  const double step = 1e-5 * m.scales.rest_length;
  return (expected_force(m, length + step, pressure) - expected_force(m, length - step, pressure)) /
         (2 * step);
}

std::vector<double> deviations_before(const ExpectedMuscle& m) {
  std::vector<double> out;
  StaticSetting setting = m.setting;
  for (const FreeParameter free_parameter : m.free_parameters) {
    const Parameter range = parameter_of(free_parameter, m.scales);
    double deviation = (range.high - range.low) / std::sqrt(12.0);  // uniform over the range
    if (const auto prior = prior_of(free_parameter, m.scales))
      deviation = prior->deviation_at(value_of(setting, free_parameter));
    out.push_back(deviation / range.scale);
  }
  return out;
}

namespace {

constexpr std::size_t fewest_levels = 3, most_levels = 8;
constexpr double worth_it = 0.999;  // share of the error; a change that gains less is not made

// A set of mounts that is improved by exchanges.
class Search {
 public:
  Search(const DesignSpace& space, const Information& begin, const PlanOptions& options,
         std::size_t levels)
      : space_(space), begin_(begin), options_(options) {
    for (const double length : space.lengths()) {
      std::vector<double> pressures = space.even_pressures(length, levels);
      if (pressures.size() < 2) continue;  // hardly pulls there
      const Information own = space.of(length, pressures);
      candidates_.push_back({length, std::move(pressures), own});
    }
  }

  // Adds the candidate that helps most; returns false if no candidate is left.
  bool add() {
    const auto best = best_candidate(chosen_);
    if (!best) return false;
    chosen_.push_back(candidates_[*best]);
    return true;
  }

  // Exchanges mounts and pressures while that helps.
  void improve() {
    for (int pass = 0; pass < 10; ++pass) {
      const double before = value(chosen_);
      for (std::size_t i = 0; i < chosen_.size(); ++i) exchange_mount(i);
      for (std::size_t i = 0; i < chosen_.size(); ++i) exchange_pressures(i);
      if (value(chosen_) > worth_it * before) return;
    }
  }

  double value() const { return value(chosen_); }

  // Returns the mounts in the order of their benefit, so that a user may stop early.
  std::vector<PlannedMount> ordered() const {
    std::vector<Candidate> left = chosen_;
    Information known = begin_;
    std::vector<PlannedMount> out;
    while (!left.empty()) {
      const auto best = std::ranges::min_element(
          left, {}, [&](const Candidate& c) { return value_of(sum(known, c)); });
      known += best->own;
      PlannedMount mount{.length = best->length, .pressures = best->pressures};
      mount.time = options_.mount_time + static_cast<double>(mount.readings()) * options_.step_time;
      mount.after = space_.error(known);
      out.push_back(mount);
      left.erase(best);
    }
    return out;
  }

 private:
  struct Candidate {
    double length = 0;
    std::vector<double> pressures;
    Information own;
  };

  static Information sum(Information known, const Candidate& more) { return known += more.own; }

  double value_of(const Information& known) const {
    return space_.error(known).of(options_.criterion);
  }

  double value(const std::vector<Candidate>& set) const {
    Information known = begin_;
    for (const Candidate& c : set) known += c.own;
    return value_of(known);
  }

  // Returns the best candidate to add, from lengths that are not in the set.
  std::optional<std::size_t> best_candidate(const std::vector<Candidate>& set) const {
    Information known = begin_;
    for (const Candidate& c : set) known += c.own;
    std::optional<std::size_t> best;
    double least = 0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (std::ranges::find(set, candidates_[i].length, &Candidate::length) != set.end()) continue;
      const double v = value_of(sum(known, candidates_[i]));
      if (best && v >= least) continue;
      best = i;
      least = v;
    }
    return best;
  }

  void exchange_mount(std::size_t at) {
    std::vector<Candidate> others = chosen_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    const auto best = best_candidate(others);
    if (!best) return;
    others.insert(others.begin() + static_cast<std::ptrdiff_t>(at), candidates_[*best]);
    if (value(others) < worth_it * value(chosen_)) chosen_ = others;
  }

  // Returns whether the pressures are spread: close ones would not show a deviation of the law's
  // dependence on pressure.
  static bool are_spread(const std::vector<double>& pressures, double range) {
    const double least = 0.49 * range / static_cast<double>(pressures.size() - 1);
    for (std::size_t i = 1; i < pressures.size(); ++i)
      if (pressures[i] - pressures[i - 1] < least) return false;
    return true;
  }

  // Tries to exchange each pressure of a mount for each other pressure.
  void exchange_pressures(std::size_t at) {
    const std::vector<double> all =
        space_.even_pressures(chosen_[at].length, space_.pressures().size());
    for (std::size_t k = 0; k < chosen_[at].pressures.size(); ++k)
      for (const double p : all) {
        std::vector<double> pressures = chosen_[at].pressures;
        if (std::ranges::find(pressures, p) != pressures.end()) continue;
        pressures[k] = p;
        std::ranges::sort(pressures);
        if (!are_spread(pressures, all.back() - all.front())) continue;
        std::vector<Candidate> set = chosen_;
        set[at] = {set[at].length, pressures, space_.of(set[at].length, pressures)};
        if (value(set) < worth_it * value(chosen_)) chosen_ = set;
      }
  }

  const DesignSpace& space_;
  const Information& begin_;
  const PlanOptions& options_;
  std::vector<Candidate> candidates_, chosen_;
};

// Returns the mounts that reach the error with that many pressures each.
std::vector<PlannedMount> mounts_with(const DesignSpace& space, const Information& begin,
                                      const PlanOptions& options, std::size_t levels,
                                      std::size_t fewest) {
  Search search(space, begin, options, levels);
  const auto most = static_cast<std::size_t>(options.most);
  std::size_t count = 0;
  while (count < most && (count < fewest || search.value() > options.error) && search.add()) {
    ++count;
    if (count >= fewest) search.improve();
  }
  return search.ordered();
}

bool is_better(const MeasurementPlan& plan, const MeasurementPlan& than,
               const PlanOptions& options) {
  if (plan.reached != than.reached) return plan.reached;
  if (plan.reached) return plan.time() < than.time();
  return plan.after().of(options.criterion) < worth_it * than.after().of(options.criterion);
}

}  // namespace

double MeasurementPlan::time() const {
  double out = 0;
  for (const PlannedMount& m : mounts) out += m.time;
  return out;
}

std::size_t MeasurementPlan::readings() const {
  std::size_t out = 0;
  for (const PlannedMount& m : mounts) out += m.readings();
  return out;
}

PlanRegion region_of(const ExpectedMuscle& muscle) {
  const double longest = muscle.scales.rest_length, free = free_length(muscle);
  const double top = muscle.scales.top_pressure;
  return {.shortest = free + 0.1 * (longest - free),
          .longest = longest,
          .lowest = top / 6,
          .highest = top};
}

std::vector<MeasuredMount> mounts_of(std::span<const StaticPoint> points) {
  std::vector<MeasuredMount> out;
  const std::vector<double> lengths = values_of(points, &StaticPoint::length);
  if (lengths.empty()) return out;
  const std::vector<int> group =
      mount_groups(lengths, 5e-4, widest_mount * *std::ranges::max_element(lengths));
  out.resize(static_cast<std::size_t>(*std::ranges::max_element(group)) + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    MeasuredMount& mount = out[static_cast<std::size_t>(group[i])];
    mount.length += points[i].length;
    mount.points.push_back(points[i]);
  }
  for (MeasuredMount& mount : out) mount.length /= static_cast<double>(mount.points.size());
  return out;
}

MeasurementPlan plan_measurements(const ExpectedMuscle& muscle, const PlanRegion& region,
                                  const PlanOptions& options,
                                  std::span<const MeasuredMount> measured) {
  const DesignSpace space(muscle, region, options);
  Information begin = space.before();
  for (const MeasuredMount& mount : measured) begin += space.of(mount);
  MeasurementPlan best{.region = region, .before = space.error(begin)};
  best.reached = best.before.of(options.criterion) <= options.error &&
                 measured.size() >= static_cast<std::size_t>(options.fewest);
  if (best.reached) return best;
  const auto fewest =
      std::max<std::ptrdiff_t>(1, options.fewest - static_cast<std::ptrdiff_t>(measured.size()));
  const MeasurementPlan none = best;
  for (std::size_t levels = fewest_levels; levels <= most_levels; ++levels) {
    MeasurementPlan plan = none;
    plan.mounts = mounts_with(space, begin, options, levels, static_cast<std::size_t>(fewest));
    plan.reached = plan.after().of(options.criterion) <= options.error;
    if (best.mounts.empty() || is_better(plan, best, options)) best = std::move(plan);
  }
  return best;
}

}  // namespace sinew::identify
