// thesis/out_dat/columns.h - channels of a robot that out.dat contains, and their scales.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::thesis {

struct GaugeScale {
  double counts_at_zero = 0, newtons_per_count = 0;  // true values of the transducer

  // Returns the tension for counts of the transducer [N].
  double newtons(double counts) const { return (counts - counts_at_zero) * newtons_per_count; }
};

// A joint with its muscles, as needed for their columns.
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

// Returns the columns. Throws config::Error if a joint does not have two muscles with a transducer
// each.
OutDatColumns out_dat_columns(const experiment::Experiment& experiment);

std::string mode_of_phase(const std::string& phase);  // "plant" for "foot_plant"
std::string phase_of_mode(const std::string& mode);   // "foot_plant" for "plant"

}  // namespace sinew::thesis
