#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/machine/run_mixture.h"
#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

namespace {

// Returns the relative difference of the readings' derivatives over a longer step; the median over
// the parameters.
double roughness(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 const RunSearched& at, int threads, const RunTangent& near) {
  RunTangent far;
  if (!run_tangent(residuals, parameters, at.cells, at.p, threads, far, long_difference))
    return unbounded;
  std::vector<double> share;
  for (std::size_t i = 0; i < near.j.columns(); ++i) {
    const std::span<const double> column = near.j.column(i);
    std::vector<double> other(column.begin(), column.end());
    for (std::size_t k = 0; k < other.size(); ++k) other[k] -= far.j(k, i);
    if (square(column) > 0) share.push_back(std::sqrt(square(other) / square(column)));
  }
  if (share.empty()) return 0;
  const auto middle = share.begin() + static_cast<std::ptrdiff_t>(share.size() / 2);
  std::ranges::nth_element(share, middle);
  return *middle;
}

// Returns the parameters that the run determines, those with cells last.
std::vector<std::size_t> seen_columns(const Matrix& j, std::span<const RunCell> cells) {
  constexpr double unseen = 1e-9, has_part = 1e-3;
  const auto [stretch, axes] = singular_axes(triangle_of(j));
  std::vector<std::size_t> plain, in_cells;
  for (std::size_t i = 0; i < j.columns(); ++i) {
    bool seen = true;
    for (std::size_t k = 0; k < j.columns(); ++k)
      if (!(stretch[k] > unseen * stretch[0]) && std::abs(axes(i, k)) > has_part) seen = false;
    const bool bounded = std::isfinite(cells[i].high);
    if (seen) (bounded ? in_cells : plain).push_back(i);
  }
  plain.insert(plain.end(), in_cells.begin(), in_cells.end());
  return plain;
}

// Returns the distribution of those parameters from the tangent at a solution, in units of the
// residuals; the residuals become those at its minimum.
RunPiece piece_of(RunTangent& t, std::span<const Parameter> parameters, const RunSearched& at,
                  const std::vector<std::size_t>& columns) {
  const std::size_t m = columns.size();
  const auto [basis, triangle] = triangular(t.j.chosen(columns));
  const std::vector<double> along = transposed_product(basis, t.r);
  const std::vector<double> explained = product(basis, along);
  for (std::size_t k = 0; k < t.r.size(); ++k) t.r[k] -= explained[k];
  RunPiece out{.cost = 0.5 * square(t.r)};
  out.spread = inverse_of_triangle(triangle);
  out.middle = product(out.spread, along);
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t i = columns[k];
    const Parameter& p = parameters[i];
    out.middle[k] = at.p[i] - p.scale * out.middle[k];
    for (std::size_t l = 0; l < m; ++l) out.spread(k, l) *= p.scale;
    if (out.spread(k, k) < 0)
      for (double& x : out.spread.column(k)) x = -x;
    out.box.push_back({std::max(p.low, at.cells[i].low - jump_clearance),
                       std::min(p.high, at.cells[i].high + jump_clearance)});
  }
  return out;
}

// Writes the standard deviation of residuals of readings that are not clipped. Returns the
// degrees of freedom.
int set_deviation(const RunResiduals& residuals, std::span<const double> left, int numbers,
                  RunJudged& out) {
  double squares = 0;
  int count = 0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (residuals.is_cut(k, left[k])) continue;
    squares += left[k] * left[k];
    ++count;
  }
  const int freedom = count - numbers;
  out.standard_deviation = freedom > 0 ? std::sqrt(squares / freedom) : 0;
  return freedom;
}

// Writes the estimates of all parameters, from the intervals of those that are determined.
void write_estimates(std::span<const Parameter> parameters, const RunSearched& at,
                     const std::vector<std::size_t>& columns, const RunPiece& best,
                     const std::vector<RunCell>& middle, RunJudged& out) {
  const std::size_t n = parameters.size();
  out.covariance.assign(n * n, 0.0);
  std::vector<RunCell> interval(n);
  for (std::size_t i = 0; i < n; ++i) out.covariance[i * n + i] = unbounded;
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const std::size_t i = columns[a];
    interval[i] = middle[a];
    for (std::size_t b = 0; b < columns.size(); ++b) {
      double& covariance = out.covariance[i * n + columns[b]];
      covariance = 0;
      for (std::size_t k = 0; k < columns.size(); ++k)
        covariance += best.spread(a, k) * best.spread(b, k);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Parameter& p = parameters[i];
    Estimate e{.name = p.name, .unit = p.unit, .value = at.p[i]};
    e.standard_error = std::sqrt(out.covariance[i * n + i]);
    e.at_bound = e.value <= p.low || e.value >= p.high;
    e.low = e.value <= p.low ? p.low : std::min(e.value, std::max(interval[i].low, p.low));
    e.high = e.value >= p.high ? p.high : std::max(e.value, std::min(interval[i].high, p.high));
    out.estimates.push_back(e);
  }
}

}  // namespace

RunJudged judge_run(const RunResiduals& residuals, std::span<const Parameter> parameters,
                    const RunSearched& at, int threads) {
  RunJudged out;
  RunTangent t;
  if (!run_tangent(residuals, parameters, at.cells, at.p, threads, t))
    throw Refusal("the run", "no simulation to its end with the numbers that suit its begin",
                  "one that goes to its end", "fewer numbers, or a shorter stretch");
  const std::vector<std::size_t> columns = seen_columns(t.j, at.cells);
  out.rms = std::sqrt(square(t.r) / static_cast<double>(residuals.count()));
  out.roughness = roughness(residuals, parameters, at, threads, t);
  std::vector<RunPiece> pieces{piece_of(t, parameters, at, columns)};
  const int freedom = set_deviation(residuals, t.r, static_cast<int>(columns.size()), out);
  for (const RunSearched& other : at.others)
    if (run_tangent(residuals, parameters, other.cells, other.p, threads, t))
      pieces.push_back(piece_of(t, parameters, other, columns));

  const double s = out.standard_deviation;
  std::erase_if(pieces, [](const RunPiece& p) { return !p.spread.is_finite(); });
  for (RunPiece& piece : pieces) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (double& x : piece.spread.column(k)) x *= s;
    piece.cost /= s * s;
  }
  const bool known = !pieces.empty() && s > 0;
  std::vector<double> value;
  for (const std::size_t i : columns) value.push_back(at.p[i]);
  const std::vector<RunCell> middle =
      known ? middle_of_pieces(pieces, value, t_quantile(std::max(1, freedom)))
            : std::vector<RunCell>(columns.size());
  const std::size_t m = columns.size();
  const RunPiece none{.middle = std::vector<double>(m), .spread = Matrix(m, m)};
  write_estimates(parameters, at, columns, known ? pieces[0] : none, middle, out);
  return out;
}

// --- undetermined directions ---

std::vector<std::string> open_directions(RunJudged& judged, std::span<const Parameter> parameters) {
  constexpr double half_width = 1.96, part = 0.2;
  const std::size_t n = parameters.size();
  const auto size = [&](std::size_t i) {
    return std::max(std::abs(judged.estimates[i].value), parameters[i].scale);
  };
  const auto wide = [&](std::size_t i) {
    const Estimate& e = judged.estimates[i];
    return !(0.5 * (e.high - e.low) <= size(i));
  };
  std::vector<std::string> out;
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < n; ++i) {
    judged.estimates[i].identifiable = !wide(i);
    if (std::isfinite(judged.estimates[i].standard_error))
      seen.push_back(i);
    else
      out.push_back(parameters[i].name + ": only together with others");
  }
  // The principal axes of the uncertainty, with each parameter in its own scale.
  const std::size_t m = seen.size();
  Matrix c(m, m);
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t b = 0; b < m; ++b) {
      const std::size_t i = seen[a], k = seen[b];
      c(a, b) = judged.covariance[i * n + k] / (size(i) * size(k));
    }
  const Axes axes = axes_of_positive(c);
  std::vector<bool> told(n, false);
  for (std::size_t a = m; a-- > 0;) {
    if (!(half_width * std::sqrt(axes.values[a]) > 0.5)) continue;
    std::string words;
    bool is_open = false;
    std::vector<std::size_t> members;
    for (std::size_t b = 0; b < m; ++b) {
      const double share = axes.axes(b, a);
      if (std::abs(share) < part) continue;
      const std::size_t i = seen[b];
      members.push_back(i);
      is_open = is_open || wide(i);
      words += fmt::format("{}{:.2g} {}/({:.3g} {})",
                           words.empty() ? (share < 0 ? "-" : "") : (share < 0 ? " - " : " + "),
                           std::abs(share), parameters[i].name, size(i), parameters[i].unit);
    }
    if (!is_open) continue;
    for (const std::size_t i : members) told[i] = true;
    out.push_back(words);
  }
  for (const std::size_t i : seen)
    if (wide(i) && !told[i])
      out.push_back(parameters[i].name + ": its interval is wider than it is large");
  return out;
}

}  // namespace sinew::identify
