// run/ensemble/ensemble.h - many runs of one experiment that differ in some of its numbers: numbers
// in, figures out.
//
//   Ensemble walks("experiments/walk-test-1.toml", {}, {"joint.hip.damping", "seed"},
//                  {"trolley.distance_m"});
//   walks.run(values, figures);                // a row of each per run, in SI
//
// The file is read and checked once. A run then records only the channels that its figures are
// computed from, and has the bits of `sinew run` with the same values. A run whose values need the
// file to be read again, or whose figures need other channels, is done like that: all figures and
// refusals are those of a single run.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/selection.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/numbers.h"
#include "sinew/run/ensemble/device.h"
#include "sinew/run/simulation/run.h"
#include "sinew/units/constants.h"

namespace sinew::run {

// A run and its result, as `sinew run` would report it.
struct RunResult {
  std::string status = "ok";  // the reason if there are no figures
  analysis::Summary summary;  // empty unless the status is "ok"; of an ensemble's run, the wanted
                              // figures
  double atmosphere = units::atmosphere;
  bool no_air = false;               // no muscle took air, whatever was commanded
  std::vector<std::string> differs;  // reported keys with the verdict "differs"

  // Returns whether there are figures.
  bool ok() const { return status == "ok"; }
};

class Ensemble {
 public:
  // Reads the experiment with these settings, "key=value". `parameters` are keys of numbers, whole
  // numbers included; `figures` are keys of summary.json. Throws config::Error if the experiment
  // is refused, or if a parameter does not exist, is not a number or is
  // given twice.
  Ensemble(const std::string& experiment, const std::vector<std::string>& sets,
           std::vector<std::string> parameters, std::vector<std::string> figures,
           bool allow_unreachable = false);

  // Returns the unit of each parameter in SI; "" for a whole number.
  const std::vector<std::string>& units() const { return start_.numbers.units(); }

  struct Options {
    int threads = 0;                                      // 0: one per core
    int lanes = 8;                                        // runs side by side in a thread, at most
    Device device = {};                                   // the processor or a card
    std::function<void(const std::string&)> notice = {};  // takes a sentence about a card
    const std::atomic<bool>* stop = nullptr;              // true: no further runs are begun
    std::atomic<std::int64_t>* progress = nullptr;        // completed runs
  };
  // Runs one experiment per row of `values` (parameters, in SI) and writes its figures (in SI; NaN:
  // the run has no such figure) to the row of `figures`. Returns the status of each run: "ok", or
  // why it has no figures; "not run" after a stop. The results do not depend on threads, lanes,
  // device and other rows. Several threads may call it. Throws std::invalid_argument if the sizes
  // do not match, std::runtime_error for a card that cannot be used, and config::Error for a
  // probably misspelt figure, which the first runs find.
  std::vector<std::string> run(std::span<const double> values, std::span<double> figures,
                               const Options& options) const;
  std::vector<std::string> run(std::span<const double> values, std::span<double> figures) const {
    return run(values, figures, Options{});
  }

  // --- for a loop of your own (run/ensemble/many.h) ---

  // A run that is ready to begin.
  struct Member {
    experiment::Experiment experiment;
    analysis::Machine machine;
    std::shared_ptr<const analysis::Selection> selection;  // its topics are recorded; empty: all
    bool is_set = false;  // its numbers were set in a copy of another run's experiment
    std::vector<std::string> values = {};  // texts of its parameters
  };

  // Reads an experiment through files that were read before, which must outlive the ensemble.
  // `values` are texts of the parameters, with which it is read first.
  Ensemble(config::Composer& files, const std::string& experiment, std::vector<std::string> sets,
           std::vector<std::string> parameters, const std::vector<std::string>& values,
           std::vector<std::string> figures, bool allow_unreachable);

  // Returns the experiment as it was read first.
  const experiment::Experiment& example() const { return start_.experiment; }

  // Returns the parameters that do not exist or are not numbers.
  std::vector<std::string> unknown() const;

  // Returns the run with these values, texts with units. Throws config::Error if it is refused.
  std::unique_ptr<Member> member(const std::vector<std::string>& values) const;
  // Returns the run with these values in SI.
  std::unique_ptr<Member> member(std::span<const double> values) const;
  // Keeps the memory of a member that is no longer needed for another one.
  void keep(std::unique_ptr<Member> member) const;
  // Returns what the figures are computed from, once a run has found it; else nullptr.
  std::shared_ptr<const analysis::Selection> selection() const;
  // Returns a text that is equal for members with the same plan, and with the same robot as far as
  // its gait controller uses it.
  std::string plan_of(const Member& member) const;
  // Returns the result of a run, with all figures or with the wanted ones, and keeps the member's
  // memory for another one.
  RunResult result(std::unique_ptr<Member> member, const Outcome& outcome) const;

 private:
  // The experiment as it was read first.
  struct Start {
    experiment::Experiment experiment;
    analysis::Machine machine;
    experiment::Numbers numbers;
    std::vector<std::string> values;
  };

  std::unique_ptr<Member> read(const std::vector<std::string>& values) const;
  std::unique_ptr<Member> set(std::span<const double> values) const;
  std::unique_ptr<Member> member(std::span<const double> values,
                                 const std::vector<std::string>& texts) const;
  std::unique_ptr<Member> member_with(std::span<const double> values,
                                      const std::vector<std::string>& texts) const;
  std::unique_ptr<Member> spare() const;
  void find_plan_parameters() const;
  Device device_of(const Device& wanted, std::size_t rows) const;
  bool reads() const;
  analysis::Summary figures_of(const Member& member, const Outcome& outcome, bool& no_air) const;
  void check_figures(const analysis::Summary& whole) const;
  analysis::Summary figures_as_it_is() const;
  std::exception_ptr misspelt() const;
  bool is_compared(std::span<const double> values) const;
  void compare(const Member& set, const Member& read, std::span<const double> values) const;
  Start start(const std::vector<std::string>& values) const;

  std::unique_ptr<config::Composer> own_;
  config::Composer* files_;
  std::string experiment_;
  std::vector<std::string> sets_, parameters_, figures_;
  bool allow_unreachable_;
  Start start_;

  // Found by the first runs.
  mutable std::mutex mutex_;
  mutable std::vector<bool> compared_;   // parameters that were read and set with equal results
  mutable bool reads_ = false;           // they differed: the file is read for every run
  mutable std::exception_ptr misspelt_;  // refusal of a figure
  mutable std::shared_ptr<const analysis::Selection> selection_;
  mutable Device device_;              // the last one, with its card
  mutable std::vector<bool> of_plan_;  // parameters that the gait controller uses; empty: not found
  mutable std::vector<std::unique_ptr<Member>> spare_;
};

}  // namespace sinew::run
