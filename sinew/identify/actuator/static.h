// identify/actuator/static.h - identification of an actuator's static law from force, length and
// pressure. Every model is fitted, and the data choose one.
//
// Choice: each model predicts parts of the data that it was not fitted to: pressures in four
// parts and lengths one by one, both without the lowest and the highest, and each muscle in turn
// if there are several. The model with the fewest parameters within 10 % of the smallest error
// (geometric mean over these kinds, and each kind) is chosen. A law with a parameter at the
// bound of its range does not describe the data and is not chosen.
//
// The end lengths, predicted from the others, are reported separately, as extrapolation. Points
// held out by the user (StaticPoint::fitted) take no part in the choice and test the result.
//
// One length between the ends of one muscle, or none, does not test the form of a law over the
// length. Then a law whose bladder saturates is chosen, if one fits about as well as the best: on
// the muscles that were measured so far these laws are nearest to lengths that were left out.
// Without any length between the ends it is the one with the smallest error: pressures do not show
// which parameter the lengths between them need.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/actuator/static_air.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_spread.h"
#include "sinew/identify/contest/fit.h"

namespace sinew::identify {

// Points that are held out to test the models: no points; every second pressure, which is then not
// fitted; each length in turn; each muscle in turn.
enum class HoldOut { none, pressure, length, muscle };

// Known quantities, and the models that are tried.
struct StaticOptions {
  std::string subject = "static law";
  double atmosphere = units::atmosphere;  // [Pa]
  std::optional<actuator::Braid> braid;   // known braid, not fitted
  double volume = 0;                      // air of the reference muscle at rest [m3]; 0: unknown
  double diameter = 0;                    // diameter of each muscle at rest [m]; 0: unknown
  std::string model;                      // the only model to try; empty: all
  HoldOut hold_out = HoldOut::none;       // in addition to StaticPoint::fitted

  // Counts the laws that have been tried, for a progress display; may be null.
  host::Tally* tried = nullptr;
};

// Actuator of one muscle, as it is written into its file.
struct StaticMuscle {
  actuator::Actuator actuator;
  double rest_length = 0;  // as labelled [m]
  double file_length = 0;  // rest length with the smallest error on its own rows [m]
  double rms = 0, half_68 = 0, half_95 = 0;  // error on its own rows [N]
  std::vector<double> lengths;               // fitted lengths as labelled, ascending [m]
  double lowest = 0, highest = 0;            // fitted gauge pressures [Pa]
};

// Fitted models, and the muscles of the chosen one.
struct StaticResult {
  Report report;
  std::vector<StaticMuscle> muscles;  // the reference, which is the longest, first
  StaticFit fit;                      // chosen law, fitted to all points that are not held out
  StaticSpread spread;                // errors on points that it was not fitted to
  std::vector<StaticPoint> points;    // fitted points
  AirAtRest air;                      // air of the reference muscle
};

// Identifies the static law. Throws Refusal if the data support no model or the model's name is
// unknown.
StaticResult identify_static(const StaticData& data, const StaticOptions& options);

// Fills in the report's curves, errors and left_out: the chosen law along each curve with its
// intervals, its error by part, and the points that were left out. Its rows and the chosen law must
// be set.
void show_static(const StaticSplit& split, std::span<const StaticOmitted> left_out,
                 StaticResult& result);

// Returns the file of one muscle, sinew.actuator/1: a fitted muscle, or a similar one
// (static_predict.h). `source` describes the origin of the data.
std::string static_file(const StaticResult& result, const StaticMuscle& muscle,
                        const std::string& name, const std::string& source,
                        const std::string& braid_source);

}  // namespace sinew::identify
