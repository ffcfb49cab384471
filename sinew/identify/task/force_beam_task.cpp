#include "sinew/identify/task/force_beam_task.h"

#include <algorithm>

#include "sinew/config/diagnostics.h"

namespace sinew::identify {

Transducer transducer_of(const TransducerSettings& o) {
  const SettingValues values(o);
  Transducer s;
  s.beam = {.length = values.of(o.length),
            .width = values.of(o.width),
            .height = values.of(o.height),
            .gage_distance = values.of(o.gages),
            .modulus = values.of(o.modulus),
            .poisson_ratio = o.poisson,
            .yield_stress = values.of(o.yield),
            .stress_concentration = o.concentration};
  s.bridge = {.arms = std::ranges::find(arrangements, o.bridge, &Arrangement::name)->arms,
              .gage_factor = o.gage_factor,
              .excitation = values.of(o.excitation),
              .gain = o.gain};
  s.load = values.of(o.load);
  s.full_scale = values.of(o.full_scale);
  s.bits = o.bits;
  if (s.beam.gage_distance > s.beam.length)
    config::fail({"gages", 0, 0}, "", config::in_quotes(o.gages),
                 "no more than the beam's length, " + o.length,
                 "the distance from the load to the middle of the gages");
  return s;
}

std::optional<double> wanted_sensitivity(const TransducerSettings& o) {
  return SettingValues(o).given(o.sensitivity);
}

}  // namespace sinew::identify
