// plant/planar/chain_mechanism.h - a chain of N links on a trolley or a fixed base, in closed form:
// muscles across one joint each over round cams, one disc for a foot.
//
//   chain.h     equations of motion          contacts.h  friction at joints, trolley and foot
//   layout.h    routes of the muscles        rollers.h   what the trolley rests on
//
// One of the mechanisms of world/world.h. robot::is_chain says which robots it holds;
// body_mechanism.h holds all, and both agree where both hold one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "sinew/air/lanes.h"
#include "sinew/plant/planar/chain.h"
#include "sinew/plant/planar/contacts.h"
#include "sinew/plant/planar/layout.h"
#include "sinew/plant/planar/planar_mechanism.h"
#include "sinew/plant/planar/rollers.h"
#include "sinew/plant/planar/setup.h"
#include "sinew/plant/planar/stops.h"

namespace sinew::plant {

template <int N>
class ChainMechanism : public PlanarMechanism<chain_muscles> {
 public:
  using Motion = plant::Pose<N>;
  using Acceleration = Generalised<N>;
  using Forces = typename Contacts<N>::Forces;
  using Pose = Chain<N>;

  struct Arms {};  // they are constant

  struct Load {
    Generalised<N> force;  // muscles, dampers, springs, ground, track's stop; no friction
    double normal = 0;     // on the foot [N]
    double ankle_x = 0, ankle_y = 0;
  };

  explicit ChainMechanism(const Setup& setup)
      : chain_(chain_of<N>(setup.robot)),
        routes_(chain_routing_of(setup.robot)),
        contacts_(chain_, setup.robot),
        robot_(setup.robot) {
    double absolute = 0;
    for (int j = 0; j < N; ++j) {
      const auto k = static_cast<std::size_t>(j);
      const robot::Joint& joint = robot_.joints[k];
      rest_[j] = joint.rest_angle;
      damping_[j] = joint.damping + joint.damper;
      spring_[j] = joint.spring;
      stop_[j] = JointStop(joint.stop);
      spring_angle_[j] = joint.spring_angle;
      dry_[j] = setup.start.blocked[k] ? blocked_bound : joint.dry_friction;
      absolute += setup.start.joint_angle[k];
      start_.angle[j] = absolute;
    }
    start_.x = setup.start.trolley;
  }

  const ChainConstants<N>& constants() const noexcept { return chain_; }
  const Motion& start() const noexcept { return start_; }
  int muscles() const noexcept { return routes_.count; }
  int joint(int muscle) const noexcept { return routes_.joint[static_cast<std::size_t>(muscle)]; }
  double arm(const Arms&, int muscle) const noexcept { return routes_.moment_arm[muscle]; }  // [m]
  Pose pose(double, const Motion& motion) const noexcept { return Pose(chain_, motion); }

  double joint_angle(const Motion& m, std::size_t j) const noexcept {
    return m.angle[j] - (j > 0 ? m.angle[j - 1] : 0.0);
  }
  double joint_rate(const Motion& m, std::size_t j) const noexcept {
    return m.rate[j] - (j > 0 ? m.rate[j - 1] : 0.0);
  }
  double lift(const Motion&) const noexcept { return 0; }

  // A number that is none where one of the coordinates is none.
  double sum(const Motion& m) const noexcept {
    double places = m.x;
    for (int j = 0; j < N; ++j) places += m.angle[j];
    return places;
  }

  // The body step, or a whole part of it that suits the fastest rate of the machine at its start.
  double node_step(const Setup& setup) const {
    std::array<double, N> damping = damping_, spring = spring_;
    for (int j = 0; j < N; ++j) damping[j] += stop_[j].damping, spring[j] += stop_[j].stiffness;
    return stable_step(setup.steps.body,
                       contacts_.stiffest_rate(Pose(chain_, start_), damping, spring));
  }

  void set_rates(Motion& m, std::initializer_list<double> joint_rates, double x_rate,
                 double) const {
    double absolute = 0;
    for (std::size_t j = 0; j < N; ++j)
      m.rate[j] = absolute += j < joint_rates.size() ? joint_rates.begin()[j] : 0.0;
    m.x_rate = x_rate;
  }

  // Lengths of the muscles and their rates, from the joints' angles.
  void route(double, const Motion& pose, air::Ends<chain_muscles>& ends, Arms&) const noexcept {
    std::array<double, N> travel, rate;
    for (int j = 0; j < N; ++j) {
      travel[j] = pose.angle[j] - (j > 0 ? pose.angle[j - 1] : 0.0) - rest_[j];
      rate[j] = pose.rate[j] - (j > 0 ? pose.rate[j - 1] : 0.0);
    }
    // In whole lanes from the start: a wide load would have to wait for narrow stores.
    for (int i = 0; i < routes_.padded; i += air::lanes) {
      const int* j = &routes_.joint[i];
      const air::Four pull = routes_.moment_arm.four(i);
      const air::Four turn = {travel[j[0]], travel[j[1]], travel[j[2]], travel[j[3]]};
      const air::Four speed = {rate[j[0]], rate[j[1]], rate[j[2]], rate[j[3]]};
      ends.length.four(i) = routes_.mount.four(i) - pull * turn;
      ends.rate.four(i) = -pull * speed;
    }
  }

  template <class Answer>
  void load(const Pose& chain, const Motion& pose, const Arms&, const Answer& air,
            Load& out) const noexcept {
    std::array<double, N + 1> torque{};
    for (int i = 0; i < routes_.count; ++i)
      torque[routes_.joint[i]] += routes_.moment_arm[i] * air.tension[i];
    for (int j = 0; j < N; ++j) {
      const auto k = static_cast<std::size_t>(j);
      torque[j] -= damping_[j] * joint_rate(pose, k);
      torque[j] -= spring_[j] * (joint_angle(pose, k) - spring_angle_[j]);
      torque[j] += stop_[j].torque(joint_angle(pose, k), joint_rate(pose, k));
    }

    out.force.x = 0;
    for (int j = 0; j < N; ++j) out.force.angle[j] = torque[j] - torque[j + 1];

    // The track's stop: one-sided, and never pulling.
    const double beyond = pose.x - robot_.trolley.track_length;
    if (robot_.trolley.present && beyond > 0) {
      const double push =
          robot_.trolley.stop_stiffness * beyond + robot_.trolley.stop_damping * pose.x_rate;
      out.force.x -= push > 0 ? push : 0.0;
    }
    ground(chain, pose, out);
  }

  Acceleration accelerate(const Pose& chain, const Motion&, const Load& load,
                          const Forces& held) const noexcept {
    Generalised<N> force = load.force;
    const Generalised<N> rub = contacts_.generalised(chain, held);
    force.x += rub.x;
    for (int i = 0; i < N; ++i) force.angle[i] += rub.angle[i];
    return chain.accelerations(force);
  }

  // Bound of the trolley's dry friction, from the last step's and what was held in it [N].
  double trolley_bound(const Forces& held, double last) const noexcept {
    return robot_.trolley.friction(held[Contacts<N>::trolley], last);
  }

  // At a node: answers the accelerations without friction and makes what hold() goes by. Bounds:
  // the mesh's own friction acts through the cams and is part of the joint's.
  Acceleration prepare(const Pose& chain, const Motion& pose, const Arms&,
                       const air::Lanes<chain_muscles>& friction_bound, double trolley_bound,
                       const Load& load) noexcept {
    const Acceleration free = chain.accelerations(load.force);
    Forces bound;
    for (int j = 0; j < N; ++j) bound[j] = dry_[j];
    for (int i = 0; i < routes_.count; ++i)
      bound[routes_.joint[i]] += std::abs(routes_.moment_arm[i]) * friction_bound[i];
    bound[Contacts<N>::trolley] = trolley_bound;
    bound[Contacts<N>::foot] = robot_.foot.friction * load.normal;
    contacts_.prepare(chain, pose, free, bound, load.normal);
    return free;
  }

  // Dry friction of a step of length h from the prepared node, and accelerations under it.
  Forces hold(double h, const Forces& last) const noexcept { return contacts_.hold(h, last); }
  Acceleration accelerate(const Acceleration& free, const Forces& held) const noexcept {
    return contacts_.accelerations(free, held);
  }
  double bound(int contact) const noexcept { return contacts_.bound(contact); }

  // `from`, h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, double h, const Motion& rates,
            const Acceleration& a) const noexcept {
    out.x = from.x + h * rates.x_rate;
    out.x_rate = from.x_rate + h * a.x;
    for (int i = 0; i < N; ++i) {
      out.angle[i] = from.angle[i] + h * rates.rate[i];
      out.rate[i] = from.rate[i] + h * a.angle[i];
    }
  }

  // h along a constant acceleration.
  void glide(Motion& m, double h, const Acceleration& a) const noexcept {
    move(m, Motion(m), h, Motion(m), a);
    m.x += 0.5 * h * h * a.x;
    for (int i = 0; i < N; ++i) m.angle[i] += 0.5 * h * h * a.angle[i];
  }

  // RK4's weighted mean of four stages.
  void finish(Motion& now, double h, const Motion* const (&stage)[4],
              const Acceleration (&a)[4]) const noexcept {
    const double sixth = h / 6.0;
    const auto mean = [&](auto&& of) {
      return sixth * (of(0) + 2.0 * of(1) + 2.0 * of(2) + of(3));
    };
    now.x += mean([&](int s) { return stage[s]->x_rate; });
    now.x_rate += mean([&](int s) { return a[s].x; });
    for (int i = 0; i < N; ++i) {
      now.angle[i] += mean([&](int s) { return stage[s]->rate[i]; });
      now.rate[i] += mean([&](int s) { return a[s].angle[i]; });
    }
  }

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
    const Chain<N> chain(chain_, pose);
    ground(chain, pose, at);
    out.foot[0].x = at.ankle_x;
    out.foot[0].y = at.ankle_y;
    out.foot[0].force_x = at.normal > 0 ? held[Contacts<N>::foot] : 0.0;
    out.foot[0].force_y = out.disc_force[0] = at.normal;
    if (robot_.rollers.present) tell_rollers(chain, pose, a, held, out);
  }

 private:
  // The foot: a disc about the ankle that belongs to the last link. Compliant normal force only;
  // the tangential force is one of the step's dry frictions.
  void ground(const Chain<N>& chain, const Motion& pose, Load& out) const noexcept {
    out.ankle_x = out.ankle_y = out.normal = 0;
    double rate_y = 0;
    for (int i = 0; i < N; ++i) {
      out.ankle_x += chain_.length[i] * chain.cos(i);
      out.ankle_y += chain_.length[i] * chain.sin(i);
      rate_y += chain_.length[i] * chain.cos(i) * pose.rate[i];
    }
    if (!robot_.ground.present || !robot_.foot.present) return;
    const double depth = robot_.ground.height - out.ankle_y;
    if (depth <= 0) return;
    const double push =
        robot_.ground.normal_stiffness * depth - robot_.ground.normal_damping * rate_y;
    out.normal = push > 0 ? push : 0.0;
    for (int i = 0; i < N; ++i) out.force.angle[i] += out.normal * chain_.length[i] * chain.cos(i);
  }

  // The force on what hangs from the trolley is what its momentum asks for, less the ground's.
  void tell_rollers(const Chain<N>& chain, const Motion& pose, const Acceleration& a,
                    const Forces& held, Truth& out) const noexcept {
    const double hung = robot::leg_mass(robot_) + robot_.cylinder.body_mass;
    Hanging h{.acceleration = a.x};
    h.force_x = hung * a.x - out.foot[0].force_x;
    h.force_y = hung * chain_.gravity - out.foot[0].force_y;
    for (int i = 0; i < N; ++i)
      h.add(chain_.first_moment[i], chain.sin(i), chain.cos(i), pose.rate[i], a.angle[i]);
    h.torque = out.torque[0] - damping_[0] * pose.rate[0] -
               spring_[0] * (pose.angle[0] - spring_angle_[0]) +
               stop_[0].torque(pose.angle[0], pose.rate[0]) + held[0];
    const RollerLoads loads = roller_loads(robot_, h);
    out.roller_front = loads.front;
    out.roller_rear = loads.rear;
  }

  ChainConstants<N> chain_;
  ChainRouting routes_;
  Contacts<N> contacts_;
  robot::Robot robot_;
  Motion start_{};
  std::array<double, N> rest_{}, damping_{}, spring_{}, spring_angle_{}, dry_{};
  std::array<JointStop, N> stop_{};
};

}  // namespace sinew::plant
