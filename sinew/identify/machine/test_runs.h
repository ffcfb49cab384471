// identify/machine/test_runs.h - runs for the tests of this folder: shipped experiments with
// changed parameters.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/numbers.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::identify {

inline experiment::Experiment shipped(const std::string& name,
                                      const std::vector<std::string>& sets = {}) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

inline signals::Table recorded(const experiment::Experiment& e) { return run::run(e).table; }

inline double number_at(const experiment::Experiment& e, const std::string& key) {
  const experiment::Numbers numbers(e, {key});
  if (!numbers.has(0)) throw std::out_of_range(key);
  return numbers.values()[0];
}

inline void set_number(experiment::Experiment& e, const std::string& key, double value) {
  if (!experiment::Numbers(e, {key}).set(e, std::span(&value, 1))) throw std::out_of_range(key);
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
