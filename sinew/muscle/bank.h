// muscle/bank.h - all muscles of a machine, side by side, as the air half of one ODE.
//
// State per muscle: the mass of its air, [40]; and the valves with the reference of the pressures,
// which stay what they are between two nodes. A bank itself is constant: whoever integrates owns
// the state and asks, in every stage,
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
#include "sinew/muscle/fault.h"
#include "sinew/muscle/muscle.h"

namespace sinew::muscle {

class Bank {
 public:
  // Two per muscle, inlet and exhaust. Copied like bytes.
  struct Valves {
    struct Open {
      int valve = 0;
      double share = 0;  // of its area
    };
    std::array<gas::Shutter, 2 * capacity> shutter;
    std::array<double, 2 * capacity> share{};  // of the area that is open
    std::array<Open, 2 * capacity> open{};     // those that let air through
    int open_count = 0;
    ActingFaults faults;
    double next_change = 0;  // instant at which a valve or a fault changes, or infinity [s]
  };

  // Throws std::invalid_argument for more than `capacity` muscles, and for faults that are not of
  // a valve's share alone.
  Bank(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
       std::span<const AirFault> faults = {});

  int size() const { return size_; }
  int padded() const { return braids_.padded(); }  // to whole lanes, which repeat the last muscle

  // Mass of air in muscle i at this pressure and length  [kg].
  double mass_at(int i, double pressure, double length) const;

  // Volume of the air  [m^3].
  double volume(int i, double length) const;

  // All valves without current since ever; the reference at the atmosphere.
  Valves valves_at_rest() const;
  Reference reference_at_rest() const { return braids_.reference(); }

  // An electrical edge of a valve (2 x muscle + (0 inlet | 1 exhaust)) at time t [s].
  void electrical(int valve, double t, bool open, Valves& valves) const noexcept;

  // At a node: valves move to t.
  void node(double t, Valves& valves) const noexcept {
    if (valves.next_change <= t) move(t, valves);
  }

  // At a node, after its evaluation: the pressure's reference follows where it has drifted. Answers
  // the first muscle whose density is none, or -1.
  int follow(const Lanes& drift, Reference& reference) const noexcept {
    return braids_.follow(drift, reference);
  }

  // The law itself; t matters only to valves that ramp.
  void evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                const Valves& valves, const Reference& reference, Pull& out) const noexcept;

  // True while some valve lets air through, or pressure could move without it.
  bool any_open(const Valves& valves) const noexcept { return ramping_ || valves.open_count > 0; }

  // Share of the valve's area that is open at t  [-].
  double open_share(int valve, double t, const Valves& valves) const noexcept;

 private:
  void flows(double t, const Lanes& y, const Valves& valves, Pull& out) const noexcept;
  double fraction(int valve, double t, const Valves& valves) const noexcept;
  void look_ahead(Valves& valves) const noexcept;
  void move(double t, Valves& valves) const noexcept;
  void refresh(double t, Valves& valves) const noexcept;

  int size_ = 0;
  gas::Air air_;
  double supply_y_ = 0;
  std::vector<Muscle> muscles_;
  BraidLanes braids_;
  std::vector<gas::FlowConstants> flow_;  // of the valves
  FaultSchedule faults_;
  bool ramping_ = false;  // some valve's area moves gradually
};

}  // namespace sinew::muscle
