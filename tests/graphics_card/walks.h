// Runs that are compared with those of a card: walks with other numbers in all their parts, and
// runs whose state hashes are in hashes.txt.
#pragma once

#include <array>
#include <deque>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/run/card/batch.h"
#include "sinew/run/ensemble/ensemble.h"
#include "tests/places.h"

namespace sinew::test {

// Walks of test 1, each with a seed of its own and one of sixteen sets of parameters of all parts:
// body, contacts, air, controllers and plan.
class VariedWalks {
 public:
  VariedWalks() : walks_(source_dir() + "/experiments/walk-test-1.toml", {}, keys(), {}) {}

  // Returns the walk with this seed, from 1 on.
  std::unique_ptr<run::Ensemble::Member> walk(int seed) const {
    std::vector<double> values = {static_cast<double>(seed)};
    for (std::size_t k = 0; k < varied_.size(); ++k)
      values.push_back(varied_[k].value(seed % 16, static_cast<int>(k)));
    return walks_.member(values);
  }
  // Returns a text that is equal for seeds with the same plan.
  static std::string plan(int seed) { return std::to_string(seed % 16); }

 private:
  // A parameter with sixteen values between two ends, in another order than those of other
  // parameters.
  struct Varied {
    const char* key;
    double low, high;  // in SI

    double value(int set, int number) const {
      return low + (high - low) * ((set * (2 * number + 3) + number) % 16) / 15.0;
    }
  };
  static constexpr std::array<Varied, 11> varied_ = {
      {{"trolley.drag", 3, 5},
       {"trolley.payload", 0, 2},
       {"joint.hip.dry_friction", 0, 0.3},
       {"joint.knee.damping", 0, 0.4},
       {"foot.friction", 0.3, 1},
       {"ground.normal_stiffness", 2e4, 8e4},
       {"air.supply.pressure", 6e5, 9e5},
       {"muscle.hip_flexor.bladder_stiffness", 100, 600},
       {"control.stiffness.hip", 2, 6},
       {"joint.knee.angle_gain", 0.0008, 0.0016},
       {"phase.swing.duration", 1.2, 1.6}}};

  static std::vector<std::string> keys() {
    std::vector<std::string> out = {"seed"};
    for (const Varied& v : varied_) out.emplace_back(v.key);
    return out;
  }

  run::Ensemble walks_;
};

// A row of hashes.txt.
struct HashedRun {
  std::string name, hash;
  experiment::Experiment experiment;
};

// Reads the file, whose rows are "HASH EXPERIMENT SETTING; SETTING".
inline std::deque<HashedRun> hashed_runs() {
  std::deque<HashedRun> out;
  std::ifstream file(source_dir() + "/tests/graphics_card/hashes.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string hash, name;
    words >> hash >> name;
    std::vector<std::string> sets;
    for (std::string set; std::getline(words >> std::ws, set, ';');) sets.push_back(set);
    out.push_back(
        {line, hash, experiment::load(source_dir() + "/experiments/" + name + ".toml", sets)});
  }
  if (out.empty()) throw std::runtime_error("tests/graphics_card/hashes.txt: no rows");
  return out;
}

}  // namespace sinew::test
