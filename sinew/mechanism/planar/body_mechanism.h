// mechanism/planar/body_mechanism.h - any planar machine: chains and trees of joints,
// driven or passive, a body that a cylinder lifts, cams of any shape, muscles across two joints,
// feet of several discs.
//
//   body.h            equations of motion       friction_contacts.h  friction, discs on the ground
//   muscle_routing.h  routes of the muscles     rollers.h            what the trolley rests on
//
// One of the mechanisms of world/world.h; chain_mechanism.h is the same for the leg that walks,
// faster. It is compiled for several sizes: N joints on feet of D discs (body.h,
// friction_contacts.h), M muscles.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/body.h"
#include "sinew/mechanism/planar/friction_contacts.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/mechanism/planar/planar_mechanism.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/mechanism/planar/stops.h"

namespace sinew::plant {

template <int N, int D, int M>
class BodyMechanism : public PlanarMechanism<M> {
 public:
  using Motion = plant::BodyState<N>;
  using Acceleration = Coordinates<N>;
  using Forces = typename FrictionContacts<N, D>::Forces;
  using Arms = MuscleRouting::MomentArms<M>;
  using Pose = BodyOnGround<N, D>;

  struct Load {
    Coordinates<N> force;                             // all but dry friction
    std::array<double, N> passive_torque;             // dampers and springs [N m]
    typename FrictionContacts<N, D>::Normals normal;  // of the ground on the discs [N]
  };

  // Is there room for this robot?
  static bool holds(const robot::Robot& robot) {
    return plant::holds<N>(robot) && robot::discs_of(robot) <= D && robot.muscles.size() <= M;
  }

  // Takes a planar machine of at most N links, D discs and M muscles.
  explicit BodyMechanism(const Setup& setup);

  // Returns the constants, the motion at the start, the number of muscles; and of one its first
  // joint and its arm there.
  const BodyConstants<N>& constants() const noexcept { return constants_; }
  const Motion& start() const noexcept { return start_; }
  int muscles() const noexcept { return cords_.count(); }
  int joint(int muscle) const noexcept { return cords_.joint(muscle, 0); }
  double arm(const Arms& arms, int muscle) const noexcept {  // at its first joint [m]
    return arms[static_cast<std::size_t>(muscle)][0];
  }
  // Returns all that a node needs to know of where the machine is.
  Pose pose(double, const Motion& motion) const noexcept {
    Pose pose(constants_, motion);
    rubs_.place(motion, pose);
    return pose;
  }

  // Returns the angle of a joint [rad], its rate [rad/s], and how far the body is up [m].
  double joint_angle(const Motion& m, std::size_t j) const noexcept {
    return m.at[first_link + j] -
           (constants_.hangs_on_link(j) ? m.at[first_link + constants_.on(j)] : 0.0);
  }
  double joint_rate(const Motion& m, std::size_t j) const noexcept {
    return m.rate[first_link + j] -
           (constants_.hangs_on_link(j) ? m.rate[first_link + constants_.on(j)] : 0.0);
  }
  double lift(const Motion& m) const noexcept { return m.at[up]; }

  // A number that is none where one of the coordinates is none.
  double sum(const Motion& m) const noexcept;

  // The body step, or a whole part of it that suits the machine's fastest rates  [s].
  double node_step(const Setup&) const noexcept { return node_step_; }
  // The ground is what asks for short steps where a foot is light. While no disc can come to it or
  // leave it, nodes stand as far apart as the joints alone bear in the air, and as the relaxed
  // damper does on the ground: at whole multiples of so many steps.
  std::int64_t next_multiple(std::int64_t multiple, double step, const Pose& pose,
                             const Motion& m) const noexcept {
    if (steps_in_air_ == 1) return multiple + 1;
    const std::int64_t steps = rubs_.touches(pose) ? steps_on_ground_ : steps_in_air_;
    if (steps == 1 || rubs_.can_change(pose, m, static_cast<double>(steps) * step))
      return multiple + 1;
    return (multiple / steps + 1) * steps;
  }
  // Returns the largest acceleration of the body per force on the piston, in any pose  [1/kg].
  double lift_per_force() const noexcept { return lift_per_force_; }
  std::int64_t most_steps_on_ground() const noexcept { return steps_on_ground_; }

  // Lets a motion have these rates of the joints [rad/s] and of the body [m/s].
  void set_rates(Motion& m, std::initializer_list<double> joint_rates, double x_rate,
                 double y_rate) const;

  // Lengths of the muscles, the piston's travel, their rates; the muscles' arms.
  void route(double, const Motion& m, air::Ends<M>& ends, Arms& arms) const noexcept;

  // Works out all forces but dry friction's, from what the air pulls and pushes.
  template <class Answer>
  void load(const Pose& body, const Motion& m, const Arms& arms, const Answer& air,
            Load& out) const noexcept {
    load(body, m, arms, air.tension, air.cylinder_force, out);
  }

  // Returns the acceleration under the load and the dry friction that is held.
  Acceleration accelerate(const Pose& body, const Motion& m, const Load& load,
                          const Forces& held) const noexcept;

  // Bound of the trolley's dry friction, from the last step's and what was held in it [N].
  double trolley_bound(const Forces& held, double last) const noexcept {
    if (constants_.held[along_track]) return 0;
    return robot_.trolley.friction(held[FrictionContacts<N, D>::trolley], last);
  }

  // At a node: answers the accelerations without friction and makes what hold() goes by. Bounds:
  // the mesh's own friction acts through the cams and is part of the joint's.
  Acceleration prepare(const Pose& body, const Motion& m, const Arms& arms,
                       const air::Lanes<M>& friction_bound, double trolley_bound,
                       const Load& load) noexcept;

  // Dry friction of a step of length h from the prepared node, and accelerations under it.
  Forces hold(double h, const Forces& last) const noexcept { return rubs_.hold(h, last); }
  Acceleration accelerate(const Acceleration& free, const Forces& held) const noexcept {
    return rubs_.accelerations(free, held);
  }
  double bound(int contact) const noexcept { return rubs_.bound(contact); }

  // `from`, h along the given rates and accelerations.
  void move(Motion& out, const Motion& from, double h, const Motion& rates,
            const Acceleration& a) const noexcept;

  // The ground's damper within a step: friction_contacts.h.
  void relax(double h, double share, const Load& load, const Acceleration& before,
             Acceleration& a) const noexcept {
    rubs_.relax(h, share, load.normal, before, a);
  }

  // h along a constant acceleration.
  void glide(Motion& m, double h, const Acceleration& a) const noexcept;

  // RK4's weighted mean of four stages.
  void finish(Motion& now, double h, const Motion* const (&stage)[4],
              const Acceleration (&a)[4]) const noexcept;

  // Adds what a muscle's tension does to its joints  [N m].
  void add_torque(const Arms& arms, int muscle, double tension,
                  std::array<double, most_joints>& torque) const noexcept;

  // Fills in what only a simulation knows of the body at a motion; the muscles' torques are there
  // already, and `load` is that of the last node.
  void tell(const Motion& m, const Acceleration& a, const Forces& held, const Load& load,
            Truth& out) const noexcept;

 private:
  void choose_steps(double body_step);
  void load(const Pose& body, const Motion& m, const Arms& arms, const air::Lanes<M>& tension,
            double piston_force, Load& out) const noexcept;
  double cylinder_stop(const Motion& m) const noexcept;
  void tell_rollers(const Body<N>& body, const Motion& m, const Acceleration& a, const Forces& held,
                    const Load& load, Truth& out) const noexcept;

  double carried(const Body<N>& body, const Motion& m, const Acceleration& a, std::size_t first,
                 const Truth& truth) const noexcept;

  BodyConstants<N> constants_;
  robot::Robot robot_;
  MuscleRouting cords_;
  FrictionContacts<N, D> rubs_;
  Motion start_{};
  double node_step_ = 1e-3;                              // [s]
  double lift_per_force_ = 0;                            // [1/kg]
  std::int64_t steps_in_air_ = 1, steps_on_ground_ = 1;  // of them, at most
  std::array<double, N> damping_{}, spring_{}, spring_angle_{}, dry_{};
  std::array<JointStop, N> stop_{};
};

}  // namespace sinew::plant
