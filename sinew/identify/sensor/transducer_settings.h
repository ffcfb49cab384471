// identify/sensor/transducer_settings.h - a force transducer as a person describes it.
#pragma once

#include <optional>
#include <string>

#include "sinew/identify/sensor/transducer.h"

namespace sinew::identify {

// The thesis's transducer, 4.4. Where the gages sit and how they are wired it does not print: of
// the bridges one gives the measured 0.17 V/lb near the strain that it wanted, 1000e-6 at 30 lb.
struct TransducerSettings {
  std::string length = "0.75 in";  // from the load to the mount
  std::string width = "0.3 in";    // of the beam
  std::string height = "0.15 in";  // in the direction of the load
  std::string gages = "0.36 in";   // from the load to the middle of the gages
  std::string modulus = "10000000 psi", yield = "40000 psi";
  double poisson = 0.33;
  double concentration = 1;        // of stress at the mount
  std::string bridge = "poisson";  // an arrangement's name, transducer_text.h
  double gage_factor = 2;
  std::string excitation = "5 V";
  double gain = 800;               // of the amplifier
  std::string full_scale = "5 V";  // of the converter
  int bits = 12;
  std::string load = "30 lbf";  // at the free end
  std::string sensitivity;      // wanted: tells where the gages must be; empty: none is
};

// Throws config::Error.
Transducer transducer_of(const TransducerSettings& settings);

// Returns the wanted sensitivity [V/N], if there is one. Throws config::Error.
std::optional<double> wanted_sensitivity(const TransducerSettings& settings);

}  // namespace sinew::identify
