// plant/planar/world.h - a machine that its muscles move, as a Port: nodes, steps, peeks and
// events, written once for every mechanism and every air.
//
// One RK4 over body and air. Committed nodes are the multiples of the body step and the instants at
// which valves really open or close, nothing else; a node is committed only when no earlier edge
// can still arrive. Readings, logs and viewers peek: they extrapolate from the last node in a copy,
// so that nobody's looking changes a bit.
//
//   order of one step:  node (valves, reference of the pressure, first stage)
//                       -> dry friction for this step -> three more stages -> next node
//
// A step is cut into several pieces, under the friction of the whole, where air is quicker than the
// body.
//
// Model, state and scratch are apart: mechanism and air are constant once made, State is everything
// that the future depends on, one block that is copied like bytes, and all else is worked out from
// it at a node.
//
// Mechanism  what moves: routes of the muscles, forces, equations of motion, contacts
//            (chain_mechanism.h, body_mechanism.h)
// Air        what fills the muscles: valves, masses, pressures, tensions (muscle/bank.h,
//            plumbing.h)
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

#include "sinew/muscle/failure.h"
#include "sinew/muscle/network.h"
#include "sinew/plant/planar/setup.h"
#include "sinew/robot/sensing.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

template <class Mechanism, class Air>
class World final : public signals::Port {
  using Acceleration = typename Mechanism::Acceleration;
  using Forces = typename Mechanism::Forces;

  // The part of the state that is integrated.
  struct Moving {
    typename Mechanism::Motion motion;
    typename Air::State air;
  };

  // Everything that one look at a state yields.
  struct Look {
    typename Air::Ends ends;
    typename Mechanism::Arms arms;
    typename Air::Answer air;
    typename Mechanism::Load load;  // all that pushes the coordinates but dry friction
    Acceleration acceleration;      // with the friction of the step
  };

 public:
  using Body = Mechanism;

  // The state at the last committed node, and the commands since. Copied like bytes; of one build
  // of the library, and for worlds of equal setups.
  struct State {
    Moving now;
    typename Air::Valves valves;
    typename Air::Memory memory;
    Forces held;                   // friction of the last step
    double trolley_bound;          // of the trolley's friction in the next [N]
    Look first;                    // first stage at the node, without friction
    double time;                   // of the node [s]
    std::int64_t multiple, nodes;  // of the body step that was passed last; so far
    bool ended;
    muscle::Failure failure;
  };

  // The setup must be free of contradictions (robot::contradictions).
  explicit World(const Setup& setup);

  signals::Status start(const signals::Scan& scan) noexcept override;
  // Answers invalid for an edge before the last node.
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // The machine at time t [s], at or after every earlier call's; an earlier one is answered with
  // the last node. Commits what is due, peeks the rest.
  Truth truth(double t) noexcept;

  // Commits every node up to t.
  void advance(double t) noexcept;

  using Motion = typename Mechanism::Motion;
  const Motion& motion() const noexcept { return state_.now.motion; }
  const auto& constants() const noexcept { return mechanism_.constants(); }
  double air_mass() const noexcept {  // in chambers, hoses and tank [kg]
    return air_.total_mass(state_.now.air, state_.first.ends.travel);
  }
  double time() const noexcept { return state_.time; }
  double shortest_step() const noexcept {  // of body and air, where it starts [s]
    return std::min(step_, air_.longest_step(state_.first.ends, state_.valves));
  }
  std::int64_t nodes() const noexcept { return state_.nodes; }
  const muscle::Failure& failure() const noexcept { return state_.failure; }

  const State& state() const noexcept { return state_; }
  // Goes on from there as the world did whose state it was: the same bits.
  void restore(const State& state) noexcept;

  // For tests: rates at the last node, of the joints (those not given: 0) [rad/s], of the trolley
  // and of the lift [m/s].
  void set_rates(std::initializer_list<double> joint_rates, double x_rate,
                 double y_rate = 0) noexcept {
    mechanism_.set_rates(state_.now.motion, joint_rates, x_rate, y_rate);
    prepare();
  }

 private:
  // Friction and accelerations that a look beyond the last node goes by.
  struct Glance {
    Forces held{};
    Acceleration acceleration{};
  };
  struct Peek {
    Moving state;
    Look look;
  };

  void evaluate_air(double t, const Moving& state, Look& look) const noexcept {
    mechanism_.route(state.motion, look.ends, look.arms);
    air_.evaluate(t, look.ends, state.air, state_.valves, state_.memory, look.air);
  }
  void look_at(double t, const Moving& state, const Forces& held, Look& look) const noexcept;
  void prepare() noexcept;
  Acceleration prepare_friction(const typename Mechanism::Pose& pose) noexcept;
  void look_for_failure() noexcept;
  void step(double h) noexcept;
  void piece(double from, double h, const Acceleration& first) noexcept;
  double pieces_of(double h, const Look& look) const noexcept;
  double next_node() const noexcept;
  void commit() noexcept;

  const Glance& glance() noexcept;
  Motion peek_motion(const Glance& g, double t) const noexcept {
    Motion motion = state_.now.motion;
    mechanism_.glide(motion, t - state_.time, g.acceleration);
    return motion;
  }
  Peek peek(const Glance& g, double t) const noexcept;
  double gauge(const Glance& g, const Peek& p, int muscle) const noexcept;
  double quantity(std::size_t sensor, double t) noexcept;

  // A step is cut into at most so many pieces. More are asked for only where a chamber has
  // vanished.
  static constexpr double most_pieces = 1e5;

  Mechanism mechanism_;
  Air air_;
  robot::Robot robot_;
  double atmosphere_ = 0;  // [Pa]
  double step_ = 1e-3;
  std::uint64_t seed_ = 1;

  State state_{};
  Glance glance_{};  // from this node, once somebody has looked
  bool glanced_ = false;

  std::array<signals::Tick, 256> lag_{};  // per channel, from the start of a conversion to its read
  std::array<int, 256> source_{};         // per channel, its joint or muscle
};

}  // namespace sinew::plant
