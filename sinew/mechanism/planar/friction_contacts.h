// mechanism/planar/friction_contacts.h - where a machine of any shape touches and rubs: joints,
// trolley, lift and the discs of its feet. contacts.h with a list of discs in place of one and a
// coordinate more.
//
// A disc's centre stands at (along, across) of its leg's last link; its lowest point slips and is
// pushed.
// Contact c slips with the velocity J_c q' and carries the force f_c; see friction.h for the law.
//
// The ground is stiff: within a step of length h the normal forces change by about
//
//   dF = -(k h/2 v + beta (a + R dF + A f)),   beta = h (h/6 k + c/2)
//
//   v, a  of the discs upwards, without dF and friction    R  upward acceleration per normal force
//   f     friction forces                                   A  upward acceleration per friction
//
// which is solved for dF and put into the slips: W becomes W - h beta A^T (1 + beta R)^-1 A.
//
// Under a light foot the ground's damper can be quicker than a step of RK4 bears, rate times step
// 2.78. Its force is then relaxed in the stages two to four: with g, the relaxation,
//
//   a_s = f_s - g h c B (a_s - a_s-1)     B = M^-1 J^T J, J the rise of the discs that are pushed
//
// a W-method of the second order along those discs and of the fourth elsewhere. With g = 0.2 a lone
// damper keeps at most a tenth of its velocity over a step for products from 2 to 4.5, and is
// stable up to 7.65. A peek goes by the mean over the step, g = 1/2 with nothing before.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

#include "sinew/mechanism/friction/friction.h"
#include "sinew/mechanism/planar/body.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"

namespace sinew::plant {

// Rates at which springs and dampers of the joints, the ground's spring and its damper bring a
// machine to rest  [1/s]: c w and sqrt(k w) with w, the joint's or disc's acceleration per force.
// Those of the stops of the track and of the cylinder are among the joints'.
struct FastestRates {
  double joints = 0, ground_spring = 0, ground_damper = 0;
  double lift = 0;  // of the body, per force on the piston [1/kg]; 0 where it is held

  // Takes the larger of each.
  void include(const FastestRates& other) {
    joints = std::max(joints, other.joints);
    ground_spring = std::max(ground_spring, other.ground_spring);
    ground_damper = std::max(ground_damper, other.ground_damper);
    lift = std::max(lift, other.lift);
  }
};

// How a disc's lowest point moves with the coordinates.
template <int N>
struct DiscAt {
  Coordinates<N> slip, rise;    // d(slip velocity)/dq', d(y')/dq'
  double slip_bias, rise_bias;  // of the accelerations, from the rates [m/s^2]
};

// A body in its pose, with its discs on the ground: what several forces of one look go by.
template <int N, int D>
struct BodyOnGround : Body<N> {
  using Body<N>::Body;

  std::array<double, D> depth;       // of the discs that are there [m]
  std::array<DiscAt<N>, D> contact;  // of those that touch, depth not up to 0
};

// They are of a body with room for N links (body.h), on feet with room for D discs.
template <int N, int D>
class FrictionContacts {
 public:
  using Pose = BodyOnGround<N, D>;
  static constexpr int trolley = N, lift = trolley + 1, first_disc = lift + 1;
  static constexpr int count = first_disc + D;
  using Forces = std::array<double, count>;  // [N m] of the joints, [N] of the others
  using Normals = std::array<double, D>;

  // The way from the body to a foot: its links, and how far along each the next one hangs, of the
  // last one its end  [m].
  struct Path {
    std::size_t count = 0;
    std::size_t first = 0;  // in it: the leg's first link
    bool whole = false;     // all links, in their order
    std::array<std::size_t, N> link{};
    std::array<double, N> reach{};
    double start = 0;  // of the first link, ahead of the body's origin [m]
  };

  // Takes the robot's feet and friction; the body outlives it.
  FrictionContacts(const BodyConstants<N>& body, const robot::Robot& robot);

  // How many discs and feet there are.
  int discs() const { return disc_count_; }
  std::size_t feet() const { return foot_count_; }
  // By leg, also of one whose foot is not present.
  const Path& leg(std::size_t foot) const { return path_[foot]; }
  std::size_t foot_of(int disc) const { return disc_[static_cast<std::size_t>(disc)].foot; }
  double friction(std::size_t disc) const { return disc_[disc].friction; }  // Coulomb [-]

  // The fastest rates at which the machine is brought to rest in a pose  [1/s].
  FastestRates fastest_rates(const Body<N>& body, const BodyState<N>& motion,
                             const robot::Robot& robot) const;
  DiscAt<N> disc(const Body<N>& body, const BodyState<N>& motion, int i) const;

  // How deep a disc is in the ground; above 0 where they touch  [m].
  double depth(const Body<N>& body, const BodyState<N>& motion, int i) const;

  // Compliant force of the ground on a disc that is so deep in it, never pulling  [N].
  double push(double depth, const DiscAt<N>& disc, const BodyState<N>& motion) const;

  // Is a disc on the ground?
  bool touches(const Pose& pose) const;

  // Can a disc come to the ground or leave it within h, by the rates of all that carries it?
  bool can_change(const Pose& pose, const BodyState<N>& motion, double h) const;

  // Puts the discs of a pose where they are.
  void place(const BodyState<N>& motion, Pose& pose) const;

  // J^T f.
  Coordinates<N> generalised(const Pose& pose, const BodyState<N>& motion, const Forces& f) const;

  // Relaxes the ground's damper in steps longer than this  [s].
  void relax_beyond(double step) { longest_explicit_ = step; }
  static constexpr double stable_relaxed = 7.65, stable_explicit = 2.785;  // rate times step

  // Relaxes accelerations in a step of length h by those before, with g = share; only discs that
  // are pushed at the node and here.
  void relax(double h, double share, const Normals& pushed, const Coordinates<N>& before,
             Coordinates<N>& a) const {
    if (h > longest_explicit_ && touching_count_ > 0) relax_touching(share * h, pushed, before, a);
  }

  // At a node: accelerations without friction, bounds, and the ground's forces on the discs.
  void prepare(const Pose& pose, const BodyState<N>& motion, const Coordinates<N>& acceleration,
               const Forces& bound, const Normals& normal);

  // Dry friction of a step of length h; `last` is the last step's.
  Forces hold(double h, const Forces& last) const;

  // Accelerations under the friction f, given those without any.
  Coordinates<N> accelerations(Coordinates<N> without, const Forces& f) const;

  // Returns the bound of a contact's dry friction, as it was found last.
  double bound(int c) const { return bound_[static_cast<std::size_t>(c)]; }

 private:
  using Matrix = std::array<Normals, D>;

  // J of a joint, of the trolley or of the lift, as a row.
  Coordinates<N> row(int c) const;
  // The product of contact c's row with rates or accelerations.
  double along(int c, const Coordinates<N>& row, const Coordinates<N>& v) const;
  // Count is a number, or a constant of a type of its own.
  template <class Count>
  Forces hold_of(double h, const Forces& last, Count active) const;
  template <class Count>
  void soften(double h, Count active, FrictionProblem<count>& problem) const;
  void relax_touching(double time, const Normals& pushed, const Coordinates<N>& before,
                      Coordinates<N>& a) const;
  void eliminate(Matrix& m) const;
  void solve(const Matrix& m, Normals& b) const;  // of an eliminated one

  struct Disc {
    std::size_t foot = 0;
    double along = 0, across = 0, radius = 0;  // of its leg's last link [m]
    double friction = 0;                       // [-]
    double surface = 0;                        // of the ground [m]
  };
  // From each link of a path to the next, or to a disc, and how high its last link hangs  [m].
  struct Levers {
    std::array<double, N> x, y;
    double height;
  };
  void add_foot(const robot::Robot& robot, std::size_t leg);
  Levers levers(const Body<N>& body, const BodyState<N>& motion, const Path& path) const;
  double reach(const Body<N>& body, const Disc& d, Levers& way) const;
  DiscAt<N> disc_at(const Levers& way, const Disc& d, const BodyState<N>& motion) const;

  BodyConstants<N> k_;
  robot::Ground ground_;
  std::array<Path, robot::max_legs> path_{};
  std::size_t foot_count_ = 0;
  std::array<Disc, D> disc_{};
  int disc_count_ = 0;
  double longest_explicit_ = std::numeric_limits<double>::infinity();  // [s]

  // The contacts that can carry something at the node stand here one after the other: only these
  // are solved.
  int active_count_ = 0;
  std::array<int, count> active_{};             // their numbers
  std::array<Coordinates<N>, count> column_{};  // M^-1 J^T
  FrictionProblem<count> problem_{};            // slips at the node, responses per second
  Forces slip_rate_{};                          // of the slips, without friction
  Forces bound_{};                              // of every contact

  // Likewise the discs that touch the ground at the node.
  std::size_t touching_count_ = 0;
  std::array<int, D> touching_{};                             // their numbers
  Normals normal_{};                                          // of the ground on them [N]
  Normals rise_{}, rise_rate_{};                              // without friction
  std::array<Coordinates<N>, D> rise_row_{}, rise_column_{};  // J, M^-1 J^T
  Matrix response_{};                                         // R
  std::array<Forces, D> along_{};                             // A, of the active contacts
};

}  // namespace sinew::plant
