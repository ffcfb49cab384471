// identify/fit/contest.h - the laws of a method are compared: each is fitted to the rows,
// predicts rows that it was not fitted to, and is scored on both.
//
// A candidate is a formula over the rows with its free parameters. All else is the same for every
// method and is here: the search from several starts, the scores, the band that holds what was not
// fitted, the refusal of parameters at their bounds, and the profiles (fit.h: conclude()).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

// Writes what a law has at every row, of the parameters p. Returns false where it has no answer.
// The things it refers to must live until conclude() returns.
using Prediction = std::function<bool(std::span<const double> p, std::span<double> values)>;

// A law of a contest.
struct Candidate {
  std::string model, law, source;  // as in Fit
  std::vector<Parameter> parameters;
  Prediction predict;
  std::vector<std::vector<double>> starts;  // the best counts; empty: the parameters' own
  SolverOptions options;
  std::vector<std::string_view> may_be_at_bound;  // parameters that mean something there
  std::string refused;                            // known before a fit; empty: it is fitted
};

// Rows that a law is fitted to, by number, and rows that it then predicts.
struct Split {
  std::vector<std::size_t> fitted, unseen;
};

// Returns a split for each part, in which its rows are unseen. `part` has the part of each row.
std::vector<Split> each_part_unseen(std::span<const int> part);
// Returns a split for each row, which is unseen in it.
std::vector<Split> each_row_unseen(std::size_t rows);

// Holds the rows that all candidates are fitted to and tried on.
struct Trial {
  std::vector<double> measured;   // at every row
  std::vector<std::size_t> rows;  // those that are fitted; empty: all
  std::vector<Split> splits;

  // The splits make errors for the choice (Fit::cross_validated), rather than one score of rows
  // that were held out (Fit::held_out).
  bool cross_validates = false;
  std::string band_where;  // the band holds there: "while the pressure rests"; empty: everywhere
};

// Fits the candidates on all cores and appends them to the report, whose full scale is set; what a
// Refusal stops is refused. `done` counts the laws that have been tried.
void contend(const std::vector<Candidate>& candidates, const Trial& trial, Report& report,
             host::Tally* done = nullptr);

}  // namespace sinew::identify
