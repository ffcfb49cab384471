#include "sinew/identify/sensor/transducer.h"

#include <fmt/format.h>

namespace sinew::identify {

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
