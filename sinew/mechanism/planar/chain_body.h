// mechanism/planar/chain_body.h - how a chain of N links on a trolley or a fixed base moves, in
// closed form: muscles across one joint each over round cams, one disc for a foot.
//
//   chain.h     equations of motion          contacts.h  friction at joints, trolley and foot
//   layout.h    routes of the muscles        stops.h     ends of the joints' ranges
//
// S is a double; or a pack of them: machines side by side, of any numbers, whose muscles pull the
// same joints. Each has the bits that it has alone. chain_mechanism.h makes a mechanism
// for world/kernel/world.h of it; contract.h describes the members.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/chain.h"
#include "sinew/mechanism/planar/contacts.h"
#include "sinew/mechanism/planar/layout.h"
#include "sinew/mechanism/planar/stops.h"
#include "sinew/units/pack.h"
#include "sinew/units/stages.h"

namespace sinew::plant {

// The numbers of a chain. Of what is missing the bounds are out of reach and the forces nothing.
template <int N, class S = double>
struct ChainModel {
  ChainConstants<N, S> chain;
  Footing<S> footing;
  std::array<S, N> rest{}, damping{}, spring{}, spring_angle{}, dry{};  // of the joints
  std::array<JointStopOf<S>, N> stop{};
  S track_length = std::numeric_limits<double>::infinity();  // [m]
  S track_stiffness = 0, track_damping = 0;                  // of its stop [N/m], [N s/m]
  S drag = 0, breakaway = 0;                                 // of the trolley [N]
};

// Returns the constants of a setup whose machine is such a chain.
template <int N>
ChainModel<N> chain_model_of(const Setup& setup) {
  const robot::Robot& robot = setup.robot;
  ChainModel<N> m{.chain = chain_of<N>(robot), .footing = footing_of(robot)};
  for (int j = 0; j < N; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const robot::Joint& joint = robot.joints[k];
    m.rest[j] = joint.rest_angle;
    m.damping[j] = joint.damping + joint.damper;
    m.spring[j] = joint.spring;
    m.spring_angle[j] = joint.spring_angle;
    m.dry[j] = setup.start.blocked[k] ? blocked_bound : joint.dry_friction;
    m.stop[j] = JointStop(joint.stop);
  }
  if (!robot.trolley.present) return m;
  m.track_length = robot.trolley.track_length;
  m.track_stiffness = robot.trolley.stop_stiffness;
  m.track_damping = robot.trolley.stop_damping;
  m.drag = robot.trolley.drag;
  m.breakaway = robot.trolley.breakaway;
  return m;
}

template <int N, class S = double>
class ChainBody {
 public:
  using Scalar = S;
  using Motion = plant::GeneralizedState<N, S>;
  using Acceleration = GeneralizedVector<N, S>;
  using Forces = typename Contacts<N, S>::Forces;
  using Pose = Chain<N, S>;
  using Ends = air::Ends<chain_muscles, S>;

  struct Arms {};  // they are constant

  // All forces but dry friction's.
  struct Load {
    GeneralizedVector<N, S> force;  // muscles, dampers, springs, ground, track's stop; no friction
    S normal = 0;                   // on the foot [N]
    S ankle_x = 0, ankle_y = 0;
  };

  // Takes the constants, and how the muscles run.
  ChainBody(const ChainModel<N, S>& model, const ChainRoutingOf<S>& routes)
      : model_(model), routes_(routes), contacts_(model.chain, model.footing) {}

  // Returns them; the number of muscles; and all that a node needs to know of where the machine is.
  const ChainModel<N, S>& model() const noexcept { return model_; }
  const ChainRoutingOf<S>& routes() const noexcept { return routes_; }
  int muscles() const noexcept { return routes_.count; }
  Pose pose(const S&, const Motion& motion) const noexcept { return Pose(model_.chain, motion); }

  // Returns the angle of a joint [rad], and its rate [rad/s].
  S joint_angle(const Motion& m, std::size_t j) const noexcept {
    return m.angle[j] - (j > 0 ? m.angle[j - 1] : S(0.0));
  }
  // Returns the rate of a joint  [rad/s].
  S joint_rate(const Motion& m, std::size_t j) const noexcept {
    return m.rate[j] - (j > 0 ? m.rate[j - 1] : S(0.0));
  }
  // A number that is none where one of the coordinates is none.
  S sum(const Motion& m) const noexcept {
    S places = m.x;
    for (int j = 0; j < N; ++j) places += m.angle[j];
    return places;
  }

  // Lengths of the muscles and their rates, from the joints' angles.
  void route(const S&, const Motion& motion, Ends& ends, Arms&) const noexcept {
    std::array<S, N> travel, rate;
    for (int j = 0; j < N; ++j) {
      travel[j] = motion.angle[j] - (j > 0 ? motion.angle[j - 1] : S(0.0)) - model_.rest[j];
      rate[j] = motion.rate[j] - (j > 0 ? motion.rate[j - 1] : S(0.0));
    }
    if constexpr (std::is_same_v<S, double>)
      lengths_of_four(travel, rate, ends);
    else
      for (int i = 0; i < routes_.count; ++i) {
        const int j = routes_.joint[i];
        ends.length[i] = routes_.mount[i] - routes_.moment_arm[i] * travel[j];
        ends.rate[i] = -routes_.moment_arm[i] * rate[j];
      }
  }

  // Works out all forces but dry friction's, from what the air pulls.
  template <class Answer>
  void load(const Pose& chain, const Motion& motion, const Arms&, const Answer& air,
            Load& out) const noexcept {
    std::array<S, N + 1> torque{};
    for (int i = 0; i < routes_.count; ++i)
      torque[routes_.joint[i]] += routes_.moment_arm[i] * air.tension[i];
    for (int j = 0; j < N; ++j) {
      const auto k = static_cast<std::size_t>(j);
      torque[j] -= model_.damping[j] * joint_rate(motion, k);
      torque[j] -= model_.spring[j] * (joint_angle(motion, k) - model_.spring_angle[j]);
      torque[j] += model_.stop[j].torque(joint_angle(motion, k), joint_rate(motion, k));
    }

    out.force.x = 0;
    for (int j = 0; j < N; ++j) out.force.angle[j] = torque[j] - torque[j + 1];

    // The track's stop: one-sided, and never pulling.
    const S beyond = motion.x - model_.track_length;
    if (const auto there = beyond > 0.0; units::any(there)) {
      const S push = model_.track_stiffness * beyond + model_.track_damping * motion.x_rate;
      out.force.x -= units::select(there & (push > 0.0), push, 0.0);
    }
    ground(chain, motion, out);
  }

  // Returns the acceleration under the load and the dry friction that is held.
  Acceleration accelerate(const Pose& chain, const Motion&, const Load& load,
                          const Forces& held) const noexcept {
    GeneralizedVector<N, S> force = load.force;
    const GeneralizedVector<N, S> rub = contacts_.generalised(chain, held);
    force.x += rub.x;
    for (int i = 0; i < N; ++i) force.angle[i] += rub.angle[i];
    return chain.accelerations(force);
  }

  // Bound of the trolley's dry friction, from the last step's and what was held in it [N].
  S trolley_bound(const Forces& held, const S& last) const noexcept {
    return robot::Trolley::friction(held[Contacts<N, S>::trolley], last, model_.drag,
                                    model_.breakaway);
  }

  // At a node: answers the accelerations without friction and makes what hold() goes by. Bounds:
  // the mesh's own friction acts through the cams and is part of the joint's.
  Acceleration prepare(const Pose& chain, const Motion& motion, const Arms&,
                       const air::Lanes<chain_muscles, S>& friction_bound, const S& trolley_bound,
                       const Load& load) noexcept {
    const Acceleration free = chain.accelerations(load.force);
    Forces bound;
    for (int j = 0; j < N; ++j) bound[j] = model_.dry[j];
    for (int i = 0; i < routes_.count; ++i)
      bound[routes_.joint[i]] += units::abs(routes_.moment_arm[i]) * friction_bound[i];
    bound[Contacts<N, S>::trolley] = trolley_bound;
    bound[Contacts<N, S>::foot] = model_.footing.friction * load.normal;
    contacts_.prepare(chain, motion, free, bound, load.normal);
    return free;
  }

  // Dry friction of a step of length h from the prepared node, and accelerations under it.
  Forces hold(const S& h, const Forces& last) const noexcept { return contacts_.hold(h, last); }
  Acceleration accelerate(const Acceleration& free, const Forces& held) const noexcept {
    return contacts_.accelerations(free, held);
  }
  S bound(int contact) const noexcept { return contacts_.bound(contact); }

  // `from`, h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, const S& h, const Motion& rates,
            const Acceleration& a) const noexcept {
    out.x = from.x + h * rates.x_rate;
    out.x_rate = from.x_rate + h * a.x;
    for (int i = 0; i < N; ++i) {
      out.angle[i] = from.angle[i] + h * rates.rate[i];
      out.rate[i] = from.rate[i] + h * a.angle[i];
    }
  }

  // h along a constant acceleration.
  void glide(Motion& m, const S& h, const Acceleration& a) const noexcept {
    move(m, Motion(m), h, Motion(m), a);
    m.x += 0.5 * h * h * a.x;
    for (int i = 0; i < N; ++i) m.angle[i] += 0.5 * h * h * a.angle[i];
  }

  // RK4's weighted mean of four stages.
  void finish(Motion& now, const S& h, const Motion* const (&stage)[4],
              const Acceleration (&a)[4]) const noexcept {
    const units::StageMean mean(h);
    now.x += mean([&](int s) { return stage[s]->x_rate; });
    now.x_rate += mean([&](int s) { return a[s].x; });
    for (int i = 0; i < N; ++i) {
      now.angle[i] += mean([&](int s) { return stage[s]->rate[i]; });
      now.rate[i] += mean([&](int s) { return a[s].angle[i]; });
    }
  }

 protected:
  // The foot: a disc about the ankle that belongs to the last link. Compliant normal force only;
  // the tangential force is one of the step's dry frictions.
  void ground(const Chain<N, S>& chain, const Motion& motion, Load& out) const noexcept {
    out.ankle_x = out.ankle_y = out.normal = 0;
    S rate_y = 0;
    for (int i = 0; i < N; ++i) {
      out.ankle_x += model_.chain.length[i] * chain.cos(i);
      out.ankle_y += model_.chain.length[i] * chain.sin(i);
      rate_y += model_.chain.length[i] * chain.cos(i) * motion.rate[i];
    }
    const S depth = model_.footing.height - out.ankle_y;
    const auto touches = depth > 0.0;
    if (!units::any(touches)) return;
    const S push = model_.footing.stiffness * depth - model_.footing.damping * rate_y;
    out.normal = units::select(touches & (push > 0.0), push, 0.0);
    for (int i = 0; i < N; ++i) {
      const S torque = out.force.angle[i] + out.normal * model_.chain.length[i] * chain.cos(i);
      out.force.angle[i] = units::select(touches, torque, out.force.angle[i]);
    }
  }

  ChainModel<N, S> model_;
  ChainRoutingOf<S> routes_;
  Contacts<N, S> contacts_;

 private:
  // In whole lanes from the start: a wide load would have to wait for narrow stores.
  void lengths_of_four(const std::array<S, N>& travel, const std::array<S, N>& rate,
                       Ends& ends) const noexcept {
    for (int i = 0; i < routes_.padded; i += air::lanes) {
      const int* j = &routes_.joint[i];
      const air::Four pull = routes_.moment_arm.four(i);
      const air::Four turn = {travel[j[0]], travel[j[1]], travel[j[2]], travel[j[3]]};
      const air::Four speed = {rate[j[0]], rate[j[1]], rate[j[2]], rate[j[3]]};
      ends.length.four(i) = routes_.mount.four(i) - pull * turn;
      ends.rate.four(i) = -pull * speed;
    }
  }
};

// Do the muscles of both pull the same joints? Only then can they stand side by side.
inline bool alike(const ChainRouting& a, const ChainRouting& b) {
  return a.count == b.count && a.joint == b.joint;
}

// All routes must be alike.
template <std::size_t W>
ChainRoutingOf<units::Pack<W>> side_by_side(const std::array<const ChainRouting*, W>& each) {
  ChainRoutingOf<units::Pack<W>> out;
  out.count = each[0]->count;
  out.padded = each[0]->padded;
  out.joint = each[0]->joint;
  for (int i = 0; i < out.padded; ++i)
    for (std::size_t k = 0; k < W; ++k) {
      out.mount[i].set(static_cast<int>(k), each[k]->mount[i]);
      out.moment_arm[i].set(static_cast<int>(k), each[k]->moment_arm[i]);
    }
  return out;
}

// Returns W bodies as one, each in its lane.
template <int N, std::size_t W>
ChainBody<N, units::Pack<W>> side_by_side(const std::array<const ChainBody<N>*, W>& each) {
  std::array<ChainModel<N>, W> models;
  std::array<const ChainRouting*, W> routes;
  for (std::size_t k = 0; k < W; ++k) {
    models[k] = each[k]->model();
    routes[k] = &each[k]->routes();
  }
  return {units::side_by_side<ChainModel<N, units::Pack<W>>>(models), side_by_side(routes)};
}

}  // namespace sinew::plant
