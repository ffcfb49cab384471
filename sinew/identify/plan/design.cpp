#include "sinew/identify/plan/design.h"

#include <algorithm>
#include <cmath>

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

}  // namespace sinew::identify
