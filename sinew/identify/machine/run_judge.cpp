#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <tuple>
#include <utility>

#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

namespace {

constexpr double normal_width = 1.959963984540054;
constexpr double outside = 6;  // standard deviations; a box beyond them has no effect
constexpr int draws_of_a_piece = 4096;

// Uniform and normal random numbers, equal for every standard library.
class Draws {
 public:
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

  // Draws a unit normal within limits, and multiplies `weight` by the probability of the interval.
  double normal_between(double low, double high, double& weight) {
    if (low < -outside && high > outside) return normal();
    const bool mirrored = low > 0;  // the lower tail is more accurate
    if (mirrored) std::tie(low, high) = std::pair(-high, -low);
    const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
    const double first = below(low), share = below(high) - first;
    weight *= std::max(0.0, share);
    const double wanted = first + uniform() * share;
    double from = std::max(low, -38.0), to = std::min(high, 38.0);
    for (int halving = 0; halving < 40; ++halving) {
      const double x = 0.5 * (from + to);
      (below(x) < wanted ? from : to) = x;
    }
    const double x = std::clamp(0.5 * (from + to), low, high);
    return mirrored ? -x : x;
  }

 private:
  std::mt19937_64 random_{1};
};

// Draws of all pieces: a row of parameters each, and its weight.
struct Drawn {
  std::vector<std::vector<double>> at;
  std::vector<double> weight;
};

// Returns the logarithm of the spread's determinant.
double log_volume(const RunPiece& piece) {
  double sum = 0;
  for (std::size_t i = 0; i < piece.middle.size(); ++i) sum += std::log(piece.spread(i, i));
  return sum;
}

void draw(const RunPiece& piece, double stretch, double least_cost, double largest, Draws& draws,
          Drawn& out) {
  const std::size_t n = piece.middle.size();
  const double height = std::exp(least_cost - piece.cost + log_volume(piece) - largest);
  std::vector<double> z(n), x(n);
  for (int k = 0; k < draws_of_a_piece; ++k) {
    double weight = height;
    for (std::size_t i = n; i-- > 0;) {
      const RunCell& box = piece.box[i];
      const double deviation = stretch * piece.spread(i, i);
      double middle = piece.middle[i];
      for (std::size_t b = i + 1; b < n; ++b) middle += stretch * piece.spread(i, b) * z[b];
      z[i] = draws.normal_between((box.low - middle) / deviation, (box.high - middle) / deviation,
                                  weight);
      x[i] = middle + deviation * z[i];
    }
    if (!(weight > 0)) continue;
    out.at.push_back(x);
    out.weight.push_back(weight);
  }
}

bool is_cut(const RunPiece& piece) {
  for (std::size_t i = 0; i < piece.middle.size(); ++i) {
    const RunCell& box = piece.box[i];
    const double far = outside * piece.spread.row_norm(i);
    if (box.low > piece.middle[i] - far || box.high < piece.middle[i] + far) return true;
  }
  return false;
}

// Returns the middle 95 % of parameter i, or the 95 % that reach up to its value.
RunCell middle_of(const Drawn& drawn, std::size_t i, double value) {
  constexpr double tail = 0.025;
  std::vector<std::size_t> order(drawn.at.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(drawn.at[k][i], k); });
  double all = 0, below = 0;
  for (std::size_t k = 0; k < drawn.at.size(); ++k) {
    all += drawn.weight[k];
    below += drawn.at[k][i] < value ? drawn.weight[k] : 0;
  }
  const auto quantile = [&](double share) {
    double sum = 0;
    for (const std::size_t k : order) {
      sum += drawn.weight[k];
      if (sum >= share * all) return drawn.at[k][i];
    }
    return drawn.at[order.back()][i];
  };
  const double from = below < tail * all         ? below / all
                      : below > (1 - tail) * all ? below / all - (1 - 2 * tail)
                                                 : tail;
  return {quantile(from), quantile(from + 1 - 2 * tail)};
}

}  // namespace

std::vector<RunCell> middle_of_pieces(std::span<const RunPiece> pieces,
                                      std::span<const double> value, double width) {
  const auto n = pieces[0].middle.size();
  std::vector<RunCell> out(n);
  Drawn drawn;
  if (pieces.size() > 1 || is_cut(pieces[0])) {
    Draws draws;
    double least = unbounded, largest = -unbounded;
    for (const RunPiece& p : pieces) {
      least = std::min(least, p.cost);
      largest = std::max(largest, log_volume(p));
    }
    for (const RunPiece& p : pieces) draw(p, width / normal_width, least, largest, draws, drawn);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const RunPiece& only = pieces[0];
    const double reach = width * only.spread.row_norm(i);
    out[i] = drawn.at.empty() ? RunCell{only.middle[i] - reach, only.middle[i] + reach}
                              : middle_of(drawn, i, value[i]);
  }
  return out;
}

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
