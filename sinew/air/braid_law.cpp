#include "sinew/air/braid_law.h"

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/tension.h"

namespace sinew::air {

bool lanes_support(const Muscle& m) {
  return m.actuator.short_end.law != actuator::ShortEnd::Law::empirical &&
         actuator::is_plain(m.actuator) && !actuator::has_hysteresis(m.actuator.hysteresis) &&
         !actuator::has_creep(m.actuator.creep);
}

BraidConstants<double> braid_constants(const Muscle& m, const gas::Air& air) {
  BraidConstants<double> k;
  const actuator::Actuator& a = m.actuator;
  const double factor = actuator::braid_factor(a.braid);
  k.thread2 = a.braid.thread_length * a.braid.thread_length;
  k.cubic = m.count * factor;
  k.linear = k.cubic * k.thread2;
  k.external = m.external_volume;

  // For an absolute pressure as the argument, expands the polynomial about one atmosphere.
  const actuator::Effectiveness& e = a.effectiveness;
  const bool absolute = e.argument == actuator::Effectiveness::Argument::absolute;
  const double shift = absolute ? air.atmosphere : 0.0;
  k.c0 = e.scale * (e.c0 + shift * (e.c1 + shift * e.c2));
  k.c1 = e.scale * (e.c1 + 2.0 * shift * e.c2);
  k.c2 = e.scale * e.c2;
  k.low = e.valid_from;
  k.high = e.valid_to;

  k.viscous = m.count * a.loss.viscous;
  k.bladder = m.count * a.bladder.stiffness;
  k.bladder_rest = a.bladder.rest_length;
  k.long_length = a.long_end.length;
  k.long_stiffness = m.count * a.long_end.stiffness;
  k.long_damping = m.count * a.long_end.damping;
  k.short_length = actuator::shortest_length(a.braid);
  k.short_stiffness = m.count * a.short_end.stiffness;
  k.short_damping = m.count * a.short_end.damping;
  k.short_zero = a.short_end.law == actuator::ShortEnd::Law::zero ? 1.0 : 0.0;

  using Scale = actuator::Loss::Scale;
  const double q = a.loss.coulomb_length;
  k.mesh_secant = a.loss.coulomb_scale == Scale::secant ? 3.0 * k.cubic * q : 0.0;
  k.mesh_constant =
      a.loss.coulomb_scale == Scale::constant ? m.count * q * a.loss.coulomb_stiffness : 0.0;
  return k;
}

}  // namespace sinew::air
