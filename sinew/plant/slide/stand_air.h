// plant/slide/stand_air.h - the air of the stand's element: a network; valves, hoses,
// leaks, walls, tank and delays all work. Of a regulated stand its pressure is prescribed instead,
// and what the volume asks for has come in or gone out by the next look.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "sinew/air/network.h"
#include "sinew/plant/slide/setup.h"

namespace sinew::plant {

using ElementAir = air::AirNetwork<4>;

// The element's one end, as the air feels it, and the pressure that a regulator holds.
struct StandEnds : ElementAir::Ends {
  double pressure = 0;  // absolute; 0: nothing is prescribed [Pa]
};

// Returns the network of the stand's element.
inline ElementAir air_of(const StandSetup& s) {
  if (s.cylinder) return {{}, s.air, s.supply, s.cylinder, s.faults};
  return {std::span(&s.muscle, 1), s.air, s.supply, {}, s.faults};
}

class StandAir : public ElementAir {
 public:
  // Takes a set-up that the mechanism has prepared.
  explicit StandAir(const StandSetup& s)
      : ElementAir(air_of(s)),
        cylinder_(s.cylinder.has_value()),
        by_valves_(s.charge.mode == Charge::Mode::valves),
        exponent_(exponent_of(s.air)),
        longest_settling_(longest_settling(s.accuracy)) {
    take_long_steps();
  }

  // Valve 0 is the inlet or a 3-way valve, 1 the exhaust.
  int valves() const noexcept { return by_valves_ ? 2 : 0; }

  // A smooth part begins: what is prescribed goes into the state.
  void place(const StandEnds& ends, State& s) const noexcept {
    if (!(ends.pressure > 0)) return;
    const double before = element(s).mass;
    hold(ends.pressure, ends.length, ends.travel, s);
    const double gained = element(s).mass - before;
    double& passed = cylinder_    ? (gained > 0 ? s.piston_in : s.piston_out)[air::up]
                     : gained > 0 ? s.in[0]
                                  : s.out[0];
    passed += std::fabs(gained);
  }

  // The law: the network's, or that of a prescribed pressure.
  void evaluate(double t, const StandEnds& ends, const State& state, const Valves& valves,
                const Memory& memory, Answer& out, std::uint64_t = 0) const noexcept {
    if (!(ends.pressure > 0)) {
      ElementAir::evaluate(t, ends, state, valves, memory, out);
      return;
    }
    State held = state;
    hold(ends.pressure, ends.length, ends.travel, held);
    ElementAir::evaluate(t, ends, held, valves, memory, out);
    hold_still(out);
  }

  // That suits what the air does  [s].
  double longest_piece(const StandEnds& ends, const Answer& look, const State& s,
                       const Valves& valves) const noexcept {
    if (!flowing(valves)) return std::numeric_limits<double>::infinity();
    return std::fmin(longest_step(ends, valves),
                     longest_settling_ / settling_rate(look, s, valves));
  }

  // Returns the element's pressure, absolute [Pa]; and what air it has and had.
  double pressure(const Answer& look) const noexcept {
    return cylinder_ ? look.cylinder_pressure[air::up] : look.pressure[0];
  }
  air::Account element(const State& s) const noexcept {
    return cylinder_ ? cylinder_account(s, air::up) : account(s, 0);
  }

 private:
  static double exponent_of(const gas::Air& air) {
    return air.wall_time > 0 ? gas::heat_capacity_ratio : air.polytropic_exponent;
  }

  // Returns the rate of a chamber that settles at the pressure behind an open valve: the flow's
  // slope is steep there [1/s].
  double settling_rate(const Answer& at, const State& s, const Valves& valves) const noexcept {
    const double behind = cylinder_ ? at.cylinder_pressure[air::up] : manifold(at, 0, valves);
    const double flow_in = cylinder_ ? at.cylinder_inflow[air::up] : at.inflow[0];
    const double flow_out = cylinder_ ? at.cylinder_outflow[air::up] : at.outflow[0];
    const double in = std::fabs(flow_in / (at.supply_pressure - behind));
    const double out = std::fabs(flow_out / (behind - atmosphere()));
    const double slope = (std::isfinite(in) ? in : 0.0) + (std::isfinite(out) ? out : 0.0);
    return exponent_ * behind * slope / element(s).mass;
  }

  bool cylinder_ = false, by_valves_ = false;
  double exponent_ = 0, longest_settling_ = 0;
};

}  // namespace sinew::plant
