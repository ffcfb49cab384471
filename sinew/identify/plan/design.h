// identify/plan/design.h - the search for a plan's mounts: which candidates there are, what each
// set of them is worth.
#pragma once

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "sinew/identify/plan/plan.h"

namespace sinew::identify {

// Returns round steps over a range, from the upper end downwards, some `count` of them: 250, 245,
// 240 mm. The lower end is one of them where it is half a step or more from the last.
std::vector<double> round_steps(double low, double high, int count);

// Holds what a plan is chosen from, and what a choice is worth.
class DesignSpace {
 public:
  // The muscle and the options must outlive it.
  DesignSpace(const ExpectedMuscle& muscle, const PlanRegion& region, const PlanOptions& options);

  // Returns the lengths and the pressures that may be chosen  [m], [Pa gauge], rising.
  const std::vector<double>& lengths() const { return lengths_; }
  const std::vector<double>& pressures() const { return pressures_; }

  // Returns that many pressures at which the muscle pulls at a length, evenly over them; fewer
  // where there are no more.
  std::vector<double> even_pressures(double length, std::size_t count) const;

  // Returns what is known before anything is measured, what a mount with these pressures tells, up
  // and down again, and what a measured one has told.
  Knowledge before() const;
  Knowledge of(double length, std::span<const double> pressures) const;
  Knowledge of(const MeasuredMount& mount) const;

  // Returns the error over the region where that is known.
  PlanError error(const Knowledge& knowledge) const;

 private:
  PlannedReading reading(double length, double pressure, Branch branch) const;
  const PlannedReading& candidate(double length, double pressure, Branch branch) const;

  const ExpectedMuscle& muscle_;
  const PlanOptions& options_;
  double law_ = 0;  // [N]
  std::vector<double> lengths_, pressures_;
  std::vector<std::vector<double>> places_;  // slopes over the region
  // Readings that may be chosen, each worked out once.
  mutable std::map<std::tuple<double, double, Branch>, PlannedReading> readings_;
};

}  // namespace sinew::identify
