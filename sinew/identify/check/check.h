// identify/check/check.h - are these the data of a muscle, and what can they tell? Asked before a
// static law is fitted.
//
// A wrong unit, a wrong label or two muscles in one table fit some law, too; the parameters are
// then wrong without a word. What a braided muscle cannot do gives most of it away: pull harder
// when it is shorter, contract by half, pull without pressure, or more than its braid turns
// pressure into by the ideal law, [22] in the form of Tondu & Lopez 2000:
//
//   F = pi D^2 p / 4 (a (1 - e)^2 - b)     a = 3/tan^2(theta), b = 1/sin^2(theta)
//
//   F  tension [N]   D, theta  diameter [m] and angle of the braid at rest   p  gauge pressure [Pa]
//   e  contraction [-]
//
// Forces that are all too small by one factor look like those of a thinner muscle: nothing in the
// law has a size of its own but D. The diameter alone tells lbf from N, and is asked for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/actuator/static_data.h"
#include "sinew/units/constants.h"

namespace sinew::identify {

// Green: it was checked and is as it should be. Grey: these data do not allow the check. Yellow: a
// suspicion, or less than a good fit needs. Red: a fit would be wrong.
enum class Light { green, grey, yellow, red };

// One question that the data were asked.
struct Check {
  std::string name;  // "pressure unit"
  Light light = Light::green;
  std::string evidence;  // a sentence
  std::string advice;    // what to do; may be empty where it is green or grey

  // A fit does not warn of it: its own report tells it, by its notes and intervals, or these data
  // give no reason to doubt.
  bool told_by_fit = false;
};

// One file, and what is known beside its columns.
struct CheckedTable {
  Measured table;
  StaticInput known;
};

// What is asked: tables, and the points that a fit would take from them.
struct CheckInput {
  std::vector<CheckedTable> tables;       // as they were read
  StaticData data;                        // their points
  double zero = 0;                        // the largest force that was taken off [N]
  std::vector<Check> unreadable;          // red
  double diameter = 0;                    // of the muscle without pressure [m]; 0: not known
  double atmosphere = units::atmosphere;  // [Pa]
  std::optional<actuator::Braid> braid;   // known from elsewhere: then one length will do

  // Adds a table with its points. Throws Refusal where no method can read it.
  void add(CheckedTable table);

  // The same, but what no method can read becomes a red check, "readable".
  void add_or_tell(CheckedTable table);
};

// Answers every question that the points allow. Those that are held out are asked, too, but do not
// count where it is about how much was measured.
std::vector<Check> check_static(const CheckInput& input);

// Returns "green", "grey", "yellow" or "red".
std::string_view word(Light light);

// Returns true if one of them is red.
bool has_red(const std::vector<Check>& checks);

// Throws Refusal where checks are red, with the evidence of each and what to do, unless they are to
// be fitted `anyway`: then they are added to the warnings of the fit's report. So are suspicions;
// what the report tells anyway is not said twice.
void heed(const std::vector<Check>& checks, bool anyway, std::vector<std::string>& warnings);

}  // namespace sinew::identify
