// muscle/braid_lanes.h - pressures and tensions of all muscles of a machine, side by side:
// [31]-[34] and [40] in lanes of four.
//
// State per muscle: the mass of its air. With sigma = m/V and x = sigma/sigma_ref - 1 the pressure
// comes from
//
//   y = (P/P_atm)^(1/7) = y_ref (1 + x)^(n/7)
//
// by six terms of the binomial series while |x| <= 0.05 (2e-11 relative; the reference is taken
// anew, exactly, at a node from |x| > 0.02 on), else by units::power. No libm, no branches between
// lanes: one muscle alone and among others has the same bits. The reference belongs to the state:
// who restores a state restores its reference with it.
//
// For muscles that lanes_hold: the thesis's law of a braid with a linear bladder. Others go by
// actuator/tension.h, which has the same laws in words; a test holds them together.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/muscle/muscle.h"

namespace sinew::muscle {

inline constexpr int lanes = 4;  // that are evaluated together

// Four doubles that are added, multiplied, compared and chosen lane by lane: GCC's and Clang's
// vector extension. Without wide registers it is two pairs; the bits are those of four scalars.
using Four = double __attribute__((vector_size(8 * lanes), may_alias));

// One number per muscle. Not set when made: `Lanes x{}` is zero.
struct alignas(64) Lanes {
  std::array<double, capacity> of;

  double& operator[](int i) { return of[static_cast<std::size_t>(i)]; }
  double operator[](int i) const { return of[static_cast<std::size_t>(i)]; }

  // Lanes first ... first + 3.
  const Four& four(int first) const { return reinterpret_cast<const Four&>(of[first]); }
  Four& four(int first) { return reinterpret_cast<Four&>(of[first]); }
};

// The body's motion, as the air feels it: the muscles' lengths and the piston's travel.
struct Ends {
  Lanes length, rate;                  // [m], [m/s]
  double travel = 0, travel_rate = 0;  // of a cylinder, upwards [m], [m/s]
};

// Answer to one evaluation.
struct Pull {
  Lanes tension;   // of the bundle, static and viscous, never negative: a cord cannot push [N]
  Lanes clamped;   // the same of a muscle that is held at both ends: it may push [N]
  Lanes pressure;  // absolute [Pa]
  Lanes mesh;      // bound of the bundle's dry friction, [33], [34]; 0 if not `stick` [N]
  Lanes drift;     // x, how far the density is from the pressure's reference [-]
  Lanes inflow;    // from the supply [kg/s]; only while some valve is open
  Lanes outflow;   // to the atmosphere [kg/s]; only while some valve is open
};

// The series are taken about this density of each muscle: y_ref and 1/sigma_ref [m^3/kg].
struct Reference {
  Lanes y, inverse_sigma;
};

// Is there nothing of this muscle's law that lanes leave out?
bool lanes_hold(const Muscle& muscle);

class BraidLanes {
 public:
  // Throws std::invalid_argument for more than `capacity` muscles.
  BraidLanes(std::span<const Muscle> muscles, const gas::Air& air);

  int size() const { return size_; }
  int padded() const { return padded_; }  // to whole lanes, which repeat the last muscle

  Reference reference() const;  // at the atmosphere

  // Lengths [m], rates [m/s] and masses [kg] give tensions, pressures, dry friction and drift of
  // `out`, and y. Pure.
  void evaluate(const Lanes& length, const Lanes& rate, const Lanes& mass,
                const Reference& reference, Pull& out, Lanes& y) const noexcept;

  // At a node, after its evaluation: the reference follows where the density has drifted. Answers
  // the first muscle whose density is none, or -1.
  int follow(const Lanes& drift, Reference& reference) const noexcept;

 private:
  // Constants of the bundles in lanes, the count of actuators and what can be multiplied beforehand
  // folded in; lanes beyond the last muscle repeat it.
  struct Constants {
    Lanes thread2, cubic, linear, external;  // b^2; volume: external + l (linear - cubic l^2)
    Lanes c0, c1, c2, low, high;             // effectiveness, of the gauge pressure
    Lanes viscous, bladder, bladder_rest;    // passive
    Lanes long_length, long_stiffness, long_damping;     // [32], [35]
    Lanes short_length, short_stiffness, short_damping;  // end stop
    Lanes short_zero;                                    // 1 where [31]'s zero holds, else 0
    Lanes mesh_secant, mesh_constant;                    // Q for [34], or the bound itself
  };

  void set_constants(int lane, const Muscle& muscle);
  double exact_y(double density) const noexcept;
  void far_roots(int first, const Four& drift, const Reference& reference,
                 Four& root) const noexcept;
  void sealed_mesh(const Lanes& length, Pull& out) const noexcept;
  void loose_signs(const Lanes& rate, Pull& out) const noexcept;

  int size_ = 0, padded_ = 0;
  gas::Air air_;
  double inverse_reference_density_ = 0;
  std::vector<Muscle> muscles_;
  Constants k_;
  bool all_stick_ = true, any_sealed_ = false;
  std::array<double, 7> series_{};  // binomial coefficients of (1 + x)^(n/7)
};

}  // namespace sinew::muscle
