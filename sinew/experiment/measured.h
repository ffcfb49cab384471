// experiment/measured.h - measurements of a stand's transducers as a CSV file, as a test rig would
// write and `sinew identify` reads.
//
//   time [s],force [N],length [m],pressure [Pa gauge]
//
// The file has a row per measured.period from measured.from on and a column per sensor, under its
// name and with all errors of its transducer. It contains nothing that only a simulation has, and
// no row before the sensors' first conversion, at the end of the first drive.period.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/table.h"

namespace sinew::experiment {

// Measured rows: instants and the value of each sensor, in the order of the experiment's sensors.
struct Notes {
  std::vector<double> time;                 // [s]
  std::vector<std::vector<double>> values;  // values of each sensor, SI; gauge pressure
};
Notes notes(const Experiment& experiment, const signals::Table& table);

// Returns the measurements as CSV. Empty without sensors, and for a sweep.
std::string measured_csv(const Experiment& experiment, const signals::Table& table);

}  // namespace sinew::experiment
