#include "sinew/identify/fit/uncertainty.h"

#include <fmt/format.h>

#include "sinew/identify/fit/matrix.h"

namespace sinew::identify {

namespace {

// A direction that moves the residuals less than this share of what the best seen one does.
constexpr double unseen_below = 1e-8;

// 1 + 2 sum of the autocorrelation, up to where it is lost in noise.
double inflation_of(std::span<const double> r) {
  const std::size_t n = r.size();
  double mean = 0, c0 = 0;
  for (const double x : r) mean += x / static_cast<double>(n);
  for (const double x : r) c0 += (x - mean) * (x - mean);
  if (c0 <= 0) return 1;
  double sum = 1;
  for (std::size_t lag = 1; lag < n / 4; ++lag) {
    double c = 0;
    for (std::size_t i = lag; i < n; ++i) c += (r[i] - mean) * (r[i - lag] - mean);
    if (c / c0 < 2 / std::sqrt(static_cast<double>(n))) break;
    sum += 2 * c / c0;
  }
  return sum;
}

// What is known about the solution at u: everything but the values.
class Uncertainty {
 public:
  Uncertainty(const Scaled& model, std::span<const Parameter> parameters,
              const SolverOptions& options)
      : model_(model), parameters_(parameters), options_(options) {}

  void describe(const std::vector<double>& u, Solution& out) const {
    const std::size_t n = model_.size();
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < n; ++i)
      if (!at_bound(u, i)) free.push_back(i);
    out.freedom = static_cast<int>(model_.count()) - static_cast<int>(free.size());

    const Matrix jacobian = weighted_jacobian(u, free, out.residuals);
    set_deviation(out);
    const Matrix cov = covariance(jacobian, free, out);
    write(u, free, cov, out);
  }

 private:
  bool at_bound(const std::vector<double>& u, std::size_t i) const {
    const double margin = 1e-7 * std::max(1.0, std::abs(u[i]));
    return u[i] <= model_.low(i) + margin || u[i] >= model_.high(i) - margin;
  }

  double weight(double residual) const {
    if (options_.outlier <= 0) return 1;
    const double s = residual / options_.outlier;
    return 1 / (1 + s * s);
  }

  Matrix weighted_jacobian(const std::vector<double>& u, const std::vector<std::size_t>& free,
                           std::span<const double> residuals) const {
    Matrix j(model_.count(), free.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
      const std::span<double> column = j.column(i);
      if (!model_.column(u, free[i], column.data())) std::fill(column.begin(), column.end(), 0.0);
      for (std::size_t k = 0; k < column.size(); ++k) column[k] *= std::sqrt(weight(residuals[k]));
    }
    return j;
  }

  void set_deviation(Solution& out) const {
    double plain = 0, weighted = 0, weights = 0;
    for (const double r : out.residuals) {
      plain += r * r;
      weighted += weight(r) * r * r;
      weights += weight(r);
    }
    const auto count = static_cast<double>(out.residuals.size());
    out.rms = std::sqrt(plain / count);
    // Residuals that the loss ignores do not count as data.
    const double freedom = weights - (count - out.freedom);
    out.standard_deviation = freedom > 0 ? std::sqrt(weighted / freedom) : 0;
    if (options_.correlated) out.inflation = inflation_of(out.residuals);
  }

  // Of the free scaled parameters; infinite where the data say nothing.
  Matrix covariance(const Matrix& jacobian, const std::vector<std::size_t>& free,
                    Solution& out) const {
    const std::size_t n = jacobian.columns();
    Matrix cov(n, n);
    if (n == 0) return cov;
    // By the triangle of its QR: squaring J would lose half the digits.
    const Axes seen = singular_axes(triangle_of(jacobian));
    const double s2 = out.standard_deviation * out.standard_deviation * out.inflation;
    for (std::size_t k = 0; k < n; ++k) {
      const std::span<const double> v = seen.axes.column(k);
      if (seen.values[k] > unseen_below * seen.values[0]) {
        const double variance = s2 / (seen.values[k] * seen.values[k]);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t l = 0; l < n; ++l) cov(i, l) += variance * v[i] * v[l];
        continue;
      }
      out.unseen.push_back(combination(v, free));
      for (std::size_t i = 0; i < n; ++i)
        if (std::abs(v[i]) > 1e-3) cov(i, i) = unbounded;
    }
    return cov;
  }

  // "0.71 scale - 0.71 moment_arm", in the parameters' scales.
  std::string combination(std::span<const double> v, const std::vector<std::size_t>& free) const {
    std::string out;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (std::abs(v[i]) < 1e-3) continue;
      const bool minus = v[i] < 0;
      const char* sign = out.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
      const Parameter& p = parameters_[free[i]];
      out += fmt::format("{}{:.2g} {}/({:g} {})", sign, std::abs(v[i]), p.name, p.scale, p.unit);
    }
    return out;
  }

  void write(const std::vector<double>& u, const std::vector<std::size_t>& free, const Matrix& cov,
             Solution& out) const {
    const std::size_t n = model_.size();
    out.covariance.assign(n * n, 0.0);
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t k = 0; k < free.size(); ++k)
        out.covariance[free[i] * n + free[k]] =
            cov(i, k) * parameters_[free[i]].scale * parameters_[free[k]].scale;

    const double t = t_quantile(std::max(1, out.freedom));
    for (std::size_t i = 0; i < n; ++i) {
      const Parameter& p = parameters_[i];
      Estimate e{.name = p.name, .unit = p.unit, .value = out.values[i]};
      e.at_bound = at_bound(u, i);
      e.standard_error = e.at_bound ? 0 : std::sqrt(out.covariance[i * n + i]);
      e.low = e.value - t * e.standard_error;
      e.high = e.value + t * e.standard_error;
      if (out.freedom < 1 && !e.at_bound) e.low = -unbounded, e.high = unbounded;
      const double size = std::max(std::abs(e.value), p.scale);
      e.identifiable = !e.at_bound && t * e.standard_error <= options_.widest_interval * size;
      out.estimates.push_back(e);
    }
  }

  const Scaled& model_;
  std::span<const Parameter> parameters_;
  const SolverOptions& options_;
};

}  // namespace

void add_uncertainty(const Scaled& model, std::span<const Parameter> parameters,
                     const SolverOptions& options, const std::vector<double>& u, Solution& out) {
  Uncertainty(model, parameters, options).describe(u, out);
}

}  // namespace sinew::identify
