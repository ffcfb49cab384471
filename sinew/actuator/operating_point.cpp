#include "sinew/actuator/operating_point.h"

#include <cmath>

#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/prediction.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"

namespace sinew::actuator {

namespace {

std::vector<std::string> beyond(const Actuator& a, double length, double gauge) {
  std::vector<std::string> out;
  if (length - a.caps.length >= a.braid.thread_length)
    out.emplace_back("longer than the thread: no braid angle");
  if (length > a.long_end.length) out.emplace_back("beyond the long end: the threads stretch");
  if (length < shortest_length(a))
    out.emplace_back("below the shortest length: the end stop pushes, or nothing pulls");
  if (gauge < a.effectiveness.valid_from || gauge > a.effectiveness.valid_to)
    out.emplace_back("outside the fitted pressures: the effectiveness is held");
  if (length < a.bladder.valid_from || length > a.bladder.valid_to)
    out.emplace_back("outside the fitted lengths: the bladder is held");
  return out;
}

}  // namespace

OperatingPoint operating_point(const Actuator& a, double length, double gauge,
                               const Surroundings& around, double velocity) {
  const double atmosphere = around.atmosphere;
  OperatingPoint p{.length = length, .gauge_pressure = gauge};
  p.tension = tension(a, length, 0.0, gauge, atmosphere);
  p.effectiveness = effectiveness(a.effectiveness, gauge, atmosphere);
  p.stiffness_at_constant_pressure = stiffness_at_constant_pressure(a, length, gauge, atmosphere);
  p.stiffness_sealed = stiffness_sealed(a, length, gauge + atmosphere, atmosphere,
                                        around.external_volume, around.polytropic_exponent);
  p.passive_stiffness = passive_stiffness(a, length, gauge, atmosphere);
  p.coulomb_bound = coulomb_bound(a, length, gauge, atmosphere, p.stiffness_sealed);
  if (std::isfinite(velocity)) {
    p.velocity = velocity;
    p.viscous_loss = clamped_tension(a, length, velocity, gauge, atmosphere) -
                     clamped_tension(a, length, 0.0, gauge, atmosphere);
    p.sliding_tension = sliding_tension(a, length, velocity, gauge, atmosphere, p.stiffness_sealed);
  }
  p.volume = volume(a, length);
  p.diameter = diameter(a.braid, length - a.caps.length);
  p.braid_angle = braid_angle(a.braid, length - a.caps.length);
  if (const ForceInterval f = force_interval(a.prediction, length, gauge, p.tension); f.known) {
    p.half_68 = f.half_68;
    p.half_95 = f.half_95;
  }
  p.beyond = beyond(a, length, gauge);
  return p;
}

}  // namespace sinew::actuator
