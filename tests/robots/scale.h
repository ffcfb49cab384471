// tests/robots/scale.h - a machine of another size that moves alike.
//
// Lengths x s, pressures and temperatures as they are. Forces are pressures by areas, s^2; masses
// volumes, s^3; so accelerations go with 1/s, and with lengths that gives times x s, velocities as
// they are, gravity / s.
#pragma once

#include <cmath>

#include "sinew/experiment/experiment.h"

namespace sinew::test {

// Powers of the scale.
struct Scale {
  double length, area, volume, torque_damping, inertia;

  explicit Scale(double s)
      : length(s),
        area(s * s),
        volume(s * s * s),
        torque_damping(s * s * s * s),
        inertia(s * s * s * s * s) {}
};

// Force over length, force over speed: s, s^2. Torques are forces by lengths, s^3, and so is their
// stiffness.
inline void scale(robot::Joint& j, const Scale& s) {
  j.moment_arm *= s.length;
  j.dry_friction *= s.volume;
  j.damping *= s.torque_damping;
  j.damper *= s.torque_damping;
  j.spring *= s.volume;
}

inline void scale(robot::Cam& cam, const Scale& s) {
  cam.radius *= s.length;  // remains not set
  for (double& r : cam.radii) r *= s.length;
}

// A pipe does not scale: the air's viscosity is a constant. Its conductance does.
inline void scale(robot::Muscle& m, const Scale& s) {
  scale(m.cam, s);
  scale(m.second.cam, s);
  m.mount_length *= s.length;
  m.external_volume *= s.volume;
  m.bladder_stiffness *= s.length;
  m.bladder_rest_length *= s.length;
  m.hose.sonic_conductance *= s.area;
  m.hose.volume *= s.volume;
  m.leak.area *= s.area;
  m.leak.conductance *= s.area;
}

inline void scale(robot::Trolley& t, const Scale& s) {
  t.total_mass *= s.volume;
  t.payload *= s.volume;
  t.drag *= s.area;
  t.breakaway *= s.area;
  t.track_length *= s.length;
  t.stop_stiffness *= s.length;
  t.stop_damping *= s.area;
}

inline void scale(robot::Cylinder& c, const Scale& s) {
  for (double* length : {&c.bore, &c.rod_diameter, &c.stroke, &c.stop_stiffness})
    *length *= s.length;
  for (double* volume : {&c.body_mass, &c.up.dead_volume, &c.down.dead_volume}) *volume *= s.volume;
  for (double* force : {&c.friction, &c.damping, &c.stop_damping}) *force *= s.area;
}

inline void scale(robot::Robot& r, const Scale& s) {
  for (robot::Link& l : r.links) {
    l.length *= s.length;
    l.center_of_mass *= s.length;
    l.mass *= s.volume;
    l.inertia *= s.inertia;
  }
  for (robot::Joint& j : r.joints) scale(j, s);
  for (robot::Muscle& m : r.muscles) scale(m, s);
  scale(r.trolley, s);
  scale(r.cylinder, s);
  r.foot.mass *= s.volume;
  r.foot.radius *= s.length;
  for (robot::Foot::Point& p : r.foot.points)
    for (double* length : {&p.along, &p.across, &p.radius}) *length *= s.length;
  r.ground.height *= s.length;
  r.ground.normal_stiffness *= s.length;
  r.ground.normal_damping *= s.area;
  r.gravity /= s.length;
}

inline void scale(actuator::Actuator& a, const Scale& s) {
  a.braid.thread_length *= s.length;
  a.long_end.length *= s.length;
  a.long_end.stiffness *= s.length;
  a.long_end.damping *= s.area;
  a.short_end.stiffness *= s.length;
  a.short_end.damping *= s.area;
  a.loss.viscous *= s.area;
  a.loss.coulomb_length *= s.length;
  a.loss.coulomb_stiffness *= s.length;
  a.bladder.stiffness *= s.length;
  a.bladder.rest_length *= s.length;
}

inline void scale(gas::Valve& v, const Scale& s) {
  v.flow.area *= s.area;
  v.flow.sonic_conductance *= s.area;
  for (double* time : {&v.opening_delay, &v.closing_delay, &v.opening_ramp, &v.closing_ramp,
                       &v.speed_up.opening, &v.speed_up.closing, &v.opening_delay_slope,
                       &v.closing_delay_slope, &v.regulator.time_constant})
    *time *= s.length;
  v.max_frequency /= s.length;
}

// What moves; the controller's numbers are not scaled.
inline experiment::Experiment scaled(experiment::Experiment e, double factor) {
  const Scale s(factor);
  scale(e.robot, s);
  for (actuator::Actuator& a : e.actuators) scale(a, s);
  for (gas::Valve& v : e.valves) scale(v, s);
  e.air.wall_time *= s.length;
  e.supply.volume *= s.volume;
  e.start.trolley *= s.length;
  e.start.lift *= s.length;
  e.body_step *= s.length;
  return e;
}

}  // namespace sinew::test
