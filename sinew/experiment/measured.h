// experiment/measured.h - what the stand's transducers showed, as the CSV that a rig would
// write and `sinew identify` reads.
//
//   time [s],force [N],length [m],pressure [Pa gauge]
//
// A row per measured.period from measured.from on; a column per sensor, under its own name, with
// all that its transducer does to the truth. Nothing in it is known to a simulation alone.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/table.h"

namespace sinew::experiment {

// The rows: instants, and what each sensor showed, in the order of the experiment's.
struct Notes {
  std::vector<double> time;                 // [s]
  std::vector<std::vector<double>> values;  // of each sensor, SI; pressure is gauge
};
Notes notes(const Experiment& experiment, const signals::Table& table);

// The same as text. Empty where nothing was read: no sensors, or a sweep.
std::string measured_csv(const Experiment& experiment, const signals::Table& table);

}  // namespace sinew::experiment
