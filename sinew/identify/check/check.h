// identify/check/check.h - plausibility checks of muscle data, made before a static law is fitted.
//
// Some law fits even data with a wrong unit, a wrong label or two muscles in one table, and its
// parameters are wrong without a warning. Most such errors show as behaviour that is impossible for
// a braided muscle: pulling harder when shorter, contracting by half, pulling without pressure, or
// pulling harder than the ideal law of its braid allows, [22] in the form of Tondu & Lopez 2000:
//
//   F = pi D^2 p / 4 (a (1 - e)^2 - b)     a = 3/tan^2(theta), b = 1/sin^2(theta)
//
//   F  tension [N]   D, theta  diameter [m] and angle of the braid at rest   p  gauge pressure [Pa]
//   e  contraction [-]
//
// Forces that are all too small by one factor equal those of a thinner muscle, as D is the only
// absolute size in the law. Only the diameter distinguishes lbf from N, so the user is requested to
// give it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/units/constants.h"

namespace sinew::identify {

// green: checked and correct. grey: not possible with these data. yellow: a suspicion, or too few
// data for a good fit. red: a fit would be wrong.
enum class TrafficLight { green, grey, yellow, red };

// Result of one check.
struct Check {
  std::string name;  // "pressure unit"
  TrafficLight light = TrafficLight::green;
  std::string evidence;  // a sentence
  std::string advice;    // advice; may be empty if green or grey

  // A fit does not repeat this as a warning: its own notes and intervals show it, or these data
  // give no reason for doubt.
  bool shown_by_fit = false;
};

// One file, and its properties that are not in the columns.
struct CheckedTable {
  Measured table;
  StaticInput known;
};

// Input of the checks: tables, and the points that a fit would take from them.
struct CheckInput {
  std::vector<CheckedTable> tables;       // as they were read
  StaticData data;                        // their points
  double zero = 0;                        // largest force that was subtracted [N]
  std::vector<Check> unreadable;          // red
  double diameter = 0;                    // diameter of the muscle without pressure [m]; 0: unknown
  double atmosphere = units::atmosphere;  // [Pa]
  std::optional<actuator::Braid> braid;   // if known, one length is enough

  // Adds a table with its points. Throws Refusal if no method can read it.
  void add(CheckedTable table);

  // Adds a table like add(), but turns a Refusal into a red check, "readable".
  void add_or_report(CheckedTable table);
};

// Makes every check that the points allow. Points that are held out are included, except where the
// amount of data is checked.
std::vector<Check> check_static(const CheckInput& input);

// Returns "green", "grey", "yellow" or "red".
std::string_view word(TrafficLight light);

// Returns whether a check is red.
bool has_red(const std::vector<Check>& checks);

// Throws Refusal if checks are red, with the evidence and advice of each, unless `anyway`:
// then they are added to the warnings of the fit's report. Yellow checks are added too, except
// those that the report itself shows.
void apply_checks(const std::vector<Check>& checks, bool anyway,
                  std::vector<std::string>& warnings);

}  // namespace sinew::identify
