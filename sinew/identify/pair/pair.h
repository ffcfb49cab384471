// identify/pair/pair.h - a sealed antagonistic pair that is moved by hand or motor: elastic and
// trapped-air stiffness, dry friction, viscous loss and mass from effort, position and pressures.
//
// The laws are those of pair_law.h. All recordings share their physics; each has a bias of the
// effort and a share of dry friction at its beginning, each rig a delay of the effort and, from the
// second on, a gain in that of the first. The law is chosen by how well five blocks of time are
// predicted, each from the others.
//
// What cannot be told: the gain of a single rig from everything else that makes effort; the area A
// from the stiffness k, where the pressures follow the position; which part of D is the muscles'
// and which that of bearings and gears; the area and the volume behind the pressures (pair_air.h).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/wish.h"
#include "sinew/identify/pair/pair_air.h"
#include "sinew/identify/pair/pair_law.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// What is asked of the recordings.
struct PairOptions {
  std::string model;  // that law alone; empty: all
  // Samples of these times are not fitted [s]; none: from > to.
  double held_out_from = std::numeric_limits<double>::infinity(), held_out_to = 0;
  Wishes wishes;
};

// Stiffness of all that springs, with the air that moves along; half a 95 % interval.
struct PairStiffness {
  double value = 0, uncertainty = 0;  // [N/m] or [N m/rad]
  double air = 0;                     // the trapped air's part of it; NaN: not told apart
};

// The sensors of a recording.
struct PairSensorsOf {
  std::string file, rig;
  PairSensors sensors;
};

// What was found.
struct PairResult {
  Report report;                       // of the effort
  PairLaw law{};                       // that was chosen
  PairValues values;                   // in it
  std::vector<PairSensorsOf> sensors;  // of each recording that was fitted
  PairStiffness stiffness;
  bool rotary = false;
  std::optional<PairAir> air;  // where a pressure was measured
};

// Throws Refusal, config::Error for a wish of a parameter that there is not, and
// std::invalid_argument for a law that there is not.
PairResult identify_pair(std::span<const PairRecord> records, const PairOptions& options = {});

// Returns the names of the laws.
std::vector<std::string> pair_models();

}  // namespace sinew::identify
