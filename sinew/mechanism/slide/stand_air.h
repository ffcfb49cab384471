// mechanism/slide/stand_air.h - air of the stand's element: a network, with valves, hoses, leaks,
// walls, tank and delays. For a regulated stand the pressure is prescribed instead, and the air for
// a change of volume enters or leaves by the next evaluation.
//
// The flow of Law::appendix_a jumps by .38 % where it chokes. Over a smooth part of a step each
// such valve has the law of the side on which the part began, and the step is cut where the
// pressures pass the limit.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "sinew/air/network.h"
#include "sinew/mechanism/slide/setup.h"

namespace sinew::plant {

using ElementAir = air::AirNetwork<4>;

// The element's motion as input of the air, and the pressure that a regulator holds.
struct StandEnds : ElementAir::Ends {
  double pressure = 0;  // absolute; 0: not prescribed [Pa]
};

// Returns the network of the stand's element. No valve is wide (bodies.h) for a step of 0: a stand
// divides its steps itself.
inline ElementAir air_of(const StandSetup& s) {
  if (s.cylinder) return {{}, s.air, s.supply, s.cylinder, s.faults, 0.0};
  return {std::span(&s.muscle, 1), s.air, s.supply, {}, s.faults, 0.0};
}

class StandAir : public ElementAir {
 public:
  // Takes a setup that the mechanism has prepared.
  explicit StandAir(const StandSetup& s)
      : ElementAir(air_of(s)),
        cylinder_(s.cylinder.has_value()),
        by_valves_(s.charge.mode == Charge::Mode::valves),
        exponent_(exponent_of(s.air)),
        longest_settling_(longest_settling(s.accuracy)) {
    use_power_table();
    for (int valve = 0; valve < valves(); ++valve) {
      const gas::Valve& of = this->valve(valve);
      jumps_[static_cast<std::size_t>(valve)] =
          of.kind != gas::Valve::Kind::regulator && of.flow.law == gas::Flow::Law::appendix_a;
      whole_[static_cast<std::size_t>(valve)] = flow(valve);
    }
  }

  // Valve 0 is the inlet or a 3-way valve, 1 the exhaust.
  int valves() const noexcept { return by_valves_ ? 2 : 0; }

  // Begins a smooth part: writes the prescribed pressure to the state.
  void place(const StandEnds& ends, State& s) const noexcept {
    if (!(ends.pressure > 0)) return;
    const double before = element(s).mass;
    impose_pressure(ends.pressure, ends.length, ends.travel, s);
    const double gained = element(s).mass - before;
    double& passed = cylinder_    ? (gained > 0 ? s.piston_in : s.piston_out)[air::up]
                     : gained > 0 ? s.in[0]
                                  : s.out[0];
    passed += std::fabs(gained);
  }

  // A smooth part begins with an evaluation of the valves' whole laws, and continues with the
  // laws of one side, chosen by the pressures of that evaluation.
  void use_whole_laws() noexcept {
    for (int v = 0; v < valves(); ++v)
      if (jumps(v)) set_flow(v, whole_[static_cast<std::size_t>(v)]);
  }
  void choose_sides(const Evaluation& evaluation, const Valves& valves) noexcept {
    for (int v = 0; v < this->valves(); ++v) {
      if (!jumps(v)) continue;
      const auto index = static_cast<std::size_t>(v);
      choked_[index] = !(past_choke(v, evaluation, valves) > 0);
      set_flow(v, gas::on_one_side(whole_[index], choked_[index]));
    }
  }

  // Returns whether a flow that jumps is open.
  bool needs_gap(const Valves& valves) const noexcept {
    return needs_gap(0, valves) || needs_gap(1, valves);
  }

  // Returns how far the pressures of an open valve are past the limit of the side that was chosen,
  // as a share of the upstream pressure: above 0 where its flow has jumped, -infinity without such
  // a valve [-].
  double gap(const Evaluation& evaluation, const Valves& valves) const noexcept {
    double most = -std::numeric_limits<double>::infinity();
    for (int v = 0; v < this->valves(); ++v) {
      if (!needs_gap(v, valves)) continue;
      const double past = past_choke(v, evaluation, valves);
      most = std::fmax(most, choked_[static_cast<std::size_t>(v)] ? past : -past);
    }
    return most;
  }

  // Evaluates the network, or the prescribed pressure.
  void evaluate(double t, const StandEnds& ends, const State& state, const Valves& valves,
                const Memory& memory, Evaluation& out, std::uint64_t = 0) const noexcept {
    if (!(ends.pressure > 0)) {
      ElementAir::evaluate(t, ends, state, valves, memory, out);
      return;
    }
    State held = state;
    impose_pressure(ends.pressure, ends.length, ends.travel, held);
    ElementAir::evaluate(t, ends, held, valves, memory, out);
    clear_imposed_rates(out);
  }

  // Returns the longest step for the air [s].
  double longest_piece(const StandEnds& ends, const Evaluation& evaluation, const State& s,
                       const Valves& valves) const noexcept {
    if (!flowing(valves)) return std::numeric_limits<double>::infinity();
    return std::fmin(longest_step(ends, valves),
                     longest_settling_ / settling_rate(evaluation, s, valves));
  }

  // Return the element's absolute pressure [Pa], and its air.
  double pressure(const Evaluation& evaluation) const noexcept {
    return cylinder_ ? evaluation.cylinder_pressure[air::up] : evaluation.pressure[0];
  }
  air::Account element(const State& s) const noexcept {
    return cylinder_ ? cylinder_account(s, air::up) : account(s, 0);
  }

 private:
  static double exponent_of(const gas::Air& air) {
    return air.wall_time > 0 ? gas::heat_capacity_ratio : air.polytropic_exponent;
  }

  bool jumps(int valve) const noexcept { return jumps_[static_cast<std::size_t>(valve)]; }
  bool needs_gap(int valve, const Valves& valves) const noexcept {
    return jumps(valve) && (ramping() || valves[static_cast<std::size_t>(valve)].share > 0);
  }

  // Returns P_down/P_up less the limit: above 0 where the flow is free [-].
  double past_choke(int valve, const Evaluation& evaluation, const Valves& valves) const noexcept {
    const double element =
        cylinder_ ? evaluation.cylinder_pressure[air::up] : manifold(evaluation, 0, valves);
    const double other = valve == 0 ? evaluation.supply_pressure : atmosphere();
    return std::fmin(element, other) / std::fmax(element, other) - 1.0 / gas::appendix_limit;
  }

  // Returns the rate at which a chamber settles at the pressure behind an open valve, where the
  // flow's slope is steep [1/s].
  double settling_rate(const Evaluation& at, const State& s, const Valves& valves) const noexcept {
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
  std::array<bool, 2> jumps_{};                // the valves' flows jump where they choke
  std::array<gas::FlowConstants, 2> whole_{};  // their laws with both sides

  // Scratch for the current smooth part.
  std::array<bool, 2> choked_{};
};

}  // namespace sinew::plant
