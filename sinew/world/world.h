// world/world.h - a machine that its muscles move, as a Port: nodes, steps, cuts, peeks and
// events, written once for every mechanism and every air.
//
// One RK4 over body and air. Committed nodes are the multiples of the body step (less those that a
// mechanism which SkipsNodes needs not) and the instants at which valves really open or close,
// nothing else; a node is committed only when no earlier edge can still arrive. Readings, logs and
// viewers peek: they extrapolate from the last node in a copy, so that nobody's looking changes a
// bit.
//
//   order of one step:  node (valves, reference of the pressure, first stage)
//                       -> dry friction for this step -> three more stages -> next node
//
// A step is divided in two ways; neither makes a node:
//
//   pieces   where air is quicker than the body: equal parts, under the friction of the whole
//   cuts     a mechanism that CutsSteps has its step end, and another begin, where a law breaks off
//            (an end stop, rest, breakaway, a corner of a schedule), each part in pieces that suit
//            its fastest rate, dry friction decided anew at each; a peek integrates as a step does
//
// Model, state and scratch are apart: mechanism and air are constant once made, State is everything
// that the future depends on, one block that is copied like bytes, and all else is worked out from
// it at a node.
//
// Mechanism  what moves: routes of the muscles, forces, equations of motion, contacts; contract.h
//            says what it has to have, and what the air
// Senses     of the mechanism: what its sensors read and what a simulation tells (planar/senses.h,
//            slide/senses.h)
// Air        what fills the muscles: valves, masses, pressures, tensions (air/network.h,
//            slide/stand_air.h)
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

#include "sinew/air/failure.h"
#include "sinew/signals/port.h"
#include "sinew/world/contract.h"

namespace sinew::plant {

template <IsMechanism Mechanism, IsAirOf<Mechanism> Air>
class World final : public signals::Port {
  using Acceleration = typename Mechanism::Acceleration;
  using Forces = typename Mechanism::Forces;
  using Memory = typename Air::Memory;

  // The part of the state that is integrated.
  struct Moving {
    typename Mechanism::Motion motion;
    typename Air::State air;
  };

  // Everything that one look at a state yields.
  struct Look {
    typename Mechanism::Ends ends;
    typename Mechanism::Arms arms;
    typename Air::Answer air;
    typename Mechanism::Load load;  // all that pushes the coordinates but dry friction
    Acceleration acceleration;      // with the friction of the step
  };

 public:
  using Body = Mechanism;
  using Setup = typename Mechanism::Setup;
  using Senses = typename Mechanism::Senses;
  using Truth = typename Senses::Truth;
  using Motion = typename Mechanism::Motion;

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
    air::Failure failure;
  };

  // The setup must be free of contradictions (robot::contradictions); a stand's throws
  // std::invalid_argument if it is not.
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

  // Returns where the machine is at the last node; its constants; the air in it [kg]; the node's
  // time [s]; the shortest step of body and air [s]; how many nodes there were; and what of it is
  // no number any more.
  const Motion& motion() const noexcept { return state_.now.motion; }
  const auto& constants() const noexcept { return mechanism_.constants(); }
  double air_mass() const noexcept {  // in chambers, hoses and tank [kg]
    return air_.total_mass(state_.now.air, state_.first.ends.travel);
  }
  double time() const noexcept { return state_.time; }
  double shortest_step() const noexcept {  // of body and air, where it starts [s]
    return std::min(step_, longest_piece_of(state_.first));
  }
  std::int64_t nodes() const noexcept { return state_.nodes; }
  const air::Failure& failure() const noexcept { return state_.failure; }

  // Returns everything that its future depends on.
  const State& state() const noexcept { return state_; }
  // Goes on from there as the world did whose state it was: the same bits.
  void restore(const State& state) noexcept;
  // For whoever integrates in this world's place (packs/chain_batch.h): the state, to be brought
  // to another node; and then the world goes on from there.
  State& borrow() noexcept { return state_; }
  void resume() noexcept {
    (void)prepare_friction(mechanism_.pose(state_.time, state_.now.motion));
  }
  double body_step() const noexcept { return step_; }  // between nodes [s]

  // For tests: rates at the last node, of the joints (those not given: 0) [rad/s], of the trolley
  // and of the lift [m/s].
  template <WholeSteps = Mechanism>
  void set_rates(std::initializer_list<double> joint_rates, double x_rate,
                 double y_rate = 0) noexcept {
    mechanism_.set_rates(state_.now.motion, joint_rates, x_rate, y_rate);
    prepare();
  }

  // For the senses: the machine as somebody sees it at t, who looks from the last node in a copy.
  struct Peek {
    Moving state;
    Look look;
  };
  Peek peek(double t) noexcept;
  // One of which a muscle's own tension and pressure are asked.
  Peek peek_muscle(double t, int) noexcept { return peek(t); }
  // Friction and accelerations that the last peek went by.
  struct Glance {
    Forces held{};
    Acceleration acceleration{};
    Acceleration mean{};  // over the whole step, where a damper is quicker (RelaxesStages)
  };
  const Glance& glanced() const noexcept { return glance_; }
  template <WholeSteps = Mechanism>
  Motion peek_motion(double t) noexcept {
    const Glance& g = glance();
    Motion motion = state_.now.motion;
    mechanism_.glide(motion, t - state_.time, RelaxesStages<Mechanism> ? g.mean : g.acceleration);
    return motion;
  }
  const Mechanism& mechanism() const noexcept { return mechanism_; }
  const Air& air() const noexcept { return air_; }
  const Senses& senses() const noexcept { return senses_; }
  const auto& arms() const noexcept { return state_.first.arms; }
  // Bounds of dry friction at the last node: of a muscle's mesh [N], and of a contact.
  template <WholeSteps = Mechanism>
  double friction_bound(int muscle) const noexcept {
    return state_.first.air.friction_bound[muscle];
  }
  template <WholeSteps = Mechanism>
  double bound(int contact) const noexcept {
    return mechanism_.bound(contact);
  }
  bool ended() const noexcept { return state_.ended; }
  // Ticks from the start of the channel's conversions to their reads.
  signals::Tick lag(signals::Channel channel) const noexcept { return lag_[channel.index]; }

 private:
  void evaluate_air(double t, const Moving& state, const Memory& memory, Look& look,
                    std::uint64_t ahead = 0) const noexcept {
    mechanism_.route(t, state.motion, look.ends, look.arms);
    air_.evaluate(t, look.ends, state.air, state_.valves, memory, look.air, ahead);
  }
  void look_at(double t, const Moving& state, const Memory& memory, const Forces& held, Look& look,
               std::uint64_t ahead = 0) const noexcept;
  void prepare() noexcept;
  Acceleration prepare_friction(const typename Mechanism::Pose& pose) noexcept;
  void look_for_failure() noexcept;
  // Does a step go from one multiple of the body step that is due to the next one?
  bool is_whole(double to) const noexcept {
    return state_.time == static_cast<double>(state_.multiple) * step_ &&
           to == static_cast<double>(state_.multiple + 1 + skipped_) * step_;
  }
  double next_node() const noexcept;
  double whole_step() const noexcept {  // from one multiple to the next that is due [s]
    return static_cast<double>(1 + skipped_) * step_;
  }
  void commit() noexcept;
  void step(double to) noexcept;
  void piece(double from, double h, Moving& now, const Memory& memory, const Look& look,
             const Acceleration& first, const Forces& held) const noexcept;
  double longest_piece_of(const Look& look) const noexcept;  // infinite where nothing is quick [s]
  double pieces_of(double h, const Look& look) const noexcept;

  // These serve mechanisms that cut their steps.
  template <CutsSteps = Mechanism>
  void begin_part(double t, Moving& s, const Memory& memory, Forces& held, Look& look) noexcept;
  template <CutsSteps = Mechanism>
  void go(double from, double to, Moving& s, Memory& memory, Forces& held, Look& first) noexcept;
  template <CutsSteps = Mechanism>
  double gap(double t, const Moving& before, const Moving& after, const Memory& memory,
             const Forces& held) const noexcept;
  template <CutsSteps = Mechanism>
  double longest_piece(const Moving& s, const Look& look) const noexcept;

  const Glance& glance() noexcept;
  template <WholeSteps = Mechanism>
  void extrapolate(double t, Peek& p) noexcept;

  // A step is cut into at most so many pieces. More are asked for only where a chamber has
  // vanished.
  static constexpr double most_pieces = 1e5;

  Mechanism mechanism_;
  Air air_;
  double step_ = 1e-3;
  std::int64_t skipped_ = 0;  // multiples of it before the next node

  State state_{};
  Glance glance_{};  // from this node, once somebody has looked
  bool glanced_ = false;

  Senses senses_;
  std::array<signals::Tick, 256> lag_{};  // per channel, from the start of a conversion to its read
};

}  // namespace sinew::plant
