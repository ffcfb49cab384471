#include "sinew/identify/fit/least_squares.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/fit/uncertainty.h"

namespace sinew::identify {

namespace {

class Cost final : public ceres::CostFunction {
 public:
  explicit Cost(const Scaled& model) : model_(model) {
    set_num_residuals(static_cast<int>(model.count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.size()));
  }

  bool Evaluate(double const* const* u, double* r, double** jacobians) const override {
    if (!model_(u[0], r)) return false;
    if (!jacobians || !jacobians[0]) return true;
    const std::vector<double> at(u[0], u[0] + model_.size());
    std::vector<double> column(model_.count());
    for (std::size_t i = 0; i < model_.size(); ++i) {
      if (!model_.column(at, i, column.data())) return false;
      for (std::size_t k = 0; k < column.size(); ++k)
        jacobians[0][k * model_.size() + i] = column[k];
    }
    return true;
  }

 private:
  const Scaled& model_;
};

// The loss acts on every residual by itself; Ceres would apply it to the whole block. So the
// residuals become sqrt(rho(r^2)) of the same sign: log1p is Cauchy's rho.
Residuals with_loss(const Residuals& residuals, double outlier) {
  if (outlier <= 0) return residuals;
  return [&residuals, outlier](std::span<const double> p, std::span<double> r) {
    if (!residuals(p, r)) return false;
    for (double& x : r) {
      const double s = x / outlier;
      x = std::copysign(outlier * std::sqrt(std::log1p(s * s)), x);
    }
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

namespace {

// Cornish and Fisher's expansion of Student's quantile about the normal one, z.
double expanded(double z, double freedom) {
  const double v = freedom, z2 = z * z;
  return z + z * (z2 + 1) / (4 * v) + z * ((5 * z2 + 16) * z2 + 3) / (96 * v * v) +
         z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * v * v * v);
}

}  // namespace

double t_quantile_68(int freedom) { return expanded(0.994457883209753, freedom); }

double t_quantile(int freedom) {
  // The expansion says too little of the first ones.
  constexpr double exact[] = {12.7062, 4.30265, 3.18245, 2.77645, 2.57058};
  if (freedom < 1) return unbounded;
  if (freedom <= 5) return exact[freedom - 1];
  return expanded(1.959963984540054, freedom);
}

Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const SolverOptions& options) {
  check_start(parameters, count);
  const Residuals lossy = with_loss(residuals, options.outlier);
  const Scaled model(lossy, count, parameters, options.difference);
  const Scaled plain(residuals, count, parameters, options.difference);

  std::vector<double> u;
  for (const Parameter& p : parameters) u.push_back(p.start / p.scale);
  Solution out;
  out.residuals.resize(count);
  if (!plain(u.data(), out.residuals.data()))
    throw Refusal("model", "no answer at its start values", "finite residuals",
                  "other start values");

  if (!parameters.empty()) {
    ceres::Problem problem;
    problem.AddParameterBlock(u.data(), static_cast<int>(u.size()));
    problem.AddResidualBlock(new Cost(model), nullptr, u.data());  // which owns the cost
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

  plain(u.data(), out.residuals.data());
  for (std::size_t i = 0; i < u.size(); ++i)
    out.values.push_back(
        std::clamp(u[i] * parameters[i].scale, parameters[i].low, parameters[i].high));
  add_uncertainty(plain, parameters, options, u, out);
  return out;
}

Solution least_squares_from(const Residuals& residuals, std::size_t count,
                            std::span<const Parameter> parameters,
                            std::span<const std::vector<double>> starts,
                            const SolverOptions& options) {
  const auto cost = [&](const Solution& s) {
    double sum = 0;
    for (const double r : s.residuals)
      sum += options.outlier > 0 ? std::log1p(std::pow(r / options.outlier, 2)) : r * r;
    return sum;
  };
  std::unique_ptr<Solution> best;
  std::vector<Parameter> from(parameters.begin(), parameters.end());
  for (const std::vector<double>& start : starts) {
    for (std::size_t i = 0; i < from.size(); ++i)
      from[i].start = std::clamp(start.at(i), from[i].low, from[i].high);
    try {
      Solution s = least_squares(residuals, count, from, options);
      if (!best || cost(s) < cost(*best)) best = std::make_unique<Solution>(std::move(s));
    } catch (const Refusal&) {
      if (&start == &starts.back() && !best) throw;
    }
  }
  if (!best) throw std::invalid_argument("no start values");
  return *best;
}

}  // namespace sinew::identify
