// identify/task/force_beam_task.h - `sinew force-beam`: a force transducer, as its settings have
// it.
#pragma once

#include <optional>
#include <string>

#include "sinew/identify/sensor/transducer.h"
#include "sinew/identify/sensor/transducer_text.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings; fields() describes them. The thesis's transducer, 4.4. Where the gages are and how they
// are wired it does not print: of the bridges one gives the measured 0.17 V/lb near the strain that
// it was designed for, 1000e-6 at 30 lb.
struct TransducerSettings {
  std::string length = "0.75 in", width = "0.3 in", height = "0.15 in", gages = "0.36 in";
  std::string modulus = "10000000 psi";
  double poisson = 0.33;
  std::string yield = "40000 psi";
  double concentration = 1;
  std::string bridge = "poisson";
  double gage_factor = 2;
  std::string excitation = "5 V";
  double gain = 800;
  std::string full_scale = "5 V";
  int bits = 12;
  std::string load = "30 lbf", sensitivity;
};

template <class Visitor>
void fields(Visitor& v, TransducerSettings& s) {
  // What is beyond these is a slip of its unit.
  constexpr config::Range size = config::above_zero(10, "of a transducer");
  constexpr config::Range stress = config::above_zero(1e13, "diamond has 1.2e12 N/m2");
  constexpr config::Range voltage = config::above_zero(1000, "of an instrument");
  v.method({"force-beam",
            "strain, safety and output of a beam with strain gages; without options the thesis's",
            Tables::none});
  v.quantity({"length", "from the load to the mount", "m", size}, s.length);
  v.quantity({"width", "of the beam", "m", size}, s.width);
  v.quantity({"height", "in the direction of the load", "m", size}, s.height);
  v.quantity({"gages", "from the load to the middle of the gages", "m", size}, s.gages);
  v.quantity({"modulus", "Young's, of the material", "N/m2", stress}, s.modulus);
  v.number(
      {"poisson", "Poisson's ratio", "", config::from_zero(0.5, "no stretched solid gains more")},
      s.poisson);
  v.quantity(
      Setting{"yield", "stress at which it yields", "N/m2", stress}.in_python("yield_stress"),
      s.yield);
  v.number({"concentration", "of stress at the mount", "", {1, 100, "a mount adds to the stress"}},
           s.concentration);
  v.choice({"bridge",
            "quarter: one gage; half: above and below; poisson: above and below, along and across; "
            "bending: two above, two below"},
           s.bridge, {"quarter", "half", "poisson", "bending"});
  v.number({"gage_factor", "of the gages", "", config::above_zero(1000, "semiconductors have 200")},
           s.gage_factor);
  v.quantity({"excitation", "of the bridge", "V", voltage}, s.excitation);
  v.number({"gain", "of the amplifier", "", config::above_zero(1e6, "of an amplifier")}, s.gain);
  v.quantity({"full_scale", "of the converter", "V", voltage}, s.full_scale);
  v.integer({"bits", "of the converter", "", {1, 24, "of a converter"}}, s.bits);
  v.quantity({"load", "at the free end", "N", config::above_zero(1e9, "at the beam's free end")},
             s.load);
  v.quantity({"sensitivity", "wanted: gives where the gages must be", "V/N",
              config::above_zero(1e9, "output by load")},
             s.sensitivity);
}

// Returns the transducer, and the wanted sensitivity [V/N], if there is one. Throw config::Error.
Transducer transducer_of(const TransducerSettings& settings);
std::optional<double> wanted_sensitivity(const TransducerSettings& settings);

}  // namespace sinew::identify
