// identify/machine/test_runs.h - runs for the tests of this folder: shipped experiments with
// changed parameters.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/experiment.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::identify {

inline experiment::Experiment shipped(const std::string& name,
                                      const std::vector<std::string>& sets = {}) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

inline signals::Table recorded(const experiment::Experiment& e) { return run::run(e).table; }

inline double& number_at(experiment::Experiment& e, const std::string& key) {
  for (const MachineNumber& n : machine_numbers(e))
    if (n.key == key) return *n.value;
  throw std::out_of_range(key);
}

inline void set_number(experiment::Experiment& e, const std::string& key, double value) {
  number_at(e, key) = value;
}

template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

}  // namespace sinew::identify
