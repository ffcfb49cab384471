// mechanism/planar/chain_body.h - motion of a chain of N links on a trolley or a fixed base, in
// closed form: muscles across one joint each over round cams, a foot of one disc.
//
//   chain.h     equations of motion
//   layout.h    routes of the muscles        setup.h     ends of the joints' ranges
//
// S is a double, or a pack (units/pack.h) over several machines with any parameters whose muscles
// act on the same joints. Each machine has the same bits as alone. ChainMechanism is the mechanism
// for world/kernel/world.h; contract.h describes the members.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <type_traits>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/friction/friction.h"
#include "sinew/mechanism/planar/chain.h"
#include "sinew/mechanism/planar/layout.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/mechanism/planar/planar_mechanism.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/robot/robot.h"
#include "sinew/units/pack.h"
#include "sinew/units/stages.h"

namespace sinew::plant {

// Dry friction of a planar machine at its joints, its trolley and its foot.
//
// Contact c slips with the velocity J_c v and carries the force f_c, whose generalised force is
// J_c^T f_c. prepare() computes once per node all terms for the friction of a step; hold() computes
// the forces for a step of any length from them. See friction.h for the law.
//
// S is a double, or a pack over several machines. A term that not all machines need is computed if
// any lane needs it, and selected.

// Constants of the ground and the foot; if one is missing the ground is out of reach.
template <class S>
struct Footing {
  S height = -std::numeric_limits<double>::infinity();  // height of the ankle at contact [m]
  S stiffness = 0, damping = 0;                         // ground [N/m], [N s/m]
  S friction = 0, radius = 0;                           // foot [-], [m]
};

// Returns foot and ground of a robot; if either is missing, a footing without contact.
inline Footing<double> footing_of(const robot::Robot& robot) {
  Footing<double> f{.friction = robot.foot.friction, .radius = robot.foot.radius};
  if (!robot.ground.present || !robot.foot.present) return f;
  f.height = robot.ground.height;
  f.stiffness = robot.ground.normal_stiffness;
  f.damping = robot.ground.normal_damping;
  return f;
}

// Computes the dry friction at joints, trolley and foot of a chain of N links.
template <int N, class S = double>
class Contacts {
 public:
  static constexpr int count = N + 2;  // the joints, the trolley, the foot
  static constexpr int trolley = N, foot = N + 1;
  using Forces = std::array<S, count>;  // joints [N m], others [N]

  // Takes the constants, which must outlive the object.
  Contacts(const ChainConstants<N, S>& chain, const Footing<S>& footing)
      : k_(chain), footing_(footing) {}

  // Returns J^T f.
  GeneralizedVector<N, S> generalised(const Chain<N, S>& chain, const Forces& f) const {
    GeneralizedVector<N, S> out;
    out.x = f[trolley] + f[foot];
    for (int i = 0; i < N; ++i)
      out.angle[i] = f[i] - (i + 1 < N ? f[i + 1] : S(0.0)) - f[foot] * k_.length[i] * chain.sin(i);
    out.angle[N - 1] += f[foot] * footing_.radius;
    return out;
  }

  // Returns J v, or J a. The foot slips at its lowest point, a radius below the ankle.
  Forces slips(const Chain<N, S>& chain, const GeneralizedVector<N, S>& v) const {
    Forces s;
    s[trolley] = v.x;
    s[foot] = v.x + footing_.radius * v.angle[N - 1];
    for (int i = 0; i < N; ++i) {
      s[i] = v.angle[i] - (i > 0 ? v.angle[i - 1] : S(0.0));
      s[foot] -= k_.length[i] * chain.sin(i) * v.angle[i];
    }
    return s;
  }

  // Returns the fastest rate at which springs, dampers and the ground bring the machine to rest
  // [1/s]: c w and sqrt(k w) with w, the acceleration per force of the joint or of the ankle.
  double stiffest_rate(const Chain<N, S>& chain, const std::array<S, N>& damping,
                       const std::array<S, N>& spring) const {
    double fastest = 0;
    const auto consider = [&](double w, double c, double k) {
      fastest = std::max({fastest, c * w, std::sqrt(k * w)});
    };
    GeneralizedVector<N, S> up;
    for (int i = 0; i < N; ++i) {
      Forces unit{};
      unit[i] = 1.0;
      consider(slips(chain, chain.response(generalised(chain, unit)))[i], damping[i], spring[i]);
      up.angle[i] = k_.length[i] * chain.cos(i);
    }
    if (std::isinf(footing_.height)) return fastest;
    const GeneralizedVector<N, S> column = chain.response(up);
    double w = 0;
    for (int i = 0; i < N; ++i) w += up.angle[i] * column.angle[i];
    consider(w, footing_.damping, footing_.stiffness);
    return fastest;
  }

  // Prepares a node: accelerations without friction, bounds, and the ground's force on the foot.
  void prepare(const Chain<N, S>& chain, const GeneralizedState<N, S>& motion,
               const GeneralizedVector<N, S>& acceleration, const Forces& bound, const S& normal) {
    problem_.bound = bound;
    for (int c = 0; c < count; ++c) {
      Forces unit{};
      unit[c] = 1.0;
      column_[c] = {};
      if (const auto has_friction = bound[c] > 0.0; units::any(has_friction))
        column_[c] = select(has_friction, chain.response(generalised(chain, unit)), column_[c]);
      const Forces response = slips(chain, column_[c]);
      for (int d = 0; d < count; ++d) problem_.response[d][c] = response[d];
    }
    problem_.slip = slips(chain, {.x = motion.x_rate, .angle = motion.rate});
    slip_rate_ = slips(chain, acceleration);
    // The foot's lever turns with the links: dJ/dt contributes to the slip's rate.
    for (int i = 0; i < N; ++i)
      slip_rate_[foot] -= k_.length[i] * chain.cos(i) * motion.rate[i] * motion.rate[i];

    normal_.force = normal;
    if (units::any(normal > 0.0)) prepare_normal(chain, motion, acceleration);
  }

  // Returns the dry friction of a step of length h; `last`: that of the last step.
  //
  // The ground is stiff: its normal force changes within the step, by about
  //
  //   dF = -k (h/2 v_y + h/6 dv_y) - c/2 dv_y    the mean over the step for a linear v_y(t)
  //
  // and so do the slips. Solving for dF adds a rank-one term to W; without it the joints would slip
  // a little where they should stick, and the walk would converge with the first order only.
  Forces hold(const S& h, const Forces& last) const {
    FrictionProblem<count, S> p;
    p.bound = problem_.bound;
    for (int c = 0; c < count; ++c) {
      p.slip[c] = problem_.slip[c] + h * slip_rate_[c];
      for (int d = 0; d < count; ++d) p.response[c][d] = problem_.response[c][d] * h;
    }
    if (const auto stands = normal_.force > 0.0; units::any(stands)) add_normal(h, stands, p);
    return solve_friction<count>(p, last);
  }

  // Returns the accelerations under the friction f, given those without friction.
  GeneralizedVector<N, S> accelerations(const GeneralizedVector<N, S>& without,
                                        const Forces& f) const {
    GeneralizedVector<N, S> a = without;
    for (int c = 0; c < count; ++c) {
      a.x += column_[c].x * f[c];
      for (int i = 0; i < N; ++i) a.angle[i] += column_[c].angle[i] * f[c];
    }
    return a;
  }

  // Returns the bound of a contact's dry friction, as in the last hold().
  S bound(int c) const { return problem_.bound[c]; }

 private:
  // Data of the ground's normal force, as one more direction.
  struct Normal {
    S force = 0;                   // at the node [N]
    S response = 0;                // upward acceleration of the ankle per force [1/kg]
    S rate = 0, acceleration = 0;  // ankle, upwards [m/s], [m/s^2]
    Forces along{};                // upward acceleration per friction force
  };

  // Adds the change of the ground's force within the step, in lanes whose foot is on the ground.
  template <class Mask>
  void add_normal(const S& h, const Mask& stands, FrictionProblem<count, S>& p) const {
    const S k = footing_.stiffness;
    const S beta = h * (h / 6.0 * k + 0.5 * footing_.damping);
    const S share = 1.0 / (1.0 + beta * normal_.response);
    const S change = -(0.5 * h * k * normal_.rate + beta * normal_.acceleration) * share;
    const S mean = normal_.force + change;
    const auto stays = stands & (mean > 0.0);
    p.bound[foot] = units::select(stands, units::select(mean > 0.0, footing_.friction * mean, 0.0),
                                  p.bound[foot]);
    if (!units::any(stays)) return;
    for (int c = 0; c < count; ++c) {
      const S slip = p.slip[c] + h * normal_.along[c] * change;
      p.slip[c] = units::select(stays, slip, p.slip[c]);
      for (int d = 0; d < count; ++d) {
        const S response =
            p.response[c][d] - h * beta * share * normal_.along[c] * normal_.along[d];
        p.response[c][d] = units::select(stays, response, p.response[c][d]);
      }
    }
  }

  void prepare_normal(const Chain<N, S>& chain, const GeneralizedState<N, S>& motion,
                      const GeneralizedVector<N, S>& acceleration) {
    GeneralizedVector<N, S> up;
    for (int i = 0; i < N; ++i) up.angle[i] = k_.length[i] * chain.cos(i);
    const GeneralizedVector<N, S> column = chain.response(up);
    normal_ = {.force = normal_.force};
    for (int i = 0; i < N; ++i) {
      const S rate = motion.rate[i];
      normal_.response += up.angle[i] * column.angle[i];
      normal_.rate += up.angle[i] * rate;
      normal_.acceleration +=
          up.angle[i] * acceleration.angle[i] - k_.length[i] * chain.sin(i) * rate * rate;
      for (int c = 0; c < count; ++c) normal_.along[c] += up.angle[i] * column_[c].angle[i];
    }
  }

  ChainConstants<N, S> k_;
  Footing<S> footing_;

  std::array<GeneralizedVector<N, S>, count> column_{};  // M^-1 J^T
  FrictionProblem<count, S> problem_{};                  // slips at the node, responses per second
  Forces slip_rate_{};                                   // rates of the slips, without friction
  Normal normal_;
};

// Parameters of a chain. For missing parts the bounds are infinite and the forces zero.
template <int N, class S = double>
struct ChainModel {
  ChainConstants<N, S> chain;
  Footing<S> footing;
  std::array<S, N> rest{}, damping{}, spring{}, spring_angle{}, dry{};  // joints' parameters
  std::array<JointStopOf<S>, N> stop{};
  S track_length = std::numeric_limits<double>::infinity();  // [m]
  S track_stiffness = 0, track_damping = 0;                  // stop of the track [N/m], [N s/m]
  S drag = 0, breakaway = 0;                                 // trolley [N]
};

// Returns the parameters of a setup whose machine is such a chain.
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

  struct Arms {};  // constant, see ChainRouting

  // All forces except dry friction.
  struct Load {
    GeneralizedVector<N, S> force;  // muscles, dampers, springs, ground, track's stop; no friction
    S normal = 0;                   // force on the foot [N]
    S ankle_x = 0, ankle_y = 0;
  };

  // Takes the parameters, and the routes of the muscles.
  ChainBody(const ChainModel<N, S>& model, const ChainRoutingOf<S>& routes)
      : model_(model), routes_(routes), contacts_(model.chain, model.footing) {}

  // Return the parameters, the routes, the number of muscles, and all position-dependent terms that
  // a node needs.
  const ChainModel<N, S>& model() const noexcept { return model_; }
  const ChainRoutingOf<S>& routes() const noexcept { return routes_; }
  int muscles() const noexcept { return routes_.count; }
  Pose pose(const S&, const Motion& motion) const noexcept { return Pose(model_.chain, motion); }

  // Returns the angle of a joint [rad].
  S joint_angle(const Motion& m, std::size_t j) const noexcept {
    return m.angle[j] - (j > 0 ? m.angle[j - 1] : S(0.0));
  }
  // Returns the rate of a joint  [rad/s].
  S joint_rate(const Motion& m, std::size_t j) const noexcept {
    return m.rate[j] - (j > 0 ? m.rate[j - 1] : S(0.0));
  }
  // Returns a sum that is not finite if any coordinate is not.
  S sum(const Motion& m) const noexcept {
    S places = m.x;
    for (int j = 0; j < N; ++j) places += m.angle[j];
    return places;
  }

  // Writes the lengths of the muscles and their rates, from the joints' angles.
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

  // Computes all forces except dry friction from the tensions of the air.
  template <class Evaluation>
  void load(const Pose& chain, const Motion& motion, const Arms&, const Evaluation& air,
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

    // The track's stop acts on one side only and never pulls.
    const S beyond = motion.x - model_.track_length;
    if (const auto there = beyond > 0.0; units::any(there)) {
      const S push = model_.track_stiffness * beyond + model_.track_damping * motion.x_rate;
      out.force.x -= units::select(there & (push > 0.0), push, 0.0);
    }
    ground(chain, motion, out);
  }

  // Returns the acceleration under the load and the dry friction of the step.
  Acceleration accelerate(const Pose& chain, const Motion&, const Load& load,
                          const Forces& held) const noexcept {
    GeneralizedVector<N, S> force = load.force;
    const GeneralizedVector<N, S> friction = contacts_.generalised(chain, held);
    force.x += friction.x;
    for (int i = 0; i < N; ++i) force.angle[i] += friction.angle[i];
    return chain.accelerations(force);
  }

  // Returns the bound of the trolley's dry friction, from the last step's bound and force [N].
  S trolley_bound(const Forces& held, const S& last) const noexcept {
    return robot::Trolley::friction(held[Contacts<N, S>::trolley], last, model_.drag,
                                    model_.breakaway);
  }

  // Prepares a node for hold() and returns the accelerations without friction. Bounds: the mesh's
  // own friction acts through the cams and is part of the joint's.
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

  // Return the dry friction of a step of length h from the prepared node, and accelerations under
  // it.
  Forces hold(const S& h, const Forces& last) const noexcept { return contacts_.hold(h, last); }
  Acceleration accelerate(const Acceleration& free, const Forces& held) const noexcept {
    return contacts_.accelerations(free, held);
  }
  S bound(int contact) const noexcept { return contacts_.bound(contact); }

  // Writes `from` moved by h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, const S& h, const Motion& rates,
            const Acceleration& a) const noexcept {
    out.x = from.x + h * rates.x_rate;
    out.x_rate = from.x_rate + h * a.x;
    for (int i = 0; i < N; ++i) {
      out.angle[i] = from.angle[i] + h * rates.rate[i];
      out.rate[i] = from.rate[i] + h * a.angle[i];
    }
  }

  // Moves by h under a constant acceleration.
  void extrapolate(Motion& m, const S& h, const Acceleration& a) const noexcept {
    m.x = m.x + h * m.x_rate + 0.5 * h * h * a.x;
    m.x_rate += h * a.x;
    for (int i = 0; i < N; ++i) {
      m.angle[i] = m.angle[i] + h * m.rate[i] + 0.5 * h * h * a.angle[i];
      m.rate[i] += h * a.angle[i];
    }
  }

  // Applies RK4's weighted mean of four stages.
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
  // Computes the ground's force on the foot, a disc about the ankle that belongs to the last link.
  // Only the compliant normal force is computed; the tangential force is one of the step's dry
  // frictions.
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
  // In whole lanes from the start: a wide load after narrow stores would stall.
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

// Returns whether the muscles of both act on the same joints, as required side by side.
inline bool alike(const ChainRouting& a, const ChainRouting& b) {
  return a.count == b.count && a.joint == b.joint;
}

// Returns W routings as one; all must be alike().
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

// A chain of N links on a trolley or a fixed base: a mechanism for world/kernel/world.h.
// muscle_routing.h has the loads of the trolley's rollers.
//
// robot::is_chain returns whether it can represent a robot; body_mechanism.h can represent all, and
// both agree on chains.
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
      : Equations(chain_model_of<N>(setup), chain_routing_of(setup.robot)),
        rollers_(setup.robot),
        hung_(robot::leg_mass(setup.robot) + setup.robot.cylinder.body_mass) {
    double absolute = 0;
    for (int j = 0; j < N; ++j)
      start_.angle[j] = absolute += setup.start.joint_angle[static_cast<std::size_t>(j)];
    start_.x = setup.start.trolley;
  }

  // Return the constants, the motion at the start, and a muscle's joint and moment arm.
  const ChainConstants<N>& constants() const noexcept { return model_.chain; }
  const Motion& start() const noexcept { return start_; }
  int joint(int muscle) const noexcept { return routes_.joint[static_cast<std::size_t>(muscle)]; }
  double arm(const Arms&, int muscle) const noexcept { return routes_.moment_arm[muscle]; }  // [m]
  // Returns 0: a chain has no lift [m].
  double lift(const Motion&) const noexcept { return 0; }

  // Returns the body step, or an integer fraction of it that suits the machine's fastest rate at
  // its start.
  double node_step(const Setup& setup) const {
    std::array<double, N> damping = model_.damping, spring = model_.spring;
    const std::vector<double> of_muscles = muscle_damping(setup);
    for (int j = 0; j < N; ++j) {
      damping[j] += model_.stop[j].damping + of_muscles[static_cast<std::size_t>(j)];
      spring[j] += model_.stop[j].stiffness;
    }
    return stable_step(setup.steps.body,
                       this->contacts_.stiffest_rate(Pose(model_.chain, start_), damping, spring));
  }

  // Sets the rates of the joints [rad/s] and of the trolley [m/s] in a motion.
  void set_rates(Motion& m, std::initializer_list<double> joint_rates, double x_rate,
                 double) const {
    double absolute = 0;
    for (std::size_t j = 0; j < N; ++j)
      m.rate[j] = absolute += j < joint_rates.size() ? joint_rates.begin()[j] : 0.0;
    m.x_rate = x_rate;
  }

  // Adds the torque of a muscle's tension on its joint [N m].
  void add_torque(const Arms&, int muscle, double tension,
                  std::array<double, most_joints>& torque) const noexcept {
    torque[static_cast<std::size_t>(joint(muscle))] += routes_.moment_arm[muscle] * tension;
  }

  // Fills in the true values that follow from the motion alone.
  void write_motion(const Motion& pose, Truth& out) const noexcept {
    out.x = pose.x;
    out.x_rate = pose.x_rate;
    for (std::size_t j = 0; j < N; ++j) {
      out.angle[j] = joint_angle(pose, j);
      out.rate[j] = joint_rate(pose, j);
    }
  }

  // Fills in the body's part of the true values at a motion. The muscles' torques must be set
  // already.
  void write_truth(const Motion& pose, const Acceleration& a, const Forces& held, const Load&,
                   Truth& out) const noexcept {
    write_motion(pose, out);
    Load at{};
    const Chain<N> chain(model_.chain, pose);
    this->ground(chain, pose, at);
    out.foot[0].x = at.ankle_x;
    out.foot[0].y = at.ankle_y;
    out.foot[0].force_x = at.normal > 0 ? held[Contacts<N>::foot] : 0.0;
    out.foot[0].force_y = out.disc_force[0] = at.normal;
    if (rollers_.rollers.present) write_roller_loads(chain, pose, a, held, out);
  }

 private:
  // The trolley's force on the masses below it is the rate of their momentum, less the ground's
  // force.
  void write_roller_loads(const Chain<N>& chain, const Motion& pose, const Acceleration& a,
                          const Forces& held, Truth& out) const noexcept {
    TrolleyReaction h{.acceleration = a.x};
    h.force_x = hung_ * a.x - out.foot[0].force_x;
    h.force_y = hung_ * model_.chain.gravity - out.foot[0].force_y;
    for (int i = 0; i < N; ++i)
      h.add(model_.chain.first_moment[i], chain.sin(i), chain.cos(i), pose.rate[i], a.angle[i]);
    h.torque = out.torque[0] - model_.damping[0] * pose.rate[0] -
               model_.spring[0] * (pose.angle[0] - model_.spring_angle[0]) +
               model_.stop[0].torque(pose.angle[0], pose.rate[0]) + held[0];
    const RollerLoads loads = roller_loads(rollers_, h);
    out.roller_front = loads.front;
    out.roller_rear = loads.rear;
  }

  RollerModel rollers_;
  double hung_ = 0;  // mass below the trolley [kg]
  Motion start_{};
};

}  // namespace sinew::plant
