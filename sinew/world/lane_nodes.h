// world/lane_nodes.h - W plain chains with their air, integrated side by side: nodes.h with a pack
// in the place of each number. This is all code that is compiled for processors with wide
// registers, each width in a file of its own (lanes_4.cpp, lanes_8.cpp); chain_lanes.h uses it.
//
// Each definition here has W in its name and calls no scalar function that is not compiled
// elsewhere, so the linker cannot mix its code with the code for all processors.
#pragma once

#include <array>

#include "sinew/air/plain_air.h"
#include "sinew/mechanism/planar/chain_body.h"
#include "sinew/world/kernel/nodes.h"

namespace sinew::plant {

template <int N, int W>
class LaneNodes : public Nodes<ChainBody<N, units::Pack<W>>, air::PlainAir<chain_muscles, W>> {
 public:
  using Body = ChainBody<N, units::Pack<W>>;
  using Air = air::PlainAir<chain_muscles, W>;
  using Integrated = Nodes<Body, Air>;
  using typename Integrated::Evaluation;
  using typename Integrated::Moving;
  using typename Integrated::S;
  using Mask = units::PackMask<W>;

  // State of all machines, like World::State.
  struct State {
    Moving now{};
    typename Air::Shares valves{};
    typename Air::Memory memory{};
    typename Body::Forces held{};
    S trolley_bound = 0;
    Evaluation first{};
  };
  // Friction and accelerations of a step from the node.
  struct StepPreview {
    typename Body::Forces held{};
    typename Body::Acceleration acceleration{};
  };

  // Takes the models of all lanes.
  LaneNodes(const Body& body, const Air& air) : Integrated(body, air) {}

  // Return the models, which can be replaced.
  Body& body() noexcept { return this->mechanism_; }
  const Body& body() const noexcept { return this->mechanism_; }
  Air& air() noexcept { return this->air_; }
  const Air& air() const noexcept { return this->air_; }

  // Advances by RK4 by h under the friction of the step. Lanes that do not step are unchanged.
  void step(const Mask& steps, const S& h, State& s) const noexcept;

  // Prepares a new node of the machines in `active`: references, the first stage, friction. The
  // others keep their first stage, which was evaluated before their references moved. Returns
  // whether all densities and motions are valid; `failed`: each machine's first muscle whose
  // density is not, or -1.
  bool prepare(const Mask& active, State& s, std::array<int, W>& failed) noexcept;

  // Computes the friction problem of all lanes. Equal inputs have equal results, so lanes that wait
  // do not change.
  void prepare_friction(State& s) noexcept;

  // Computes friction and accelerations of a step of length h from the node.
  void preview_step(const S& h, const State& s, StepPreview& out) const noexcept;

 private:
  static void blend(const Mask& mask, const typename Body::Motion& from,
                    typename Body::Motion& to) noexcept;
};

// Calls visit(value of a, value of b) for each per-muscle value of an evaluation, and of a state of
// the air.
template <class EvaluationA, class EvaluationB, class Visit>
void each_of_evaluation(EvaluationA& a, EvaluationB& b, const Visit& visit) {
  visit(a.ends.length, b.ends.length);
  visit(a.ends.rate, b.ends.rate);
  visit(a.air.tension, b.air.tension);
  visit(a.air.clamped, b.air.clamped);
  visit(a.air.pressure, b.air.pressure);
  visit(a.air.friction_bound, b.air.friction_bound);
  visit(a.air.drift, b.air.drift);
  visit(a.air.inflow, b.air.inflow);
  visit(a.air.outflow, b.air.outflow);
}
template <class AirA, class AirB, class Visit>
void each_of_air(AirA& a, AirB& b, const Visit& visit) {
  visit(a.mass, b.mass);
  visit(a.in, b.in);
  visit(a.out, b.out);
}

// Replaces the values in the lanes of the mask.
template <int N, int W>
void LaneNodes<N, W>::blend(const Mask& mask, const typename Body::Motion& from,
                            typename Body::Motion& to) noexcept {
  to.x = units::select(mask, from.x, to.x);
  to.x_rate = units::select(mask, from.x_rate, to.x_rate);
  for (int i = 0; i < N; ++i) {
    to.angle[i] = units::select(mask, from.angle[i], to.angle[i]);
    to.rate[i] = units::select(mask, from.rate[i], to.rate[i]);
  }
}

template <int N, int W>
void LaneNodes<N, W>::step(const Mask& steps, const S& h, State& s) const noexcept {
  const typename Body::Forces held = body().hold(h, s.held);
  for (std::size_t c = 0; c < held.size(); ++c)
    s.held[c] = units::select(steps, held[c], s.held[c]);
  const typename Body::Acceleration first = body().accelerate(s.first.acceleration, s.held);
  if (W == 1 || units::all(steps)) {  // one lane is stepped only if it steps
    this->integrate_piece(0, h, s.now, s.valves, s.memory, s.first, first, s.held);
    return;
  }
  Moving after = s.now;
  this->integrate_piece(0, h, after, s.valves, s.memory, s.first, first, s.held);
  blend(steps, after.motion, s.now.motion);
  each_of_air(after.air, s.now.air, [&](const auto& from, auto& to) {
    for (int i = 0; i < air().muscles(); ++i) to[i] = units::select(steps, from[i], to[i]);
  });
}

template <int N, int W>
bool LaneNodes<N, W>::prepare(const Mask& active, State& s, std::array<int, W>& failed) noexcept {
  if (W == 1 || units::all(active)) {
    this->evaluate_air(0, s.now, s.valves, s.memory, s.first);
  } else {
    Evaluation evaluation;
    this->evaluate_air(0, s.now, s.valves, s.memory, evaluation);
    each_of_evaluation(evaluation, s.first, [&](const auto& from, auto& to) {
      for (int i = 0; i < air().muscles(); ++i) to[i] = units::select(active, from[i], to[i]);
    });
  }
  failed = air().update_memory(active, s.first.air, s.memory);
  s.trolley_bound =
      units::select(active, body().trolley_bound(s.held, s.trolley_bound), s.trolley_bound);
  prepare_friction(s);
  bool valid = units::all(air::is_position(body().sum(s.now.motion)));
  for (const int muscle : failed) valid = valid && muscle < 0;
  return valid;
}

template <int N, int W>
void LaneNodes<N, W>::prepare_friction(State& s) noexcept {
  this->prepare_forces(body().pose(0, s.now.motion), s.now.motion, s.trolley_bound, s.first);
}

template <int N, int W>
void LaneNodes<N, W>::preview_step(const S& h, const State& s, StepPreview& out) const noexcept {
  out.held = body().hold(h, s.held);
  out.acceleration = body().accelerate(s.first.acceleration, out.held);
}

extern template class LaneNodes<2, 2>;
extern template class LaneNodes<2, 4>;
extern template class LaneNodes<2, 8>;

}  // namespace sinew::plant
