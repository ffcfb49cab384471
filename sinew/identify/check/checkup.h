// identify/check/checkup.h - all that can be said of measurements before a static law is fitted.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/check/check.h"
#include "sinew/identify/check/determined.h"
#include "sinew/identify/check/recognised.h"
#include "sinew/json/json.h"

namespace sinew::identify {

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
