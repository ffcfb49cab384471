#include "sinew/identify/contest/contest.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

using Rowset = std::vector<std::size_t>;

// Returns the problem of fitting the candidate to these rows.
FitProblem problem_of(const Candidate& candidate, const std::vector<double>& measured,
                      const Rowset& rows) {
  auto residuals = [predict = candidate.predict, measured, rows,
                    values = std::vector<double>(measured.size())](std::span<const double> p,
                                                                   std::span<double> r) mutable {
    if (!predict(p, values)) return false;
    for (std::size_t i = 0; i < rows.size(); ++i) r[i] = values[rows[i]] - measured[rows[i]];
    return true;
  };
  return {.residuals = std::move(residuals),
          .count = rows.size(),
          .parameters = candidate.parameters,
          .options = candidate.options,
          .constraints = {}};
}

void start_at(const Solution& solution, FitProblem& problem) {
  for (std::size_t i = 0; i < problem.parameters.size(); ++i)
    problem.parameters[i].start = solution.values[i];
}

// Returns predicted - measured at every row.
std::vector<double> misses(const Candidate& candidate, const std::vector<double>& measured,
                           std::span<const double> p) {
  std::vector<double> out(measured.size());
  if (!candidate.predict(p, out)) throw Refusal("model", "no value", "a value at every row", "");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= measured[i];
  return out;
}

std::vector<double> at(const std::vector<double>& values, const Rowset& rows) {
  std::vector<double> out;
  for (const std::size_t i : rows) out.push_back(values[i]);
  return out;
}

// Returns the residuals of the rows that each split leaves out. A split that leaves out no fitted
// row needs no fit.
std::vector<double> left_out_residuals(const Candidate& candidate, const Trial& trial,
                                       const Rowset& rows, const Solution& whole) {
  std::vector<double> out;
  for (const Split& split : trial.splits) {
    Solution part = whole;
    if (split.fitted != rows) {
      FitProblem problem = problem_of(candidate, trial.measured, split.fitted);
      start_at(whole, problem);
      problem.options.tolerance = std::max(problem.options.tolerance, 1e-12);
      part = least_squares(problem.residuals, problem.count, problem.parameters, problem.options);
    }
    const auto left = at(misses(candidate, trial.measured, part.values), split.held_out);
    out.insert(out.end(), left.begin(), left.end());
  }
  return out;
}

Fit fit_of(const Candidate& candidate, const Trial& trial, double full_scale) {
  Fit out{.model = candidate.model, .law = candidate.law, .source = candidate.source};
  out.refused = candidate.refused;
  if (!out.refused.empty()) return out;
  Rowset rows = trial.rows;
  if (rows.empty()) {
    rows.resize(trial.measured.size());
    std::iota(rows.begin(), rows.end(), 0);
  }
  try {
    FitProblem problem = problem_of(candidate, trial.measured, rows);
    if (!candidate.starts.empty()) {
      SolverOptions roughly = problem.options;
      roughly.tolerance = std::max(roughly.tolerance, 1e-6);
      start_at(least_squares_from(problem.residuals, problem.count, problem.parameters,
                                  candidate.starts, roughly),
               problem);
    }
    Solution found =
        least_squares(problem.residuals, problem.count, problem.parameters, problem.options);
    out.parameters = found.estimates;
    out.fit = score(found.residuals, full_scale);
    out.residuals = misses(candidate, trial.measured, found.values);
    if (!trial.splits.empty()) {
      const std::vector<double> left = left_out_residuals(candidate, trial, rows, found);
      (trial.cross_validates ? out.cross_validated : out.held_out) = score(left, full_scale);
      out.band = band_of(left, trial.band_where);
    }
    keep_off_bounds(out, candidate.may_be_at_bound);
    out.refit = std::make_shared<Refit>(std::move(problem), std::move(found));
  } catch (const Refusal& refusal) {
    out.refused = refusal.what();
  }
  return out;
}

}  // namespace

std::vector<Split> each_part_held_out(std::span<const int> part) {
  std::vector<Split> out;
  const int parts = part.empty() ? 0 : 1 + *std::ranges::max_element(part);
  for (int k = 0; k < parts; ++k) {
    Split split;
    for (std::size_t i = 0; i < part.size(); ++i)
      (part[i] == k ? split.held_out : split.fitted).push_back(i);
    out.push_back(std::move(split));
  }
  return out;
}

std::vector<Split> each_row_held_out(std::size_t rows) {
  std::vector<int> part(rows);
  std::iota(part.begin(), part.end(), 0);
  return each_part_held_out(part);
}

void fit_candidates(const std::vector<Candidate>& candidates, const Trial& trial, Report& report,
                    host::Tally* done) {
  const std::size_t before = report.fits.size();
  report.fits.resize(before + candidates.size());
  host::side_by_side(
      candidates.size(),
      [&](std::size_t k) {
        report.fits[before + k] = fit_of(candidates[k], trial, report.full_scale);
      },
      done);
}

}  // namespace sinew::identify
