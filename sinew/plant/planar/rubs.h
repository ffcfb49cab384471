// plant/planar/rubs.h - where a machine of any shape touches and rubs: joints, trolley, lift and
// the discs of its foot. contacts.h with a list of discs in place of one and a coordinate more.
//
// A disc's centre stands at (along, across) of the last link; its lowest point slips and is pushed.
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
#include "sinew/robot/robot.h"

namespace sinew::plant {

inline constexpr int most_discs = 4;

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

  Rubs(const BodyConstants& body, const robot::Robot& robot);

  int discs() const { return disc_count_; }

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

  BodyConstants k_;
  robot::Foot foot_;
  robot::Ground ground_;
  std::array<robot::Foot::Point, most_discs> disc_;
  int disc_count_ = 0;
  double surface_ = 0;  // of the ground [m]

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
