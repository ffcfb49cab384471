// plant/planar/body.h - a planar tree of up to eight links under a trolley that slides and a body
// that a cylinder moves up and down: the equations of chain.h with one coordinate more, as a dense
// system.
//
//   q = (x, y, phi_1 ... phi_N)      trolley, lift, absolute link angles
//
//   M x'' - sum_i c_i sin(phi_i) phi_i''                    = F_x + sum_i c_i cos(phi_i) phi_i'^2
//   L y'' + sum_i c_i cos(phi_i) phi_i'' = F_y - L g              + sum_i c_i sin(phi_i) phi_i'^2
//   -c_i sin(phi_i) x'' + c_i cos(phi_i) y'' + sum_j A_ij cos(phi_i - phi_j) phi_j''
//                         = Q_i - g c_i cos(phi_i) - sum_j A_ij sin(phi_i - phi_j) phi_j'^2
//
//   c_i   first moment of link i and all that hangs on it, about its joint           [kg m]
//   A_ij  d_ij c_j where j hangs on i, d_ij along i up to where the way to j leaves it; 0 where
//         neither hangs on the other: branches meet at the body alone  [kg m^2]
//   A_ii  moment of inertia of link i about its joint, with what hangs on it as points [kg m^2]
//   M     all that slides [kg]    L  all that lifts [kg]
//
// A chain is the tree whose links hang at each other's ends, with the same bits. A coordinate that
// is held (no trolley, locked cylinder) keeps its place with the acceleration 0.
#pragma once

#include <array>

#include "sinew/robot/robot.h"

namespace sinew::plant {

inline constexpr int most_links = robot::max_joints;
inline constexpr int most_coordinates = most_links + 2;

// One number per coordinate: x, y, then the links.
using Coordinates = std::array<double, most_coordinates>;
enum Coordinate : std::size_t { along_track, up, first_link };

struct BodyConstants {
  std::size_t links = 0;
  std::array<int, most_links> parent{};         // the link that it hangs on; -1: the body
  std::array<double, most_links> attachment{};  // along the parent, or ahead of the origin [m]
  std::array<double, most_links> length{}, first_moment{};  // l [m], c [kg m]
  std::array<double, most_links> hanging{};  // mass of the link and all that hangs on it [kg]
  std::array<std::array<double, most_links>, most_links> inertia{};  // A [kg m^2]
  double sliding_mass = 0, lifted_mass = 0;                          // M, L [kg]
  double gravity = 9.80665;                                          // [m/s^2]
  std::array<bool, 2> held{};                                        // of x, y

  std::size_t coordinates() const { return first_link + links; }
  // Position of the parent among the links, for links that have one.
  std::size_t on(std::size_t link) const { return static_cast<std::size_t>(parent[link]); }
  bool hangs_on_link(std::size_t link) const { return parent[link] >= 0; }
  // The link on the body that this one hangs on in the end, or is.
  std::size_t first_on(std::size_t link) const {
    while (hangs_on_link(link)) link = on(link);
    return link;
  }
};

// Parents come before their children (robot::contradictions).
BodyConstants body_of(const robot::Robot& robot);

// Mass at the end of each link: of the feet that are there  [kg].
std::array<double, most_links> end_masses(const robot::Robot& robot);

struct Motion {
  Coordinates at{}, rate{};
};

// What of the equations depends on the pose: evaluated once, used for several right-hand sides.
class Body {
 public:
  Body(const BodyConstants& constants, const Motion& motion);

  double sin(std::size_t link) const { return sin_[link]; }
  double cos(std::size_t link) const { return cos_[link]; }

  // Under the given forces, gravity and the velocities' own terms.
  Coordinates accelerations(Coordinates force) const;

  // What the forces alone cause: the inverse mass matrix times `force`.
  Coordinates response(const Coordinates& force) const;

 private:
  void factor();

  const BodyConstants& k_;
  const Motion& motion_;
  // Set for the coordinates that are there, no others.
  std::array<double, most_links> sin_, cos_;
  std::array<Coordinates, most_coordinates> lower_;
  Coordinates pivot_, inverse_pivot_;
};

// Kinetic plus potential energy [J], zero potential at the origin.
double energy(const BodyConstants& k, const Motion& motion);

// Momentum of all that moves, along the track and upwards [N s].
std::array<double, 2> momentum(const BodyConstants& k, const Motion& motion);

}  // namespace sinew::plant
