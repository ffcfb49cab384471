#include "sinew/identify/sensor/transducer_settings.h"

#include <algorithm>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/sensor/transducer_text.h"

namespace sinew::identify {

namespace {

using config::above_zero;
using config::number_setting;
using config::Range;

// Sizes, stresses and voltages that a transducer can have; what is beyond is a slip of its unit.
constexpr Range size = above_zero(10, "of a transducer");
constexpr Range stress = above_zero(1e13, "diamond has 1.2e12 N/m2");
constexpr Range voltage = above_zero(1000, "of an instrument");

Bridge::Arms arms_of(const std::string& bridge) {
  const auto* found = std::ranges::find(arrangements, bridge, &Arrangement::name);
  if (found == std::end(arrangements))
    config::fail({"bridge", 0, 0}, "", config::in_quotes(bridge),
                 config::either(config::names_of(arrangements)));
  return found->arms;
}

double quantity(std::string_view name, const std::string& text, std::string_view unit,
                const Range& range) {
  return config::quantity_setting(name, text, unit, units::atmosphere, range);
}

}  // namespace

Transducer transducer_of(const TransducerSettings& o) {
  Transducer s;
  s.beam = {.length = quantity("length", o.length, "m", size),
            .width = quantity("width", o.width, "m", size),
            .height = quantity("height", o.height, "m", size),
            .gage_distance = quantity("gages", o.gages, "m", size),
            .modulus = quantity("modulus", o.modulus, "N/m2", stress),
            .poisson_ratio = number_setting(
                "poisson", o.poisson, config::from_zero(0.5, "no stretched solid gains more")),
            .yield_stress = quantity("yield", o.yield, "N/m2", stress),
            .stress_concentration = number_setting("concentration", o.concentration,
                                                   {1, 100, "a mount adds to the stress"})};
  s.bridge = {.arms = arms_of(o.bridge),
              .gage_factor = number_setting("gage_factor", o.gage_factor,
                                            above_zero(1000, "semiconductors have 200")),
              .excitation = quantity("excitation", o.excitation, "V", voltage),
              .gain = number_setting("gain", o.gain, above_zero(1e6, "of an amplifier"))};
  s.load = quantity("load", o.load, "N", above_zero(1e9, "at the beam's free end"));
  s.full_scale = quantity("full_scale", o.full_scale, "V", voltage);
  s.bits = static_cast<int>(number_setting("bits", o.bits, {1, 24, "of a converter"}));
  if (s.beam.gage_distance > s.beam.length)
    config::fail({"gages", 0, 0}, "", config::in_quotes(o.gages),
                 "no more than the beam's length, " + o.length,
                 "the distance from the load to the middle of the gages");
  return s;
}

std::optional<double> wanted_sensitivity(const TransducerSettings& o) {
  if (o.sensitivity.empty()) return {};
  return quantity("sensitivity", o.sensitivity, "V/N", above_zero(1e9, "output by load"));
}

}  // namespace sinew::identify
