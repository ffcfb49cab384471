// identify/pair/pair.h - identification of a sealed antagonistic pair that is moved by hand or
// motor: elastic and trapped-air stiffness, dry friction, viscous loss and mass from effort (force
// or torque), position and pressures.
//
// The laws are those of pair_law.h. The physical values are common to all recordings. Each
// recording has a bias of the effort and an initial value of phi, the share of dry friction; each
// rig has a delay of the effort and, except for the first, a gain relative to the first. The law is
// chosen by the errors on five blocks of time, each predicted from the others.
//
// Not determined by such data: the gain of a single rig, as everything scales with it; the area A
// and the stiffness k separately, if the pressures follow the position; which part of Phi_c is due
// to the muscles and which to bearings and gears; area and volume behind the pressures
// (pair_air.h).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/pair/pair_air.h"
#include "sinew/identify/pair/pair_law.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// Options of the identification.
struct PairOptions {
  std::string model;  // the only law to try; empty: all
  // Samples of these times are not fitted [s]; from > to: none.
  double held_out_from = std::numeric_limits<double>::infinity(), held_out_to = 0;
  Constraints constraints;
};

// Total stiffness, of the muscles and of the air in them, with half its 95 % interval.
struct PairStiffness {
  double value = 0, uncertainty = 0;  // [N/m] or [N m/rad]
  double air = 0;                     // part of the trapped air; NaN: not determined
};

// Sensors of a recording.
struct PairSensorsOf {
  std::string file, rig;
  PairSensors sensors;
};

// Result of the identification.
struct PairResult {
  Report report;                       // report on the effort
  PairLaw law{};                       // chosen law
  PairValues values;                   // values in the chosen law
  std::vector<PairSensorsOf> sensors;  // for each fitted recording
  PairStiffness stiffness;
  bool rotary = false;
  std::optional<PairAir> air;  // if a pressure was measured
};

// Identifies the pair. Throws Refusal, config::Error for a constraint on an unknown parameter, and
// std::invalid_argument for an unknown law.
PairResult identify_pair(std::span<const PairRecord> records, const PairOptions& options = {});

// Returns the names of the laws.
std::vector<std::string> pair_models();

}  // namespace sinew::identify
