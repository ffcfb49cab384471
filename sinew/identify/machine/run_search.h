// identify/machine/run_search.h - search of run_fit.h: residuals of a run, coarse scan, and
// Gauss-Newton between the jumps of the dead times.
//
// A valve's pulse of length D is lost if D is not longer than the opening delay, a gap if it is not
// longer than the closing delay, and both are whole ticks. So a delay has cells, from tick to tick;
// the readings jump at their ends and are smooth within. The right cells are found by scan and by
// moving to neighbours; within them
//
//   (J^T J + mu D) step = -J^T r      of the parameters that no bound holds; the best of a few mu
//                                     is taken; D the diagonal of J^T J (Levenberg, Marquardt)
//
// Neighbouring cells that the run does not exclude are searched too. The last step is without
// bounds, along the tangent: this step and J^T J give the distribution within a cell; the lost
// pulses show that a delay is in it (below).
#pragma once

#include <atomic>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/numbers.h"
#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/identify/machine/run_fit.h"

namespace sinew::identify {

// Range of a parameter without jumps of the readings; unbounded without jumps.
struct RunCell {
  double low = -unbounded, high = unbounded;
};

inline constexpr double jump_clearance = 1e-7;  // simulated distance from a cell's end [s]

// Returns whether the parameter is the delay of a valve.
bool is_dead_time(const Parameter& number);

// Returns the cells that contain these values.
std::vector<RunCell> run_cells(std::span<const Parameter> parameters, std::span<const double> p);

// Residuals of a run over parameters of its machine. Calls are thread-safe.
class RunResiduals {
 public:
  // All arguments must outlive this object. Samples later than `until` [s] are not included.
  RunResiduals(const experiment::Experiment& machine, const DrivenRun& run,
               std::span<const Parameter> parameters, const RunFitOptions& options, double until);

  // Return the number of residuals: samples, then priors; and the end of the samples [s].
  std::size_t count() const { return fitted_.size() + options_.priors.size(); }
  double until() const { return until_; }
  // Returns the number of simulations so far.
  int simulations() const { return simulations_; }

  // Returns the description with these parameter values, of which the residuals were evaluated.
  experiment::Experiment machine(std::span<const double> p) const;
  // Writes (predicted - read)/noise. Returns false if the simulation fails.
  bool operator()(std::span<const double> p, std::span<double> r) const;
  // Returns whether a converter's limit clips the noise of that residual's reading, which reduces
  // it.
  bool is_cut(std::size_t k, double residual) const;
  // Returns half the sum of squared residuals; infinite if the simulation fails.
  double cost(std::span<const double> p) const;

 private:
  const experiment::Experiment& machine_;
  experiment::Numbers numbers_;  // the parameters in it
  const DrivenRun& run_;
  std::span<const Parameter> parameters_;
  const RunFitOptions& options_;
  std::vector<double> reading_, noise_, bottom_, top_;  // for each sample
  std::vector<std::size_t> fitted_;
  double until_ = 0;
  mutable std::atomic<int> simulations_ = 0;
};

// Result of a search.
struct RunSearched {
  std::vector<double> p;            // within the cells
  std::vector<RunCell> cells;       // cells of `p`
  double rms = 0;                   // rms of the residuals
  std::vector<RunSearched> others;  // in other cells that the run does not exclude
};

// Residuals that are this many times the noise [rms] show a wrong minimum, or another machine.
inline constexpr double far_above_noise = 5;

// Scans and searches with the beginning of the run, moves to neighbouring cells while the residuals
// exceed the noise, and ends with all of `whole`, where the result is never worse than the start.
RunSearched search_run(const RunResiduals& beginning, const RunResiduals& whole,
                       std::span<const Parameter> parameters, const RunFitOptions& options,
                       int threads);

// Makes at most `steps` Levenberg-Marquardt steps from `p`, within its cells.
RunSearched search_in_cells(const RunResiduals& residuals, std::span<const Parameter> parameters,
                            const std::vector<double>& p, int steps, int threads);

// Returns for each place half the sum of squares that would remain after all parameters are
// adjusted along the tangent at `at`: one simulation each shows which cells are worth a search.
std::vector<double> linearised_costs(const RunResiduals& residuals,
                                     std::span<const Parameter> parameters, const RunSearched& at,
                                     const std::vector<std::vector<double>>& places, int threads);

// Estimates of all parameters after a search. An interval is the middle 95 % over the cells that
// the run does not exclude (below).
struct RunJudged {
  std::vector<Estimate> estimates;
  std::vector<double> covariance;  // row by row; infinite for undetermined parameters
  double rms = 0;
  double standard_deviation = 0;  // standard deviation of the residuals
  double roughness = 0;           // relative difference of derivatives over a longer step
};
RunJudged judge_run(const RunResiduals& residuals, std::span<const Parameter> parameters,
                    const RunSearched& at, int threads);

// Returns combinations of parameters that the run does not determine, in words: along them changes
// as large as the parameters are compatible with the data. Parameters with such wide intervals are
// marked as not identifiable.
std::vector<std::string> open_directions(RunJudged& judged, std::span<const Parameter> parameters);

// --- derivatives of the readings ---

// Steps of derivatives, in the parameters' scales: that of the search, and a longer one that must
// agree.
inline constexpr double short_difference = 1e-4, long_difference = 2e-3;

// Residuals and their derivatives by the scaled parameters, at a point.
struct RunTangent {
  std::vector<double> r;
  Matrix j;
};

// Writes the tangent at p, with derivatives within the cells. Columns are forward differences:
// central ones need twice the simulations and gain nothing if another step follows. Returns false
// if a simulation fails.
bool run_tangent(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 std::span<const RunCell> cells, const std::vector<double>& p, int threads,
                 RunTangent& out, double by = short_difference);

// --- intervals over cells ---
//
// Distribution of parameters as a mixture of normal distributions, each within its own box: dead
// times have cells, and in each cell that the run does not exclude the readings give another
// distribution.
//
//   p(x)  ~  sum over the pieces of  exp(-c) exp(-|z|^2/2)  within the piece's box
//
//   x = middle + spread z      z of unit normals, spread upper triangular
//   c                          half the sum of squares at the piece's own minimum
//
// The middle 95 % of each parameter come from seeded draws, parameter after parameter within the
// remaining box, weighted with the box's probability (Geweke, Hajivassiliou, Keane).

// One of the distributions.
struct RunPiece {
  std::vector<double> middle;
  Matrix spread;             // its diagonal > 0
  std::vector<RunCell> box;  // for each parameter
  double cost = 0;           // c
};

// Returns the middle 95 % of each parameter; for a single distribution they are its middle -+
// `width` standard deviations. If they do not contain `value`, such as a value at the end of its
// box, they are the 95 % that reach up to it. `pieces` must not be empty.
std::vector<RunCell> middle_of_pieces(std::span<const RunPiece> pieces,
                                      std::span<const double> value, double width);

}  // namespace sinew::identify
