// plant/planar/rubs.h - where a machine of any shape touches and rubs: joints, trolley, lift and
// the discs of its feet. contacts.h with a list of discs in place of one and a coordinate more.
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
#pragma once

#include <array>

#include "sinew/plant/planar/body.h"
#include "sinew/plant/planar/friction.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"

namespace sinew::plant {

inline constexpr int most_discs = robot::max_discs;

// Where a disc is and how its lowest point moves with the coordinates.
struct DiscAt {
  double x = 0, y = 0;                  // of its centre, from the origin of the trolley [m]
  Coordinates slip{}, rise{};           // d(slip velocity)/dq', d(y')/dq'
  double slip_bias = 0, rise_bias = 0;  // of the accelerations, from the rates [m/s^2]
};

class Rubs {
 public:
  static constexpr int trolley = most_links, lift = trolley + 1, first_disc = lift + 1;
  static constexpr int count = first_disc + most_discs;
  using Forces = std::array<double, count>;  // [N m] of the joints, [N] of the others
  using Normals = std::array<double, most_discs>;

  // The way from the body to a foot: its links, and how far along each the next one hangs, of the
  // last one its end  [m].
  struct Path {
    std::size_t count = 0;
    std::size_t first = 0;  // in it: the leg's first link
    std::array<std::size_t, most_links> link{};
    std::array<double, most_links> reach{};
    double start = 0;  // of the first link, ahead of the body's origin [m]
  };

  Rubs(const BodyConstants& body, const robot::Robot& robot);

  int discs() const { return disc_count_; }
  std::size_t feet() const { return foot_count_; }
  // By leg, also of one whose foot is not present.
  const Path& leg(std::size_t foot) const { return path_[foot]; }
  std::size_t foot_of(int disc) const { return disc_[static_cast<std::size_t>(disc)].foot; }
  double friction(std::size_t disc) const { return disc_[disc].friction; }  // Coulomb [-]

  // The fastest rate at which springs, dampers and the ground bring the machine to rest  [1/s], by
  // joint: c w and sqrt(k w) with w, the joint's or disc's acceleration per force.
  double stiffest_rate(const Body& body, const Motion& motion, const robot::Robot& robot) const;
  DiscAt disc(const Body& body, const Motion& motion, int i) const;

  // Compliant force of the ground on a disc, never pulling  [N].
  double push(const DiscAt& disc, int i, const Motion& motion) const;

  // J^T f.
  Coordinates generalised(const Body& body, const Motion& motion, const Forces& f) const;

  // At a node: accelerations without friction, bounds, and the ground's forces on the discs.
  void prepare(const Body& body, const Motion& motion, const Coordinates& acceleration,
               const Forces& bound, const Normals& normal);

  // Dry friction of a step of length h; `last` is the last step's.
  Forces hold(double h, const Forces& last) const;

  // Accelerations under the friction f, given those without any.
  Coordinates accelerations(Coordinates without, const Forces& f) const;

  double bound(int c) const { return bound_[static_cast<std::size_t>(c)]; }

 private:
  using Matrix = std::array<Normals, most_discs>;

  // J of contact c, as a row.
  Coordinates row(int c, const std::array<DiscAt, most_discs>& discs) const;
  void soften(double h, FrictionProblem<count>& problem) const;
  Normals solve(Matrix m, Normals b) const;

  struct Disc {
    std::size_t foot = 0;
    double along = 0, across = 0, radius = 0;  // of its leg's last link [m]
    double friction = 0;                       // [-]
    double surface = 0;                        // of the ground [m]
  };
  void add_foot(const robot::Robot& robot, std::size_t leg);
  std::size_t discs_there() const { return static_cast<std::size_t>(disc_count_); }

  BodyConstants k_;
  robot::Ground ground_;
  std::array<Path, robot::max_legs> path_{};
  std::size_t foot_count_ = 0;
  std::array<Disc, most_discs> disc_{};
  int disc_count_ = 0;

  // The contacts that can carry something at the node stand here one after the other: only these
  // are solved.
  int active_count_ = 0;
  std::array<int, count> active_{};          // their numbers
  std::array<Coordinates, count> column_{};  // M^-1 J^T
  FrictionProblem<count> problem_{};         // slips at the node, responses per second
  Forces slip_rate_{};                       // of the slips, without friction
  Forces bound_{};                           // of every contact
  Normals normal_{};                         // at the node; 0: no contact [N]
  Normals rise_{}, rise_rate_{};             // of the discs, without friction
  Matrix response_{};                        // R
  std::array<Forces, most_discs> along_{};   // A, of the active contacts
};

}  // namespace sinew::plant
