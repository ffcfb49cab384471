#include "sinew/identify/contest/least_squares.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

// --- uncertainty of a solution ---

// Residuals over scaled parameters, for Ceres and for the covariance.
class Scaled {
 public:
  // `count` is the number of residuals, `difference` the step of numerical derivatives in the
  // parameters' scales, if `slopes` is empty.
  Scaled(const Residuals& residuals, const Slopes& slopes, std::size_t count,
         std::span<const Parameter> parameters, double difference)
      : residuals_(residuals),
        slopes_(slopes),
        count_(count),
        parameters_(parameters),
        difference_(difference),
        p_(parameters.size()) {}

  // Return the number of residuals and of parameters, and the bounds of one in its scale.
  std::size_t count() const { return count_; }
  std::size_t size() const { return parameters_.size(); }
  double low(std::size_t i) const { return parameters_[i].low / parameters_[i].scale; }
  double high(std::size_t i) const { return parameters_[i].high / parameters_[i].scale; }

  // Writes the residuals at u. Returns false if the model is undefined or not finite there, or the
  // search is stopped.
  bool operator()(const double* u, double* r) const {
    set_parameters(u);
    const std::span<double> out(r, count_);
    return !host::is_stopped() && residuals_(p_, out) && are_finite(out);
  }

  // Writes the residuals at u and d r/d u. Returns false if the model is undefined there.
  bool linearised(const std::vector<double>& u, double* r, Matrix& by) const {
    if (!slopes_) {
      if (!(*this)(u.data(), r)) return false;
      for (std::size_t i = 0; i < size(); ++i)
        if (!column(u, i, by.column(i).data())) return false;
      return true;
    }
    set_parameters(u.data());
    const std::span<double> out(r, count_);
    if (host::is_stopped() || !slopes_(p_, out, {by.column(0).data(), count_ * size()}))
      return false;
    if (!are_finite(out)) return false;
    for (std::size_t i = 0; i < size(); ++i)
      for (double& x : by.column(i)) x *= parameters_[i].scale;
    return by.is_finite();
  }

  // Writes d r/d u_i by central differences, one-sided at a bound. Returns false if undefined.
  bool column(const std::vector<double>& u, std::size_t i, double* out) const {
    const double step = difference_ * std::max(1.0, std::abs(u[i]));
    std::vector<double> at = u, above(count_), below(count_);
    at[i] = std::min(u[i] + step, high(i));
    const double to = at[i];
    if (!(*this)(at.data(), above.data())) return false;
    at[i] = std::max(u[i] - step, low(i));
    const double from = at[i];
    if (!(*this)(at.data(), below.data()) || !(to > from)) return false;
    for (std::size_t k = 0; k < count_; ++k) out[k] = (above[k] - below[k]) / (to - from);
    return true;
  }

 private:
  void set_parameters(const double* u) const {
    for (std::size_t i = 0; i < p_.size(); ++i)
      p_[i] = std::clamp(u[i] * parameters_[i].scale, parameters_[i].low, parameters_[i].high);
  }

  static bool are_finite(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  }

  const Residuals& residuals_;
  const Slopes& slopes_;
  std::size_t count_;
  std::span<const Parameter> parameters_;
  double difference_;
  mutable std::vector<double> p_;
};

// A direction counts as undetermined if its singular value is below this share of the largest.
constexpr double undetermined_below = 1e-8;

// Returns how many readings are behind a residual.
double readings_of(std::span<const double> weights, std::size_t i) {
  return i < weights.size() ? weights[i] : 1;
}

}  // namespace

double loss_of(std::span<const double> residuals, const SolverOptions& options, std::size_t count) {
  const double outlier = options.outlier;
  double sum = 0;
  for (std::size_t i = 0; i < (count > 0 ? count : residuals.size()); ++i) {
    const double square = residuals[i] * residuals[i];
    sum += readings_of(options.weights, i) *
           (outlier > 0 ? outlier * outlier * std::log1p(square / (outlier * outlier)) : square);
  }
  return sum;
}

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

namespace {

// Computes everything about the solution at u except its values.
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
    double readings = 0;
    for (std::size_t i = 0; i < model_.count(); ++i) readings += readings_of(options_.weights, i);
    out.freedom = static_cast<int>(std::lround(readings)) - static_cast<int>(free.size());

    const Matrix jacobian = weighted_jacobian(u, free, out.residuals);
    set_deviation(free.size(), out);
    const Matrix cov = covariance(jacobian, free, out);
    write(u, free, cov, out);
  }

 private:
  bool at_bound(const std::vector<double>& u, std::size_t i) const {
    const double margin = 1e-7 * std::max(1.0, std::abs(u[i]));
    return u[i] <= model_.low(i) + margin || u[i] >= model_.high(i) - margin;
  }

  double weight(std::size_t i, double residual) const {
    const double readings = readings_of(options_.weights, i);
    if (options_.outlier <= 0) return readings;
    const double s = residual / options_.outlier;
    return readings / (1 + s * s);
  }

  Matrix weighted_jacobian(const std::vector<double>& u, const std::vector<std::size_t>& free,
                           std::span<const double> residuals) const {
    Matrix j(model_.count(), free.size());
    if (options_.slopes) {
      Matrix all(model_.count(), model_.size());
      std::vector<double> r(model_.count());
      if (model_.linearised(u, r.data(), all)) j = all.chosen(free);
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
      const std::span<double> column = j.column(i);
      if (!options_.slopes && !model_.column(u, free[i], column.data()))
        std::fill(column.begin(), column.end(), 0.0);
      for (std::size_t k = 0; k < column.size(); ++k)
        column[k] *= std::sqrt(weight(k, residuals[k]));
    }
    return j;
  }

  void set_deviation(std::size_t free, Solution& out) const {
    double plain = 0, weighted = 0, weights = 0, of_averages = 0;
    for (std::size_t i = 0; i < out.residuals.size(); ++i) {
      const double r = out.residuals[i], w = weight(i, r);
      plain += r * r;
      of_averages += w * r * r;
      weighted += w * (r * r + (i < options_.variances.size() ? options_.variances[i] : 0));
      weights += w;
    }
    const auto count = static_cast<double>(out.residuals.size());
    out.rms = std::sqrt(plain / count);
    // Residuals that the loss ignores do not count as data.
    const double freedom = weights - static_cast<double>(free);
    out.standard_deviation = freedom > 0 ? std::sqrt(weighted / freedom) : 0;
    if (options_.correlated) out.inflation = inflation_of(out.residuals);
    // Neighbouring averages that are correlated are of correlated readings, several each.
    if (out.inflation > 1 && !options_.weights.empty()) {
      const double readings = (out.freedom + static_cast<double>(free)) / count;
      out.inflation = 1 + (out.inflation - 1) * readings * of_averages / weighted;
    }
  }

  // Returns the covariance of the free scaled parameters; infinite where the data determine
  // nothing.
  Matrix covariance(const Matrix& jacobian, const std::vector<std::size_t>& free,
                    Solution& out) const {
    const std::size_t n = jacobian.columns();
    Matrix cov(n, n);
    if (n == 0) return cov;
    // The triangle of a QR decomposition is used: squaring J would lose half the digits.
    const Axes svd = singular_axes(triangle_of(jacobian));
    const double s2 = out.standard_deviation * out.standard_deviation * out.inflation;
    for (std::size_t k = 0; k < n; ++k) {
      const std::span<const double> v = svd.axes.column(k);
      if (svd.values[k] > undetermined_below * svd.values[0]) {
        const double variance = s2 / (svd.values[k] * svd.values[k]);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t l = 0; l < n; ++l) cov(i, l) += variance * v[i] * v[l];
        continue;
      }
      out.undetermined.push_back(combination(v, free));
      for (std::size_t i = 0; i < n; ++i)
        if (std::abs(v[i]) > 1e-3) cov(i, i) = unbounded;
    }
    return cov;
  }

  // Returns a combination such as "0.71 scale - 0.71 moment_arm", in the parameters' scales.
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
      e.set_interval(e.at_bound ? 0 : std::sqrt(out.covariance[i * n + i]), t);
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

// Fills in all of `out` except values and residuals, which are those at the scaled parameters u.
void add_uncertainty(const Scaled& model, std::span<const Parameter> parameters,
                     const SolverOptions& options, const std::vector<double>& u, Solution& out) {
  Uncertainty(model, parameters, options).describe(u, out);
}

class Cost final : public ceres::CostFunction {
 public:
  explicit Cost(const Scaled& model) : model_(model) {
    set_num_residuals(static_cast<int>(model.count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.size()));
  }

  bool Evaluate(double const* const* u, double* r, double** jacobians) const override {
    double* row = jacobians ? jacobians[0] : nullptr;
    bool found = row || model_(u[0], r);
    if (row) {
      Matrix by(model_.count(), model_.size());
      found = model_.linearised({u[0], u[0] + model_.size()}, r, by);
      for (std::size_t k = 0; k < model_.count(); ++k)
        for (std::size_t i = 0; i < model_.size(); ++i) *row++ = by(k, i);
    }
    if (!host::is_stopped()) return found;
    // Zero residuals leave nothing to improve, so that Ceres ends without a message.
    std::fill_n(r, model_.count(), 0.0);
    if (row) std::fill_n(jacobians[0], model_.count() * model_.size(), 0.0);
    return true;
  }

 private:
  const Scaled& model_;
};

// Applies loss and weight to a residual, and returns the remaining share of its derivatives.
double apply_loss(double outlier, double weight, double& r) {
  const double of_weight = std::sqrt(weight);
  double share = 1;
  if (outlier > 0) {
    const double s = r / outlier, root = std::sqrt(std::log1p(s * s));
    if (root > 0) share = std::abs(s) / ((1 + s * s) * root);
    r = std::copysign(outlier * root, r);
  }
  r *= of_weight;
  return share * of_weight;
}

// Applies loss and weight to each residual: Ceres would apply a loss to the whole block. Residuals
// become sqrt(w rho(r^2)) with their sign; log1p is Cauchy's rho.
Residuals with_loss(const Residuals& residuals, const SolverOptions& options) {
  if (options.outlier <= 0 && options.weights.empty()) return residuals;
  return [&residuals, outlier = options.outlier, weights = std::span(options.weights)](
             std::span<const double> p, std::span<double> r) {
    if (!residuals(p, r)) return false;
    for (std::size_t i = 0; i < r.size(); ++i) apply_loss(outlier, readings_of(weights, i), r[i]);
    return true;
  };
}

// Applies loss and weight to residuals with their derivatives.
Slopes with_loss(const Slopes& slopes, const SolverOptions& options) {
  if (!slopes || (options.outlier <= 0 && options.weights.empty())) return slopes;
  return [&slopes, outlier = options.outlier, weights = std::span(options.weights)](
             std::span<const double> p, std::span<double> r, std::span<double> by) {
    if (!slopes(p, r, by)) return false;
    std::vector<double> share;  // remaining share of each derivative
    for (std::size_t i = 0; i < r.size(); ++i)
      share.push_back(apply_loss(outlier, readings_of(weights, i), r[i]));
    for (std::size_t k = 0; k < p.size(); ++k)
      for (std::size_t i = 0; i < r.size(); ++i) by[k * r.size() + i] *= share[i];
    return true;
  };
}

void check_start(std::span<const Parameter> parameters, std::size_t count) {
  for (const Parameter& p : parameters)
    if (!(p.low <= p.start && p.start <= p.high) || !(p.low < p.high) || !(p.scale > 0))
      throw std::invalid_argument(fmt::format("parameter {}: start {} in [{}, {}], scale {}",
                                              p.name, p.start, p.low, p.high, p.scale));
  if (count < parameters.size())
    throw Refusal("data", fmt::format("{} points", count),
                  fmt::format("at least {}, one per parameter", parameters.size()),
                  "more measurements, or a model with fewer parameters");
}

}  // namespace

const Estimate& Solution::operator[](std::string_view name) const {
  for (const Estimate& e : estimates)
    if (e.name == name) return e;
  throw std::out_of_range(fmt::format("no parameter {}", name));
}

std::vector<double> starts_of(std::span<const Parameter> parameters) {
  std::vector<double> out;
  for (const Parameter& p : parameters) out.push_back(p.start);
  return out;
}

double t_quantile(int freedom) {
  // The expansion of Cornish and Fisher is too small for few degrees of freedom.
  constexpr double exact[] = {12.7062, 4.30265, 3.18245, 2.77645, 2.57058};
  if (freedom < 1) return unbounded;
  if (freedom <= 5) return exact[freedom - 1];
  const double z = 1.959963984540054, z2 = z * z, v = freedom;
  return z + z * (z2 + 1) / (4 * v) + z * ((5 * z2 + 16) * z2 + 3) / (96 * v * v) +
         z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * v * v * v);
}

Estimate scaled(Estimate e, std::string name, std::string unit, double factor) {
  e.name = std::move(name);
  e.unit = std::move(unit);
  for (double* x : {&e.value, &e.standard_error, &e.low, &e.high}) *x *= factor;
  return e;
}

Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const SolverOptions& options) {
  check_start(parameters, count);
  const Residuals lossy = with_loss(residuals, options);
  const Slopes lossy_slopes = with_loss(options.slopes, options);
  const Scaled model(lossy, lossy_slopes, count, parameters, options.difference);
  const Scaled plain(residuals, options.slopes, count, parameters, options.difference);

  std::vector<double> u;
  for (const Parameter& p : parameters) u.push_back(p.start / p.scale);
  Solution out;
  out.residuals.resize(count);
  if (host::is_stopped()) throw host::Stopped();
  if (!plain(u.data(), out.residuals.data()))
    throw Refusal("model", "no value at its start values", "finite residuals",
                  "other start values");

  out.converged = parameters.empty();
  if (!parameters.empty()) {
    ceres::Problem problem;
    problem.AddParameterBlock(u.data(), static_cast<int>(u.size()));
    problem.AddResidualBlock(new Cost(model), nullptr, u.data());  // the problem owns the cost
    for (std::size_t i = 0; i < u.size(); ++i) {
      const int index = static_cast<int>(i);
      if (std::isfinite(model.low(i)))
        problem.SetParameterLowerBound(u.data(), index, model.low(i));
      if (std::isfinite(model.high(i)))
        problem.SetParameterUpperBound(u.data(), index, model.high(i));
    }
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.max_num_iterations = options.most_steps;
    solver.function_tolerance = options.tolerance;
    solver.gradient_tolerance = 1e-14;
    solver.parameter_tolerance = 1e-10;
    solver.logging_type = ceres::SILENT;
    solver.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    out.converged = summary.termination_type == ceres::CONVERGENCE;
    out.steps = static_cast<int>(summary.iterations.size());
  }

  if (host::is_stopped()) throw host::Stopped();
  plain(u.data(), out.residuals.data());
  for (std::size_t i = 0; i < u.size(); ++i)
    out.values.push_back(
        std::clamp(u[i] * parameters[i].scale, parameters[i].low, parameters[i].high));
  add_uncertainty(plain, parameters, options, u, out);
  return out;
}

}  // namespace sinew::identify
