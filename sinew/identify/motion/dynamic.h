// identify/motion/dynamic.h - what a muscle loses in motion, from free decays of a mass on trapped
// air (chapter 3.4): least squares on the whole trajectories, one law for all records.
//
//   F_loss = c v + Q k sign v      k   dry_secant, secant      3 P_g Eff (L + L_min)/(4 pi n^2),
//   [34]
//                                      dry_sealed, sealed      of the sealed muscle, stiffness.h
//                                      dry_constant, constant  a number [N/m]
//
//   c  viscous loss [N s/m], 0 in dry_...      Q  coulomb_length [m], 0 in `viscous`
//
// The law is chosen by what it says about records that it was not fitted to: those marked, or else
// each in turn, or of a single record its last third. A record that is held out has its own start,
// offset and tension fitted, but no loss.
//
// Departures from 3.4: the mass sticks; the air's exponent is given or measured, not fitted, since
// the period cannot tell it from the tension. Not in it: swaying, hysteresis, creep - an actuator
// that has them is refused.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/wish.h"
#include "sinew/identify/motion/decay.h"
#include "sinew/identify/motion/swing.h"

namespace sinew::identify {

// What the turns of one record say without a model of the muscle.
struct DecaySummary {
  std::string file;
  double period = 0, noise = 0, rest = 0, amplitude = 0;  // [s] [m] [m] [m]
  double stiffness = 0;                                   // of the sealed muscle at rest [N/m]
  double friction = 0;  // at rest, by the chosen law [N]; by the others Q times `stiffness`
  std::size_t turns = 0;
  double exponent = 0, pressure_delay = 0;  // of the trapped air [1]; NaN: no pressure was used [s]
  std::optional<Damping> printed, exact;    // two points, [45]-[53]; none: see `why_not`
  std::string why_not;
  DecayFit all;  // of all turns
};

// The losses that were found, and how well each law fits.
struct DynamicResult {
  actuator::Loss loss;  // of the chosen law
  Report report;
  std::vector<DecaySummary> records;
};

// `model`: only that law; empty: all. `wishes` are for the parameters of the laws, viscous and
// coulomb_length, and for those of the records that are fitted: start_length, start_velocity,
// offset and tension, each " of FILE" where there are several. Throws Refusal, config::Error for a
// wish of a parameter that there is not, and std::invalid_argument for a name that no law has.
DynamicResult identify_dynamic(std::span<const DecayRecord> records, std::string_view model = "",
                               const Wishes& wishes = {});
std::vector<std::string> dynamic_models();

}  // namespace sinew::identify
