// world/kernel/contract.h - what a world needs of its mechanism and of its air.
//
// A mechanism (planar/chain_body.h, planar/body_mechanism.h, slide/slide_mechanism.h) has
//
//   Scalar         a double, or a pack of them: mechanisms side by side
//   Motion         the generalized state: coordinates, rates      Acceleration   d(rates)/dt
//   Ends, Arms     what the air feels of a motion: lengths and rates of the muscles, travel of a
//                  piston; moment arms
//   Pose, Load     of one look: what the equations of motion need; all that pushes but dry friction
//   Forces         dry friction that is held through a step
//
//   start()                            where it starts
//   node_step(setup)                   between nodes [s]
//   route(t, motion, ends, arms)       muscles' lengths and rates, moment arms -dL/dq
//   pose(t, motion)                    mass matrix, places, what is prescribed there
//   load(pose, motion, arms, look, load)       forces, by the air's look
//   accelerate(pose, motion, load, held)       under the frictions that are held
//   move(out, from, h, rates, a)       from (+) h rates, and h a
//   finish(motion, h, stages, a)       RK4's weighted mean
//   sum(motion)                        no number where a coordinate is none
//
// One whose laws hold through a step (WholeSteps) decides dry friction once a step, all contacts
// together:
//
//   prepare(pose, motion, arms, bounds, trolley bound, load)   at a node: the friction problem
//   hold(h, last)                      friction of a step of length h from there
//   accelerate(free, held)             accelerations there, under that friction
//   glide(motion, h, a)                along a constant acceleration, for a peek
//
// and may leave out nodes (SkipsNodes) while what asks for them is out of reach:
//
//   next_multiple(multiple, step, pose, motion)   of the body step, where the next node is due
//
// and may take a damper that is quicker than the step into the later stages (RelaxesStages):
//
//   relax(h, share, load, before, a)   accelerations in a step of length h, by those before
//
// and may be moved through a table, whose points are nodes (PrescribesMotion):
//
//   corner_after(t)                    the next point [s]
//   begin(t, motion)                   what is prescribed from a node on
//
// and may be lifted by a cylinder (LiftsBody):
//
//   lift_per_force()                   most acceleration of the body per force of the piston [1/kg]
//
// One whose laws break off within a step (CutsSteps) has its step end there and another begin:
//
//   begin(t, motion)               a smooth part begins: what is prescribed goes into the motion
//   corner()                       where that part ends at the latest, by what is prescribed [s]
//   longest_piece(motion, look)    that suits the fastest rate there [s]
//   watches(held), gap(...)        how far a state is beyond what the part can hold: cut.h
//   cut_within()                   how near the break its cut must be [s]
//   stop(motion, held)             at a cut: what turned back against its friction rests
//   hold(motion, load, held)       dry friction of the part, by what it was before
//
// Air (air/network.h) has State, what is integrated; Valves and Memory, what holds until the
// next node; Answer, all that one look says; Course, what goes through a step ahead of the body.
// All that lasts from node to node is copied like bytes.
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "sinew/signals/port.h"

namespace sinew::plant {

// A mechanism: it has all of the first list.
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
  m.glide(q, h, a);
};

// A mechanism that may leave out nodes where nothing happens.
template <class M>
concept SkipsNodes = WholeSteps<M> &&
    requires(const M& m, const typename M::Pose& pose, const typename M::Motion& q, double step) {
  { m.next_multiple(std::int64_t{}, step, pose, q) } -> std::same_as<std::int64_t>;
};

// A mechanism that takes a quick damper into the later stages.
template <class M>
concept RelaxesStages = WholeSteps<M> &&
    requires(const M& m, double h, const typename M::Load& load,
             const typename M::Acceleration& before, typename M::Acceleration& a) {
  m.relax(h, h, load, before, a);
};

// A mechanism that is moved through a table.
template <class M>
concept PrescribesMotion = WholeSteps<M> && requires(const M& m, double t, typename M::Motion& q) {
  { m.corner_after(t) } -> std::same_as<double>;
  m.begin(t, q);
};

// A mechanism whose body a cylinder may lift: the air in its chambers is a spring that grows stiff
// as a chamber vanishes.
template <class M>
concept LiftsBody = WholeSteps<M> && requires(const M& m) {
  { m.lift_per_force() } -> std::same_as<double>;
};

// A mechanism whose steps end where a law breaks off.
template <class M>
concept CutsSteps = IsMechanism<M> && M::cuts_steps &&
    requires(M& m, double t, typename M::Motion& q, typename M::Forces& held,
             const typename M::Load& load) {
  m.begin(t, q);
  m.stop(q, held);
  { m.corner() } -> std::same_as<double>;
  { m.watches(held) } -> std::same_as<bool>;
  { m.gap(q, q, held, load) } -> std::same_as<double>;
  { m.cut_within() } -> std::same_as<double>;
  { m.hold(q, load, held) } -> std::same_as<typename M::Forces>;
};

// Air that goes with the mechanism.
template <class A, class M>
concept IsAirOf = IsMechanism<M> && std::is_trivially_copyable_v<typename A::State> &&
    std::is_trivially_copyable_v<typename A::Valves> &&
    std::is_trivially_copyable_v<typename A::Memory> &&
    requires(const A& air, double t, const typename M::Ends& ends, const typename A::State& state,
             typename A::State& out, typename A::Valves& valves, typename A::Memory& memory,
             typename A::Answer& look, const typename A::Answer* const (&looks)[4],
             const typename A::Course& course, const signals::Edge& edge) {
  air.evaluate(t, ends, state, valves, memory, look);
  air.move(out, state, t, look, valves, course);
  air.finish(out, t, looks, valves, course);
  air.command(edge, t, look, valves);
  air.move_valves(t, look, valves);
  air.remember(look, state, memory);
  { air.flowing(valves) } -> std::same_as<bool>;
  { air.valves() } -> std::same_as<int>;
  { valves.next_change } -> std::convertible_to<double>;
};

}  // namespace sinew::plant
