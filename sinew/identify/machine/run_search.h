// identify/machine/run_search.h - the search of run_fit.h: the residuals of a run, the coarse scan,
// and Gauss-Newton between the jumps of the dead times.
//
// A valve's pulse of D is lost where D is not longer than the opening delay, a gap where it is not
// longer than the closing delay, and both are whole ticks. So a delay has cells, from tick to tick,
// at whose ends the readings jump; within one they change smoothly. Which cells are the right ones
// is tried out, by scan and by moving to the neighbours; within them
//
//   (J^T J + mu D) step = -J^T r      of the numbers that no bound holds, a few mu at once, the
//   best
//                                     is taken; D the diagonal of J^T J (Levenberg, Marquardt)
//
// Where the run does not rule out neighbouring cells, these are searched too. The last step goes
// without bounds, along the tangent: it and J^T J give what the readings say within a cell, and
// that a delay is in it, the lost pulses say (run_mixture.h).
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/fit/matrix.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/identify/machine/run_fit.h"

namespace sinew::identify {

// Between which values of a number the readings do not jump; unbounded where they never do.
struct RunCell {
  double low = -unbounded, high = unbounded;
};

inline constexpr double off_the_jump = 1e-7;  // how near to a cell's end is simulated [s]

// Is it the delay of a valve?
bool is_dead_time(const Parameter& number);

// Returns the cells that these numbers stand in.
std::vector<RunCell> run_cells(std::span<const Parameter> parameters, std::span<const double> p);

// The residuals of a run over numbers of its machine. Asked from several threads at once.
class RunResiduals {
 public:
  // All of these outlive it. Samples later than `until` [s] are no part of it.
  RunResiduals(const experiment::Experiment& machine, const DrivenRun& run,
               std::span<const Parameter> parameters, const RunFitOptions& options, double until);

  // How many there are: the samples, then the priors.
  std::size_t count() const { return fitted_.size() + options_.priors.size(); }
  double until() const { return until_; }
  // Returns how many simulations there were.
  int simulations() const { return simulations_; }

  // Returns the description with these numbers in place of its own.
  experiment::Experiment machine(std::span<const double> p) const;
  // Writes (predicted - read)/noise. False where the machine has no answer.
  bool operator()(std::span<const double> p, std::span<double> r) const;
  // Does a converter's end cut the noise of that residual's reading? Such ones scatter less.
  bool is_cut(std::size_t k, double residual) const;
  // Returns half the sum of their squares; infinite where there is no answer.
  double cost(std::span<const double> p) const;

 private:
  const experiment::Experiment& machine_;
  const DrivenRun& run_;
  std::span<const Parameter> parameters_;
  const RunFitOptions& options_;
  std::vector<double> reading_, noise_, bottom_, top_;  // by sample
  std::vector<std::size_t> fitted_;
  double until_ = 0;
  mutable std::atomic<int> simulations_ = 0;
};

// Where a search has ended.
struct RunSearched {
  std::vector<double> p;            // within the cells
  std::vector<RunCell> cells;       // these numbers stand in
  double rms = 0;                   // of the residuals there
  std::vector<RunSearched> others;  // in cells that the run does not rule out either
};

// Scans and searches in the beginning of the run, moves to neighbouring cells while more than noise
// is left, and ends with all of `whole`.
RunSearched search_run(const RunResiduals& beginning, const RunResiduals& whole,
                       std::span<const Parameter> parameters, const RunFitOptions& options,
                       int threads);

// Levenberg's and Marquardt's steps from `p` on, within its cells; `steps` at most.
RunSearched search_in_cells(const RunResiduals& residuals, std::span<const Parameter> parameters,
                            const std::vector<double>& p, int steps, int threads);

// Returns for each of the places half the sum of squares that would be left there if all numbers
// made up for what the tangent at `at` can: one simulation each tells which cells are worth a
// search.
std::vector<double> made_up_costs(const RunResiduals& residuals,
                                  std::span<const Parameter> parameters, const RunSearched& at,
                                  const std::vector<std::vector<double>>& places, int threads);

// Holds what the run says of all numbers, at the end of a search. An interval is the middle 95 %
// of what the cells leave that the run does not rule out (run_mixture.h).
struct RunJudged {
  std::vector<Estimate> estimates;
  std::vector<double> covariance;  // row by row; of numbers that nothing is known of infinite
  double rms = 0;
  double standard_deviation = 0;  // of the residuals
  double roughness = 0;           // share by which derivatives over a longer step are others
};
RunJudged judge_run(const RunResiduals& residuals, std::span<const Parameter> parameters,
                    const RunSearched& at, int threads);

// Returns combinations of the numbers that the run leaves open, in words: along them the data bear
// a change as large as the numbers are. Numbers whose intervals are so wide are marked as not
// identifiable.
std::vector<std::string> open_directions(RunJudged& judged, std::span<const Parameter> parameters);

// --- the derivatives of the readings ---

// Steps of derivatives, in the parameters' scales: the search's, and a longer one that has to
// agree.
inline constexpr double short_difference = 1e-4, long_difference = 2e-3;

// The residuals about a point, by the scaled parameters.
struct RunTangent {
  std::vector<double> r;
  Matrix j;
};

// Writes the tangent at p, of derivatives within the cells. Its columns are forward differences: a
// central one costs a simulation more and gains nothing where the next step comes anyway. False
// where the machine has no answer.
bool run_tangent(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 std::span<const RunCell> cells, const std::vector<double>& p, int threads,
                 RunTangent& out, double by = short_difference);

}  // namespace sinew::identify
