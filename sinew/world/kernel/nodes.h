// world/kernel/nodes.h - a mechanism with its air, from node to node: evaluations, the friction
// problem of a node and RK4 over both, written once for one machine and for several side by side.
//
// S, the scalar of mechanism and air, is a double, or a pack of doubles (units/pack.h): a lane has
// the bits of the machine alone. World (world.h) is one machine as a Port, LaneNodes (lane_nodes.h)
// several.
//
// Only the model is here; the derived class owns the state.
#pragma once

#include <cstdint>

#include "sinew/world/kernel/contract.h"

namespace sinew::plant {

// Times of a machine's nodes: the multiples of its body step, and the effective edges of its
// valves.
struct NodeTimes {
  double time = 0;                       // last node [s]
  std::int64_t multiple = 0, nodes = 0;  // last passed multiple of the body step; node count

  // Returns the next node [s]: the multiple after `skipped` others, or the next change if earlier.
  double next(double step, std::int64_t skipped, double change) const noexcept {
    const double due = static_cast<double>(multiple + 1 + skipped) * step;
    return change < due ? change : due;
  }
  // Records that the node at this time has been reached.
  void pass(double at, double step) noexcept {
    if (at > time) time = at;
    while (at >= static_cast<double>(multiple + 1) * step) ++multiple;
    ++nodes;
  }
};

template <class M, class A>
class Nodes {
 public:
  using S = typename M::Scalar;

  // The part of the state that is integrated.
  struct Moving {
    typename M::Motion motion;
    typename A::State air;
  };

  // Result of one evaluation of a state.
  struct Evaluation {
    typename M::Ends ends;
    typename M::Arms arms;
    typename A::Evaluation air;
    typename M::Load load;                  // all forces on the coordinates except dry friction
    typename M::Acceleration acceleration;  // with the friction of the step
  };

 protected:
  // Takes the two models.
  Nodes(const M& mechanism, const A& air) : mechanism_(mechanism), air_(air) {}
  // Builds the models from a setup.
  template <class Setup>
  explicit Nodes(const Setup& setup)
      : mechanism_(setup), air_(mechanism_.template make_air<A>(setup)) {}

  // Evaluates the air at a state.
  void evaluate_air(const S& t, const Moving& state, const typename A::Valves& valves,
                    const typename A::Memory& memory, Evaluation& evaluation,
                    std::uint64_t ahead = 0) const noexcept {
    mechanism_.route(t, state.motion, evaluation.ends, evaluation.arms);
    air_.evaluate(t, evaluation.ends, state.air, valves, memory, evaluation.air, ahead);
  }

  // Evaluates the right side with this dry friction.
  void evaluate(const S& t, const Moving& state, const typename A::Valves& valves,
                const typename A::Memory& memory, const typename M::Forces& held,
                Evaluation& evaluation, std::uint64_t ahead = 0) const noexcept {
    if constexpr (EvaluatesStages<A>) {
      mechanism_.route(t, state.motion, evaluation.ends, evaluation.arms);
      air_.evaluate_stage(evaluation.ends, state.air, valves, memory, evaluation.air);
    } else {
      evaluate_air(t, state, valves, memory, evaluation, ahead);
    }
    const typename M::Pose pose = mechanism_.pose(t, state.motion);
    mechanism_.load(pose, state.motion, evaluation.arms, evaluation.air, evaluation.load);
    evaluation.acceleration = mechanism_.accelerate(pose, state.motion, evaluation.load, held);
  }

  // At a node whose air has been evaluated, computes the forces, the friction problem, and the
  // accelerations without friction.
  void prepare_forces(const typename M::Pose& pose, const typename M::Motion& motion,
                      const S& trolley_bound, Evaluation& first) noexcept {
    mechanism_.load(pose, motion, first.arms, first.air, first.load);
    first.acceleration = mechanism_.prepare(pose, motion, first.arms, first.air.friction_bound,
                                            trolley_bound, first.load);
  }

  // Advances the state by RK4. The first stage is the given evaluation, with these accelerations;
  // stages two to four are at 1/2, 1/2 and 1. Quick bodies of air are integrated ahead.
  void integrate_piece(const S& from, const S& h, Moving& now, const typename A::Valves& valves,
                       const typename A::Memory& memory, const Evaluation& evaluation,
                       const typename M::Acceleration& first,
                       const typename M::Forces& held) const noexcept {
    Evaluation later[3];
    Moving stage[3];
    typename A::QuickMasses quick_masses;
    if constexpr (!CutsSteps<M>)
      air_.plan(from, h, evaluation.ends, now.air, valves, memory, quick_masses);
    const typename M::Motion* motion[4] = {&now.motion, &stage[0].motion, &stage[1].motion,
                                           &stage[2].motion};
    const typename A::Evaluation* air[4] = {&evaluation.air, &later[0].air, &later[1].air,
                                            &later[2].air};
    typename M::Acceleration acceleration[4] = {first};
    for (int s = 0; s < 3; ++s) {
      const S part = s == 2 ? h : 0.5 * h;
      mechanism_.move(stage[s].motion, now.motion, part, *motion[s], acceleration[s]);
      air_.move(stage[s].air, now.air, part, *air[s], valves, quick_masses);
      evaluate(from + part, stage[s], valves, memory, held, later[s], quick_masses.muscles);
      if constexpr (RelaxesStages<M>)
        mechanism_.relax(h, 0.2, later[s].load, acceleration[s], later[s].acceleration);
      acceleration[s + 1] = later[s].acceleration;
    }

    const typename M::Motion rates = now.motion;  // rates of the first stage: the state moves
    motion[0] = &rates;
    mechanism_.finish(now.motion, h, motion, acceleration);
    air_.finish(now.air, h, air, valves, quick_masses);
  }

  M mechanism_;
  A air_;
};

}  // namespace sinew::plant
