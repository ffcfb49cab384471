// identify/contest/contest.h - comparison of the laws of a method: each is fitted to the rows,
// predicts rows that it was not fitted to, and is scored on both.
//
// A candidate is a formula over the rows with its free parameters. All else is common to the
// methods and is here: the search from several starts, the scores, the band that contains rows left
// out of the fit, the refusal of parameters at their bounds, and the profiles (fit.h: conclude()).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/least_squares.h"

namespace sinew::identify {

// Writes the value of a law at every row, for the parameters p. Returns false if the law is not
// defined there. Objects that it refers to must live until conclude() returns.
using Prediction = std::function<bool(std::span<const double> p, std::span<double> values)>;

// A law to be compared.
struct Candidate {
  std::string model, law, source;  // as in Fit
  std::vector<Parameter> parameters;
  Prediction predict;
  std::vector<std::vector<double>> starts;  // the best solution is used; empty: Parameter::start
  double search_tolerance = 1e-6;  // tolerance of the searches from the starts; the best is refined
  int search_steps = 0;            // largest number of steps of each search; 0: as in the options
  SolverOptions options;
  Constraints constraints;
  std::vector<std::string_view> may_be_at_bound;  // parameters with a meaning there
  bool may_be_at_bounds = false;                  // all of them have one
  std::string refused;                            // reason known before a fit; empty: it is fitted
  std::vector<std::string> notes;                 // as in Fit

  // Fits the law in a way of its own, instead of `predict` to the rows of the trial, and writes all
  // of the result. Throws Refusal. Empty: `predict` is fitted.
  std::function<void(Fit& out)> fit;

  // Returns predicted - measured for data that take more than the rows of a split, such as a
  // recording with a start of its own, by the solution for all rows. Empty: the splits are used.
  std::function<std::vector<double>(const Solution& whole)> left_out;
  // Corrects the solution, whose rivals are those of all starts. Throws Refusal if it is useless.
  std::function<void(const FitProblem& problem, std::span<const Solution> all, Solution& best)>
      finish;
};

// Throws config::Error if their constraints name a parameter that no candidate has.
void check_constraints(std::span<const Candidate> candidates);

// Widens the intervals of a solution with values at their bounds: these values then count as free.
// Values within `inside` scales of a bound are treated alike, as noise of the data may determine
// the derivatives there.
void widen_at_bounds(const FitProblem& problem, Solution& s, double inside = 0);

// Returns the solution for all rows.
Solution solve(const Candidate& candidate, const std::vector<double>& measured);

// Returns the names of laws.
template <class Laws>
std::vector<std::string> names_of_laws(const Laws& laws) {
  std::vector<std::string> out;
  for (const auto& law : laws) out.emplace_back(law.name);
  return out;
}

// Indices of rows that a law is fitted to, and of rows that it then predicts.
struct Split {
  std::vector<std::size_t> fitted, held_out;
};

// Returns a split for each part that leaves out its rows. `part` is the part of each row.
std::vector<Split> each_part_held_out(std::span<const int> part);
// Returns a split for each row that leaves it out.
std::vector<Split> each_row_held_out(std::size_t rows);

// Rows that all candidates are fitted to and tested on.
struct Trial {
  std::vector<double> measured;            // at every row
  std::vector<double> weights, variances;  // one per row, as in SolverOptions; empty: readings
  std::vector<std::size_t> rows;           // fitted rows; empty: all
  std::vector<Split> splits;

  // true: the splits give the errors for the choice (Fit::cross_validated); false: they give one
  // score of held-out rows (Fit::held_out).
  bool cross_validates = false;
  std::string band_where;  // condition of the band, e.g. "while the pressure rests"; empty: none
  bool has_band = true;
  bool shows_left_out = false;  // residuals of Candidate::left_out follow those of the rows

  std::string_view model = "";  // the only law to try; empty: all
};

// Fits the candidates on all cores and appends them to the report, whose full scale is set. A
// candidate that throws Refusal is entered as refused. `done` counts the laws that have been tried.
// Throws std::invalid_argument if none has the name Trial::model.
void fit_candidates(std::vector<Candidate> candidates, const Trial& trial, Report& report,
                    host::Tally* done = nullptr);

}  // namespace sinew::identify
