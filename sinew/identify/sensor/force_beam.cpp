#include "sinew/identify/sensor/force_beam.h"

#include <fmt/format.h>

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

// --- a force beam with its bridge and converter ---

TransducerPoint evaluate(const Transducer& t) {
  const double per_newton = sensitivity(t.beam, t.bridge);
  return {.strain = gage_strain(t.beam, t.load),
          .stress = mount_stress(t.beam, t.load),
          .factor_of_safety = factor_of_safety(t.beam, t.load),
          .yield_load = yield_load(t.beam),
          .deflection = deflection(t.beam, t.load),
          .bridge_output = bridge_output(t.beam, t.bridge, t.load),
          .output = per_newton * t.load,
          .sensitivity = per_newton,
          .counts_per_newton = per_newton * (1 << t.bits) / t.full_scale,
          .clip_load = t.full_scale / per_newton};
}

std::vector<std::string> doubts(const Transducer& t) {
  std::vector<std::string> out;
  if (factor_of_safety(t.beam, t.load) < 1)
    out.emplace_back(
        "the beam yields under this load: it stays bent, and strain is no longer "
        "stress by the modulus");
  if (t.beam.length < 5 * t.beam.height)
    out.emplace_back(
        "shorter than five times its height: shear counts, the law is for slender "
        "beams");
  if (sensitivity(t.beam, t.bridge) * t.load > t.full_scale)
    out.push_back(
        fmt::format("the amplifier's output is beyond the converter's {} V: readings "
                    "end before this load",
                    t.full_scale));
  return out;
}

}  // namespace sinew::identify
