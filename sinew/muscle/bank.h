// muscle/bank.h - all muscles of a machine, side by side, as the air half of one ODE.
//
// State per muscle: the mass of its air, [40]. The bank owns the valves and what they have let
// through; whoever integrates owns the masses and asks, in every stage,
//
//   lengths, rates, masses  ->  tensions, pressures, mass flows in and out
//
// braid_lanes.h has the laws and the series that the pressure comes from.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/supply.h"
#include "sinew/muscle/braid_lanes.h"
#include "sinew/muscle/muscle.h"

namespace sinew::muscle {

class Bank {
 public:
  // Throws std::invalid_argument for more than `capacity` muscles.
  Bank(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply);

  int size() const { return size_; }
  int padded() const { return braids_.padded(); }  // to whole lanes, which repeat the last muscle

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
  int follow(const Lanes& drift) noexcept { return braids_.follow(drift, reference_); }

  // The law itself. Pure between two nodes; t matters only to valves that ramp.
  void evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                Pull& out) const noexcept;

  // True while some valve lets air through, or pressure could move without it.
  bool any_open() const noexcept { return ramping_ || open_count_ > 0; }

  // Share of the valve's area that is open at t  [-].
  double open_share(int valve, double t) const noexcept;

 private:
  void flows(double t, const Lanes& y, Pull& out) const noexcept;
  void move_valves(double t) noexcept;
  void refresh(double t) noexcept;

  int size_ = 0;
  gas::Air air_;
  double supply_y_ = 0;
  std::vector<Muscle> muscles_;
  BraidLanes braids_;
  Reference reference_;

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
