// run/ensemble/many.h - many runs, of one ensemble or of several, in the lanes of the processor.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sinew/config/compose.h"
#include "sinew/run/ensemble/device.h"
#include "sinew/run/ensemble/ensemble.h"

namespace sinew::run {

// A run that is ready, and its ensemble.
struct BegunRun {
  std::shared_ptr<const Ensemble> ensemble;
  std::unique_ptr<Ensemble::Member> member;
};

struct Many {
  // Returns the number of the next run, if there is one. Must not throw.
  std::function<std::optional<std::size_t>()> next;
  // Returns that run. What it throws is the run's refusal.
  std::function<BegunRun(std::size_t)> begin;
  // Receives the results, in any order. Must not throw.
  std::function<void(std::size_t, RunResult)> done;
  int lanes = 8;  // largest number; 1: one after the other
  // Returns whether to begin no further run. May be absent.
  std::function<bool()> stopped = {};
  // Takes a sentence for the user. May be absent.
  std::function<void(const std::string&)> notice = {};
};
// Runs all in this thread (run/simulation/lanes.h). Each result has the wanted figures of the
// same single run.
void run_many(const Many& many);

// Runs all, `runs` in number, on a chosen device (device.h), with the results of run_many(). An
// automatic card is used for fewest_on_card runs or more. Runs that a card cannot make, or that
// fail on it, are made on threads of the processor. If an automatic card fails, the processor
// continues, with a notice. Throws std::runtime_error if a named card fails, and WrongBits.
void run_on(const Device& device, std::size_t runs, const Many& many, int threads);

// Fewer runs than this are faster on the processor than on a card.
inline constexpr std::size_t fewest_on_card = 100;

// Returns the number of lanes per thread, at most `most`, with which all threads have runs.
int lanes_of(std::size_t runs, std::size_t threads, int most);

// The ensembles of runs that are given as files with settings: runs that differ only in numbers
// form one. Threads may use it at the same time.
class Ensembles {
 public:
  // The keys of the figures that are needed of each run.
  explicit Ensembles(std::vector<std::string> figures, bool allow_unreachable = false)
      : figures_(std::move(figures)), allow_unreachable_(allow_unreachable) {}

  // Returns the run of an experiment's file with settings "key=value". Throws config::Error if it
  // is refused.
  BegunRun begin(const std::string& experiment, const std::vector<std::string>& sets);

  // Runs an experiment's file with settings. The status gives the reason if there are no figures.
  RunResult run_once(const std::string& experiment, const std::vector<std::string>& sets);

 private:
  struct Split;

  std::shared_ptr<const Ensemble> ensemble(const std::string& experiment, Split& split);

  std::vector<std::string> figures_;
  bool allow_unreachable_;
  config::Composer files_;
  std::mutex mutex_;  // guards what follows
  std::map<std::vector<std::string>, std::shared_ptr<const Ensemble>> ensembles_;
  std::set<std::pair<std::string, std::string>> fixed_;  // keys without a number, by file
};

// Runs an experiment's file with settings; the result has all figures.
RunResult run_once(const std::string& experiment, const std::vector<std::string>& sets,
                   bool allow_unreachable = false);

}  // namespace sinew::run
