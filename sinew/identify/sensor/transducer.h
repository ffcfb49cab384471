// identify/sensor/transducer.h - a force beam with its bridge and the converter that reads it.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/sensor/force_beam.h"

namespace sinew::identify {

struct Transducer {
  ForceBeam beam;
  Bridge bridge;
  double load = 0;        // that it is looked at under [N]
  double full_scale = 0;  // of the converter [V]
  int bits = 12;
};

// The transducer's answer under its load.
struct TransducerPoint {
  double strain = 0, stress = 0;  // at the gages, and at the mount [Pa]
  double factor_of_safety = 0;
  double yield_load = 0, deflection = 0;  // [N], [m]
  double bridge_output = 0, output = 0;   // before and after the amplifier [V]
  double sensitivity = 0;                 // [V/N]
  double counts_per_newton = 0;           // [count/N]
  double clip_load = 0;                   // at which the converter ends [N]
};

// Returns what the beam, the bridge and the converter do under its load.
TransducerPoint evaluate(const Transducer& t);

// Returns what is doubtful under the load, in words: the beam yields, is no slender beam, or the
// converter ends before.
std::vector<std::string> doubts(const Transducer& t);

}  // namespace sinew::identify
