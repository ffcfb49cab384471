// identify/contest/least_squares.h - least squares fit of parameters, with their uncertainty.
//
//   minimise  sum w_i rho(r_i(p)^2)/2 by Levenberg-Marquardt (Ceres), p within bounds
//
//   J     dr/dp at the solution, rows with the weights of the readings and of the loss
//   s^2   sum w (r^2 + v)/(n - k)     n readings, k parameters that are free, v variance among the
//                                     readings of which a residual is the average
//   cov   s^2 (J^T J)^-1              by singular values; directions that J does not determine are
//                                     left out, and the parameters in them are not identifiable
//
// The intervals are value +- t(0.975, n - k) standard errors: 95 %, if the model is right and the
// residuals are independent. With no more residuals than parameters the error cannot be estimated
// and the interval is infinite. Samples of a time series are not independent; with `correlated` the
// variance is multiplied by 1 + 2 sum of the residuals' autocorrelation.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::identify {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

// A parameter of the search, with its bounds.
struct Parameter {
  std::string name;
  std::string unit;  // SI
  double start = 0;
  double low = -unbounded, high = unbounded;
  double scale = 1;                 // size of a significant change, > 0
  bool may_widen = false;           // a bound of its size is a guess (bounds.h)
  bool is_scaled_by_start = false;  // its size is unknown before a start is given: that is `scale`
};

// Returns the start values of the parameters.
std::vector<double> starts_of(std::span<const Parameter> parameters);

// Writes the residuals for the parameters p; their number is constant. May return false if the
// model is undefined there: the step is then rejected.
using Residuals = std::function<bool(std::span<const double> p, std::span<double> r)>;

// Writes the residuals like Residuals, and their derivatives: dr_i/dp_k is by[k * r.size() + i].
using Slopes =
    std::function<bool(std::span<const double> p, std::span<double> r, std::span<double> by)>;

struct SolverOptions {
  // Residual beyond which a measurement counts as an outlier, in units of the residuals; 0: no
  // robust loss (rho = r^2). Cauchy's rho grows only with the logarithm of the residual.
  double outlier = 0;
  bool correlated = false;  // residuals are a time series
  // Independent readings behind each of the first residuals, which are averages, and the variance
  // among these readings. The others are single readings. Empty: all are.
  std::vector<double> weights, variances;
  int most_steps = 200;
  // The search ends when a step reduces the sum of squares by less than this share. A larger value
  // suits many fits of little weight, for instance in cross-validation.
  double tolerance = 1e-14;
  // A parameter is not identifiable if its interval is wider than this share of its value or of its
  // scale, whichever is larger.
  double widest_interval = 1.0;
  // Step of numerical derivatives, in the parameters' scales. The default is the cube root of the
  // roundoff; a model that integrates with its own steps has kinks of that size and needs more.
  double difference = 6e-6;
  // Closed-form derivatives of the same residuals; empty: central differences.
  Slopes slopes;
};

// Growth of the error when a parameter is moved and the others are fitted again (profile.h).
struct Profile {
  // The parameter is moved to these multiples of its value, or, if that is near zero, to the value
  // + (factor - 1) scales, within its bounds.
  static constexpr std::array<double, 5> factors{0.5, 0.8, 1, 1.25, 2};
  static constexpr double most = 10;
  // Errors there, as multiples of the error at the value, up to `most`; NaN: beyond a bound.
  std::array<double, 5> error{};
  bool near_zero = false;  // the value is near zero
  bool pinned = false;     // the data exclude the first and the last factor (if within bounds)
};

// An estimated parameter with its uncertainty.
struct Estimate {
  std::string name, unit;
  double value = 0;
  double standard_error = 0;  // infinite: not identifiable
  double low = 0, high = 0;   // 95 % interval
  bool identifiable = true;
  bool at_bound = false;           // the optimum is beyond the bound: no interval; free or frozen
  bool free = true;                // false: frozen, or tied to another parameter
  std::string known;               // prior knowledge in words, e.g. "frozen"; empty: none
  std::optional<Profile> profile;  // for the chosen law, if its method has profiles

  // Sets the interval: `t` standard errors to either side.
  void set_interval(double error, double t) {
    standard_error = error;
    low = value - t * error;
    high = value + t * error;
  }
  // Removes the interval: nothing is known of the error.
  void remove_interval() {
    standard_error = unbounded;
    low = -unbounded;
    high = unbounded;
  }
};

// Returns the estimate of another quantity that is `factor` times the first.
Estimate scaled(Estimate e, std::string name, std::string unit, double factor);

// Solution of a search.
struct Solution {
  std::vector<Estimate> estimates;  // in the parameters' order
  std::vector<double> values;
  std::vector<double> residuals;   // at the solution, without the loss
  std::vector<double> covariance;  // row by row; 0 for fixed parameters
  std::vector<std::string>
      undetermined;               // combinations of parameters that the data do not determine
  double rms = 0;                 // root mean square of the residuals, each average counted once
  double standard_deviation = 0;  // s, of single readings: with those within averages
  double inflation = 1;           // factor of the variance due to correlation
  int freedom = 0;                // n - k
  int steps = 0;
  bool converged = false;

  const Estimate& operator[](std::string_view name) const;  // throws std::out_of_range
};

// Minimises the residuals. Throws host::Stopped if the calling thread is stopped
// (host/side_by_side.h) during the search, std::invalid_argument if the start is outside the
// bounds, and Refusal if there are fewer residuals than parameters or the model is undefined at the
// start.
Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const SolverOptions& options = {});

// Returns what a search minimises, of the first `count` residuals; 0: all.
double loss_of(std::span<const double> residuals, const SolverOptions& options,
               std::size_t count = 0);

// Returns 1 + 2 sum of the autocorrelation, up to the lag at which noise dominates: the number of
// values of a series that count as one independent value.
double inflation_of(std::span<const double> values);

// Returns the 0.975 quantile of Student's t: the half-width of a 95 % interval in standard errors.
double t_quantile(int freedom);

}  // namespace sinew::identify
