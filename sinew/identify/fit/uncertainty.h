// identify/fit/uncertainty.h - what is known of a solution besides its values. least_squares.cpp
// alone includes it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

// The residuals over scaled parameters, for Ceres and for the covariance alike.
class Scaled {
 public:
  // `count` residuals; `difference` is the derivatives' step, in the parameters' scales.
  Scaled(const Residuals& residuals, std::size_t count, std::span<const Parameter> parameters,
         double difference)
      : residuals_(residuals),
        count_(count),
        parameters_(parameters),
        difference_(difference),
        p_(parameters.size()) {}

  // How many residuals and parameters there are, and the bounds of one in its scale.
  std::size_t count() const { return count_; }
  std::size_t size() const { return parameters_.size(); }
  double low(std::size_t i) const { return parameters_[i].low / parameters_[i].scale; }
  double high(std::size_t i) const { return parameters_[i].high / parameters_[i].scale; }

  // Writes the residuals at u. False where the model has no answer, or none in numbers.
  bool operator()(const double* u, double* r) const {
    for (std::size_t i = 0; i < p_.size(); ++i)
      p_[i] = std::clamp(u[i] * parameters_[i].scale, parameters_[i].low, parameters_[i].high);
    const std::span<double> out(r, count_);
    if (!residuals_(p_, out)) return false;
    return std::all_of(out.begin(), out.end(), [](double x) { return std::isfinite(x); });
  }

  // d r/d u_i: central, at a bound one-sided. False where the model has no answer.
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
  const Residuals& residuals_;
  std::size_t count_;
  std::span<const Parameter> parameters_;
  double difference_;
  mutable std::vector<double> p_;
};

// Fills in everything of `out` but values and residuals, which are those at the scaled parameters
// u.
void add_uncertainty(const Scaled& model, std::span<const Parameter> parameters,
                     const SolverOptions& options, const std::vector<double>& u, Solution& out);

}  // namespace sinew::identify
