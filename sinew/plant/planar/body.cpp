#include "sinew/plant/planar/body.h"

#include <algorithm>

#include "sinew/robot/legs.h"
#include "sinew/units/math.h"

namespace sinew::plant {

std::array<double, most_links> end_masses(const robot::Robot& robot) {
  std::array<double, most_links> out{};
  for (std::size_t leg = 0; leg < std::max<std::size_t>(1, robot.legs.size()); ++leg) {
    const int link = robot::foot_link(robot, leg);
    const robot::Foot& foot = robot::foot_of(robot, leg);
    if (foot.present && link >= 0) out[static_cast<std::size_t>(link)] += foot.mass;
  }
  return out;
}

BodyConstants body_of(const robot::Robot& robot) {
  BodyConstants k;
  k.links = robot.links.size();
  k.gravity = robot.gravity;
  k.hanging = end_masses(robot);
  for (std::size_t i = 0; i < k.links; ++i) {
    const robot::Link& link = robot.links[i];
    const double l = link.length, r = link.center_of_mass;
    k.parent[i] = robot::parent_of(robot, i);
    k.attachment[i] = robot::attachment_of(robot, i);
    k.length[i] = l;
    k.first_moment[i] = link.mass * r + l * k.hanging[i];
    k.inertia[i][i] = link.inertia + link.mass * r * r + l * l * k.hanging[i];
  }
  // From the tips inwards: all that hangs on a link is there before it hangs on another.
  for (std::size_t i = k.links; i-- > 0;) {
    k.hanging[i] += robot.links[i].mass;
    if (!k.hangs_on_link(i)) continue;
    const std::size_t p = k.on(i);
    const double at = k.attachment[i];
    k.first_moment[p] += at * k.hanging[i];
    k.inertia[p][p] += at * at * k.hanging[i];
    k.hanging[p] += k.hanging[i];
  }
  // Each link against all that it hangs on, up to the body.
  for (std::size_t j = 0; j < k.links; ++j)
    for (std::size_t child = j; k.hangs_on_link(child); child = k.on(child)) {
      const std::size_t i = k.on(child);
      k.inertia[i][j] = k.inertia[j][i] = k.attachment[child] * k.first_moment[j];
    }

  const bool lifts = robot.cylinder.present && robot.cylinder.mode != robot::Cylinder::Mode::locked;
  k.held = {!robot.trolley.present, !lifts};
  k.sliding_mass = robot.trolley.moving_mass();
  k.lifted_mass = robot::leg_mass(robot) + robot.cylinder.body_mass;
  return k;
}

Body::Body(const BodyConstants& constants, const Motion& motion) : k_(constants), motion_(motion) {
  for (std::size_t i = 0; i < k_.links; ++i) {
    const units::SinCos sc = units::sin_cos(motion.at[first_link + i]);
    sin_[i] = sc.sin;
    cos_[i] = sc.cos;
  }
  factor();
}

// LDL^T of the mass matrix; a held coordinate has the row of a unit matrix.
void Body::factor() {
  const std::size_t n = k_.coordinates();
  std::array<Coordinates, most_coordinates> m;
  m[along_track][along_track] = k_.held[0] ? 1.0 : k_.sliding_mass;
  m[up][along_track] = 0;
  m[up][up] = k_.held[1] ? 1.0 : k_.lifted_mass;
  for (std::size_t i = 0; i < k_.links; ++i) {
    const std::size_t row = first_link + i;
    m[row][along_track] = k_.held[0] ? 0.0 : -k_.first_moment[i] * sin_[i];
    m[row][up] = k_.held[1] ? 0.0 : k_.first_moment[i] * cos_[i];
    for (std::size_t j = 0; j < i; ++j)
      m[row][first_link + j] = k_.inertia[i][j] * (cos_[i] * cos_[j] + sin_[i] * sin_[j]);
    m[row][row] = k_.inertia[i][i];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double a = m[i][j];
      for (std::size_t k = 0; k < j; ++k) a -= lower_[i][k] * lower_[j][k] * pivot_[k];
      if (i == j) {
        pivot_[i] = a;
        inverse_pivot_[i] = 1.0 / a;
      } else {
        lower_[i][j] = a * inverse_pivot_[j];
      }
    }
}

Coordinates Body::response(const Coordinates& force) const {
  const std::size_t n = k_.coordinates();
  Coordinates a = force;
  if (k_.held[0]) a[along_track] = 0;
  if (k_.held[1]) a[up] = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) a[i] -= lower_[i][j] * a[j];
  for (std::size_t i = n; i-- > 0;) {
    a[i] *= inverse_pivot_[i];
    for (std::size_t j = i + 1; j < n; ++j) a[i] -= lower_[j][i] * a[j];
  }
  return a;
}

Coordinates Body::accelerations(Coordinates force) const {
  force[up] -= k_.lifted_mass * k_.gravity;
  for (std::size_t i = 0; i < k_.links; ++i) {
    const double rate = motion_.rate[first_link + i], rate2 = rate * rate;
    force[along_track] += k_.first_moment[i] * cos_[i] * rate2;
    force[up] += k_.first_moment[i] * sin_[i] * rate2;
    double& q = force[first_link + i];
    q -= k_.gravity * k_.first_moment[i] * cos_[i];
    for (std::size_t j = 0; j < k_.links; ++j) {
      if (j == i) continue;
      const double other = motion_.rate[first_link + j];
      q -= k_.inertia[i][j] * (sin_[i] * cos_[j] - cos_[i] * sin_[j]) * (other * other);
    }
  }
  return response(force);
}

double energy(const BodyConstants& k, const Motion& motion) {
  const double x = motion.rate[along_track], y = motion.rate[up];
  double e = 0.5 * k.sliding_mass * x * x + 0.5 * k.lifted_mass * y * y +
             k.lifted_mass * k.gravity * motion.at[up];
  for (std::size_t i = 0; i < k.links; ++i) {
    const units::SinCos a = units::sin_cos(motion.at[first_link + i]);
    const double rate = motion.rate[first_link + i];
    e += k.first_moment[i] * (k.gravity * a.sin + rate * (y * a.cos - x * a.sin));
    for (std::size_t j = 0; j < k.links; ++j) {
      const units::SinCos b = units::sin_cos(motion.at[first_link + j]);
      e += 0.5 * k.inertia[i][j] * (a.cos * b.cos + a.sin * b.sin) * rate *
           motion.rate[first_link + j];
    }
  }
  return e;
}

std::array<double, 2> momentum(const BodyConstants& k, const Motion& motion) {
  std::array<double, 2> p{k.sliding_mass * motion.rate[along_track],
                          k.lifted_mass * motion.rate[up]};
  for (std::size_t i = 0; i < k.links; ++i) {
    const units::SinCos a = units::sin_cos(motion.at[first_link + i]);
    const double m = k.first_moment[i] * motion.rate[first_link + i];
    p[0] -= m * a.sin;
    p[1] += m * a.cos;
  }
  return p;
}

}  // namespace sinew::plant
