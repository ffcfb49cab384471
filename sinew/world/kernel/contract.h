// world/kernel/contract.h - requirements of a world on its mechanism and on its air.
//
// A mechanism (planar/chain_body.h, planar/body_mechanism.h, slide/slide_mechanism.h) has
//
//   Scalar         a double, or a pack of doubles: mechanisms side by side
//   Motion         the generalized state: coordinates, rates      Acceleration   d(rates)/dt
//   Ends, Arms     inputs of the air at a motion: lengths and rates of the muscles, travel of a
//                  piston; moment arms
//   Pose, Load     parts of one evaluation: terms of the equations of motion; all forces except
//                  dry friction
//   Forces         dry friction, constant through a step
//
//   start()                            motion at the start
//   node_step(setup)                   time between nodes [s]
//   route(t, motion, ends, arms)       muscles' lengths and rates, moment arms -dL/dq
//   pose(t, motion)                    mass matrix, positions, prescribed values
//   load(pose, motion, arms, air, load)       forces, from the air's evaluation
//   accelerate(pose, motion, load, held)       acceleration under this dry friction
//   move(out, from, h, rates, a)       from (+) h rates, and h a
//   finish(motion, h, stages, a)       RK4's weighted mean
//   sum(motion)                        not finite if any coordinate is not
//
// A mechanism whose laws hold through a step (WholeSteps) computes dry friction once a step, for
// all contacts together:
//
//   prepare(pose, motion, arms, bounds, trolley bound, load)   at a node: the friction problem
//   hold(h, last)                      friction of a step of length h from there
//   accelerate(free, held)             accelerations there, under that friction
//   extrapolate(motion, h, a)          motion under a constant acceleration, for a preview
//
// It may leave out nodes (SkipsNodes) that are not needed:
//
//   next_multiple(multiple, step, pose, motion)   multiple of the body step of the next node
//
// It may treat a damper that is quicker than the step in the later stages (RelaxesStages):
//
//   relax(h, share, load, before, a)   accelerations in a step of length h, by those before
//
// It may follow a table, whose points are nodes (PrescribesMotion):
//
//   corner_after(t)                    the next point [s]
//   begin(t, motion)                   prescribed motion from a node on
//
// It may be lifted by a cylinder (LiftsBody):
//
//   lift_per_force()                   largest acceleration of the body per piston force [1/kg]
//
// A mechanism whose laws have discontinuities within a step (CutsSteps) ends the step there and
// begins another:
//
//   begin(t, motion)               begins a smooth part: writes prescribed values to the motion
//   corner()                       latest end of that part, by the prescribed values [s]
//   longest_piece(motion, load, air)  length that suits the fastest rate there [s]
//   needs_gap(held), gap(...)      distance of a state beyond the limit of the part: cut.h
//   cut_within()                   required accuracy of the cut [s]
//   stop(motion, held)             at a cut: brings to rest what reversed against its friction
//   hold(motion, load, held)       dry friction of the part, from that before
//
// Air (air/network.h) has State, which is integrated; Valves and Memory, which are constant until
// the next node; Evaluation, the result of one evaluation; QuickMasses, the parts that are
// integrated through a step ahead of the body. All data that last from node to node are trivially
// copyable. Air that needs fewer results in the stages of a step (EvaluatesStages) has
//
//   evaluate_stage(ends, state, valves, memory, evaluation)   tensions and flows only
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "sinew/signals/port.h"

namespace sinew::plant {

// A mechanism: it has all functions of the first list.
template <class M>
concept IsMechanism = std::is_trivially_copyable_v<typename M::Motion> &&
    std::is_trivially_copyable_v<typename M::Forces> &&
    requires(const M& m, const typename M::Setup& setup, double t, typename M::Motion& out,
             const typename M::Motion& q, typename M::Ends& ends, typename M::Arms& arms,
             const typename M::Load& load, const typename M::Forces& held,
             const typename M::Acceleration& a, const typename M::Motion* const (&stages)[4],
             const typename M::Acceleration (&as)[4]) {
  { M::cuts_steps } -> std::convertible_to<bool>;
  typename M::Scalar;
  typename M::Senses;
  { m.start() } -> std::convertible_to<typename M::Motion>;
  { m.node_step(setup) } -> std::same_as<double>;
  m.route(t, q, ends, arms);
  { m.pose(t, q) } -> std::convertible_to<typename M::Pose>;
  { m.accelerate(m.pose(t, q), q, load, held) } -> std::same_as<typename M::Acceleration>;
  m.move(out, q, t, q, a);
  m.finish(out, t, stages, as);
  { m.sum(q) } -> std::same_as<double>;
};

// A mechanism whose steps are never cut.
template <class M>
concept WholeSteps = IsMechanism<M> && !M::cuts_steps &&
                     requires(const M& m, double h, typename M::Motion& q,
                              const typename M::Forces& held, const typename M::Acceleration& a) {
  { m.hold(h, held) } -> std::same_as<typename M::Forces>;
  { m.accelerate(a, held) } -> std::same_as<typename M::Acceleration>;
  m.extrapolate(q, h, a);
};

// A mechanism that may leave out nodes.
template <class M>
concept SkipsNodes = WholeSteps<M> &&
    requires(const M& m, const typename M::Pose& pose, const typename M::Motion& q, double step) {
  { m.next_multiple(std::int64_t{}, step, pose, q) } -> std::same_as<std::int64_t>;
};

// A mechanism that treats a quick damper in the later stages.
template <class M>
concept RelaxesStages = WholeSteps<M> &&
    requires(const M& m, double h, const typename M::Load& load,
             const typename M::Acceleration& before, typename M::Acceleration& a) {
  m.relax(h, h, load, before, a);
};

// A mechanism that follows a table.
template <class M>
concept PrescribesMotion = WholeSteps<M> && requires(const M& m, double t, typename M::Motion& q) {
  { m.corner_after(t) } -> std::same_as<double>;
  m.begin(t, q);
};

// A mechanism whose body may be lifted by a cylinder: the air in its chambers is a spring that
// grows stiff as a chamber vanishes.
template <class M>
concept LiftsBody = WholeSteps<M> && requires(const M& m) {
  { m.lift_per_force() } -> std::same_as<double>;
};

// A mechanism whose steps end at discontinuities of its laws.
template <class M>
concept CutsSteps = IsMechanism<M> && M::cuts_steps &&
    requires(M& m, double t, typename M::Motion& q, typename M::Forces& held,
             const typename M::Load& load) {
  m.begin(t, q);
  m.stop(q, held);
  { m.corner() } -> std::same_as<double>;
  { m.needs_gap(held) } -> std::same_as<bool>;
  { m.gap(q, q, held, load) } -> std::same_as<double>;
  { m.cut_within() } -> std::same_as<double>;
  { m.hold(q, load, held) } -> std::same_as<typename M::Forces>;
};

// Air that suits the mechanism.
template <class A, class M>
concept IsAirOf = IsMechanism<M> && std::is_trivially_copyable_v<typename A::State> &&
    std::is_trivially_copyable_v<typename A::Valves> &&
    std::is_trivially_copyable_v<typename A::Memory> &&
    requires(const A& air, double t, const typename M::Ends& ends, const typename A::State& state,
             typename A::State& out, typename A::Valves& valves, typename A::Memory& memory,
             typename A::Evaluation& evaluation,
             const typename A::Evaluation* const (&evaluations)[4],
             const typename A::QuickMasses& quick_masses, const signals::Edge& edge) {
  air.evaluate(t, ends, state, valves, memory, evaluation);
  air.move(out, state, t, evaluation, valves, quick_masses);
  air.finish(out, t, evaluations, valves, quick_masses);
  air.command(edge, t, evaluation, valves);
  air.move_valves(t, evaluation, valves);
  air.update_memory(evaluation, state, memory);
  { air.flowing(valves) } -> std::same_as<bool>;
  { air.valves() } -> std::same_as<int>;
  { valves.next_change } -> std::convertible_to<double>;
};

// Air with a shorter evaluation for the stages of a step.
template <class A>
concept EvaluatesStages = requires(const A& air, const typename A::Ends& ends,
                                   const typename A::State& state, const typename A::Valves& valves,
                                   const typename A::Memory& memory,
                                   typename A::Evaluation& evaluation) {
  air.evaluate_stage(ends, state, valves, memory, evaluation);
};

}  // namespace sinew::plant
