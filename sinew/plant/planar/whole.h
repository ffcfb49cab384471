// plant/planar/whole.h - a whole planar machine as a Port: up to four joints, driven or passive, a
// body that a cylinder lifts, cams of any shape, muscles across two joints, a foot of several
// discs, and air that knows tanks, hoses, walls and leaks.
//
// A machine with light links, stiff springs or strong dampers takes a whole part of the body step
// that suits its fastest rate, at its start.
//
// world.h is the same for the leg that walks, and faster; where both hold a robot they agree. The
// rules are the same: one RK4 over body and air, nodes at multiples of the body step and where a
// valve really moves, dry friction per step, readings that peek and change nothing.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/muscle/failure.h"
#include "sinew/muscle/plumbing.h"
#include "sinew/plant/planar/body.h"
#include "sinew/plant/planar/cords.h"
#include "sinew/plant/planar/rubs.h"
#include "sinew/plant/planar/setup.h"
#include "sinew/robot/sensing.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

class WholeWorld final : public signals::Port {
 public:
  // The setup must be free of contradictions (robot::contradictions).
  explicit WholeWorld(const Setup& setup);

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
  const Motion& motion() const noexcept { return state_.motion; }
  const BodyConstants& constants() const noexcept { return constants_; }
  double air_mass() const noexcept;  // in chambers, hoses and tank [kg]
  double time() const noexcept { return time_; }
  double shortest_step() const noexcept;  // of body and air, where it starts [s]
  std::int64_t nodes() const noexcept { return nodes_; }
  const muscle::Failure& failure() const noexcept { return failure_; }
  void set_rates(const std::array<double, most_links>& joint_rates, double x_rate,
                 double y_rate) noexcept;

 private:
  using Forces = Rubs::Forces;

  // Air that has passed the valves and leaks since the start; the cylinder's chambers, up and down,
  // come after the muscles  [kg].
  struct Tally {
    std::array<double, muscle::capacity + 2> in, out, leak;
  };
  struct State {
    Motion motion;
    muscle::AirState air;
    Tally tally;
  };

  // Everything that one look at a state yields.
  struct Look {
    muscle::Lanes length, rate;
    Cords::Pulls pulls;
    muscle::AirPull pull;
    muscle::AirState flow;                          // d(air)/dt
    Coordinates force;                              // all but dry friction
    std::array<double, most_links> passive_torque;  // dampers and springs [N m]
    Rubs::Normals normal;
    Coordinates acceleration;  // with the friction of the step
  };

  // Friction and accelerations that a look beyond the last node goes by.
  struct Glance {
    Forces held{};
    Coordinates acceleration{};
  };
  struct Peek {
    State state;
    Look look;
  };

  double joint_angle(const Motion& m, std::size_t j) const noexcept;
  double joint_rate(const Motion& m, std::size_t j) const noexcept;
  void air(double t, const State& state, Look& look) const noexcept;
  void forces(const Body& body, const State& state, Look& look) const noexcept;
  double cylinder_stop(const Motion& m) const noexcept;
  void look_at(double t, const State& state, const Forces& f, Look& look) const noexcept;
  void push_air(State& out, const State& from, double h, const Look& look) const noexcept;
  void shift(State& out, const State& from, double h, const State& at,
             const Look& look) const noexcept;

  void prepare() noexcept;  // the look at a new node
  void look_for_failure() noexcept;
  void step(double h) noexcept;
  double pieces_of(double h, const Look& look) const noexcept;  // of a step
  void piece(double h) noexcept;
  double next_node() const noexcept;
  void commit() noexcept;

  const Glance& glance() noexcept;
  Motion peek_motion(const Glance& g, double t) const noexcept;
  Peek peek(const Glance& g, double t) const noexcept;
  double gauge(const Glance& g, const Peek& p, int muscle) const noexcept;
  double quantity(std::size_t sensor, double t) noexcept;
  void tell_cylinder(const Peek& p, Truth& out) const noexcept;
  void tell_foot(const Glance& g, const Peek& p, Truth& out) const noexcept;
  void tell_rollers(const Glance& g, const Peek& p, Truth& out) const noexcept;

  BodyConstants constants_;
  robot::Robot robot_;
  Cords cords_;
  muscle::Plumbing plumbing_;
  Rubs rubs_;
  std::array<double, most_links> rest_{}, damping_{}, dry_{};
  double step_ = 1e-3;
  std::uint64_t seed_ = 1;

  State state_{};
  double time_ = 0;            // of the last committed node [s]
  double inner_ = 0;           // within a step of several pieces [s]
  std::int64_t multiple_ = 0;  // of the body step that was passed last
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

}  // namespace sinew::plant
