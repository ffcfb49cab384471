// analysis/stand.h - a run on the test stand in numbers, from its log alone.
//
//   stand.…    lengths, forces, pressures at their extremes, air used
//   swing.…    of a load that swings freely: turns, period, and what [45]-[53] make of them
//   pulsed.…   means and ripples of the last five periods of a pulsed valve
//   track.…    length against the desired one
//   sweep.…    settled lengths by duty, "sweep.42_5.length_m"
//
// docs/theory/test-stand.md has the definitions. A key that does not apply is absent.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/summary.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/node.h"
#include "sinew/signals/table.h"
#include "sinew/units/constants.h"

namespace sinew::analysis {

// What of a stand's file the numbers need.
struct StandFile {
  std::string title, reproduces;
  double atmosphere = units::atmosphere;  // [Pa]
  std::string element = "bpa";            // in the topics
  std::string drive = "none";             // its kind
  double period = 0.04;                   // of the drive [s]
  std::vector<Reported> reported;
  std::vector<MachineFault> faults;
};

// Throws config::Error with everything that is wrong in what is read.
StandFile read_stand(const config::Node& root);

// Returns the figures of a run of the stand, those that its log allows.
Summary summarize(const signals::Table&, const StandFile&);

}  // namespace sinew::analysis
