// identify/actuator/static.h - the static law of an actuator from force, length and pressure: every
// model is tried, the data choose.
//
// Choice: each model predicts parts of the data it was not fitted to - pressures in four parts,
// lengths one by one, the lowest and the highest of both left in - and the one with the fewest
// parameters within 10 % of the smallest error (geometric mean over the kinds, and each) is taken.
// Of several muscles each is left out once, too: that is the third kind.
// A law of which a parameter stands at the bound of its range is none for the data and is not
// chosen. The end lengths, predicted by the others, are told apart: that is extrapolation. What is
// held out by the user (StaticPoint::fitted) has no part in it and tells how good the result is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/actuator/static_air.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_spread.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

// Which points judge the models: none; every second pressure, which is not fitted; each length
// once, all others fitted; each muscle once.
enum class HoldOut { none, pressure, length, muscle };

// Holds what is known besides the points, and which models are tried.
struct StaticOptions {
  std::string subject = "static law";
  double atmosphere = units::atmosphere;  // [Pa]
  std::optional<actuator::Braid> braid;   // known from elsewhere
  double volume = 0;                      // of the reference's air at rest [m3]; 0: unknown
  double diameter = 0;                    // of each muscle at rest [m]; 0: unknown
  std::string model;                      // this one alone; empty: all
  HoldOut hold_out = HoldOut::none;       // beside what the points say

  // Counts the laws that have been tried, for whoever watches; null: nobody does.
  host::Tally* tried = nullptr;
};

// One muscle's actuator, as a file would have it.
struct StaticMuscle {
  actuator::Actuator actuator;
  double rest_length = 0;  // as labelled [m]
  double file_length = 0;  // rest length with which the law misses its own rows least [m]
  double rms = 0, half_68 = 0, half_95 = 0;  // of what it misses them by [N]
  std::vector<double> lengths;     // that were fitted, as labelled, in ascending order [m]
  double lowest = 0, highest = 0;  // gauge pressures that were fitted [Pa]
};

// The models that were fitted, and the muscles of the chosen one.
struct StaticResult {
  Report report;
  std::vector<StaticMuscle> muscles;  // the reference, the longest, first
  StaticScales scales;
  StaticFit fit;                    // the chosen one, to all points that were to be fitted
  StaticSpread spread;              // how far it was off where it had not seen the points
  std::vector<StaticPoint> points;  // that were fitted
  AirAtRest air;                    // of the reference
};

// Throws Refusal where the data support no model, std::invalid_argument for a model that there is
// not.
StaticResult identify_static(const StaticData& data, const StaticOptions& options);

// Returns the file of one muscle, sinew.actuator/1: one of those that were fitted, or their like
// (static_predict.h). `source` says where the data are from.
std::string static_file(const StaticResult& result, const StaticMuscle& muscle,
                        const std::string& name, const std::string& source,
                        const std::string& braid_source);

}  // namespace sinew::identify
