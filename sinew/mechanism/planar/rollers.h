// mechanism/planar/rollers.h - what the trolley's two rollers carry, 4.2 and 7.2.
//
//   N_f + N_r = m_t g + R_y
//   N_f x_f + N_r x_r = g (m_c x_c + m_w x_w) - m_t h_c x'' + h D - y R_x + T,   D = m_t x'' + R_x
//
//   R   force of the trolley on all that hangs from it (body, links, foot), at the first joint [N]
//   T   torque of the trolley on the first link [N m]           D  of the track on the trolley [N]
//   m_t = m_c + m_w   trolley with payload; counterweight [kg]  h, h_c  of track and mass centre
//   y   height of the first joint above the origin [m]          x  ahead of the first joint [m]
//
// Rollers rest on the track: what comes out below zero has lifted off, and the trolley would tip.
// The plant moves it along the track all the same.
#pragma once

#include "sinew/robot/robot.h"

namespace sinew::plant {

// What hangs from the trolley does to it.
struct Hanging {
  double acceleration = 0;          // of the trolley [m/s^2]
  double force_x = 0, force_y = 0;  // R [N]
  double torque = 0;                // T [N m]
  double lift = 0;                  // y [m]

  // A link's share of the momentum's rate: first moment c [kg m], sine, cosine, rate, acceleration.
  void add(double c, double sine, double cosine, double rate, double turn) {
    force_x -= c * (sine * turn + cosine * rate * rate);
    force_y += c * (cosine * turn - sine * rate * rate);
  }
};

struct RollerLoads {
  double front = 0, rear = 0;  // [N], up > 0
};

// Returns them, by what hangs on the trolley and how it moves.
inline RollerLoads roller_loads(const robot::Robot& robot, const Hanging& hanging) {
  const robot::Rollers& r = robot.rollers;
  const double own = robot::trolley_own_mass(robot) + robot.trolley.payload;
  const double g = robot.gravity, carriage = own - r.counterweight;
  const double track = own * hanging.acceleration + hanging.force_x;

  const double sum = own * g + hanging.force_y;
  const double moment = g * (carriage * r.center_of_mass + r.counterweight * r.counterweight_at) -
                        own * r.center_of_mass_up * hanging.acceleration + r.height * track -
                        hanging.lift * hanging.force_x + hanging.torque;
  const double front = (moment - r.rear * sum) / (r.front - r.rear);
  return {front, sum - front};
}

}  // namespace sinew::plant
