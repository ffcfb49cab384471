// air/braid_lanes.h - pressures and tensions of all muscles of a machine, side by side:
// [31]-[34] and [40] in lanes of four.
//
// State per muscle: the mass of its air. With sigma = m/V and x = sigma/sigma_ref - 1 the pressure
// comes from
//
//   y = (P/P_atm)^(1/7) = y_ref (1 + x)^(n/7)
//
// by gas/power_series.h while x is small (the reference is taken anew, exactly, at a node from
// |x| > 0.02 on), else by units::power, or by gas/power_series.h where that is the rule. No libm,
// no branches between lanes: one muscle alone and among others has the same bits. The reference
// belongs to the state: who restores a state restores its reference with it.
//
// For muscles that lanes_hold: the thesis's law of a braid with a linear bladder. Others go by
// actuator/tension.h, which has the same laws in words; a test holds them together.
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
  int padded() const { return padded_; }  // to whole lanes, which repeat the last muscle

  const gas::PowerSeries& series() const { return series_; }  // y of the density

  // From now on a table answers beyond the reach of the series: for steps that go there often.
  void go_by_table() { table_.emplace(air_.polytropic_exponent / 7.0); }

  // Returns what the series stand on before any look: the atmosphere.
  template <int Most>
  Reference<Most> reference() const {  // at the atmosphere
    Reference<Most> r{};
    for (int i = 0; i < padded_; ++i) {
      r.y[i] = 1.0;
      r.inverse_sigma[i] = inverse_reference_density_;
    }
    return r;
  }

  // Lengths [m], rates [m/s] and masses [kg] give all of `out`, and y. Pure.
  template <int Most>
  void evaluate(const Lanes<Most>& length, const Lanes<Most>& rate, const Lanes<Most>& mass,
                const Reference<Most>& reference, Pull<Most>& out, Lanes<Most>& y) const noexcept {
    evaluate({length.of.data(), rate.of.data(), mass.of.data(), reference.y.of.data(),
              reference.inverse_sigma.of.data()},
             {out.tension.of.data(), out.clamped.of.data(), out.pressure.of.data(),
              out.friction_bound.of.data(), out.drift.of.data(), y.of.data()});
  }

  // These return the constants of muscle i, whether its dry friction is bound by its sealed
  // stiffness, and whether it sticks.
  BraidConstants<double> constants(int i) const {
    return units::lane_of<BraidConstants<double>>(
        constants_[static_cast<std::size_t>(i / lanes)].law, i % lanes);
  }
  bool bound_by_sealed(int i) const;
  bool sticks(int i) const;

  // Returns y of a density by the power itself, for whoever is beyond the series  [-].
  double exact_y(double density) const noexcept;
  // Returns the bound of muscle i's dry friction by its sealed stiffness  [N].
  double sealed_bound(int i, double length, double pressure) const noexcept;

  // At a node, after its evaluation: the reference follows where the density has drifted. Answers
  // the first muscle whose density is none, or -1.
  template <int Most>
  int follow(const Lanes<Most>& drift, Reference<Most>& reference) const noexcept {
    return follow(drift.of.data(), reference.y.of.data(), reference.inverse_sigma.of.data());
  }

 private:
  // Four bundles; lanes beyond the last muscle repeat it. Aligned for wide registers, whatever the
  // file that makes it is compiled for.
  struct alignas(64) Constants {
    BraidConstants<units::Pack<lanes>> law;
    Four reach;  // of the series; none of a lane to spare
  };

  // evaluate() goes by the one and fills the other: whole lanes of each.
  struct Given {
    const double *length, *rate, *mass, *y_ref, *inverse_sigma;
  };
  struct Filled {
    double *tension, *clamped, *pressure, *friction_bound, *drift, *y;
  };

  void evaluate(const Given& in, const Filled& out) const noexcept;
  int follow(const double* drift, double* y_ref, double* inverse_sigma) const noexcept;
  void far_roots(const Four& drift, const Four& reach, const double* inverse_sigma,
                 double* root) const noexcept;
  void sealed_mesh(const Given& in, const Filled& out) const noexcept;
  void loose_signs(const Given& in, const Filled& out) const noexcept;

  int size_ = 0, padded_ = 0;
  gas::Air air_;
  gas::PowerSeries series_;
  std::optional<gas::PowerTable> table_;
  double inverse_reference_density_ = 0;
  std::vector<Muscle> muscles_;
  std::vector<Constants> constants_;  // of each four lanes
  bool all_stick_ = true, any_sealed_ = false;
};

}  // namespace sinew::air
