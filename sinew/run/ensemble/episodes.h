// run/ensemble/episodes.h - many episodes of one task that differ in numbers and seeds and step
// together: in the lanes of the processor, on all cores.
//
//   Episodes legs(definition, ensemble, 64);
//   for (std::size_t i = 0; i < 64; ++i) legs.begin(i, seed, values);   // numbers of each, in SI
//   legs.step(actions, results);                 // runs to the start of the first step
//   legs.step(actions, results);                 // a step of all
//
// Each has the bits of a single episode (run/simulation/episode.h) of the experiment with these
// values, independent of the others, of lanes and of threads.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sinew/run/ensemble/ensemble.h"
#include "sinew/run/simulation/episode.h"

namespace sinew::run {

class Episodes {
 public:
  // `definition` is an episode of the ensemble's experiment. `threads`: 0: one per core.
  Episodes(std::shared_ptr<const Episode> definition, std::shared_ptr<const Ensemble> ensemble,
           std::size_t count, int threads = 0);
  ~Episodes();
  Episodes(const Episodes&) = delete;
  Episodes& operator=(const Episodes&) = delete;

  // Return the number of environments, the definition of their episodes, and the number of
  // parameters that each has.
  std::size_t count() const { return episodes_.size(); }
  const Episode& definition() const { return *definition_; }
  std::size_t parameters() const { return ensemble_->units().size(); }

  // Replaces episode i by another one with these values of the ensemble's parameters, in SI: the
  // next step runs it to its first step's start. Throws config::Error, without changes, if a value
  // is refused.
  void begin(std::size_t i, int seed, std::span<const double> values);

  // Results of a step, a row for each episode.
  struct Results {
    std::span<double> observed, measured;
    std::span<bool> ended;   // its plan has ended, or it has failed
    std::span<bool> failed;  // cause() has the reason
  };
  // Runs a step of all episodes, or to the ends of their plans; `actions` has a row of finite
  // numbers for each. An episode that has ended stays. Requires that all have begun.
  void step(std::span<const double> actions, const Results& results);

  // Returns why an episode failed; empty if it has not.
  std::string cause(std::size_t i) const;

 private:
  class Running;
  class Group;

  std::size_t width() const;
  void start(std::size_t i);
  void step_group(std::size_t g, std::span<const double> actions, const Results& results);

  std::shared_ptr<const Episode> definition_;
  std::shared_ptr<const Ensemble> ensemble_;
  int threads_;
  std::vector<std::unique_ptr<Group>> groups_;
  std::vector<std::unique_ptr<Running>> episodes_;
};

}  // namespace sinew::run
