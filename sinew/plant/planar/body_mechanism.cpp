#include "sinew/plant/planar/body_mechanism.h"

#include <cmath>

#include "sinew/plant/planar/rollers.h"

namespace sinew::plant {

BodyMechanism::BodyMechanism(const Setup& setup)
    : constants_(body_of(setup.robot)),
      robot_(setup.robot),
      cords_(setup.robot),
      rubs_(constants_, setup.robot) {
  double absolute = 0;
  for (std::size_t j = 0; j < constants_.links; ++j) {
    const robot::Joint& joint = robot_.joints[j];
    damping_[j] = joint.damping + joint.damper;
    dry_[j] = setup.start.blocked[j] ? blocked_bound : joint.dry_friction;
    absolute += setup.start.joint_angle[j];
    start_.at[first_link + j] = absolute;
  }
  start_.at[along_track] = setup.start.trolley;
  start_.at[up] = setup.start.lift;
}

double BodyMechanism::sum(const Motion& m) const noexcept {
  double places = 0;
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) places += m.at[c];
  return places;
}

double BodyMechanism::stable_step(double step) const {
  return plant::stable_step(step, rubs_.stiffest_rate(Body(constants_, start_), start_, robot_));
}

void BodyMechanism::set_rates(Motion& m, std::initializer_list<double> joint_rates, double x_rate,
                              double y_rate) const {
  double absolute = 0;
  for (std::size_t j = 0; j < constants_.links; ++j)
    m.rate[first_link + j] = absolute += j < joint_rates.size() ? joint_rates.begin()[j] : 0.0;
  m.rate[along_track] = x_rate;
  m.rate[up] = y_rate;
}

void BodyMechanism::route(const Motion& m, muscle::Ends& ends, Arms& arms) const noexcept {
  std::array<double, most_links> angle, rate;
  for (std::size_t j = 0; j < constants_.links; ++j) {
    angle[j] = joint_angle(m, j);
    rate[j] = joint_rate(m, j);
  }
  cords_.at(angle.data(), rate.data(), ends.length, ends.rate, arms);
  ends.travel = m.at[up];
  ends.travel_rate = m.rate[up];
}

// One-sided at both ends of the stroke.
double BodyMechanism::cylinder_stop(const Motion& m) const noexcept {
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

void BodyMechanism::load(const Pose& body, const Motion& m, const Arms& arms,
                         const muscle::Lanes& tension, double piston_force,
                         Load& out) const noexcept {
  std::array<double, most_links + 1> torque{};
  for (std::size_t j = 0; j < constants_.links; ++j) {
    const robot::Joint& joint = robot_.joints[j];
    out.passive_torque[j] =
        -damping_[j] * joint_rate(m, j) - joint.spring * (joint_angle(m, j) - joint.spring_angle);
    torque[j] = out.passive_torque[j];
  }
  for (int i = 0; i < cords_.count(); ++i)
    for (int k = 0; k < Cords::most; ++k)
      if (const int j = cords_.joint(i, k); j >= 0)
        torque[static_cast<std::size_t>(j)] +=
            arms[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] * tension[i];

  out.force = {};
  for (std::size_t j = 0; j < constants_.links; ++j)
    out.force[first_link + j] = torque[j] - torque[j + 1];

  const double beyond = m.at[along_track] - robot_.trolley.track_length;
  if (robot_.trolley.present && beyond > 0) {
    const double push =
        robot_.trolley.stop_stiffness * beyond + robot_.trolley.stop_damping * m.rate[along_track];
    out.force[along_track] -= push > 0 ? push : 0.0;
  }
  if (!constants_.held[up])
    out.force[up] += piston_force - robot_.cylinder.damping * m.rate[up] + cylinder_stop(m);

  out.normal = {};
  for (int i = 0; i < rubs_.discs(); ++i) {
    const DiscAt disc = rubs_.disc(body, m, i);
    const double push = rubs_.push(disc, i, m);
    out.normal[static_cast<std::size_t>(i)] = push;
    if (push <= 0) continue;
    for (std::size_t c = 0; c < constants_.coordinates(); ++c) out.force[c] += push * disc.rise[c];
  }
}

auto BodyMechanism::accelerate(const Pose& body, const Motion& m, const Load& load,
                               const Forces& held) const noexcept -> Acceleration {
  Coordinates force = load.force;
  const Coordinates rub = rubs_.generalised(body, m, held);
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) force[c] += rub[c];
  return body.accelerations(force);
}

auto BodyMechanism::prepare(const Pose& body, const Motion& m, const Arms& arms,
                            const muscle::Lanes& mesh, double trolley_bound,
                            const Load& load) noexcept -> Acceleration {
  const Acceleration free = body.accelerations(load.force);
  Forces bound{};
  for (std::size_t j = 0; j < constants_.links; ++j) bound[j] = dry_[j];
  for (int i = 0; i < cords_.count(); ++i)
    for (int k = 0; k < Cords::most; ++k)
      if (const int j = cords_.joint(i, k); j >= 0)
        bound[static_cast<std::size_t>(j)] +=
            std::abs(arms[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]) * mesh[i];
  bound[Rubs::trolley] = trolley_bound;
  bound[Rubs::lift] = constants_.held[up] ? 0.0 : robot_.cylinder.friction;
  for (std::size_t i = 0; i < most_discs; ++i)
    bound[Rubs::first_disc + i] = robot_.foot.friction * load.normal[i];
  rubs_.prepare(body, m, free, bound, load.normal);
  return free;
}

void BodyMechanism::move(Motion& out, const Motion& from, double h, const Motion& rates,
                         const Acceleration& a) const noexcept {
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    out.at[c] = from.at[c] + h * rates.rate[c];
    out.rate[c] = from.rate[c] + h * a[c];
  }
}

void BodyMechanism::glide(Motion& m, double h, const Acceleration& a) const noexcept {
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    m.at[c] += h * (m.rate[c] + 0.5 * h * a[c]);
    m.rate[c] += h * a[c];
  }
}

void BodyMechanism::finish(Motion& now, double h, const Motion* const (&stage)[4],
                           const Acceleration (&a)[4]) const noexcept {
  const double sixth = h / 6.0;
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) {
    now.at[c] += sixth * (stage[0]->rate[c] + 2.0 * stage[1]->rate[c] + 2.0 * stage[2]->rate[c] +
                          stage[3]->rate[c]);
    now.rate[c] += sixth * (a[0][c] + 2.0 * a[1][c] + 2.0 * a[2][c] + a[3][c]);
  }
}

void BodyMechanism::add_torque(const Arms& arms, int muscle, double tension,
                               std::array<double, most_joints>& torque) const noexcept {
  for (std::size_t s = 0; s < Cords::most; ++s)
    if (const int j = cords_.joint(muscle, static_cast<int>(s)); j >= 0)
      torque[static_cast<std::size_t>(j)] += arms[static_cast<std::size_t>(muscle)][s] * tension;
}

// The ankle is the last link's end; the ground's force is that on all discs.
void BodyMechanism::tell(const Motion& m, const Acceleration& a, const Forces& held,
                         const Load& load, Truth& out) const noexcept {
  out.x = m.at[along_track];
  out.x_rate = m.rate[along_track];
  out.lift = m.at[up];
  out.lift_rate = m.rate[up];
  const Body body(constants_, m);
  for (std::size_t j = 0; j < constants_.links; ++j) {
    out.angle[j] = joint_angle(m, j);
    out.rate[j] = joint_rate(m, j);
    out.foot_x += constants_.length[j] * body.cos(j);
    out.foot_y += constants_.length[j] * body.sin(j);
  }
  for (int i = 0; i < rubs_.discs(); ++i) {
    const double push = rubs_.push(rubs_.disc(body, m, i), i, m);
    out.disc_force[static_cast<std::size_t>(i)] = push;
    out.force_y += push;
    if (push > 0) out.force_x += held[static_cast<std::size_t>(Rubs::first_disc + i)];
  }
  if (robot_.rollers.present) tell_rollers(body, m, a, held, load, out);
}

void BodyMechanism::tell_rollers(const Body& body, const Motion& m, const Acceleration& a,
                                 const Forces& held, const Load& load, Truth& out) const noexcept {
  const double hung = constants_.lifted_mass;
  Hanging h{.acceleration = a[along_track], .lift = m.at[up]};
  h.force_x = hung * a[along_track] - out.force_x;
  h.force_y = hung * (a[up] + constants_.gravity) - out.force_y;
  for (std::size_t i = 0; i < constants_.links; ++i)
    h.add(constants_.first_moment[i], body.sin(i), body.cos(i), m.rate[first_link + i],
          a[first_link + i]);
  h.torque = out.torque[0] + load.passive_torque[0] + held[0];
  const RollerLoads loads = roller_loads(robot_, h);
  out.roller_front = loads.front;
  out.roller_rear = loads.rear;
}

}  // namespace sinew::plant
