#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/machine/run_search.h"
#include "sinew/identify/machine/run_tangent.h"

namespace sinew::identify {

namespace {

// Adds `times` the column to a vector.
void add(std::span<const double> column, double times, std::vector<double>& to) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += times * column[k];
}

// The step from p on under this damping, the bounds kept.
std::vector<double> stepped(const RunTangent& t, std::span<const Parameter> parameters,
                            std::span<const RunCell> cells, const std::vector<double>& p,
                            double mu) {
  const std::size_t n = p.size();
  const std::vector<double> gradient = transposed_product(t.j, t.r);
  std::vector<std::size_t> free;
  const auto low = [&](std::size_t i) { return std::max(parameters[i].low, cells[i].low); };
  const auto high = [&](std::size_t i) { return std::min(parameters[i].high, cells[i].high); };
  for (std::size_t i = 0; i < n; ++i) {
    const double g = gradient[i];
    const bool held = (p[i] <= low(i) && g > 0) || (p[i] >= high(i) && g < 0);
    if (!held) free.push_back(i);
  }
  std::vector<double> q = p;
  // What runs into a bound is held there, and the others go on without it.
  while (!free.empty()) {
    const Matrix j = t.j.chosen(free);
    Matrix a = transposed_product(j, j);
    double least = 0;
    for (std::size_t i = 0; i < a.rows(); ++i) least = std::max(least, 1e-12 * a(i, i));
    for (std::size_t i = 0; i < a.rows(); ++i) a(i, i) += mu * a(i, i) + least + 1e-300;
    std::vector<double> rest = t.r;  // with what is held already at its bound
    for (std::size_t i = 0; i < n; ++i)
      if (std::ranges::find(free, i) == free.end())
        add(t.j.column(i), (q[i] - p[i]) / parameters[i].scale, rest);
    const std::vector<double> s = solved(a, transposed_product(j, rest));  // against the gradient
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const std::size_t i = free[k];
      const double to = p[i] - s[k] * parameters[i].scale;
      q[i] = std::clamp(to, low(i), high(i));
      if (q[i] == to) inside.push_back(i);
    }
    if (inside.size() == free.size()) break;
    free = inside;
  }
  return q;
}

}  // namespace

bool run_tangent(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 std::span<const RunCell> cells, const std::vector<double>& p, int threads,
                 RunTangent& out, double by) {
  const std::size_t n = parameters.size();
  std::vector<std::vector<double>> moved(n + 1, std::vector<double>(residuals.count()));
  std::vector<char> answered(n + 1);
  std::vector<double> step(n);
  host::side_by_side(
      n + 1,
      [&](std::size_t i) {
        std::vector<double> q = p;
        if (i < n) {
          const double high = std::min(parameters[i].high, cells[i].high);
          step[i] = by * parameters[i].scale;
          if (p[i] + step[i] > high) step[i] = -step[i];
          q[i] += step[i];
        }
        answered[i] = residuals(q, moved[i]) ? 1 : 0;
      },
      nullptr, threads);
  if (!answered[n]) return false;
  out.r = moved[n];
  out.j = Matrix(residuals.count(), n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!answered[i]) continue;
    const double per_scale = parameters[i].scale / step[i];
    const std::span<double> column = out.j.column(i);
    for (std::size_t k = 0; k < column.size(); ++k)
      column[k] = (moved[i][k] - out.r[k]) * per_scale;
  }
  return true;
}

RunSearched search_in_cells(const RunResiduals& residuals, std::span<const Parameter> parameters,
                            const std::vector<double>& p, int steps, int threads) {
  constexpr std::array<double, 4> dampings = {1e-3, 0.1, 10,
                                              1e3};  // times the last one that helped
  constexpr double nothing = 1e-3;  // of half the sum of squares: far below what noise makes of it
  RunSearched out{p, run_cells(parameters, p), unbounded};
  for (std::size_t i = 0; i < p.size(); ++i)
    out.p[i] = std::clamp(out.p[i], std::max(parameters[i].low, out.cells[i].low),
                          std::min(parameters[i].high, out.cells[i].high));
  double mu = 1e-2, cost = unbounded;
  for (int step = 0; step < steps; ++step) {
    RunTangent t;
    if (!run_tangent(residuals, parameters, out.cells, out.p, threads, t)) break;
    cost = 0.5 * square(t.r);
    std::vector<std::vector<double>> to;
    std::vector<double> there(dampings.size());
    for (const double times : dampings)
      to.push_back(stepped(t, parameters, out.cells, out.p, mu * times));
    host::side_by_side(
        to.size(), [&](std::size_t k) { there[k] = residuals.cost(to[k]); }, nullptr, threads);
    const auto best = static_cast<std::size_t>(std::ranges::min_element(there) - there.begin());
    const double gained = cost - there[best];
    if (gained > 0) out.p = to[best], cost = there[best];
    mu = std::clamp(mu * (gained > 0 ? dampings[best] : 1e4), 1e-8, 1e8);
    if (gained < nothing && (gained >= 0 || mu > 1e4)) break;
  }
  out.rms = std::sqrt(2 * cost / static_cast<double>(residuals.count()));
  return out;
}

std::vector<double> made_up_costs(const RunResiduals& residuals,
                                  std::span<const Parameter> parameters, const RunSearched& at,
                                  const std::vector<std::vector<double>>& places, int threads) {
  std::vector<double> out(places.size(), unbounded);
  RunTangent t;
  if (!run_tangent(residuals, parameters, at.cells, at.p, threads, t)) return out;
  const Matrix basis = triangular(t.j).basis;
  host::side_by_side(
      places.size(),
      [&](std::size_t k) {
        std::vector<double> r(t.r.size());
        if (!residuals(places[k], r)) return;
        out[k] = 0.5 * std::max(0.0, square(r) - square(transposed_product(basis, r)));
      },
      nullptr, threads);
  return out;
}

}  // namespace sinew::identify
