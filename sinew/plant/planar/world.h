// plant/planar/world.h - a planar machine with N joints, its muscles and its air, as a Port.
//
// One RK4 over body and air. Committed nodes are the multiples of the body step and the instants at
// which valves really open or close, nothing else; a node is committed only when no earlier edge
// can still arrive. Readings, logs and viewers peek: they extrapolate from the last node in a copy,
// so that nobody's looking changes a bit.
//
//   order of one step:  node (valves, reference of the pressure, first stage)
//                       -> dry friction for this step -> three more stages -> next node
#pragma once

#include <array>
#include <cmath>

#include "sinew/muscle/bank.h"
#include "sinew/muscle/failure.h"
#include "sinew/plant/planar/chain.h"
#include "sinew/plant/planar/contacts.h"
#include "sinew/plant/planar/layout.h"
#include "sinew/plant/planar/setup.h"
#include "sinew/robot/sensing.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

template <int N>
class World final : public signals::Port {
 public:
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

  // For tests and tools: commit every node up to t.
  void advance(double t) noexcept;
  const Pose<N>& pose() const noexcept { return state_.pose; }
  const ChainConstants<N>& constants() const noexcept { return chain_; }
  double time() const noexcept { return time_; }
  std::int64_t nodes() const noexcept { return nodes_; }
  const muscle::Failure& failure() const noexcept { return failure_; }
  void set_rates(const std::array<double, N>& joint_rates, double x_rate) noexcept;

 private:
  using Forces = typename Contacts<N>::Forces;

  struct State {
    Pose<N> pose;
    muscle::Lanes mass;
  };

  // Everything that one look at a state yields.
  struct Look {
    muscle::Lanes length, rate;
    muscle::Pull pull;
    Generalised<N> force;  // muscles, damping, ground, track's stop; no friction
    double normal = 0;     // on the foot [N]
    double ankle_x = 0, ankle_y = 0;
    Generalised<N> acceleration;  // with the friction of the step
  };

  // Friction and accelerations that a look beyond the last node goes by.
  struct Glance {
    Forces held{};
    Generalised<N> acceleration;
  };

  struct Peek {
    State state;
    Look look;
    muscle::Lanes air_in, air_out;
  };

  void strings(const Pose<N>& pose, Look& look) const noexcept;
  void forces(const Chain<N>& chain, const Pose<N>& pose, Look& look) const noexcept;
  void contact(const Chain<N>& chain, const Pose<N>& pose, Look& look) const noexcept;
  void look_at(double t, const State& state, const Forces& f, Look& look) const noexcept;

  void prepare() noexcept;  // the look at a new node

  // Is the motion at this node no number, or the air of that muscle (-1: none)?
  void look_for_failure(int muscle) noexcept {
    double places = state_.pose.x;
    for (int j = 0; j < N; ++j) places += state_.pose.angle[j];
    using Of = muscle::Failure::Of;
    if (muscle < 0 && muscle::is_place(places)) return;
    if (failure_) return;
    failure_ = {.of = muscle < 0 ? Of::motion : Of::air, .time = time_};
    if (muscle >= 0) failure_.muscle = muscle, failure_.length = first_.length[muscle];
  }

  void step(double h) noexcept;

  const Glance& glance() noexcept;
  Pose<N> peek_pose(const Glance& g, double t) const noexcept;
  Peek peek(const Glance& g, double t) const noexcept;
  double gauge(const Glance& g, const Peek& p, int muscle) const noexcept;
  void rollers(const Glance& g, const Chain<N>& chain, const Pose<N>& pose,
               Truth& out) const noexcept;
  double next_node() const noexcept;
  void commit() noexcept;

  ChainConstants<N> chain_;
  Strings strings_;
  muscle::Bank bank_;
  Contacts<N> contacts_;
  robot::Robot robot_;
  std::array<double, N> rest_{}, damping_{}, dry_{};
  double step_ = 1e-3;
  std::uint64_t seed_ = 1;

  State state_{};
  muscle::Lanes air_in_{}, air_out_{};  // since the start [kg]
  double time_ = 0;                     // of the last committed node [s]
  std::int64_t multiple_ = 0;           // of the body step that was passed last
  std::int64_t nodes_ = 0;
  Glance glance_{};  // from this node, once somebody has looked
  bool glanced_ = false;
  Look first_{};   // first stage at the node, without friction
  Forces held_{};  // friction of the last step

  std::array<signals::Tick, 256> lag_{};  // per channel, from the start of a conversion to its read
  std::array<int, 256> source_{};         // per channel, its joint or muscle
  bool ended_ = false;
  muscle::Failure failure_;
};

extern template class World<1>;
extern template class World<2>;

}  // namespace sinew::plant
