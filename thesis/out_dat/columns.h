// thesis/out_dat/columns.h - which of a robot's channels stand in out.dat, and their scales.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::thesis {

struct GaugeScale {
  double counts_at_zero = 0, newtons_per_count = 0;  // of the transducer itself

  // Returns the tension that counts of the transducer stand for  [N].
  double newtons(double counts) const { return (counts - counts_at_zero) * newtons_per_count; }
};

// A joint with its muscles, as their columns need them.
struct OutDatJoint {
  std::string name, flexor, extensor;                   // joint and muscles
  std::string angle, flexor_tension, extensor_tension;  // sensors
  double rest = 0, counts_per_rad = 0, counts_at_rest = 0;
  GaugeScale flexor_scale, extensor_scale;
};

// All columns of a robot.
struct OutDatColumns {
  std::string cylinder;  // sensor of joint 0; empty: none
  std::vector<OutDatJoint> joints;

  // Returns the first line of the file.
  std::string heading() const;
};

// Throws config::Error for a robot whose joints have not two muscles with transducers each.
OutDatColumns out_dat_columns(const experiment::Experiment& experiment);

std::string mode_of_phase(const std::string& phase);  // "plant" of "foot_plant"
std::string phase_of_mode(const std::string& mode);   // "foot_plant" of "plant"

}  // namespace sinew::thesis
