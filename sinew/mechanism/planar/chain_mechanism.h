// mechanism/planar/chain_mechanism.h - a chain of N links on a trolley or a fixed base: one of the
// mechanisms of world/kernel/world.h.
//
//   chain_body.h  how it moves               rollers.h   what the trolley rests on
//
// robot::is_chain says which robots it holds; body_mechanism.h holds all, and both agree where both
// hold one.
#pragma once

#include <array>
#include <initializer_list>

#include "sinew/mechanism/planar/chain_body.h"
#include "sinew/mechanism/planar/planar_mechanism.h"
#include "sinew/mechanism/planar/rollers.h"
#include "sinew/mechanism/planar/setup.h"

namespace sinew::plant {

template <int N>
class ChainMechanism : public PlanarMechanism<chain_muscles>, public ChainBody<N> {
  using Equations = ChainBody<N>;
  using Equations::model_;
  using Equations::routes_;

 public:
  using typename Equations::Acceleration;
  using typename Equations::Arms;
  using typename Equations::Ends;
  using typename Equations::Forces;
  using typename Equations::Load;
  using typename Equations::Motion;
  using typename Equations::Pose;

  // These are the body's own.
  using Equations::joint_angle;
  using Equations::joint_rate;

  // Takes a machine that is such a chain (chain_body.h).
  explicit ChainMechanism(const Setup& setup)
      : Equations(chain_model_of<N>(setup), chain_routing_of(setup.robot)), robot_(setup.robot) {
    double absolute = 0;
    for (int j = 0; j < N; ++j)
      start_.angle[j] = absolute += setup.start.joint_angle[static_cast<std::size_t>(j)];
    start_.x = setup.start.trolley;
  }

  // Returns the constants, the motion at the start, and the joint of a muscle.
  const ChainConstants<N>& constants() const noexcept { return model_.chain; }
  const Motion& start() const noexcept { return start_; }
  int joint(int muscle) const noexcept { return routes_.joint[static_cast<std::size_t>(muscle)]; }
  double arm(const Arms&, int muscle) const noexcept { return routes_.moment_arm[muscle]; }  // [m]
  // A chain has no lift: 0  [m].
  double lift(const Motion&) const noexcept { return 0; }

  // The body step, or a whole part of it that suits the fastest rate of the machine at its start.
  double node_step(const Setup& setup) const {
    std::array<double, N> damping = model_.damping, spring = model_.spring;
    for (int j = 0; j < N; ++j)
      damping[j] += model_.stop[j].damping, spring[j] += model_.stop[j].stiffness;
    return stable_step(setup.steps.body,
                       this->contacts_.stiffest_rate(Pose(model_.chain, start_), damping, spring));
  }

  // Lets a motion have these rates of the joints [rad/s] and of the trolley [m/s].
  void set_rates(Motion& m, std::initializer_list<double> joint_rates, double x_rate,
                 double) const {
    double absolute = 0;
    for (std::size_t j = 0; j < N; ++j)
      m.rate[j] = absolute += j < joint_rates.size() ? joint_rates.begin()[j] : 0.0;
    m.x_rate = x_rate;
  }

  // Adds what a muscle's tension does to its joint  [N m].
  void add_torque(const Arms&, int muscle, double tension,
                  std::array<double, most_joints>& torque) const noexcept {
    torque[static_cast<std::size_t>(joint(muscle))] += routes_.moment_arm[muscle] * tension;
  }

  // Fills in what only a simulation knows of the body at a motion; the muscles' torques are there
  // already.
  void tell(const Motion& pose, const Acceleration& a, const Forces& held, const Load&,
            Truth& out) const noexcept {
    out.x = pose.x;
    out.x_rate = pose.x_rate;
    for (std::size_t j = 0; j < N; ++j) {
      out.angle[j] = joint_angle(pose, j);
      out.rate[j] = joint_rate(pose, j);
    }
    Load at{};
    const Chain<N> chain(model_.chain, pose);
    this->ground(chain, pose, at);
    out.foot[0].x = at.ankle_x;
    out.foot[0].y = at.ankle_y;
    out.foot[0].force_x = at.normal > 0 ? held[Contacts<N>::foot] : 0.0;
    out.foot[0].force_y = out.disc_force[0] = at.normal;
    if (robot_.rollers.present) tell_rollers(chain, pose, a, held, out);
  }

 private:
  // The force on what hangs from the trolley is what its momentum asks for, less the ground's.
  void tell_rollers(const Chain<N>& chain, const Motion& pose, const Acceleration& a,
                    const Forces& held, Truth& out) const noexcept {
    const double hung = robot::leg_mass(robot_) + robot_.cylinder.body_mass;
    Hanging h{.acceleration = a.x};
    h.force_x = hung * a.x - out.foot[0].force_x;
    h.force_y = hung * model_.chain.gravity - out.foot[0].force_y;
    for (int i = 0; i < N; ++i)
      h.add(model_.chain.first_moment[i], chain.sin(i), chain.cos(i), pose.rate[i], a.angle[i]);
    h.torque = out.torque[0] - model_.damping[0] * pose.rate[0] -
               model_.spring[0] * (pose.angle[0] - model_.spring_angle[0]) +
               model_.stop[0].torque(pose.angle[0], pose.rate[0]) + held[0];
    const RollerLoads loads = roller_loads(robot_, h);
    out.roller_front = loads.front;
    out.roller_rear = loads.rear;
  }

  robot::Robot robot_;
  Motion start_{};
};

}  // namespace sinew::plant
