// identify/check/checkup.h - summary of measurements before a static law is fitted: checks, what
// was recognised, and which parameters of a static law the data determine.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/check/check.h"
#include "sinew/identify/check/recognised.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Source of a parameter's value.
enum class Determination {
  by_data,       // interval less than half of the value
  by_priors,     // value near that of other muscles
  at_bound,      // end of its range: the data show no such effect
  undetermined,  // compatible with zero, or no measurement depends on it
};

// One parameter of the law.
struct Determined {
  std::string name, unit;
  double value = 0, half_width = 0;  // half of its 95 % interval [unit]; infinite: unknown
  Determination by = Determination::undetermined;
  std::string words;   // "to +-3.1 %"
  std::string advice;  // measurement that would determine it; empty if the data do
};

// The richest law, fitted to these data.
struct DeterminedLaw {
  std::string model, law;  // "saturating-effectiveness", and its equation
  std::vector<Determined> parameters;
  std::string refused;  // why no fit is possible; empty: it is
};

// Fits the richest law to the points that are to be fitted. Bad data throw nothing.
DeterminedLaw determine(const CheckInput& input);

// Returns "data", "priors", "bound" or "nothing".
std::string_view word(Determination by);

// Checks, what was recognised, and the parameters that the data determine; these are left out if a
// check is red.
struct Checkup {
  std::vector<Check> checks;
  Recognised recognised;
  DeterminedLaw determined;
};

// Makes the whole summary. Bad data throw nothing.
Checkup check_up(const CheckInput& input);

// Returns the output of `sinew identify check --json`, sinew.check/1.
Json to_json(const Checkup& checkup);

}  // namespace sinew::identify
