// identify/check/checkup.h - everything that measurements show before a static law is fitted:
// checks, what was recognised, and which parameters of a static law the data determine.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/check/check.h"
#include "sinew/identify/check/recognised.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// What is known of a parameter.
enum class Determination {
  by_data,     // to less than half of its value
  by_priors,   // it stays about where other muscles have it
  at_bound,    // at the end of its range: the data show no such effect
  not_at_all,  // zero would do as well, or nothing was measured that depends on it
};

// One parameter of the law.
struct Determined {
  std::string name, unit;
  double value = 0, half_width = 0;  // of its 95 % interval [unit]; infinite: none
  Determination by = Determination::not_at_all;
  std::string words;   // "to +-3.1 %"
  std::string advice;  // the measurement that would tell it; empty where the data do
};

// The richest law, on these data.
struct DeterminedLaw {
  std::string model, law;  // "saturating-effectiveness", and its equation
  std::vector<Determined> parameters;
  std::string refused;  // why nothing can be said; empty: it can
};

// Fits the richest law to the points that are to be fitted. Throws nothing for what they hold.
DeterminedLaw determine(const CheckInput& input);

// Returns "data", "priors", "bound" or "nothing".
std::string_view word(Determination by);

// Checks, what was recognised, and which parameters the data can tell; of those nothing is said
// where a check is red.
struct Checkup {
  std::vector<Check> checks;
  Recognised recognised;
  DeterminedLaw determined;
};

// Asks everything. Throws nothing for what the tables hold.
Checkup check_up(const CheckInput& input);

// Returns it as `sinew identify check --json` prints it, sinew.check/1.
Json to_json(const Checkup& checkup);

}  // namespace sinew::identify
