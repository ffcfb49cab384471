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
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/actuator/static_data.h"

namespace sinew::identify {

// Green: as it should be. Yellow: a suspicion, or less than a good fit needs. Red: a fit would be
// wrong.
enum class Light { green, yellow, red };

// One question that the data were asked.
struct Check {
  std::string name;  // "pressure unit"
  Light light = Light::green;
  std::string evidence;  // a sentence
  std::string advice;    // what to do; empty where it is green
};

// One file, and what is known beside its columns.
struct CheckedTable {
  Measured table;
  StaticInput known;
};

// Answers every question that the tables allow. `diameter` is that of the muscle without pressure
// [m], 0: not known. Throws nothing for what the tables hold: what no method can read is a red
// check, "readable".
std::vector<Check> check_static(const std::vector<CheckedTable>& tables, double diameter = 0);

// Returns "green", "yellow" or "red".
std::string_view word(Light light);

// Returns true if one of them is red.
bool has_red(const std::vector<Check>& checks);

}  // namespace sinew::identify
