// air/regulator_lanes.h - muscles behind pressure regulators, integrated ahead of a calm step four
// at a time. They take one step of RODAS3 (stiff/quick.h), as in quick_bodies.h, with a pack in the
// place of each number.
//
// State per muscle: the mass m of its air.
//
//   m' = f(y_outlet(t), y(m/V(t)))    V linear over the step; the outlet follows its lag
//
// A lane whose step is not calm, or that leaves a series' range, is reported, and the caller
// integrates that muscle alone. The result of a lane does not depend on the others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sinew/air/braid_lanes.h"
#include "sinew/air/lanes.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/power_series.h"
#include "sinew/units/pack.h"

namespace sinew::air {

class RegulatorLanes {
 public:
  // Four muscles at the node, a lane each, and the outlets of their regulators.
  struct Inputs {
    const double *length, *rate, *mass, *y_ref, *inverse_sigma;
    alignas(64) double set[lanes];             // set point of the outlet [Pa]
    alignas(64) double off[lanes];             // deviation of the outlet from it at the node [Pa]
    alignas(64) double outlet_y[lanes];        // base of the outlet's series
    alignas(64) double outlet_inverse[lanes];  // [1/Pa]
  };
  struct Outputs {
    alignas(64) double half[lanes], full[lanes];  // masses at the half and at the end [kg]
    alignas(64) double in[lanes], out[lanes];     // through the regulators within the step [kg]
    std::uint64_t calm;                           // a bit for each lane whose step is valid
  };

  RegulatorLanes() = default;
  // `valves`: the inlet of each muscle of the braids; those that are not regulators are ignored.
  RegulatorLanes(const BraidLanes& braids, std::span<const gas::Valve> valves, const gas::Air& air);

  // Integrates through a step of length h, with the supply at y; `first` is the first of the four.
  void integrate(int first, double h, double y_supply, const Inputs& in,
                 Outputs& out) const noexcept;

 private:
  struct alignas(64) Constants {
    BraidConstants<units::Pack<lanes>> braid;
    gas::FlowConstantsOf<units::Pack<lanes>> flow;
    units::Pack<lanes> inverse_lag;  // one over the regulator's time constant; 0: no lag [1/s]
  };

  gas::PowerSeries of_density_;
  std::vector<Constants> constants_;  // for each group of four lanes
};

}  // namespace sinew::air
