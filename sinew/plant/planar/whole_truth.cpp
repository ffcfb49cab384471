// What only a simulation knows of a whole machine.
#include "sinew/plant/planar/rollers.h"
#include "sinew/plant/planar/whole.h"

namespace sinew::plant {

Truth WholeWorld::truth(double t) noexcept {
  advance(t);
  const Glance& g = glance();
  const Peek p = peek(g, t);
  const Motion& m = p.state.motion;

  Truth out;
  out.x = m.at[along_track];
  out.x_rate = m.rate[along_track];
  for (std::size_t j = 0; j < constants_.links; ++j) {
    out.angle[j] = joint_angle(m, j);
    out.rate[j] = joint_rate(m, j);
  }
  for (int i = 0; i < cords_.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.tension[k] = gauge(g, p, i);
    out.pressure[k] = p.look.pull.pressure[i];
    out.length[k] = p.look.length[i];
    out.mass[k] = p.state.air[i];
    out.air_in[k] = p.state.tally.in[k];
    out.air_out[k] = p.state.tally.out[k];
    out.air_leaked[k] = p.state.tally.leak[k];
    for (std::size_t s = 0; s < Cords::most; ++s)
      if (const int j = cords_.joint(i, static_cast<int>(s)); j >= 0)
        out.torque[static_cast<std::size_t>(j)] += p.look.pulls[k][s] * out.tension[k];
  }
  out.supply_pressure = p.look.pull.supply_pressure;
  out.tank_pressure = p.look.pull.tank_pressure;
  tell_cylinder(p, out);
  tell_foot(g, p, out);
  tell_rollers(g, p, out);
  return out;
}

void WholeWorld::tell_cylinder(const Peek& p, Truth& out) const noexcept {
  out.lift = p.state.motion.at[up];
  out.lift_rate = p.state.motion.rate[up];
  const auto n = static_cast<std::size_t>(cords_.count());
  for (std::size_t c = 0; c < 2; ++c) {
    out.cylinder_pressure[c] = p.look.pull.cylinder_pressure[c];
    out.cylinder_in[c] = p.state.tally.in[n + c];
    out.cylinder_out[c] = p.state.tally.out[n + c];
  }
}

// The ankle is the last link's end; the ground's force is that on all discs.
void WholeWorld::tell_foot(const Glance& g, const Peek& p, Truth& out) const noexcept {
  const Motion& m = p.state.motion;
  const Body body(constants_, m);
  for (std::size_t i = 0; i < constants_.links; ++i) {
    out.foot_x += constants_.length[i] * body.cos(i);
    out.foot_y += constants_.length[i] * body.sin(i);
  }
  for (int i = 0; i < rubs_.discs(); ++i) {
    const double push = rubs_.push(rubs_.disc(body, m, i), i, m);
    out.disc_force[static_cast<std::size_t>(i)] = push;
    out.force_y += push;
    if (push > 0) out.force_x += g.held[static_cast<std::size_t>(Rubs::first_disc + i)];
  }
}

void WholeWorld::tell_rollers(const Glance& g, const Peek& p, Truth& out) const noexcept {
  if (!robot_.rollers.present) return;
  const Motion& m = p.state.motion;
  const Body body(constants_, m);
  const double hung = constants_.lifted_mass;
  Hanging h{.acceleration = g.acceleration[along_track], .lift = m.at[up]};
  h.force_x = hung * g.acceleration[along_track] - out.force_x;
  h.force_y = hung * (g.acceleration[up] + constants_.gravity) - out.force_y;
  for (std::size_t i = 0; i < constants_.links; ++i)
    h.add(constants_.first_moment[i], body.sin(i), body.cos(i), m.rate[first_link + i],
          g.acceleration[first_link + i]);
  h.torque = out.torque[0] + first_.passive_torque[0] + g.held[0];
  const RollerLoads loads = roller_loads(robot_, h);
  out.roller_front = loads.front;
  out.roller_rear = loads.rear;
}

// Is anything of the look at a node no number?
void WholeWorld::look_for_failure() noexcept {
  if (failure_) return;
  using Of = muscle::Failure::Of;
  for (int i = 0; i < cords_.count(); ++i)
    if (!muscle::is_pressure(first_.pull.pressure[i])) {
      failure_ = {.of = Of::air, .muscle = i, .length = first_.length[i], .time = time_};
      return;
    }
  double places = 0;
  for (std::size_t c = 0; c < constants_.coordinates(); ++c) places += state_.motion.at[c];
  if (!muscle::is_place(places)) failure_ = {.of = Of::motion, .time = time_};
  for (const double p : first_.pull.cylinder_pressure)
    if (!constants_.held[up] && !(p >= 0 && p < muscle::most_pressure))
      failure_ = {.of = Of::cylinder, .time = time_};
}

}  // namespace sinew::plant
