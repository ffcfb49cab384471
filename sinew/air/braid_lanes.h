// air/braid_lanes.h - pressures and tensions of all muscles of a machine, [31]-[34] and [40] in
// lanes of four.
//
// State per muscle: the mass of its air. With sigma = m/V and x = sigma/sigma_ref - 1 the pressure
// follows from
//
//   y = (P/P_atm)^(1/7) = y_ref (1 + x)^(n/7)
//
// The power is a series (gas/power_series.h) while x is small, else units::power, or a table after
// use_power_table(). From |x| > 0.02 on the reference is set to the exact value at the next node.
// The code uses no libm and no branches between lanes: a muscle has the same bits alone and among
// others. The reference belongs to the state and is saved and restored with it.
//
// Holds for muscles for which lanes_support() is true: the thesis's law of a braid with a linear
// bladder. Other muscles use actuator/tension.h, a direct form of the same laws; a test compares
// both.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sinew/air/braid_law.h"
#include "sinew/air/lanes.h"
#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/power_series.h"

namespace sinew::air {

class BraidLanes {
 public:
  // Takes the muscles in the order of their lanes.
  BraidLanes(std::span<const Muscle> muscles, const gas::Air& air);

  int size() const { return size_; }
  int padded() const { return padded_; }  // rounded up to whole lanes, which repeat the last muscle

  const gas::PowerSeries& series() const { return series_; }  // y as a function of the density
  // Returns 1 over the density at the atmosphere [m^3/kg].
  double inverse_reference_density() const { return inverse_reference_density_; }

  // Selects a table for densities outside the series' range, for steps that often leave that range.
  void use_power_table() { table_.emplace(air_.polytropic_exponent / 7.0); }

  // Returns the reference before the first evaluation: the density at the atmosphere.
  template <int Most>
  Reference<Most> reference() const {  // at the atmosphere
    Reference<Most> r{};
    for (int i = 0; i < padded_; ++i) {
      r.y[i] = 1.0;
      r.inverse_sigma[i] = inverse_reference_density_;
    }
    return r;
  }

  // Computes all of `out`, and y, from lengths [m], rates [m/s] and masses [kg].
  template <int Most>
  void evaluate(const Lanes<Most>& length, const Lanes<Most>& rate, const Lanes<Most>& mass,
                const Reference<Most>& reference, Pull<Most>& out, Lanes<Most>& y) const noexcept {
    evaluate({length.of.data(), rate.of.data(), mass.of.data(), reference.y.of.data(),
              reference.inverse_sigma.of.data()},
             {out.tension.of.data(), out.clamped.of.data(), out.pressure.of.data(),
              out.friction_bound.of.data(), out.drift.of.data(), y.of.data()});
  }

  // Return the constants of muscle i, whether its dry friction is bounded by its sealed stiffness,
  // and whether it sticks.
  BraidConstants<double> constants(int i) const {
    return units::lane_of<BraidConstants<double>>(
        constants_[static_cast<std::size_t>(i / lanes)].law, i % lanes);
  }
  bool bound_by_sealed(int i) const;
  bool sticks(int i) const;

  // Returns y of a density by the power itself, for densities outside the series' range [-].
  double exact_y(double density) const noexcept;
  // Returns the bound of muscle i's dry friction by its sealed stiffness [N].
  double sealed_bound(int i, double length, double pressure) const noexcept;

  // Updates the references whose density has drifted; called at a node after its evaluation.
  // Returns the first muscle whose density is not valid, or -1.
  template <int Most>
  int update_references(const Lanes<Most>& drift, Reference<Most>& reference) const noexcept {
    return update_references(drift.of.data(), reference.y.of.data(),
                             reference.inverse_sigma.of.data());
  }

 private:
  // Four bundles; lanes beyond the last muscle repeat it. The alignment suits wide registers and
  // does not depend on the compiler options of the including file.
  struct alignas(64) Constants {
    BraidConstants<units::Pack<lanes>> law;
    Four reach;  // range of the series; infinite in lanes beyond the last muscle
  };

  // Inputs and outputs of evaluate(): whole lanes of each.
  struct Inputs {
    const double *length, *rate, *mass, *y_ref, *inverse_sigma;
  };
  struct Outputs {
    double *tension, *clamped, *pressure, *friction_bound, *drift, *y;
  };

  void evaluate(const Inputs& in, const Outputs& out) const noexcept;
  int update_references(const double* drift, double* y_ref, double* inverse_sigma) const noexcept;
  void far_roots(const Four& drift, const Four& reach, const double* inverse_sigma,
                 double* root) const noexcept;
  void sealed_mesh(const Inputs& in, const Outputs& out) const noexcept;
  void apply_sliding_friction(const Inputs& in, const Outputs& out) const noexcept;

  int size_ = 0, padded_ = 0;
  gas::Air air_;
  gas::PowerSeries series_;
  std::optional<gas::PowerTable> table_;
  double inverse_reference_density_ = 0;
  std::vector<Muscle> muscles_;
  std::vector<Constants> constants_;  // for each group of four lanes
  bool all_stick_ = true, any_sealed_ = false;
};

}  // namespace sinew::air
