// muscle/bank.h - all muscles of a machine, side by side, as the air half of one ODE.
//
// State per muscle: the mass of its air, [40]. The bank owns the valves and what they have let
// through; whoever integrates owns the masses and asks, in every stage,
//
//   lengths, rates, masses  ->  tensions, pressures, mass flows in and out
//
// With sigma = m/V and x = sigma/sigma_ref - 1 the pressure comes from
//
//   y = (P/P_atm)^(1/7) = y_ref (1 + x)^(n/7)
//
// by six terms of the binomial series while |x| <= 0.05 (2e-11 relative; the reference is taken
// anew, exactly, at a node from |x| > 0.02 on), else by units::power. No libm, no branches between
// lanes: one muscle alone and in a bank has the same bits.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/supply.h"
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

// What the body does to the air: the muscles' lengths and the piston's travel.
struct Ends {
  Lanes length, rate;                  // [m], [m/s]
  double travel = 0, travel_rate = 0;  // of a cylinder, upwards [m], [m/s]
};

// Answer to one evaluation.
struct Pull {
  Lanes tension;   // of the bundle, static and viscous, never negative: a cord cannot push [N]
  Lanes pressure;  // absolute [Pa]
  Lanes mesh;      // bound of the bundle's dry friction, [33], [34]; 0 if not `stick` [N]
  Lanes drift;     // x, how far the density is from the pressure's reference [-]
  Lanes inflow;    // from the supply; 0 while all valves are shut [kg/s]
  Lanes outflow;   // to the atmosphere; 0 while all valves are shut [kg/s]
};

class Bank {
 public:
  // Throws std::invalid_argument for more than `capacity` muscles.
  Bank(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply);

  int size() const { return size_; }
  int padded() const { return padded_; }  // to whole lanes, which repeat the last muscle

  // Mass of air in muscle i at this pressure and length  [kg].
  double mass_at(int i, double pressure, double length) const;

  // Volume of the air  [m^3].
  double volume(int i, double length) const;

  // An electrical edge of a valve (2 x muscle + (0 inlet | 1 exhaust)) at time t [s].
  void electrical(int valve, double t, bool open) noexcept;

  // The next instant at which a valve really changes, or infinity  [s].
  double next_change() const noexcept { return next_change_; }

  // At a node: valves move to t.
  void node(double t) noexcept {
    if (next_change_ <= t) move_valves(t);
  }

  // At a node, after its evaluation: the pressure's reference follows where it has drifted. Answers
  // the first muscle whose density is none, or -1.
  int follow(const Lanes& drift) noexcept;

  // The law itself. Pure between two nodes; t matters only to valves that ramp.
  void evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                Pull& out) const noexcept;

  // True while some valve lets air through, or pressure could move without it.
  bool any_open() const noexcept { return ramping_ || open_count_ > 0; }

  // Share of the valve's area that is open at t  [-].
  double open_share(int valve, double t) const noexcept;

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
  void flows(double t, const Lanes& y, Pull& out) const noexcept;
  void far_roots(int first, const Four& drift, Four& root) const noexcept;
  void sealed_mesh(const Lanes& length, Pull& out) const noexcept;
  void loose_signs(const Lanes& rate, Pull& out) const noexcept;
  void move_valves(double t) noexcept;
  void refresh(double t) noexcept;

  int size_ = 0, padded_ = 0;
  gas::Air air_;
  double inverse_reference_density_ = 0;
  double supply_y_ = 0;

  std::vector<Muscle> muscles_;
  Constants k_;
  bool all_stick_ = true, any_sealed_ = false;

  std::array<double, 7> series_{};  // binomial coefficients of (1 + x)^(n/7)
  Lanes y_reference_{}, inverse_sigma_{};

  // Valves: two per muscle.
  std::vector<gas::Shutter> shutters_;
  std::vector<gas::FlowConstants> flow_;
  struct Open {
    int valve = 0;
    double share = 0;  // of its area
  };
  std::array<double, 2 * capacity> share_{};
  std::array<Open, 2 * capacity> open_{};  // those that let air through
  int open_count_ = 0;
  double next_change_ = 0;
  bool ramping_ = false;
};

}  // namespace sinew::muscle
