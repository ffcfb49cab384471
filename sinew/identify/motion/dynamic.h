// identify/motion/dynamic.h - losses of a muscle in motion, from free decays of a mass on trapped
// air (chapter 3.4): least squares on the whole trajectories, one law for all records.
//
//   F_loss = c v + Q k sign v
//   k   dry_secant, secant      3 P_g Eff (L + L_min)/(4 pi n^2), [34]
//       dry_sealed, sealed      of the sealed muscle, stiffness.h
//       dry_constant, constant  a number [N/m]
//
//   c  viscous loss [N s/m], 0 in dry_...      Q  coulomb_length [m], 0 in `viscous`
//
// The law is chosen by its errors on records that it was not fitted to: the marked ones, or else
// each in turn, or the last third of a single record. For a held-out record the start, offset and
// tension are fitted, but no loss.
//
// Departures from 3.4: the mass sticks; the air's exponent is given or measured, not fitted, since
// the period cannot separate it from the tension. Not included: swaying, hysteresis, creep; an
// actuator with these is refused.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/motion/decay.h"
#include "sinew/identify/motion/swing.h"

namespace sinew::identify {

// A record, with results from its turns, without a model of the muscle.
struct DecaySummary {
  Swing swing;
  double friction = 0;                              // at rest, by the chosen law [N]
  std::optional<Damping> printed = {}, exact = {};  // two points, [45]-[53]; empty: see `why_not`
  std::string why_not = "";
  DecayFit all;  // fit to all turns
};

// Identified losses, and the quality of each law's fit.
struct DynamicResult {
  actuator::Loss loss;  // identified, by the chosen law
  Report report;
  std::vector<DecaySummary> records;
};

// Identifies the losses. `model`: the only law to try; empty: all. `constraints` may concern
// the parameters of the laws, viscous and coulomb_length, and those of the fitted records:
// start_length, start_velocity, offset and tension, each with " of FILE" if there are several.
// Throws Refusal, config::Error for a constraint on an unknown parameter, and std::invalid_argument
// for an unknown law.
DynamicResult identify_dynamic(std::span<const DecayRecord> records, std::string_view model = "",
                               const Constraints& constraints = {});
std::vector<std::string> dynamic_models();

}  // namespace sinew::identify
