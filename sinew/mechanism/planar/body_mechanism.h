// mechanism/planar/body_mechanism.h - mechanism of any planar machine: chains and trees of joints,
// driven or passive, a body that a cylinder lifts, cams of any shape, muscles across two joints,
// feet of several discs.
//
//   body.h            equations of motion       friction_contacts.h  friction, discs on the ground
//   muscle_routing.h  routes of the muscles, loads of the trolley's rollers
//
// It is a mechanism for world/kernel/world.h; chain_body.h is a faster one for the walking leg. It
// is compiled for several sizes: N joints on feet of D discs (body.h, friction_contacts.h), M
// muscles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/body.h"
#include "sinew/mechanism/planar/friction_contacts.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/mechanism/planar/planar_mechanism.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/units/stages.h"

namespace sinew::plant {

template <int N, int D, int M>
class BodyMechanism : public PlanarMechanism<M> {
 public:
  using Scalar = double;
  using Motion = plant::BodyState<N>;
  using Acceleration = Coordinates<N>;
  using Forces = typename FrictionContacts<N, D>::Forces;
  using Arms = MuscleRouting::MomentArms<M>;
  using Pose = BodyOnGround<N, D>;

  struct Load {
    Coordinates<N> force;                             // all except dry friction
    std::array<double, N> passive_torque;             // dampers and springs [N m]
    typename FrictionContacts<N, D>::Normals normal;  // force of the ground on the discs [N]
  };

  // Returns whether this robot fits.
  static bool fits(const robot::Robot& robot) {
    return plant::fits<N>(robot) && robot::discs_of(robot) <= D && robot.muscles.size() <= M;
  }

  // Takes a planar machine of at most N links, D discs and M muscles.
  explicit BodyMechanism(const Setup& setup);

  // Return the constants, the motion at the start, the number of muscles; and a muscle's first
  // joint and its moment arm there.
  const BodyConstants<N>& constants() const noexcept { return constants_; }
  const Motion& start() const noexcept { return start_; }
  int muscles() const noexcept { return routing_.count(); }
  int joint(int muscle) const noexcept { return routing_.joint(muscle, 0); }
  double arm(const Arms& arms, int muscle) const noexcept {  // at its first joint [m]
    return arms[static_cast<std::size_t>(muscle)][0];
  }
  // Returns all position-dependent terms that a node needs.
  Pose pose(double, const Motion& motion) const noexcept {
    Pose pose(constants_, motion);
    contacts_.place(motion, pose);
    return pose;
  }

  // Return the angle of a joint [rad], its rate [rad/s], and the body's lift [m].
  double joint_angle(const Motion& m, std::size_t j) const noexcept {
    return m.at[first_link + j] -
           (constants_.hangs_on_link(j) ? m.at[first_link + constants_.on(j)] : 0.0);
  }
  double joint_rate(const Motion& m, std::size_t j) const noexcept {
    return m.rate[first_link + j] -
           (constants_.hangs_on_link(j) ? m.rate[first_link + constants_.on(j)] : 0.0);
  }
  double lift(const Motion& m) const noexcept { return m.at[up]; }

  // Returns a sum that is not finite if any coordinate is not.
  double sum(const Motion& m) const noexcept;

  // Returns the body step, or an integer fraction of it that suits the machine's fastest rates [s].
  double node_step(const Setup&) const noexcept { return node_step_; }
  // Returns the multiple of the step at which the next node is. A light foot requires short steps
  // because of the ground. While no disc can touch or leave the ground, nodes are further apart: as
  // far as the joints allow in the air, or the relaxed damper on the ground, at multiples of that
  // many steps.
  std::int64_t next_multiple(std::int64_t multiple, double step, const Pose& pose,
                             const Motion& m) const noexcept {
    if (steps_in_air_ == 1) return multiple + 1;
    const std::int64_t steps = contacts_.touches(pose) ? steps_on_ground_ : steps_in_air_;
    if (steps == 1 || contacts_.can_change(pose, m, static_cast<double>(steps) * step))
      return multiple + 1;
    return (multiple / steps + 1) * steps;
  }
  // Returns the largest acceleration of the body per force on the piston, in any pose  [1/kg].
  double lift_per_force() const noexcept { return lift_per_force_; }
  std::int64_t most_steps_on_ground() const noexcept { return steps_on_ground_; }

  // Sets the rates of the joints [rad/s], of the trolley and of the body [m/s] in a motion.
  void set_rates(Motion& m, std::initializer_list<double> joint_rates, double x_rate,
                 double y_rate) const;

  // Writes the lengths of the muscles, the piston's travel, their rates, and the muscles' arms.
  void route(double, const Motion& m, air::Ends<M>& ends, Arms& arms) const noexcept;

  // Computes all forces except dry friction from the forces of the air.
  template <class Evaluation>
  void load(const Pose& body, const Motion& m, const Arms& arms, const Evaluation& air,
            Load& out) const noexcept {
    load(body, m, arms, air.tension, air.cylinder_force, out);
  }

  // Returns the acceleration under the load and the dry friction of the step.
  Acceleration accelerate(const Pose& body, const Motion& m, const Load& load,
                          const Forces& held) const noexcept;

  // Returns the bound of the trolley's dry friction, from the last step's bound and force [N].
  double trolley_bound(const Forces& held, double last) const noexcept {
    if (constants_.held[along_track]) return 0;
    return robot_.trolley.friction(held[FrictionContacts<N, D>::trolley], last);
  }

  // Prepares a node for hold() and returns the accelerations without friction. Bounds: the mesh's
  // own friction acts through the cams and is part of the joint's.
  Acceleration prepare(const Pose& body, const Motion& m, const Arms& arms,
                       const air::Lanes<M>& friction_bound, double trolley_bound,
                       const Load& load) noexcept;

  // Return the dry friction of a step of length h from the prepared node, and accelerations under
  // it.
  Forces hold(double h, const Forces& last) const noexcept { return contacts_.hold(h, last); }
  Acceleration accelerate(const Acceleration& free, const Forces& held) const noexcept {
    return contacts_.accelerations(free, held);
  }
  double bound(int contact) const noexcept { return contacts_.bound(contact); }

  // Writes `from` moved by h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, double h, const Motion& rates,
            const Acceleration& a) const noexcept;

  // Relaxes the ground's damper within a step: friction_contacts.h.
  void relax(double h, double share, const Load& load, const Acceleration& before,
             Acceleration& a) const noexcept {
    contacts_.relax(h, share, load.normal, before, a);
  }

  // Moves by h under a constant acceleration.
  void extrapolate(Motion& m, double h, const Acceleration& a) const noexcept;

  // Applies RK4's weighted mean of four stages.
  void finish(Motion& now, double h, const Motion* const (&stage)[4],
              const Acceleration (&a)[4]) const noexcept;

  // Adds the torque of a muscle's tension on its joints [N m].
  void add_torque(const Arms& arms, int muscle, double tension,
                  std::array<double, most_joints>& torque) const noexcept;

  // Fills in the body's part of the true values at a motion. The muscles' torques must be set
  // already; `load` is that of the last node.
  void write_truth(const Motion& m, const Acceleration& a, const Forces& held, const Load& load,
                   Truth& out) const noexcept;

 private:
  void choose_steps(const Setup& setup);
  void load(const Pose& body, const Motion& m, const Arms& arms, const air::Lanes<M>& tension,
            double piston_force, Load& out) const noexcept;
  double cylinder_stop(const Motion& m) const noexcept;
  void write_roller_loads(const Body<N>& body, const Motion& m, const Acceleration& a,
                          const Forces& held, const Load& load, Truth& out) const noexcept;

  double carried(const Body<N>& body, const Motion& m, const Acceleration& a, std::size_t first,
                 const Truth& truth) const noexcept;

  BodyConstants<N> constants_;
  robot::Robot robot_;
  MuscleRouting routing_;
  FrictionContacts<N, D> contacts_;
  Motion start_{};
  double node_step_ = 1e-3;                              // [s]
  double lift_per_force_ = 0;                            // [1/kg]
  std::int64_t steps_in_air_ = 1, steps_on_ground_ = 1;  // longest multiples of node_step_
  std::array<double, N> damping_{}, spring_{}, spring_angle_{}, dry_{};
  std::array<JointStop, N> stop_{};
};

template <int N, int D, int M>
BodyMechanism<N, D, M>::BodyMechanism(const Setup& setup)
    : constants_(body_of<N>(setup.robot)),
      robot_(setup.robot),
      routing_(setup.robot),
      contacts_(constants_, setup.robot) {
  for (std::size_t j = 0; j < constants_.links(); ++j) {
    const robot::Joint& joint = robot_.joints[j];
    damping_[j] = joint.damping + joint.damper;
    spring_[j] = joint.spring;
    spring_angle_[j] = joint.spring_angle;
    stop_[j] = JointStop(joint.stop);
    dry_[j] = setup.start.blocked[j] ? blocked_bound : joint.dry_friction;
    const double on = constants_.hangs_on_link(j) ? start_.at[first_link + constants_.on(j)] : 0.0;
    start_.at[first_link + j] = on + setup.start.joint_angle[j];
  }
  start_.at[along_track] = setup.start.trolley;
  start_.at[up] = setup.start.lift;
  choose_steps(setup);
}

template <int N, int D, int M>
double BodyMechanism<N, D, M>::sum(const Motion& m) const noexcept {
  double places = 0;
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) places += m.at[c];
  return places;
}

// Chooses the step that suits all rates, and the longer ones without the ground or with its damper
// relaxed.
template <int N, int D, int M>
void BodyMechanism<N, D, M>::choose_steps(const Setup& setup) {
  const double body_step = setup.steps.body;
  const std::vector<double> of_muscles = muscle_damping(setup);
  const auto rates = [&](const Motion& m) {
    return contacts_.fastest_rates(Body<N>(constants_, m), m, robot_, of_muscles);
  };
  // A light foot is quick if the ground pushes past its centre of mass. The poses cover the
  // range of angles: each link turns by an irrational number of turns from one to the next (5 + 7 j
  // is no square).
  const FastestRates at_start = rates(start_);
  FastestRates elsewhere;
  Motion m = start_;
  for (int k = 0; k < 100; ++k) {
    for (std::size_t j = 0; j < constants_.links(); ++j)
      m.at[first_link + j] += 2.0 * std::numbers::pi * std::sqrt(static_cast<double>(5 + 7 * j));
    elsewhere.include(rates(m));
  }
  lift_per_force_ = std::max(at_start.lift, elsewhere.lift);
  using Contacts = FrictionContacts<N, D>;
  const auto suited = [&](double ground, double damper) {  // shares of the ground's rates
    const auto rate = [&](const FastestRates& r) {
      return std::max({r.joints, ground * r.ground_spring, damper * r.ground_damper});
    };
    return stable_step(body_step, rate(at_start), rate(elsewhere));
  };
  node_step_ = suited(1, 1);
  const auto steps = [&](double longer) {
    return static_cast<std::int64_t>(longer / node_step_ + 1e-9);
  };
  steps_in_air_ = steps(suited(0, 0));
  steps_on_ground_ = steps(suited(1, Contacts::stable_explicit / Contacts::stable_relaxed));
  contacts_.relax_beyond(node_step_ * (1 + 1e-9));
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::set_rates(Motion& m, std::initializer_list<double> joint_rates,
                                       double x_rate, double y_rate) const {
  for (std::size_t j = 0; j < constants_.links(); ++j) {
    const double on = constants_.hangs_on_link(j) ? m.rate[first_link + constants_.on(j)] : 0.0;
    m.rate[first_link + j] = on + (j < joint_rates.size() ? joint_rates.begin()[j] : 0.0);
  }
  m.rate[along_track] = x_rate;
  m.rate[up] = y_rate;
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::route(double, const Motion& m, air::Ends<M>& ends,
                                   Arms& arms) const noexcept {
  std::array<double, N> angle, rate;
  for (std::size_t j = 0; j < constants_.links(); ++j) {
    angle[j] = joint_angle(m, j);
    rate[j] = joint_rate(m, j);
  }
  routing_.at(angle.data(), rate.data(), ends.length, ends.rate, arms);
  ends.travel = m.at[up];
  ends.travel_rate = m.rate[up];
}

// Acts one-sided at both ends of the stroke.
template <int N, int D, int M>
double BodyMechanism<N, D, M>::cylinder_stop(const Motion& m) const noexcept {
  const robot::Cylinder& c = robot_.cylinder;
  const double below = -m.at[up], above = m.at[up] - c.stroke;
  if (below > 0) {
    const double push = c.stop_stiffness * below - c.stop_damping * m.rate[up];
    return push > 0 ? push : 0.0;
  }
  if (above > 0) {
    const double push = c.stop_stiffness * above + c.stop_damping * m.rate[up];
    return push > 0 ? -push : 0.0;
  }
  return 0;
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::load(const Pose& body, const Motion& m, const Arms& arms,
                                  const air::Lanes<M>& tension, double piston_force,
                                  Load& out) const noexcept {
  std::array<double, N> torque{};
  for (std::size_t j = 0; j < constants_.links(); ++j) {
    const double angle = joint_angle(m, j), rate = joint_rate(m, j);
    out.passive_torque[j] = -damping_[j] * rate - spring_[j] * (angle - spring_angle_[j]);
    out.passive_torque[j] += stop_[j].torque(angle, rate);
    torque[j] = out.passive_torque[j];
  }
  routing_.each(arms, [&](int i, std::size_t j, double arm) { torque[j] += arm * tension[i]; });

  out.force = {};
  for (std::size_t j = 0; j < constants_.links(); ++j) {
    out.force[first_link + j] = torque[j];
    if (constants_.hangs_on_link(j)) out.force[first_link + constants_.on(j)] -= torque[j];
  }

  const double beyond = m.at[along_track] - robot_.trolley.track_length;
  if (robot_.trolley.present && beyond > 0) {
    const double push =
        robot_.trolley.stop_stiffness * beyond + robot_.trolley.stop_damping * m.rate[along_track];
    out.force[along_track] -= push > 0 ? push : 0.0;
  }
  if (!constants_.held[up])
    out.force[up] += piston_force - robot_.cylinder.damping * m.rate[up] + cylinder_stop(m);

  out.normal = {};
  for (int i = 0; i < contacts_.discs(); ++i) {
    const double depth = body.depth[static_cast<std::size_t>(i)];
    if (depth <= 0) continue;
    const DiscAt<N>& disc = body.contact[static_cast<std::size_t>(i)];
    const double push = contacts_.push(depth, disc, m);
    out.normal[static_cast<std::size_t>(i)] = push;
    if (push <= 0) continue;
    for (std::size_t c = 0; c < constants_.coordinates(); ++c) out.force[c] += push * disc.rise[c];
  }
}

template <int N, int D, int M>
auto BodyMechanism<N, D, M>::accelerate(const Pose& body, const Motion& m, const Load& load,
                                        const Forces& held) const noexcept -> Acceleration {
  Coordinates<N> force = load.force;
  const Coordinates<N> friction = contacts_.generalised(body, m, held);
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) force[c] += friction[c];
  return body.accelerations(force);
}

template <int N, int D, int M>
auto BodyMechanism<N, D, M>::prepare(const Pose& body, const Motion& m, const Arms& arms,
                                     const air::Lanes<M>& friction_bound, double trolley_bound,
                                     const Load& load) noexcept -> Acceleration {
  const Acceleration free = body.accelerations(load.force);
  Forces bound{};
  for (std::size_t j = 0; j < constants_.links(); ++j) bound[j] = dry_[j];
  routing_.each(arms, [&](int i, std::size_t j, double arm) {
    bound[j] += std::abs(arm) * friction_bound[i];
  });
  bound[FrictionContacts<N, D>::trolley] = trolley_bound;
  bound[FrictionContacts<N, D>::lift] = constants_.held[up] ? 0.0 : robot_.cylinder.friction;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contacts_.discs()); ++i)
    bound[FrictionContacts<N, D>::first_disc + i] = contacts_.friction(i) * load.normal[i];
  contacts_.prepare(body, m, free, bound, load.normal);
  return free;
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::move(Motion& out, const Motion& from, double h, const Motion& rates,
                                  const Acceleration& a) const noexcept {
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    out.at[c] = from.at[c] + h * rates.rate[c];
    out.rate[c] = from.rate[c] + h * a[c];
  }
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::extrapolate(Motion& m, double h,
                                         const Acceleration& a) const noexcept {
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    m.at[c] += h * (m.rate[c] + 0.5 * h * a[c]);
    m.rate[c] += h * a[c];
  }
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::finish(Motion& now, double h, const Motion* const (&stage)[4],
                                    const Acceleration (&a)[4]) const noexcept {
  const units::StageMean mean(h);
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    now.at[c] += mean([&](int s) { return stage[s]->rate[c]; });
    now.rate[c] += mean([&](int s) { return a[s][c]; });
  }
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::add_torque(const Arms& arms, int muscle, double tension,
                                        std::array<double, most_joints>& torque) const noexcept {
  for (std::size_t s = 0; s < MuscleRouting::most; ++s)
    if (const int j = routing_.joint(muscle, static_cast<int>(s)); j >= 0)
      torque[static_cast<std::size_t>(j)] += arms[static_cast<std::size_t>(muscle)][s] * tension;
}

// A foot is at the end of its leg's last link; the ground's force on it is the sum over its discs.
template <int N, int D, int M>
void BodyMechanism<N, D, M>::write_truth(const Motion& m, const Acceleration& a, const Forces& held,
                                         const Load& load, Truth& out) const noexcept {
  out.x = m.at[along_track];
  out.x_rate = m.rate[along_track];
  out.lift = m.at[up];
  out.lift_rate = m.rate[up];
  const Body<N> body(constants_, m);
  for (std::size_t j = 0; j < constants_.links(); ++j) {
    out.angle[j] = joint_angle(m, j);
    out.rate[j] = joint_rate(m, j);
  }
  for (std::size_t f = 0; f < contacts_.feet(); ++f) {
    const typename FrictionContacts<N, D>::Path& path = contacts_.leg(f);
    out.foot[f] = {};
    for (std::size_t k = path.first; k < path.count; ++k) {
      out.foot[f].x += path.reach[k] * body.cos(path.link[k]);
      out.foot[f].y += path.reach[k] * body.sin(path.link[k]);
    }
  }
  for (int i = 0; i < contacts_.discs(); ++i) {
    FootTruth& foot = out.foot[contacts_.foot_of(i)];
    const double push = contacts_.push(contacts_.depth(body, m, i), contacts_.disc(body, m, i), m);
    out.disc_force[static_cast<std::size_t>(i)] = push;
    foot.force_y += push;
    if (push > 0)
      foot.force_x += held[static_cast<std::size_t>(FrictionContacts<N, D>::first_disc + i)];
  }
  if (robot_.rollers.present) write_roller_loads(body, m, a, held, load, out);
}

// Returns the body's upward force on the links carried by one of its first links [N].
template <int N, int D, int M>
double BodyMechanism<N, D, M>::carried(const Body<N>& body, const Motion& m, const Acceleration& a,
                                       std::size_t first, const Truth& truth) const noexcept {
  double force = constants_.hanging[first] * (a[up] + constants_.gravity);
  for (std::size_t i = 0; i < constants_.links(); ++i) {
    const double rate = m.rate[first_link + i];
    if (constants_.first_on(i) == first)
      force += constants_.first_moment[i] *
               (body.cos(i) * a[first_link + i] - body.sin(i) * rate * rate);
  }
  for (std::size_t f = 0; f < contacts_.feet(); ++f)
    if (contacts_.leg(f).link[0] == first) force -= truth.foot[f].force_y;
  return force;
}

template <int N, int D, int M>
void BodyMechanism<N, D, M>::write_roller_loads(const Body<N>& body, const Motion& m,
                                                const Acceleration& a, const Forces& held,
                                                const Load& load, Truth& out) const noexcept {
  const double hung = constants_.lifted_mass;
  FootTruth ground;
  for (const FootTruth& foot : out.foot) {
    ground.force_x += foot.force_x;
    ground.force_y += foot.force_y;
  }
  TrolleyReaction h{.acceleration = a[along_track], .lift = m.at[up]};
  h.force_x = hung * a[along_track] - ground.force_x;
  h.force_y = hung * (a[up] + constants_.gravity) - ground.force_y;
  for (std::size_t i = 0; i < constants_.links(); ++i) {
    h.add(constants_.first_moment[i], body.sin(i), body.cos(i), m.rate[first_link + i],
          a[first_link + i]);
    if (constants_.hangs_on_link(i)) continue;
    h.torque += out.torque[i] + load.passive_torque[i] + held[i];
    if (constants_.attachment[i] != 0)
      h.torque += constants_.attachment[i] * carried(body, m, a, i, out);
  }
  const RollerLoads loads = roller_loads(RollerModel(robot_), h);
  out.roller_front = loads.front;
  out.roller_rear = loads.rear;
}

}  // namespace sinew::plant
