#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <thread>

#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

namespace {

// Steps of derivatives, in the parameters' scales: the search's, and a longer one that has to
// agree.
constexpr double difference = 1e-4, longer = 2e-3;

// The residuals about a point, by the scaled parameters.
struct Tangent {
  Eigen::VectorXd r;
  Eigen::MatrixXd j;
};

// The columns are forward differences: a central one costs a simulation more and gains nothing
// where the next step comes anyway.
bool tangent_at(const RunResiduals& residuals, std::span<const Parameter> parameters,
                std::span<const RunCell> cells, const std::vector<double>& p, int threads,
                Tangent& out, double by = difference) {
  const auto rows = static_cast<Eigen::Index>(residuals.count());
  const std::size_t n = parameters.size();
  out.r.resize(rows);
  out.j.resize(rows, static_cast<Eigen::Index>(n));
  std::vector<Eigen::VectorXd> moved(n + 1, Eigen::VectorXd(rows));
  std::vector<char> answered(n + 1);
  std::vector<double> step(n);
  in_threads(n + 1, threads, [&](std::size_t i) {
    std::vector<double> q = p;
    if (i < n) {
      const double high = std::min(parameters[i].high, cells[i].high);
      step[i] = by * parameters[i].scale;
      if (p[i] + step[i] > high) step[i] = -step[i];
      q[i] += step[i];
    }
    answered[i] = residuals(q, {moved[i].data(), residuals.count()}) ? 1 : 0;
  });
  if (!answered[n]) return false;
  out.r = moved[n];
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (answered[i])
      out.j.col(k) = (moved[i] - out.r) * (parameters[i].scale / step[i]);
    else
      out.j.col(k).setZero();
  }
  return true;
}

// The step from p on under this damping, the bounds kept.
std::vector<double> stepped(const Tangent& t, std::span<const Parameter> parameters,
                            std::span<const RunCell> cells, const std::vector<double>& p,
                            double mu) {
  const std::size_t n = p.size();
  const Eigen::VectorXd gradient = t.j.transpose() * t.r;
  std::vector<Eigen::Index> free;
  const auto low = [&](std::size_t i) { return std::max(parameters[i].low, cells[i].low); };
  const auto high = [&](std::size_t i) { return std::min(parameters[i].high, cells[i].high); };
  for (std::size_t i = 0; i < n; ++i) {
    const double g = gradient(static_cast<Eigen::Index>(i));
    const bool held = (p[i] <= low(i) && g > 0) || (p[i] >= high(i) && g < 0);
    if (!held) free.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<double> q = p;
  // What runs into a bound is held there, and the others go on without it.
  while (!free.empty()) {
    const Eigen::MatrixXd j = t.j(Eigen::all, free);
    Eigen::MatrixXd a = j.transpose() * j;
    const double least = 1e-12 * a.diagonal().maxCoeff() + 1e-300;
    for (Eigen::Index i = 0; i < a.rows(); ++i) a(i, i) += mu * a(i, i) + least;
    Eigen::VectorXd rest = t.r;  // with what is held already at its bound
    for (std::size_t i = 0; i < n; ++i)
      if (std::ranges::find(free, static_cast<Eigen::Index>(i)) == free.end())
        rest += t.j.col(static_cast<Eigen::Index>(i)) * ((q[i] - p[i]) / parameters[i].scale);
    const Eigen::VectorXd s = a.ldlt().solve(-j.transpose() * rest);
    std::vector<Eigen::Index> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const auto i = static_cast<std::size_t>(free[k]);
      const double to = p[i] + s(static_cast<Eigen::Index>(k)) * parameters[i].scale;
      q[i] = std::clamp(to, low(i), high(i));
      if (q[i] == to) inside.push_back(free[k]);
    }
    if (inside.size() == free.size()) break;
    free = inside;
  }
  return q;
}

double half_square(const Eigen::VectorXd& r) { return 0.5 * r.squaredNorm(); }

// By how much the readings' derivatives over a longer step differ from these, as a share of them;
// the median of the numbers.
double roughness(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 const RunSearched& at, int threads, const Tangent& near) {
  Tangent far;
  if (!tangent_at(residuals, parameters, at.cells, at.p, threads, far, longer)) return unbounded;
  std::vector<double> share;
  for (Eigen::Index i = 0; i < near.j.cols(); ++i) {
    const double norm = near.j.col(i).norm();
    if (norm > 0) share.push_back((far.j.col(i) - near.j.col(i)).norm() / norm);
  }
  if (share.empty()) return 0;
  const auto middle = share.begin() + static_cast<std::ptrdiff_t>(share.size() / 2);
  std::ranges::nth_element(share, middle);
  return *middle;
}

// What two numbers that the run binds together leave each other: a cell of the one is one of the
// other.
std::vector<RunCell> reachable(std::vector<RunCell> cells, const std::vector<double>& middle,
                               const std::vector<double>& covariance) {
  constexpr double bound_together = 0.98;  // correlation
  const std::size_t n = cells.size();
  const std::vector<RunCell> own = cells;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const double vi = covariance[i * n + i], vk = covariance[k * n + k];
      if (i == k || !std::isfinite(own[k].low) || !std::isfinite(vi + vk)) continue;
      if (!(covariance[i * n + k] > bound_together * std::sqrt(vi * vk))) continue;
      const double slope = std::sqrt(vi / vk);
      cells[i].low = std::max(cells[i].low, middle[i] + slope * (own[k].low - middle[k]));
      cells[i].high = std::min(cells[i].high, middle[i] + slope * (own[k].high - middle[k]));
    }
  return cells;
}

// The middle 95 % of a normal distribution that is known to lie in a cell.
RunCell cut_interval(double middle, double deviation, double width, const RunCell& cell) {
  const auto below = [&](double x) {  // share of the whole distribution
    return 0.5 * std::erfc((middle - x) / (deviation * std::numbers::sqrt2));
  };
  const double first = below(cell.low), last = below(cell.high);
  if (!(deviation > 0) || !std::isfinite(deviation) || (first < 1e-6 && last > 1 - 1e-6))
    return {middle - width * deviation, middle + width * deviation};
  const auto quantile = [&](double share) {
    double low = std::max(cell.low, middle - 9 * deviation);
    double high = std::min(cell.high, middle + 9 * deviation);
    if (!(low < high)) return std::clamp(middle, cell.low, std::max(cell.low, cell.high));
    for (int halving = 0; halving < 60; ++halving) {
      const double x = 0.5 * (low + high);
      (below(x) < first + share * (last - first) ? low : high) = x;
    }
    return 0.5 * (low + high);
  };
  return {quantile(0.025), quantile(0.975)};
}

}  // namespace

void in_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto some = [&] {
    for (std::size_t k = next++; k < count; k = next++) work(k);
  };
  std::vector<std::jthread> others;
  const auto wanted = std::min(static_cast<std::size_t>(std::max(threads, 1)), count);
  for (std::size_t t = 1; t < wanted; ++t) others.emplace_back(some);
  some();
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
    Tangent t;
    if (!tangent_at(residuals, parameters, out.cells, out.p, threads, t)) break;
    cost = half_square(t.r);
    std::vector<std::vector<double>> to;
    std::vector<double> there(dampings.size());
    for (const double times : dampings)
      to.push_back(stepped(t, parameters, out.cells, out.p, mu * times));
    in_threads(to.size(), threads, [&](std::size_t k) { there[k] = residuals.cost(to[k]); });
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
  Tangent t;
  if (!tangent_at(residuals, parameters, at.cells, at.p, threads, t)) return out;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(t.j);
  const Eigen::MatrixXd basis =
      qr.householderQ() * Eigen::MatrixXd::Identity(t.j.rows(), t.j.cols());
  in_threads(places.size(), threads, [&](std::size_t k) {
    Eigen::VectorXd r(t.r.size());
    if (!residuals(places[k], {r.data(), residuals.count()})) return;
    out[k] = 0.5 * std::max(0.0, r.squaredNorm() - (basis.transpose() * r).squaredNorm());
  });
  return out;
}

RunJudged judge_run(const RunResiduals& residuals, std::span<const Parameter> parameters,
                    const RunSearched& at, int threads) {
  const std::size_t n = parameters.size();
  const auto m = static_cast<Eigen::Index>(n);
  RunJudged out;
  Tangent t;
  (void)tangent_at(residuals, parameters, at.cells, at.p, threads, t);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(t.j);
  const Eigen::MatrixXd triangle = qr.matrixQR().topRows(m).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(triangle, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd along = (qr.householderQ().transpose() * t.r).head(m);

  const int freedom = static_cast<int>(residuals.count()) - static_cast<int>(n);
  const double left = t.r.squaredNorm() - along.squaredNorm();  // after the last step
  out.rms = std::sqrt(t.r.squaredNorm() / static_cast<double>(residuals.count()));
  out.standard_deviation = freedom > 0 ? std::sqrt(std::max(0.0, left) / freedom) : 0;
  out.roughness = roughness(residuals, parameters, at, threads, t);
  const double s2 = out.standard_deviation * out.standard_deviation;

  Eigen::VectorXd step = Eigen::VectorXd::Zero(m);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m, m);
  constexpr double unseen = 1e-9;
  const Eigen::VectorXd& seen = svd.singularValues();
  for (Eigen::Index k = 0; k < m; ++k) {
    const Eigen::VectorXd v = svd.matrixV().col(k);
    if (seen(k) > unseen * seen(0)) {
      step -= v * (svd.matrixU().col(k).dot(along) / seen(k));
      covariance += s2 / (seen(k) * seen(k)) * v * v.transpose();
    } else {
      for (Eigen::Index i = 0; i < m; ++i)
        if (std::abs(v(i)) > 1e-3) covariance(i, i) = unbounded;
    }
  }
  out.covariance.assign(n * n, 0.0);
  std::vector<double> middle(n);
  for (std::size_t i = 0; i < n; ++i) {
    middle[i] = at.p[i] + step(static_cast<Eigen::Index>(i)) * parameters[i].scale;
    for (std::size_t k = 0; k < n; ++k)
      out.covariance[i * n + k] =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) *
          parameters[i].scale * parameters[k].scale;
  }
  const std::vector<RunCell> reach = reachable(at.cells, middle, out.covariance);
  const double width = t_quantile(std::max(1, freedom));
  for (std::size_t i = 0; i < n; ++i) {
    const Parameter& p = parameters[i];
    Estimate e{.name = p.name, .unit = p.unit, .value = at.p[i]};
    e.standard_error = std::sqrt(out.covariance[i * n + i]);
    e.at_bound = e.value <= p.low || e.value >= p.high;
    const RunCell cell = e.at_bound ? RunCell{p.low, p.high} : reach[i];
    const RunCell cut = cut_interval(middle[i], e.standard_error, width, cell);
    e.low = e.value <= p.low ? p.low : std::min(e.value, std::clamp(cut.low, p.low, p.high));
    e.high = e.value >= p.high ? p.high : std::max(e.value, std::clamp(cut.high, p.low, p.high));
    out.estimates.push_back(e);
  }
  return out;
}

}  // namespace sinew::identify
