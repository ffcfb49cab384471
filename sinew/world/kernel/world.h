// world/kernel/world.h - simulation of a machine with muscles, as a Port: nodes, steps, cuts,
// previews and events, for every mechanism and every air.
//
// Body and air are integrated together by RK4. Nodes are committed at the multiples of the body
// step (except those that a SkipsNodes mechanism does not need) and at the effective edges of
// valves, nowhere else; a node is committed only when no earlier edge can still arrive. Readings,
// logs and viewers use previews: these extrapolate from the last node in a copy, so that they
// change no bit of the simulation.
//
//   order of one step:  node (valves, reference of the pressure, first stage)
//                       -> dry friction for this step -> three more stages -> next node
//
// A step is divided in two ways; neither makes a node:
//
//   pieces   where air is quicker than the body: equal parts, under the friction of the whole step
//   cuts     a CutsSteps mechanism ends the step and begins another at discontinuities of its laws
//            (an end stop, rest, breakaway, a corner of a schedule); each part has pieces that suit
//            its fastest rate, with dry friction computed for each; a preview integrates likewise
//
// Model, state and scratch are separate: mechanism and air are constant after construction; State
// is the complete state, one trivially copyable block; all else is computed from it at a node.
//
//   Mechanism  routes of the muscles, forces, equations of motion, contacts; contract.h lists the
//              requirements, also for the air
//   Senses     of the mechanism: values of its sensors and true values (planar/planar_mechanism.h,
//              slide/senses.h)
//   Air        valves, masses, pressures, tensions (air/network.h, slide/stand_air.h)
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>

#include "sinew/air/failure.h"
#include "sinew/signals/port.h"
#include "sinew/world/kernel/contract.h"
#include "sinew/world/kernel/cut.h"
#include "sinew/world/kernel/nodes.h"
#include "sinew/world/kernel/reading.h"

namespace sinew::plant {

template <IsMechanism Mechanism, IsAirOf<Mechanism> Air>
class World final : public signals::Port, private Nodes<Mechanism, Air> {
  using Integrated = Nodes<Mechanism, Air>;
  using typename Integrated::Evaluation;
  using typename Integrated::Moving;
  using Acceleration = typename Mechanism::Acceleration;
  using Forces = typename Mechanism::Forces;
  using Memory = typename Air::Memory;
  struct NoVisitor {
    void operator()(const auto&...) const noexcept {}
  };

 public:
  using Body = Mechanism;
  using Setup = typename Mechanism::Setup;
  using Senses = typename Mechanism::Senses;
  using Truth = typename Senses::Truth;
  using Motion = typename Mechanism::Motion;

  // The state at the last committed node, and the commands since. Trivially copyable; valid for one
  // build of the library and for worlds of equal setups.
  struct State {
    Moving now;
    typename Air::Valves valves;
    typename Air::Memory memory;
    Forces held;           // friction of the last step
    double trolley_bound;  // bound of the trolley's friction in the next step [N]
    Evaluation first;      // first stage at the node, without friction
    NodeTimes times;
    bool ended;
    air::Failure failure;
  };

  // The setup must be free of contradictions (robot::contradictions). A stand throws
  // std::invalid_argument if it is not.
  explicit World(const Setup& setup);

  signals::Status start(const signals::Scan& scan) noexcept override;
  // Returns Status::invalid for an edge before the last node.
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // Returns the true values at t [s]. For a t before that of an earlier call the last node is used.
  // Commits the nodes that are due and extrapolates the rest. The second function writes them;
  // parts that the machine does not have stay as they are.
  Truth truth(double t) noexcept {
    Truth out;
    truth(t, out);
    return out;
  }
  void truth(double t, Truth& out) noexcept;

  // Commits every node up to t. If the mechanism cuts its steps, visit(from, before, to, after) is
  // called with the times [s] and the motions at both ends of each smooth piece.
  template <class Visit = NoVisitor>
  void advance(double t, const Visit& visit = {}) noexcept;

  // Return the motion at the last node; the constants; the air in the machine [kg]; the node's time
  // [s]; the shortest step of body and air [s]; the number of nodes; and the failure, if any
  // part of the state is not finite.
  const Motion& motion() const noexcept { return state_.now.motion; }
  const auto& constants() const noexcept { return mechanism_.constants(); }
  bool took_air() const noexcept {  // whether a muscle took air from the supply since the start
    bool any = false;
    for (int i = 0; i < air_.muscles(); ++i) any = any || air_.account(state_.now.air, i).in > 0;
    return any;
  }
  double air_mass() const noexcept {  // chambers, hoses and tank [kg]
    return air_.total_mass(state_.now.air, state_.first.ends.travel);
  }
  double time() const noexcept { return state_.times.time; }
  double shortest_step() const noexcept {  // body and air, at the start [s]
    return std::min(step_, longest_piece_of(state_.first));
  }
  std::int64_t nodes() const noexcept { return state_.times.nodes; }
  const air::Failure& failure() const noexcept { return state_.failure; }

  // Returns the complete state.
  const State& state() const noexcept { return state_; }
  // Continues from this state as its world did, with the same bits.
  void restore(const State& state) noexcept;
  // Serve chain_lanes.h, which integrates instead of this world: mutable_state() gives access to
  // the state, to move it to another node; after continue_from_state() the world continues from
  // there.
  State& mutable_state() noexcept { return state_; }
  void continue_from_state() noexcept {
    prepare_friction(mechanism_.pose(state_.times.time, state_.now.motion));
  }
  double body_step() const noexcept { return step_; }  // between nodes [s]

  // For a loop outside of Sinew, at the last node: apply an edge of a valve; set the motion from
  // there on; and make a node at t [s], up to which all others are committed.
  void command(const signals::Edge& edge) noexcept {
    air_.command(edge, state_.times.time, state_.first.air, state_.valves);
    prepare();
  }
  void set_motion(const Motion& motion) noexcept {
    state_.now.motion = motion;
    prepare();
  }
  void node_at(double t) noexcept {
    advance(t);
    if (!state_.failure && t > state_.times.time) commit(t, NoVisitor());
  }

  // For tests: sets the rates at the last node, of the joints (missing ones: 0) [rad/s], of the
  // trolley and of the lift [m/s].
  template <WholeSteps = Mechanism>
  void set_rates(std::initializer_list<double> joint_rates, double x_rate,
                 double y_rate = 0) noexcept {
    mechanism_.set_rates(state_.now.motion, joint_rates, x_rate, y_rate);
    prepare();
  }

  // For the senses: the machine at t, extrapolated from the last node in a copy.
  struct Preview {
    Moving state;
    Evaluation evaluation;
  };
  Preview preview(double t) noexcept;
  // Returns a preview in which only this muscle's tension and pressure are required.
  Preview preview_muscle(double t, int) noexcept { return preview(t); }
  // Friction and accelerations that the last preview used.
  struct StepPreview {
    Forces held{};
    Acceleration acceleration{};
    Acceleration mean{};  // over the whole step, where a damper is quicker (RelaxesStages)
  };
  const StepPreview& step_preview() const noexcept { return step_preview_; }
  template <WholeSteps = Mechanism>
  Motion preview_motion(double t) noexcept {
    const StepPreview& g = update_step_preview();
    Motion motion = state_.now.motion;
    mechanism_.extrapolate(motion, t - state_.times.time,
                           RelaxesStages<Mechanism> ? g.mean : g.acceleration);
    return motion;
  }
  const Mechanism& mechanism() const noexcept { return mechanism_; }
  const Air& air() const noexcept { return air_; }
  const Senses& senses() const noexcept { return senses_; }
  const auto& arms() const noexcept { return state_.first.arms; }
  const auto& load() const noexcept { return state_.first.load; }  // at the last node
  // Return the bounds of dry friction at the last node: of a muscle's mesh [N], and of a contact.
  template <WholeSteps = Mechanism>
  double friction_bound(int muscle) const noexcept {
    return state_.first.air.friction_bound[muscle];
  }
  template <WholeSteps = Mechanism>
  double bound(int contact) const noexcept {
    return mechanism_.bound(contact);
  }
  bool ended() const noexcept { return state_.ended; }
  // Returns the ticks from the start of the channel's conversions to their reads.
  signals::Tick lag(signals::Channel channel) const noexcept { return lag_[channel.index]; }

 private:
  void evaluate_air(double t, const Moving& state, const Memory& memory, Evaluation& evaluation,
                    std::uint64_t ahead = 0) const noexcept {
    Integrated::evaluate_air(t, state, state_.valves, memory, evaluation, ahead);
  }
  void evaluate(double t, const Moving& state, const Memory& memory, const Forces& held,
                Evaluation& evaluation, std::uint64_t ahead = 0) const noexcept {
    Integrated::evaluate(t, state, state_.valves, memory, held, evaluation, ahead);
  }
  void integrate_piece(double from, double h, Moving& now, const Memory& memory,
                       const Evaluation& evaluation, const Acceleration& first,
                       const Forces& held) const noexcept {
    Integrated::integrate_piece(from, h, now, state_.valves, memory, evaluation, first, held);
  }
  void prepare() noexcept;
  void prepare_friction(const typename Mechanism::Pose& pose) noexcept;
  void check_for_failure() noexcept;
  // Returns whether a step goes from one due multiple of the body step to the next one.
  bool is_whole(double to) const noexcept {
    return state_.times.time == static_cast<double>(state_.times.multiple) * step_ &&
           to == static_cast<double>(state_.times.multiple + 1 + skipped_) * step_;
  }
  double next_node() const noexcept;
  double whole_step() const noexcept {  // time from one due multiple to the next [s]
    return static_cast<double>(1 + skipped_) * step_;
  }
  template <class Visit>
  void commit(double next, const Visit& visit) noexcept;
  template <class Visit>
  void step(double to, const Visit& visit) noexcept;
  double longest_piece_of(
      const Evaluation& evaluation) const noexcept;  // infinite if no part is quick [s]
  double pieces_of(double h, const Evaluation& evaluation) const noexcept;

  // For mechanisms that cut their steps.
  template <CutsSteps = Mechanism>
  void begin_part(double t, Moving& s, const Memory& memory, Forces& held,
                  Evaluation& evaluation) noexcept;
  template <class Visit>
  void integrate_parts(double from, double to, Moving& s, Memory& memory, Forces& held,
                       Evaluation& first,
                       const Visit& visit) noexcept requires CutsSteps<Mechanism>;
  template <CutsSteps = Mechanism>
  double gap(double t, const Moving& before, const Moving& after, const Memory& memory,
             const Forces& held) const noexcept;
  template <CutsSteps = Mechanism>
  double longest_piece(const Moving& s, const Evaluation& evaluation) const noexcept;

  const StepPreview& update_step_preview() noexcept;
  template <WholeSteps = Mechanism>
  void extrapolate(double t, Preview& p) noexcept;

  // Largest number of pieces of a step. Only a vanishing chamber would need more.
  static constexpr double most_pieces = 1e5;

  using Integrated::air_;
  using Integrated::mechanism_;
  double step_ = 1e-3;
  std::int64_t skipped_ = 0;  // multiples to skip before the next node

  State state_{};
  StepPreview step_preview_{};  // for this node, once it has been computed
  bool has_step_preview_ = false;

  Senses senses_;
  std::array<signals::Tick, 256> lag_{};  // per channel, from the start of a conversion to its read
};

template <IsMechanism M, IsAirOf<M> A>
World<M, A>::World(const Setup& setup)
    : Integrated(setup), step_(mechanism_.node_step(setup)), senses_(setup) {
  static_assert(std::is_trivially_copyable_v<State>);
  Evaluation& first = state_.first;
  state_.now.motion = mechanism_.start();
  mechanism_.route(0, state_.now.motion, first.ends, first.arms);
  state_.now.air = mechanism_.start_air(air_, setup, first.ends);
  state_.valves = air_.valves_at_rest();
  state_.memory = mechanism_.start_memory(air_, setup, first.ends);
  prepare();
}

// Prepares a new node: valves and references, the first stage, and the friction problem.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::prepare() noexcept {
  Evaluation& first = state_.first;
  air_.move_valves(state_.times.time, state_.first.air, state_.valves);
  if constexpr (PrescribesMotion<M>) mechanism_.begin(state_.times.time, state_.now.motion);
  if constexpr (CutsSteps<M>) {
    begin_part(state_.times.time, state_.now, state_.memory, state_.held, first);
    check_for_failure();
  } else {
    evaluate_air(state_.times.time, state_.now, state_.memory, first,
                 air_.always_quick_muscles(state_.valves));
    check_for_failure();
    state_.trolley_bound = mechanism_.trolley_bound(state_.held, state_.trolley_bound);
    prepare_friction(mechanism_.pose(state_.times.time, state_.now.motion));
  }
}

// Computes the friction problem of the node, and the accelerations without friction.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::prepare_friction(const typename M::Pose& pose) noexcept {
  has_step_preview_ = false;
  if constexpr (SkipsNodes<M>)
    skipped_ = mechanism_.next_multiple(state_.times.multiple, step_, pose, state_.now.motion) -
               (state_.times.multiple + 1);
  if constexpr (!CutsSteps<M>)  // else each part has its own
    this->prepare_forces(pose, state_.now.motion, state_.trolley_bound, state_.first);
}

template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::restore(const State& state) noexcept {
  state_ = state;
  continue_from_state();
}

// Records a failure if any value of the node's evaluation is not finite. Also updates the air's
// memory from that evaluation.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::check_for_failure() noexcept {
  const air::Failure of_air = air_.update_memory(state_.first.air, state_.now.air, state_.memory);
  if (state_.failure) return;
  if (of_air) {
    state_.failure = of_air;
    state_.failure.time = state_.times.time;
    if (of_air.of == air::Failure::Of::air)
      state_.failure.length = state_.first.ends.length[of_air.muscle];
  } else if (!air::is_position(mechanism_.sum(state_.now.motion))) {
    state_.failure = {.of = air::Failure::Of::motion, .time = state_.times.time};
  }
}

// While nothing flows, only the air that a piston traps can be quick.
template <IsMechanism M, IsAirOf<M> A>
double World<M, A>::longest_piece_of(const Evaluation& evaluation) const noexcept {
  double longest = std::numeric_limits<double>::infinity();
  if (air_.flowing(state_.valves))
    longest = air_.longest_step_of_rest(evaluation.ends, state_.valves);
  if constexpr (LiftsBody<M>)
    longest = std::min(longest, air_.longest_step_of_piston(evaluation.ends, evaluation.air,
                                                            mechanism_.lift_per_force()));
  return longest;
}

template <IsMechanism M, IsAirOf<M> A>
double World<M, A>::pieces_of(double h, const Evaluation& evaluation) const noexcept {
  const double longest = longest_piece_of(evaluation);
  return h > longest ? std::min(std::ceil(h / longest), most_pieces) : 1.0;
}

// Hoses, walls and lags can be quicker than the body: the step then consists of several pieces,
// under the friction of the whole step.
template <IsMechanism M, IsAirOf<M> A>
template <class Visit>
void World<M, A>::step(double to, const Visit& visit) noexcept {
  if constexpr (CutsSteps<M>) {
    integrate_parts(state_.times.time, to, state_.now, state_.memory, state_.held, state_.first,
                    visit);
  } else {
    const double h = to - state_.times.time;
    Acceleration first;
    if (SkipsNodes<M> && is_whole(to)) {  // a preview uses the same friction
      first = update_step_preview().acceleration;
      state_.held = step_preview_.held;
    } else {
      state_.held = mechanism_.hold(h, state_.held);
      first = mechanism_.accelerate(state_.first.acceleration, state_.held);
    }
    const double pieces = pieces_of(h, state_.first);
    for (double k = 0; k < pieces; ++k) {
      const double from = state_.times.time + k * (h / pieces);
      if (k > 0) {
        evaluate(from, state_.now, state_.memory, state_.held, state_.first,
                 air_.always_quick_muscles(state_.valves));
        air_.update_memory(state_.first.air, state_.now.air, state_.memory);
        first = state_.first.acceleration;
      }
      integrate_piece(from, h / pieces, state_.now, state_.memory, state_.first, first,
                      state_.held);
    }
  }
}

// Returns the next due multiple of the body step, or the next change of a valve, or point of a
// table.
template <IsMechanism M, IsAirOf<M> A>
double World<M, A>::next_node() const noexcept {
  double change = state_.valves.next_change;
  if constexpr (PrescribesMotion<M>)
    change = std::min(change, mechanism_.corner_after(state_.times.time));
  return state_.times.next(step_, skipped_, change);
}

template <IsMechanism M, IsAirOf<M> A>
template <class Visit>
void World<M, A>::advance(double t, const Visit& visit) noexcept {
  for (double next; !state_.failure && (next = next_node()) <= t;) commit(next, visit);
}

template <IsMechanism M, IsAirOf<M> A>
template <class Visit>
void World<M, A>::commit(double next, const Visit& visit) noexcept {
  if (next > state_.times.time) step(next, visit);
  state_.times.pass(next, step_);
  prepare();
}

// Returns the friction of a whole body step from the last node. Previews use it, whatever their
// length, so that it depends on the node alone.
template <IsMechanism M, IsAirOf<M> A>
auto World<M, A>::update_step_preview() noexcept -> const StepPreview& {
  if (has_step_preview_) return step_preview_;
  has_step_preview_ = true;
  if constexpr (!CutsSteps<M>) {
    step_preview_.held = mechanism_.hold(whole_step(), state_.held);
    step_preview_.acceleration =
        mechanism_.accelerate(state_.first.acceleration, step_preview_.held);
  }
  if constexpr (RelaxesStages<M>) {
    step_preview_.mean = step_preview_.acceleration;
    mechanism_.relax(whole_step(), 0.5, state_.first.load, {}, step_preview_.mean);
  }
  return step_preview_;
}

// Extrapolates from the last node to t in a copy: the body by its acceleration, the air by Heun's
// rule in as many pieces as a step would take. A mechanism that cuts its steps is integrated
// instead, and an instant before the last node has the values prescribed at that time.
template <IsMechanism M, IsAirOf<M> A>
auto World<M, A>::preview(double t) noexcept -> Preview {
  Preview p{.state = state_.now, .evaluation = state_.first};
  if constexpr (CutsSteps<M>) {
    Memory memory = state_.memory;
    step_preview_.held = state_.held;
    if (!state_.failure)
      integrate_parts(state_.times.time, t, p.state, memory, step_preview_.held, p.evaluation,
                      NoVisitor());
    begin_part(t, p.state, memory, step_preview_.held, p.evaluation);
    step_preview_.acceleration = p.evaluation.acceleration;
  } else {
    (void)update_step_preview();
    if (t > state_.times.time && !state_.failure) extrapolate(t, p);
  }
  return p;
}

template <IsMechanism M, IsAirOf<M> A>
template <WholeSteps>
void World<M, A>::extrapolate(double t, Preview& p) noexcept {
  const double dt = t - state_.times.time;
  const double pieces = pieces_of(dt, state_.first), h = dt / pieces;
  for (double k = 1; k <= pieces; ++k) {
    const double to = k < pieces ? state_.times.time + k * h : t;
    p.state.motion = preview_motion(to);
    if (air_.flowing(state_.valves)) {
      const typename A::State from = p.state.air;
      const typename A::Evaluation before = p.evaluation.air;
      typename A::QuickMasses quick_masses;
      air_.plan(to - h, h, p.evaluation.ends, from, state_.valves, state_.memory, quick_masses);
      air_.move(p.state.air, from, h, before, state_.valves, quick_masses);
      evaluate_air(to, p.state, state_.memory, p.evaluation, quick_masses.muscles);
      air_.correct(p.state.air, from, h, before, p.evaluation.air, state_.valves, quick_masses);
    }
    evaluate_air(to, p.state, state_.memory, p.evaluation,
                 air_.always_quick_muscles(state_.valves));
  }
}

template <IsMechanism M, IsAirOf<M> A>
signals::Status World<M, A>::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions) {
    if (c.channel.index >= senses_.channels()) return signals::Status::invalid;
    lag_[c.channel.index] = c.read - c.start;
  }
  return signals::Status::ok;
}

template <IsMechanism M, IsAirOf<M> A>
signals::Status World<M, A>::drive(signals::Edge edge) noexcept {
  if (state_.ended) return signals::Status::ended;
  if (state_.failure) return signals::Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= air_.valves() || t < state_.times.time) return signals::Status::invalid;
  // Later edges act at t or after, so these nodes are final.
  for (double next; !state_.failure && (next = next_node()) < t;) commit(next, NoVisitor());
  air_.command(edge, t, state_.first.air, state_.valves);
  return signals::Status::ok;
}

template <IsMechanism M, IsAirOf<M> A>
signals::Reading World<M, A>::read(signals::Channel channel, signals::Tick now) noexcept {
  return reading(*this, senses_, channel, now - lag_[channel.index]);
}

template <IsMechanism M, IsAirOf<M> A>
signals::Status World<M, A>::stop(signals::Tick) noexcept {
  state_.ended = true;  // a simulated body does not move after its last tick
  return state_.failure ? signals::Status::fault : signals::Status::ok;
}

template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::truth(double t, Truth& out) noexcept {
  advance(t);
  senses_.truth(*this, std::max(t, state_.times.time), out);
}

// Begins a smooth part at t: writes the prescribed values to the state, and determines the
// friction from an evaluation there.
template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
void World<M, A>::begin_part(double t, Moving& s, const Memory& memory, Forces& held,
                             Evaluation& evaluation) noexcept {
  mechanism_.begin(t, s.motion);
  mechanism_.route(t, s.motion, evaluation.ends, evaluation.arms);
  air_.place(evaluation.ends, s.air);
  air_.use_whole_laws();
  air_.evaluate(t, evaluation.ends, s.air, state_.valves, memory, evaluation.air);
  air_.choose_sides(evaluation.air, state_.valves);
  const typename M::Pose pose = mechanism_.pose(t, s.motion);
  mechanism_.load(pose, s.motion, evaluation.arms, evaluation.air, evaluation.load);
  held = mechanism_.hold(s.motion, evaluation.load, held);
  evaluation.acceleration = mechanism_.accelerate(pose, s.motion, evaluation.load, held);
}

// Integrates from one instant to another. `first` is the evaluation at `from`, and finally that at
// the beginning of the last piece.
template <IsMechanism M, IsAirOf<M> A>
template <class Visit>
void World<M, A>::integrate_parts(double from, double to, Moving& s, Memory& memory, Forces& held,
                                  Evaluation& first,
                                  const Visit& visit) noexcept requires CutsSteps<M> {
  constexpr double shortest = 1e-7;  // shortest piece that is not cut [s]
  Moving others[2];
  Moving *now = &s, *after = &others[0], *spare = &others[1];
  for (double t = from; t < to;) {
    if (t > from) {
      begin_part(t, *now, memory, held, first);
      air_.update_memory(first.air, now->air, memory);
    } else {
      mechanism_.begin(t, now->motion);
      air_.choose_sides(first.air, state_.valves);
    }
    const double target = std::min(to, mechanism_.corner()), whole = target - t;
    const double pieces = std::ceil(whole / std::max(longest_piece(*now, first), shortest) - 1e-9);
    double h = pieces > 1 ? whole / pieces : whole;
    double reached = pieces > 1 ? t + h : target;
    const auto integrate = [&](Moving& out, double within) {
      out = *now;
      integrate_piece(t, within, out, memory, first, first.acceleration, held);
    };
    integrate(*after, h);
    const double broken = gap(reached, *now, *after, memory, held);
    if (broken > 0) {
      // The piece is ended just beyond the discontinuity.
      const double unbroken = std::max(mechanism_.gap(now->motion, now->motion, held, first.load),
                                       air_.gap(first.air, state_.valves));
      h = cut(h, unbroken, broken, mechanism_.cut_within(), [&](double within) {
        integrate(*spare, within);
        const double g = gap(t + within, *now, *spare, memory, held);
        if (g > 0) std::swap(after, spare);
        return g;
      });
      reached = t + h;
      mechanism_.stop(after->motion, held);
    }
    visit(t, now->motion, reached, after->motion);
    std::swap(now, after);
    t = reached;
  }
  if (now == &s) return;
  s = *now;
}

// Returns the distance of `after` beyond the limit of a smooth piece that starts at `before`.
template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
double World<M, A>::gap(double t, const Moving& before, const Moving& after, const Memory& memory,
                        const Forces& held) const noexcept {
  Evaluation evaluation;
  const bool needs_gap = air_.needs_gap(state_.valves);
  if (needs_gap || mechanism_.needs_gap(held)) evaluate(t, after, memory, held, evaluation);
  const double of_body = mechanism_.gap(before.motion, after.motion, held, evaluation.load);
  return needs_gap ? std::max(of_body, air_.gap(evaluation.air, state_.valves)) : of_body;
}

template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
double World<M, A>::longest_piece(const Moving& s, const Evaluation& evaluation) const noexcept {
  return std::min(mechanism_.longest_piece(s.motion, evaluation.load, evaluation.air),
                  air_.longest_piece(evaluation.ends, evaluation.air, s.air, state_.valves));
}

}  // namespace sinew::plant
