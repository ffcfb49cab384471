#include "sinew/robot/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::robot {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

// Tolerance by which a target on the edge of the reach counts as reachable [-].
constexpr double edge = 1e-12;

// Returns +1 if the muscle flexes its joint, -1 if it extends it.
double sign_of(Muscle::Role role) { return role == Muscle::Role::flexor ? 1.0 : -1.0; }

// Returns the target moved along its own ray to distance d; straight down if it has no direction.
Point on_ray(Point target, double distance, double d) {
  if (distance == 0) return {0, -d};
  return {target.x / distance * d, target.y / distance * d};
}

// Returns the angles for a reachable target.
std::array<double, 2> solve(const TwoLinks& leg, Point p, Knee knee) {
  const double d = std::hypot(p.x, p.y);
  const double straight = (leg.l1 + leg.l2 - d) * (leg.l1 + leg.l2 + d);
  const double folded = (d - leg.l1 + leg.l2) * (d + leg.l1 - leg.l2);
  const double half =
      std::atan2(std::sqrt(std::max(straight, 0.0)), std::sqrt(std::max(folded, 0.0)));

  const double theta2 = knee == Knee::below_pi ? 2.0 * half : -2.0 * half;
  const double theta1 = std::atan2(p.y, p.x) -
                        std::atan2(leg.l2 * std::sin(theta2), leg.l1 + leg.l2 * std::cos(theta2));
  return {normalised(theta1), normalised(theta2)};
}

}  // namespace

bool is_leg(const Robot& robot) {
  const std::size_t n = robot.joints.size();
  if (robot.links.size() < 2 || n != robot.links.size()) return false;
  if (!robot.legs.empty() || parent_of(robot, 1) != 0) return false;
  for (std::size_t j = 0; j < n; ++j)
    if ((robot.joints[j].kind == Joint::Kind::passive) != (j >= 2)) return false;
  return true;
}

TwoLinks two_links(const Robot& robot) {
  return {attachment_of(robot, 1), robot.links.at(1).length};
}

double normalised(double angle) {
  const double rest = std::fmod(angle, turn);
  const double positive = rest < 0 ? rest + turn : rest;
  return positive >= turn ? 0.0 : positive;  // -1e-17 + 2 pi is 2 pi; NaN stays NaN
}

Pose forward(std::span<const double> lengths, std::span<const double> angles) {
  Pose pose;
  const std::size_t n =
      std::min({lengths.size(), angles.size(), static_cast<std::size_t>(max_joints)});
  pose.links = static_cast<int>(n);

  double heading = 0;
  for (std::size_t i = 0; i < n; ++i) {
    heading += angles[i];
    pose.joint[i + 1] = {pose.joint[i].x + lengths[i] * std::cos(heading),
                         pose.joint[i].y + lengths[i] * std::sin(heading)};
  }
  return pose;
}

Pose forward(const Robot& robot, std::span<const double> angles) {
  std::array<double, max_joints> lengths{};
  const std::size_t n = std::min(robot.links.size(), lengths.size());
  for (std::size_t i = 0; i < n; ++i)
    lengths[i] = i + 1 < n ? attachment_of(robot, i + 1) : robot.links[i].length;
  return forward(std::span(lengths).first(n), angles);
}

std::vector<LinkPlace> places(const Robot& robot, std::span<const double> angles) {
  std::vector<LinkPlace> out;
  for (std::size_t i = 0; i < robot.links.size() && i < angles.size(); ++i) {
    const int parent = parent_of(robot, i);
    const double at = attachment_of(robot, i);
    LinkPlace place{.joint = {at, 0}, .heading = angles[i]};
    if (parent >= 0) {
      const LinkPlace& on = out[static_cast<std::size_t>(parent)];
      place.heading += on.heading;
      place.joint = {on.joint.x + at * std::cos(on.heading),
                     on.joint.y + at * std::sin(on.heading)};
    }
    out.push_back(place);
  }
  return out;
}

Point foot_position(const TwoLinks& leg, double theta1, double theta2) {
  return {leg.l1 * std::cos(theta1) + leg.l2 * std::cos(theta1 + theta2),   // [61]
          leg.l1 * std::sin(theta1) + leg.l2 * std::sin(theta1 + theta2)};  // [62]
}

Inverse inverse(const TwoLinks& leg, Point target, Knee knee) {
  Inverse out;
  out.longest = leg.l1 + leg.l2;
  out.shortest = std::abs(leg.l1 - leg.l2);
  out.distance = std::hypot(target.x, target.y);
  if (!std::isfinite(target.x) || !std::isfinite(target.y)) {
    out.status = Inverse::Status::not_a_number;
    return out;
  }

  out.nearest = target;
  const double slack = edge * out.longest;
  if (out.distance > out.longest + slack) out.status = Inverse::Status::too_far;
  if (out.distance < out.shortest - slack) out.status = Inverse::Status::too_near;
  if (!out.reached())
    out.nearest = on_ray(target, out.distance,
                         out.status == Inverse::Status::too_far ? out.longest : out.shortest);
  out.angle = solve(leg, out.nearest, knee);
  return out;
}

std::array<double, 2> inverse_as_printed(const TwoLinks& leg, Point p) {
  const double l1 = leg.l1, l2 = leg.l2;
  const double square = p.x * p.x + p.y * p.y;
  const double theta2 = -std::acos((square - l1 * l1 - l2 * l2) / (2.0 * l1 * l2));  // [63]

  const double along = l1 + l2 * std::cos(theta2);
  const double reach = std::sqrt(l1 * l1 + l2 * l2 + 2.0 * l1 * l2 * std::cos(theta2));
  const double tilt = std::acos(p.y / reach);
  const double side = p.x < 0 ? 1.0 : -1.0;
  const double theta1 = std::atan2(along, l2 * std::sin(theta2)) + side * tilt;  // [64]
  return {normalised(theta1), normalised(theta2)};
}

Jacobian jacobian(const TwoLinks& leg, double theta1, double theta2) {
  const double x2 = -leg.l2 * std::sin(theta1 + theta2);
  const double y2 = leg.l2 * std::cos(theta1 + theta2);
  return {-leg.l1 * std::sin(theta1) + x2, x2,  //
          leg.l1 * std::cos(theta1) + y2, y2};
}

GroundReaction ground_reaction(const TwoLinks& leg, double theta1, double theta2,
                               std::array<double, 2> torque) {
  // Also true for NaN.
  if (!(std::abs(std::sin(theta2)) >= singular_sine)) return {.force = {}, .singular = true};

  // (J^T)^-1 = 1/det [ y2 -y1; -x2 x1 ]
  const Jacobian j = jacobian(leg, theta1, theta2);
  const double det = j.determinant();
  const Point by_foot = {(j.y2 * torque[0] - j.y1 * torque[1]) / det,
                         (j.x1 * torque[1] - j.x2 * torque[0]) / det};
  return {.force = {-by_foot.x, -by_foot.y}, .singular = false};
}

std::array<double, max_joints> torques_for(const Pose& pose, Point force) {
  std::array<double, max_joints> out{};
  const Point foot = pose.foot();
  for (std::size_t j = 0; j < static_cast<std::size_t>(pose.links); ++j)
    out[j] = (foot.x - pose.joint[j].x) * force.y - (foot.y - pose.joint[j].y) * force.x;
  return out;
}

double cam_radius(std::span<const double> angle, std::span<const double> radii, double at) {
  if (at <= angle.front()) return radii.front();
  for (std::size_t k = 1; k < angle.size(); ++k) {
    if (at > angle[k]) continue;
    const double share = (at - angle[k - 1]) / (angle[k] - angle[k - 1]);
    return radii[k - 1] + share * (radii[k] - radii[k - 1]);
  }
  return radii.back();
}

double cam_radius(const Cam& cam, const Joint& joint, double angle) {
  if (cam.angle.empty()) return std::isfinite(cam.radius) ? cam.radius : joint.moment_arm;
  return cam_radius(cam.angle, cam.radii, angle);
}

double moment_arm_at(const Muscle& muscle, const Joint& joint, double angle) {
  const bool first = muscle.joint == joint.name, second = muscle.second.joint == joint.name;
  if (!first && !second) return 0;
  const Cam& cam = first ? muscle.cam : muscle.second.cam;
  return sign_of(first ? muscle.role : muscle.second.role) * joint.sign() *
         cam_radius(cam, joint, angle);
}

JointMuscles::JointMuscles(const Robot& robot, int joint)
    : robot_(robot), joint_(robot.joints[static_cast<std::size_t>(joint)]) {
  if (!is_plain(robot)) return;
  flexor_ = muscle_of(robot, joint, Muscle::Role::flexor);
  extensor_ = muscle_of(robot, joint, Muscle::Role::extensor);
}

double JointMuscles::torque(double angle, std::span<const double> tensions) const {
  if (flexor_ >= 0 && extensor_ >= 0)
    return robot::torque(joint_, tensions[static_cast<std::size_t>(flexor_)],
                         tensions[static_cast<std::size_t>(extensor_)]);
  double sum = 0;
  for (std::size_t m = 0; m < robot_.muscles.size() && m < tensions.size(); ++m)
    sum += moment_arm_at(robot_.muscles[m], joint_, angle) * tensions[m];
  return sum;
}

double torque_of_muscles(const Robot& robot, int joint, double angle,
                         std::span<const double> tensions) {
  return JointMuscles(robot, joint).torque(angle, tensions);
}

double torque(const Joint& joint, double flexor_tension, double extensor_tension) {
  return joint.sign() * joint.moment_arm * (flexor_tension - extensor_tension);
}

double muscle_length(const Joint& joint, Muscle::Role role, double mount_length, double angle) {
  return mount_length -
         sign_of(role) * joint.sign() * joint.moment_arm * (angle - joint.rest_angle);
}

namespace {

// Returns the tendon length taken up by the cam. The trapezoidal rule is exact for the straight
// pieces of a cam if it meets the corners.
double tendon_travel(const Muscle& muscle, const Joint& joint, double angle) {
  constexpr int pieces = 32;
  const double step = (angle - joint.rest_angle) / pieces;
  double sum = 0;
  for (int i = 0; i <= pieces; ++i) {
    const double share = i == 0 || i == pieces ? 0.5 : 1.0;
    sum += share * moment_arm_at(muscle, joint, joint.rest_angle + i * step);
  }
  return sum * step;
}

}  // namespace

double muscle_length(const Robot& robot, const Muscle& muscle, std::span<const double> angles) {
  double length = muscle.mount_length;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (moment_arm_at(muscle, robot.joints[j], angles[j]) != 0)
      length -= tendon_travel(muscle, robot.joints[j], angles[j]);
  return length;
}

double assumed_muscle_length(const Robot& robot, int muscle, double angle) {
  const Muscle& m = robot.muscles[static_cast<std::size_t>(muscle)];
  const Joint& joint = robot.joints[static_cast<std::size_t>(find_joint(robot, m.joint))];

  const double assumed = robot.low_level.assumed_mount_length;
  const double mount = assumed > 0 ? assumed : m.mount_length;
  const double sign = robot.thesis.knee_lengths_swapped ? 1.0 : joint.sign();
  return mount - sign_of(m.role) * sign * joint.moment_arm * (angle - joint.rest_angle);
}

}  // namespace sinew::robot
