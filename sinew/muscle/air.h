// muscle/air.h - a bank or a plumbing as the air half of a world: its state, its look, and how both
// move on. plant/planar/world.h integrates it together with a body.
//
//   State    what is integrated, and what has passed the valves since the start
//   Node     what holds until the next node: where the valves are, and what the series stand on
//   Answer   all that one evaluation yields
//   move     the state, h along the rates of one look: the stages of RK4
//   finish   the state, by RK4's weighted mean of four looks
//   predict, correct   Heun's rule, for a peek
//   remember at a node: the references and the plays that looks between nodes go by; answers what
//            of the air is no number
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "sinew/muscle/bank.h"
#include "sinew/muscle/failure.h"
#include "sinew/muscle/fault.h"
#include "sinew/muscle/plumbing.h"
#include "sinew/signals/port.h"

namespace sinew::muscle {

// Air of one chamber: what is there, and what has passed since the start  [kg].
struct Account {
  double mass = 0, in = 0, out = 0, leak = 0;
};

// Pressures of the supply, absolute  [Pa], and what it has given while a fault had cut it from its
// tank [kg].
struct SupplyState {
  double line = 0, tank = 0, past_tank = 0;
};

inline double piston_force(const Pull&) { return 0; }  // a bank has no cylinder
inline double piston_force(const AirPull& pull) { return pull.cylinder_force; }

// Muscles on a supply that is always the same, with valves beside them: lanes.
class BankAir {
 public:
  using Answer = Pull;
  struct State {
    Lanes mass, in, out;  // [kg]
  };
  struct Node {
    Bank::Valves valves;
    Reference reference;
  };

  BankAir(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
          const std::optional<Cylinder>&, std::span<const AirFault> faults = {})
      : bank_(muscles, air, supply, faults), supply_(supply.pressure) {}

  State initial(double pressure, const Lanes& length, double) const {
    State s{};
    for (int i = 0; i < bank_.size(); ++i) s.mass[i] = bank_.mass_at(i, pressure, length[i]);
    for (int i = bank_.size(); i < bank_.padded(); ++i) s.mass[i] = s.mass[bank_.size() - 1];
    return s;
  }

  Node at_rest() const { return {bank_.valves_at_rest(), bank_.reference_at_rest()}; }

  int valves() const noexcept { return 2 * bank_.size(); }
  void command(const signals::Edge& edge, double t, const Answer&, Node& node) const noexcept {
    bank_.electrical(edge.valve.index, t, edge.open, node.valves);
  }
  void move_valves(double t, const Answer&, Node& node) const noexcept {
    bank_.node(t, node.valves);
  }
  double next_change(const Node& node) const noexcept { return node.valves.next_change; }
  bool flowing(const Node& node) const noexcept { return bank_.any_open(node.valves); }
  double longest_step(const Ends&, const Node&) const noexcept {
    return std::numeric_limits<double>::infinity();
  }

  void evaluate(double t, const Ends& ends, const State& state, const Node& node,
                Answer& out) const noexcept {
    bank_.evaluate(t, ends.length, ends.rate, state.mass, node.valves, node.reference, out);
  }

  Failure remember(const Answer& look, State&, Node& node) const noexcept {
    const int failed = bank_.follow(look.drift, node.reference);
    if (failed < 0) return {};
    return {.of = Failure::Of::air, .muscle = failed};
  }

  // Only the masses: what has passed is summed where the step ends.
  void move(State& out, const State& from, double h, const Answer& look,
            const Node& node) const noexcept {
    const bool flows = flowing(node);
    for (int i = 0; i < bank_.padded(); i += lanes) {
      Four mass = from.mass.four(i);
      if (flows) mass += h * (look.inflow.four(i) - look.outflow.four(i));
      out.mass.four(i) = mass;
    }
  }

  void finish(State& state, double h, const Answer* const (&look)[4],
              const Node& node) const noexcept {
    if (!flowing(node)) return;
    const double sixth = h / 6.0;
    const auto mean = [&](auto&& of) {
      return sixth * (of(0) + 2.0 * of(1) + 2.0 * of(2) + of(3));
    };
    for (int i = 0; i < bank_.size(); ++i)
      pass(state, state, i, mean([&](int s) { return look[s]->inflow[i]; }),
           mean([&](int s) { return look[s]->outflow[i]; }));
  }

  // The mass at the node serves the predictor.
  void predict(State&, const State&, double, const Answer&) const noexcept {}
  void correct(State& out, const State& from, double h, const Answer& before,
               const Answer& after) const noexcept {
    for (int i = 0; i < bank_.size(); ++i)
      pass(out, from, i, 0.5 * h * (before.inflow[i] + after.inflow[i]),
           0.5 * h * (before.outflow[i] + after.outflow[i]));
  }

  Account account(const State& s, int muscle) const noexcept {
    return {.mass = s.mass[muscle], .in = s.in[muscle], .out = s.out[muscle]};
  }
  double total_mass(const State& s, double) const noexcept {
    double sum = 0;
    for (int i = 0; i < bank_.size(); ++i) sum += s.mass[i];
    return sum;
  }
  SupplyState supply_state(const State&, const Answer&) const noexcept {
    return {supply_, supply_};
  }
  double cylinder_pressure(const Answer&, int) const noexcept { return 0; }
  Account cylinder_account(const State&, int) const noexcept { return {}; }

 private:
  static void pass(State& out, const State& from, int i, double in, double gone) noexcept {
    out.in[i] = from.in[i] + in;
    out.out[i] = from.out[i] + gone;
    out.mass[i] = from.mass[i] + (in - gone);
  }

  Bank bank_;
  double supply_ = 0;  // [Pa]
};

// Muscles with whatever a plumbing has: tank, regulators, hoses, leaks, heat, a cylinder.
class PlumbingAir {
 public:
  struct Answer : AirPull {
    AirState flow;  // d(air)/dt
  };
  // The cylinder's chambers, up and down, come after the muscles.
  struct State {
    AirState air;
    std::array<double, capacity + 2> in, out, leak;  // [kg]
  };
  struct Node {
    Plumbing::Valves valves;
  };

  PlumbingAir(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
              const std::optional<Cylinder>& cylinder, std::span<const AirFault> faults = {})
      : plumbing_(muscles, air, supply, cylinder, faults), cylinder_(cylinder.has_value()) {}

  State initial(double pressure, const Lanes& length, double travel) const {
    State s{};
    s.air = plumbing_.initial(pressure, length, travel);
    return s;
  }

  Node at_rest() const { return {plumbing_.valves_at_rest()}; }

  int valves() const noexcept { return plumbing_.valves(); }
  void command(const signals::Edge& edge, double t, const Answer& at_node,
               Node& node) const noexcept {
    const double share = static_cast<double>(edge.level) / signals::max_level;
    plumbing_.electrical(edge.valve.index, t, edge.open, at_node, node.valves);
    plumbing_.level(edge.valve.index, t, share, node.valves);
  }
  void move_valves(double t, const Answer& before, Node& node) const noexcept {
    plumbing_.node(t, before, node.valves);
  }
  double next_change(const Node& node) const noexcept { return node.valves.next_change; }
  bool flowing(const Node& node) const noexcept { return !plumbing_.quiet(node.valves); }
  double longest_step(const Ends& ends, const Node& node) const noexcept {
    return plumbing_.longest_step(ends.length, ends.travel, node.valves);
  }

  void evaluate(double t, const Ends& ends, const State& state, const Node& node,
                Answer& out) const noexcept {
    plumbing_.evaluate(t, ends.length, ends.rate, ends.travel, ends.travel_rate, state.air,
                       node.valves, out, out.flow);
  }

  Failure remember(const Answer& look, State& state, Node&) const noexcept {
    plumbing_.remember(look, state.air);
    for (int i = 0; i < plumbing_.muscles(); ++i)
      if (!is_pressure(look.pressure[i])) return {.of = Failure::Of::air, .muscle = i};
    for (const double p : look.cylinder_pressure)
      if (cylinder_ && !(p >= 0 && p < most_pressure)) return {.of = Failure::Of::cylinder};
    return {};
  }

  void move(State& out, const State& from, double h, const Answer& look,
            const Node&) const noexcept {
    shift(out, from, h, look);
  }

  void finish(State& state, double h, const Answer* const (&look)[4], const Node&) const noexcept {
    const double weight[4] = {h / 6.0, h / 3.0, h / 3.0, h / 6.0};
    for (int s = 0; s < 4; ++s) shift(state, state, weight[s], *look[s]);
  }

  void predict(State& out, const State& from, double h, const Answer& before) const noexcept {
    shift(out, from, h, before);
  }
  void correct(State& out, const State& from, double h, const Answer& before,
               const Answer& after) const noexcept {
    shift(out, from, 0.5 * h, before);
    shift(out, out, 0.5 * h, after);
  }

  Account account(const State& s, int muscle) const noexcept {
    const auto i = static_cast<std::size_t>(muscle);
    return {.mass = s.air[muscle], .in = s.in[i], .out = s.out[i], .leak = s.leak[i]};
  }
  double total_mass(const State& s, double travel) const noexcept {
    return plumbing_.total_mass(s.air, travel);
  }
  SupplyState supply_state(const State& s, const Answer& a) const noexcept {
    return {a.supply_pressure, a.tank_pressure, plumbing_.given_past_tank(s.air)};
  }
  double cylinder_pressure(const Answer& a, int chamber) const noexcept {
    return a.cylinder_pressure[static_cast<std::size_t>(chamber)];
  }
  Account cylinder_account(const State& s, int chamber) const noexcept {
    const auto i = static_cast<std::size_t>(plumbing_.muscles() + chamber);
    return {.in = s.in[i], .out = s.out[i]};
  }

 private:
  void shift(State& out, const State& from, double h, const Answer& look) const noexcept {
    out.air.reference = from.air.reference;
    for (int i = 0; i < plumbing_.states(); ++i) out.air[i] = from.air[i] + h * look.flow[i];
    const auto n = static_cast<std::size_t>(plumbing_.muscles());
    for (std::size_t i = 0; i < n; ++i) {
      const int m = static_cast<int>(i);
      out.in[i] = from.in[i] + h * look.inflow[m];
      out.out[i] = from.out[i] + h * look.outflow[m];
      out.leak[i] = from.leak[i] + h * look.leak[m];
    }
    for (std::size_t c = 0; c < 2; ++c) {
      out.in[n + c] = from.in[n + c] + h * look.cylinder_inflow[c];
      out.out[n + c] = from.out[n + c] + h * look.cylinder_outflow[c];
    }
  }

  Plumbing plumbing_;
  bool cylinder_ = false;
};

}  // namespace sinew::muscle
