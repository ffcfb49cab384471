#include "sinew/identify/sensor/force_beam.h"

namespace sinew::identify {

namespace {

double section_modulus(const ForceBeam& b) { return b.width * b.height * b.height / 6; }

}  // namespace

double bending_stress(const ForceBeam& beam, double load, double distance) {
  return load * distance / section_modulus(beam);
}

double gage_strain(const ForceBeam& beam, double load) {
  return bending_stress(beam, load, beam.gage_distance) / beam.modulus;
}

double mount_stress(const ForceBeam& beam, double load) {
  return beam.stress_concentration * bending_stress(beam, load, beam.length);
}

double yield_load(const ForceBeam& beam) { return beam.yield_stress / mount_stress(beam, 1); }

double factor_of_safety(const ForceBeam& beam, double load) { return yield_load(beam) / load; }

double deflection(const ForceBeam& beam, double load) {
  const double inertia = section_modulus(beam) * beam.height / 2;
  return load * beam.length * beam.length * beam.length / (3 * beam.modulus * inertia);
}

double bridge_factor(Bridge::Arms arms, double poisson_ratio) {
  switch (arms) {
    case Bridge::Arms::quarter:
      return 0.25;
    case Bridge::Arms::half:
      return 0.5;
    case Bridge::Arms::poisson:
      return 0.5 * (1 + poisson_ratio);
    case Bridge::Arms::bending:
      break;
  }
  return 1;
}

double bridge_output(const ForceBeam& beam, const Bridge& bridge, double load) {
  return bridge.excitation * bridge.gage_factor * bridge_factor(bridge.arms, beam.poisson_ratio) *
         gage_strain(beam, load);
}

double sensitivity(const ForceBeam& beam, const Bridge& bridge) {
  return bridge.gain * bridge_output(beam, bridge, 1);
}

double gage_distance_for(const ForceBeam& beam, const Bridge& bridge, double wanted_sensitivity) {
  ForceBeam one_meter = beam;
  one_meter.gage_distance = 1;
  return wanted_sensitivity / sensitivity(one_meter, bridge);
}

}  // namespace sinew::identify
