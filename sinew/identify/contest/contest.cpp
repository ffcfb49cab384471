#include "sinew/identify/contest/contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "sinew/identify/contest/bounds.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

using Rowset = std::vector<std::size_t>;

std::vector<double> at(const std::vector<double>& values, const Rowset& rows) {
  std::vector<double> out;
  for (const std::size_t i : rows) out.push_back(values[i]);
  return out;
}

// Returns the problem of fitting the candidate to these rows.
FitProblem problem_of(const Candidate& candidate, const Trial& trial, const Rowset& rows) {
  const std::vector<double>& measured = trial.measured;
  auto residuals = [predict = candidate.predict, measured, rows,
                    values = std::vector<double>(measured.size())](std::span<const double> p,
                                                                   std::span<double> r) mutable {
    if (!predict(p, values)) return false;
    for (std::size_t i = 0; i < rows.size(); ++i) r[i] = values[rows[i]] - measured[rows[i]];
    return true;
  };
  FitProblem out{.residuals = std::move(residuals),
                 .count = rows.size(),
                 .parameters = candidate.parameters,
                 .options = candidate.options,
                 .constraints = candidate.constraints};
  if (!trial.weights.empty()) {
    out.options.weights = at(trial.weights, rows);
    out.options.variances = at(trial.variances, rows);
  }
  return out;
}

Rowset all_of(const std::vector<double>& measured) {
  Rowset out(measured.size());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

// Returns the solutions from the candidate's starts.
std::vector<Solution> solutions_of(const Candidate& candidate, FitProblem problem) {
  SolverOptions& options = problem.options;
  options.tolerance = std::max(options.tolerance, candidate.search_tolerance);
  if (candidate.search_steps > 0) options.most_steps = candidate.search_steps;
  return solutions_from(candidate.starts, std::move(problem));
}

// Returns predicted - measured at every row.
std::vector<double> misses(const Candidate& candidate, const std::vector<double>& measured,
                           std::span<const double> p) {
  std::vector<double> out(measured.size());
  if (!candidate.predict(p, out)) throw Refusal("model", "no value", "a value at every row", "");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= measured[i];
  return out;
}

// Returns the residuals of the rows that each split leaves out. A split that leaves out no fitted
// row needs no fit. `problem` is that of the whole fit.
std::vector<double> left_out_residuals(const Candidate& candidate, const Trial& trial,
                                       const Rowset& rows, const FitProblem& problem,
                                       const Solution& whole) {
  if (candidate.left_out) return candidate.left_out(whole);
  std::vector<double> out;
  for (const Split& split : trial.splits) {
    Solution part = whole;
    if (split.fitted != rows) {
      FitProblem some = problem_of(candidate, trial, split.fitted);
      some.parameters = problem.parameters;
      some.constraints = problem.constraints;
      start_at(whole.values, some);
      some.options.tolerance = std::max(some.options.tolerance, 1e-12);
      part = least_squares(some);
    }
    const auto left = at(misses(candidate, trial.measured, part.values), split.held_out);
    out.insert(out.end(), left.begin(), left.end());
  }
  return out;
}

// Returns the solution from the best of the starts; the problem then starts there.
Solution solved(const Candidate& candidate, FitProblem& problem) {
  std::vector<Solution> all;
  std::optional<Solution> best;
  if (!candidate.starts.empty()) {
    all = solutions_of(candidate, problem);
    best = best_of(all, problem.options);
    start_at(best->values, problem);
  }
  if (!best || candidate.search_steps > 0 || candidate.search_tolerance > problem.options.tolerance)
    best = least_squares(problem);
  best = least_squares_within(problem, std::move(*best));
  if (candidate.finish) candidate.finish(problem, all, *best);
  return std::move(*best);
}

// Fits the candidate to the rows of the trial, and scores it.
void fit_rows(const Candidate& candidate, const Trial& trial, double full_scale, Fit& out) {
  const Rowset rows = trial.rows.empty() ? all_of(trial.measured) : trial.rows;
  FitProblem problem = problem_of(candidate, trial, rows);
  Solution found = solved(candidate, problem);
  out.parameters = found.estimates;
  out.fit = score(found.residuals, full_scale);
  out.residuals = misses(candidate, trial.measured, found.values);
  if (!trial.splits.empty() || candidate.left_out) {
    const std::vector<double> left = left_out_residuals(candidate, trial, rows, problem, found);
    (trial.cross_validates ? out.cross_validated : out.held_out) = score(left, full_scale);
    if (trial.has_band) out.band = band_of(left, trial.band_where);
    if (trial.shows_left_out) out.residuals.insert(out.residuals.end(), left.begin(), left.end());
  }
  out.refit = std::make_shared<Refit>(Refit{std::move(problem), std::move(found)});
}

Fit fit_of(const Candidate& candidate, const Trial& trial, double full_scale) {
  Fit out{.model = candidate.model, .law = candidate.law, .source = candidate.source};
  out.refused = candidate.refused;
  out.notes = candidate.notes;
  if (!out.refused.empty()) return out;
  try {
    candidate.fit ? candidate.fit(out) : fit_rows(candidate, trial, full_scale, out);
    if (!candidate.may_be_at_bounds) keep_off_bounds(out, candidate.may_be_at_bound);
  } catch (const Refusal& refusal) {
    out.refused = refusal.what();
  }
  return out;
}

}  // namespace

// The intervals are computed slightly inside, by a solver with no steps.
void widen_at_bounds(const FitProblem& problem, Solution& s, double inside) {
  FitProblem moved = problem;
  moved.options.most_steps = 0;
  bool any = false;
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    Parameter& p = moved.parameters[i];
    const double margin = std::min(std::max(2 * problem.options.difference, inside) * p.scale,
                                   0.25 * (p.high - p.low));
    p.start = std::clamp(s.values[i], p.low + margin, p.high - margin);
    any = any || s.estimates[i].at_bound || (inside > 0 && p.start != s.values[i]);
  }
  if (!any) return;
  const Solution free = least_squares(moved);
  const double change = s.rms > 0 && free.rms > 0 ? s.rms / free.rms : 1;
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    Estimate& e = s.estimates[i];
    if (e.at_bound || !e.free) continue;
    const double half = 0.5 * change * (free.estimates[i].high - free.estimates[i].low);
    if (!(half > e.high - e.value)) continue;
    e.standard_error = change * free.estimates[i].standard_error;
    e.low = e.value - half;
    e.high = e.value + half;
    const double size = std::max(std::abs(e.value), moved.parameters[i].scale);
    e.identifiable = half <= problem.options.widest_interval * size;
  }
}

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

void check_constraints(std::span<const Candidate> candidates) {
  std::vector<Parameter> all;
  for (const Candidate& c : candidates)
    all.insert(all.end(), c.parameters.begin(), c.parameters.end());
  if (!candidates.empty()) candidates[0].constraints.check(all);
}

Solution solve(const Candidate& candidate, const std::vector<double>& measured) {
  FitProblem problem = problem_of(candidate, {.measured = measured}, all_of(measured));
  return solved(candidate, problem);
}

void fit_candidates(std::vector<Candidate> candidates, const Trial& trial, Report& report,
                    host::Tally* done) {
  if (!trial.model.empty())
    std::erase_if(candidates, [&](const Candidate& c) { return c.model != trial.model; });
  if (candidates.empty()) throw std::invalid_argument(fmt::format("no model {}", trial.model));
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
