// plant/slide/stand_air.h - the air of the stand's element: that of a plumbing; valves, hoses,
// leaks, walls, tank and delays all work. Of a regulated stand its pressure is prescribed instead,
// and what the volume asks for has come in or gone out by the next look.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "sinew/muscle/air.h"
#include "sinew/plant/slide/setup.h"

namespace sinew::plant {

// The element's one end, as the air feels it, and the pressure that a regulator holds.
struct StandEnds : muscle::Ends {
  double pressure = 0;  // absolute; 0: nothing is prescribed [Pa]
};

inline muscle::Plumbing plumbing_of(const StandSetup& s) {
  if (s.cylinder) return {{}, s.air, s.supply, s.cylinder};
  return {std::span(&s.muscle, 1), s.air, s.supply};
}

class StandAir : public muscle::PlumbingAir {
 public:
  // Of a set-up that the mechanism has prepared.
  explicit StandAir(const StandSetup& s)
      : PlumbingAir(s.cylinder ? std::span<const muscle::Muscle>() : std::span(&s.muscle, 1), s.air,
                    s.supply, s.cylinder),
        plumbing_(plumbing_of(s)),
        cylinder_(s.cylinder.has_value()),
        by_valves_(s.charge.mode == Charge::Mode::valves),
        exponent_(exponent_of(s.air)),
        longest_settling_(longest_settling(s.accuracy)) {}

  // Valve 0 is the inlet or a 3-way valve, 1 the exhaust.
  int valves() const noexcept { return by_valves_ ? 2 : 0; }
  double open_share(int valve, double t, const Node& node) const noexcept {
    return plumbing_.open_share(valve, t, node.valves);
  }

  // A smooth part begins: what is prescribed goes into the state.
  void place(const StandEnds& ends, State& s) const noexcept {
    if (!(ends.pressure > 0)) return;
    const double before = s.air[0];
    plumbing_.hold(ends.pressure, ends.length, ends.travel, s.air);
    const double gained = s.air[0] - before;
    (gained > 0 ? s.in : s.out)[0] += std::fabs(gained);
  }

  void evaluate(double t, const StandEnds& ends, const State& state, const Node& node,
                Answer& out) const noexcept {
    if (!(ends.pressure > 0)) {
      PlumbingAir::evaluate(t, ends, state, node, out);
      return;
    }
    State held = state;
    plumbing_.hold(ends.pressure, ends.length, ends.travel, held.air);
    PlumbingAir::evaluate(t, ends, held, node, out);
    out.inflow[0] = out.outflow[0] = out.leak[0] = 0;
    out.cylinder_inflow = out.cylinder_outflow = {};
    for (int i = 0; i < plumbing_.held_states(); ++i) out.flow[i] = 0;
  }

  // `from`, as far as it is in use.
  void keep(State& out, const State& from) const noexcept {
    for (int i = 0; i < plumbing_.states(); ++i) out.air[i] = from.air[i];
    out.air.reference = from.air.reference;
    out.in[0] = from.in[0];
    out.out[0] = from.out[0];
    out.leak[0] = cylinder_ ? 0.0 : from.leak[0];
  }

  // That suits what the air does  [s].
  double longest_piece(const StandEnds& ends, const Answer& look, const State& s,
                       const Node& node) const noexcept {
    if (!flowing(node)) return std::numeric_limits<double>::infinity();
    return std::fmin(longest_step(ends, node), longest_settling_ / settling_rate(look, s));
  }

  double pressure(const Answer& look) const noexcept {
    return cylinder_ ? look.cylinder_pressure[muscle::up] : look.pressure[0];
  }
  muscle::Account element(const State& s) const noexcept {
    muscle::Account account =
        cylinder_ ? cylinder_account(s, muscle::up) : PlumbingAir::account(s, 0);
    account.mass = s.air[0];
    return account;
  }

 private:
  static double exponent_of(const gas::Air& air) {
    return air.wall_time > 0 ? gas::heat_capacity_ratio : air.polytropic_exponent;
  }

  // Of a chamber that settles at the pressure behind an open valve: the flow's slope is steep there
  // [1/s].
  double settling_rate(const Answer& at, const State& s) const noexcept {
    const double behind = cylinder_ ? at.cylinder_pressure[muscle::up] : at.manifold[0];
    const double flow_in = cylinder_ ? at.cylinder_inflow[muscle::up] : at.inflow[0];
    const double flow_out = cylinder_ ? at.cylinder_outflow[muscle::up] : at.outflow[0];
    const double in = std::fabs(flow_in / (at.supply_pressure - behind));
    const double out = std::fabs(flow_out / (behind - plumbing_.atmosphere()));
    const double slope = (std::isfinite(in) ? in : 0.0) + (std::isfinite(out) ? out : 0.0);
    return exponent_ * behind * slope / s.air[0];
  }

  muscle::Plumbing plumbing_;
  bool cylinder_ = false, by_valves_ = false;
  double exponent_ = 0, longest_settling_ = 0;
};

}  // namespace sinew::plant
