// identify/joint/hinge.h - path of a muscle's tendon over a joint: its moment arm and the muscle's
// shortening over the joint's angle q (Delta theta) from rest, positive where it shortens.
//
//   round   r(q) = r                          DL(q) = r q
//   hinge   r(q) = l_a l_d sin(theta_h)/l_D   DL(q) = l_D(q = 0) - l_D,  theta_h = theta_h0 - q
//           l_D^2 = l_a^2 + l_d^2 - 2 l_a l_d cos(theta_h)
//
//   r   moment arm [m]               l_a, l_d  from the joint to both ends of the muscle [m]
//   DL  shortening [m], DL' = r      theta_h   angle between them, seen from the joint [rad]
//
// A hinge is described by r = r(0), theta_h0 and l_a sin(theta_h0)/r, which is above 1; l_d
// follows.
#pragma once

#include <cmath>

namespace sinew::identify {

// Path of a muscle over a joint: round a cam, or straight between two points.
class Hinge {
 public:
  // Returns a cam with this radius [m].
  static Hinge round(double arm) { return Hinge(arm, 0, 0, 0); }

  // `ratio` is l_a sin(angle)/arm, above 1; 0 < angle < pi.
  static Hinge points(double arm, double ratio, double angle) {
    const double s = std::sin(angle), origin = ratio * arm / s;
    const double insertion =
        origin * (std::sqrt(ratio * ratio - s * s) - std::cos(angle)) / (ratio * ratio - 1);
    return Hinge(arm, origin, insertion, angle);
  }

  // Returns the moment arm at this angle from rest [m].
  double arm(double q) const {
    if (origin_ == 0) return arm_;
    const double phi = angle_ - q;
    return origin_ * insertion_ * std::sin(phi) / distance(phi);
  }

  // Returns the shortening at this angle relative to rest [m].
  double shortening(double q) const {
    return origin_ == 0 ? arm_ * q : distance(angle_) - distance(angle_ - q);
  }

  double origin() const { return origin_; }        // l_a [m]
  double insertion() const { return insertion_; }  // l_d [m]

 private:
  Hinge(double arm, double origin, double insertion, double angle)
      : arm_(arm), origin_(origin), insertion_(insertion), angle_(angle) {}

  double distance(double phi) const {
    return std::sqrt(origin_ * origin_ + insertion_ * insertion_ -
                     2 * origin_ * insertion_ * std::cos(phi));
  }

  double arm_, origin_, insertion_, angle_;
};

}  // namespace sinew::identify
