// identify/plan/design.h - search space of a plan: candidate mounts, and the value of sets of them.
#pragma once

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "sinew/identify/plan/plan.h"

namespace sinew::identify {

// Returns about `count` round steps over a range, from the upper end downwards: 250, 245, 240 mm.
// The lower end is included if it is at least half a step from the last.
std::vector<double> round_steps(double low, double high, int count);

// Candidates of a plan, and the value of a choice.
class DesignSpace {
 public:
  // The muscle and the options must outlive this object.
  DesignSpace(const ExpectedMuscle& muscle, const PlanRegion& region, const PlanOptions& options);

  // Return the candidate lengths [m] and gauge pressures [Pa], ascending.
  const std::vector<double>& lengths() const { return lengths_; }
  const std::vector<double>& pressures() const { return pressures_; }

  // Returns up to `count` pressures at which the muscle pulls at a length, evenly spaced.
  std::vector<double> even_pressures(double length, std::size_t count) const;

  // Return the information before any measurement; that of a planned mount with these pressures,
  // rising and falling; and that of a measured mount.
  Information before() const;
  Information of(double length, std::span<const double> pressures) const;
  Information of(const MeasuredMount& mount) const;

  // Returns the error over the region with this information.
  PlanError error(const Information& information) const;

 private:
  PlannedReading reading(double length, double pressure, Branch branch) const;
  const PlannedReading& candidate(double length, double pressure, Branch branch) const;

  const ExpectedMuscle& muscle_;
  const PlanOptions& options_;
  double law_ = 0;  // [N]
  std::vector<double> lengths_, pressures_;
  std::vector<std::vector<double>> places_;  // slopes at the places of the region
  // Candidate readings, each computed once.
  mutable std::map<std::tuple<double, double, Branch>, PlannedReading> readings_;
};

}  // namespace sinew::identify
