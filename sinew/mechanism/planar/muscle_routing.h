// mechanism/planar/muscle_routing.h - muscles over cams of any shape, across one joint or two.
//
//   L = L_m - sum_j s_j S_j(theta_j),     S_j = integral of r_j from the rest angle to theta_j
//   tau_j = s_j r_j(theta_j) F            the same r: virtual work
//
//   r_j  radius of the cam at joint j [m]: constant, or linear between the points of a table and
//        constant beyond them, so that S is exact: parabolas and straight lines
//   s_j  +1 if tension raises the angle
#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/robot/robot.h"

namespace sinew::plant {

// Radius of a cam, and the tendon length wound on it.
class CamLaw {
 public:
  CamLaw() = default;
  // Takes the cam; a round one without a radius uses the joint's.
  CamLaw(const robot::Cam& cam, const robot::Joint& joint);

  // Returns the radius at this angle of the joint [m].
  double radius(double angle) const noexcept {  // [m]
    return round_ ? first_radius_ : radius_of_table(angle);
  }
  // Returns S [m]; for a round cam it is exactly r (theta - rest), as for a chain.
  double travel(double angle) const noexcept {
    return round_ ? first_radius_ * (angle - rest_) : area(angle) - area_at_rest_;
  }

  // Returns whether the radius is the same at every angle.
  bool round() const noexcept { return round_; }
  double rest() const noexcept { return rest_; }  // angle at which S is 0 [rad]
  double largest_radius() const noexcept;         // [m]

 private:
  double radius_of_table(double angle) const noexcept;
  double area(double angle) const noexcept;  // integral of r from the first point [m]

  bool round_ = true;                          // its table has one point
  std::vector<double> angle_, radius_, area_;  // ascending
  double first_radius_ = 0, rest_ = 0, area_at_rest_ = 0;
};

class MuscleRouting {
 public:
  static constexpr int most = 2;  // joints of a muscle

  // s_k r_k of every muscle at the present pose, for at most M muscles.
  template <int M>
  using MomentArms = std::array<std::array<double, most>, M>;

  // Takes the cams of all muscles.
  explicit MuscleRouting(const robot::Robot& robot);

  // Returns the number of muscles.
  int count() const { return static_cast<int>(routes_.size()); }

  // Returns the k-th joint of muscle i; -1: no second joint.
  int joint(int i, int k) const { return routes_[static_cast<std::size_t>(i)].joint[k]; }

  // Visits every muscle i at each joint j that it crosses, with its moment arm there.
  template <class Arms, class Visit>
  void each(const Arms& arms, const Visit& visit) const noexcept;

  // Computes lengths, rates and moment arms from the joints' angles [rad] and rates [rad/s]. Lanes
  // beyond the last muscle repeat it.
  template <int M>
  void at(const double* angle, const double* rate, air::Lanes<M>& length,
          air::Lanes<M>& length_rate, std::type_identity_t<MomentArms<M>>& arms) const noexcept;

 private:
  struct Route {
    double mount = 0;
    std::array<int, most> joint{-1, -1};
    std::array<double, most> sign{};
    std::array<CamLaw, most> cam;
  };
  // Four muscles over one round cam each: L = mount - arm (theta - rest).
  struct RoundRoutes {
    air::Four mount, arm, rest;
    std::array<std::size_t, air::lanes> joint;
  };
  void group_round_cams();

  std::vector<Route> routes_;
  std::vector<RoundRoutes> round_;  // all muscles, if all cross one round cam; else empty
};

template <class Arms, class Visit>
void MuscleRouting::each(const Arms& arms, const Visit& visit) const noexcept {
  for (std::size_t i = 0; i < routes_.size() && !round_.empty(); ++i)
    visit(static_cast<int>(i), round_[i / air::lanes].joint[i % air::lanes], arms[i][0]);
  if (!round_.empty()) return;
  for (std::size_t i = 0; i < routes_.size(); ++i)
    for (std::size_t k = 0; k < most; ++k)
      if (const int j = routes_[i].joint[k]; j >= 0)
        visit(static_cast<int>(i), static_cast<std::size_t>(j), arms[i][k]);
}

template <int M>
void MuscleRouting::at(const double* angle, const double* rate, air::Lanes<M>& length,
                       air::Lanes<M>& length_rate,
                       std::type_identity_t<MomentArms<M>>& arms) const noexcept {
  // In whole lanes from the start: a wide load after narrow stores would stall.
  for (std::size_t k = 0; k < round_.size(); ++k) {
    const RoundRoutes& r = round_[k];
    const auto& j = r.joint;
    const air::Four theta = {angle[j[0]], angle[j[1]], angle[j[2]], angle[j[3]]};
    const air::Four turn = {rate[j[0]], rate[j[1]], rate[j[2]], rate[j[3]]};
    const int first = static_cast<int>(k) * air::lanes;
    length.four(first) = r.mount - r.arm * (theta - r.rest);
    length_rate.four(first) = -(r.arm * turn);
  }
  if (!round_.empty()) {
    for (std::size_t i = 0; i < routes_.size(); ++i)
      arms[i] = {round_[i / air::lanes].arm[i % air::lanes], 0.0};
    return;
  }
  for (int i = 0; i < count(); ++i) {
    const Route& route = routes_[static_cast<std::size_t>(i)];
    double l = route.mount, v = 0;
    for (std::size_t k = 0; k < most; ++k) {
      double& p = arms[static_cast<std::size_t>(i)][k];
      p = 0;
      const int j = route.joint[k];
      if (j < 0) continue;
      p = route.sign[k] * route.cam[k].radius(angle[j]);
      l -= route.sign[k] * route.cam[k].travel(angle[j]);
      v -= p * rate[j];
    }
    length[i] = l;
    length_rate[i] = v;
  }
  for (int i = count(); i % air::lanes != 0; ++i) {
    length[i] = length[count() - 1];
    length_rate[i] = length_rate[count() - 1];
  }
}

// Returns the damping that the viscous losses of the muscles add to each joint, c r^2 at the
// largest radius, for the choice of the step [N m s/rad]. Their ends are not in it.
std::vector<double> muscle_damping(const Setup& setup);

// Loads of the trolley's two rollers, 4.2 and 7.2.
//
//   N_f + N_r = m_t g + R_y
//   N_f x_f + N_r x_r = g (m_c x_c + m_w x_w) - m_t h_c x'' + h D - y R_x + T,   D = m_t x'' + R_x
//
//   R   force of the trolley on body, links and foot below it, at the first joint [N]
//   T   torque of the trolley on the first link [N m]           D  of the track on the trolley [N]
//   m_t = m_c + m_w   trolley with payload; counterweight [kg]  h, h_c  of track and mass centre
//   y   height of the first joint above the origin [m]          x  ahead of the first joint [m]
//
// Rollers rest on the track: a negative load means that the roller has lifted off and the trolley
// would tip. The simulation nevertheless moves it along the track.

// Motion of the trolley, and the reaction of everything that hangs from it.
struct TrolleyReaction {
  double acceleration = 0;          // trolley's acceleration [m/s^2]
  double force_x = 0, force_y = 0;  // R [N]
  double torque = 0;                // T [N m]
  double lift = 0;                  // y [m]

  // Adds a link's share of the rate of momentum: first moment c [kg m], sine, cosine, rate,
  // acceleration.
  void add(double c, double sine, double cosine, double rate, double turn) {
    force_x -= c * (sine * turn + cosine * rate * rate);
    force_y += c * (cosine * turn - sine * rate * rate);
  }
};

struct RollerLoads {
  double front = 0, rear = 0;  // [N], up > 0
};

// The trolley's rollers, with the mass that they carry directly.
struct RollerModel {
  robot::Rollers rollers;
  double own_mass = 0, gravity = 0;  // trolley with its payload [kg], [m/s^2]

  RollerModel() = default;
  // Takes the rollers of a robot.
  explicit RollerModel(const robot::Robot& robot)
      : rollers(robot.rollers),
        own_mass(robot::trolley_own_mass(robot) + robot.trolley.payload),
        gravity(robot.gravity) {}
};

// Returns the loads of both rollers.
inline RollerLoads roller_loads(const RollerModel& model, const TrolleyReaction& reaction) {
  const robot::Rollers& r = model.rollers;
  const double own = model.own_mass;
  const double g = model.gravity, carriage = own - r.counterweight;
  const double track = own * reaction.acceleration + reaction.force_x;

  const double sum = own * g + reaction.force_y;
  const double moment = g * (carriage * r.center_of_mass + r.counterweight * r.counterweight_at) -
                        own * r.center_of_mass_up * reaction.acceleration + r.height * track -
                        reaction.lift * reaction.force_x + reaction.torque;
  const double front = (moment - r.rear * sum) / (r.front - r.rear);
  return {front, sum - front};
}

}  // namespace sinew::plant
