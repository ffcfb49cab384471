// identify/fit/least_squares.h - parameters that make residuals small, and how far they can be
// trusted.
//
//   minimise  sum rho(r_i(p)^2)/2     by Levenberg-Marquardt (Ceres), p within bounds
//
//   J     dr/dp at the solution, rows weighted as the loss weighs them
//   s^2   sum w r^2/(n - k)           n residuals, k parameters that are free
//   cov   s^2 (J^T J)^-1              by singular values; directions that J does not see are left
//                                     out and every parameter in them counts as not identifiable
//
// The intervals are value +- t(0.975, n - k) standard errors: 95 %, if the model is right and the
// residuals are independent. Where there are no more residuals than parameters no error can be
// seen, and the interval is infinite. Samples of a time series are not; with `correlated` the
// variance grows by 1 + 2 sum of the residuals' autocorrelation.
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

// A number that is searched, and between which bounds.
struct Parameter {
  std::string name;
  std::string unit;  // SI, as a field's
  double start = 0;
  double low = -unbounded, high = unbounded;
  double scale = 1;  // a change of this size matters; > 0
};

// Writes the residuals of the parameters p, always as many. May return false where the model has no
// answer there: the step is then refused.
using Residuals = std::function<bool(std::span<const double> p, std::span<double> r)>;

// Writes the residuals of the parameters p as Residuals does, and their derivatives by each
// parameter: dr_i/dp_k is by[k * r.size() + i].
using Slopes =
    std::function<bool(std::span<const double> p, std::span<double> r, std::span<double> by)>;

struct SolverOptions {
  // Residuals beyond it are taken for outliers, in units of the residuals; 0: none is (rho = r^2).
  // Cauchy's rho grows with their logarithm only.
  double outlier = 0;
  bool correlated = false;  // residuals are a time series
  int most_steps = 200;
  // The search ends where a step makes the sum of squares smaller by less than this share of it.
  // Whoever asks for many fits of little weight, for instance to leave points out, takes more.
  double tolerance = 1e-14;
  // A parameter whose interval is wider than this share of the larger of its value and its scale is
  // not identifiable.
  double widest_interval = 1.0;
  // Step of the derivatives, in the parameters' scales. By default the cube root of the roundoff; a
  // model that integrates with steps of its own has kinks of that size and needs more.
  double difference = 6e-6;
  // Derivatives in closed form of the same residuals; empty: they are central differences.
  Slopes slopes;
};

// Holds the growth of the error when a parameter is moved and the others are fitted again
// (profile.h).
struct Profile {
  // The parameter is moved to these multiples of its value, or, where that is near zero, to the
  // value + (factor - 1) scales; not beyond its bounds.
  static constexpr std::array<double, 5> factors{0.5, 0.8, 1, 1.25, 2};
  static constexpr double most = 10;
  // There, as multiples of that of the value itself, up to `most`; NaN: a bound is in the way.
  std::array<double, 5> error{};
  bool near_zero = false;  // the value is
  bool pinned = false;     // the data exclude the first and the last, where they can be
};

// A number that was found, and how sure it is.
struct Estimate {
  std::string name, unit;
  double value = 0;
  double standard_error = 0;  // infinite: not identifiable at all
  double low = 0, high = 0;   // 95 %
  bool identifiable = true;
  bool at_bound = false;           // no interval: it would like to be elsewhere
  bool free = true;                // false: frozen, or tied to another parameter
  std::string known;               // what was known beforehand, in words: "frozen"; empty: nothing
  std::optional<Profile> profile;  // of the chosen law, where its method has one
};

// Returns an estimate of another quantity, which is `factor` times the first.
Estimate scaled(Estimate e, std::string name, std::string unit, double factor);

// Where the search has ended.
struct Solution {
  std::vector<Estimate> estimates;  // in the parameters' order
  std::vector<double> values;
  std::vector<double> residuals;    // at the solution, without the loss
  std::vector<double> covariance;   // row by row; of fixed parameters 0
  std::vector<std::string> unseen;  // combinations of parameters that the data do not determine
  double rms = 0;                   // of the residuals
  double standard_deviation = 0;    // s
  double inflation = 1;             // of the variance, by correlation
  int freedom = 0;                  // n - k
  int steps = 0;
  bool converged = false;

  const Estimate& operator[](std::string_view name) const;  // throws std::out_of_range
};

// Throws host::Stopped where the calling thread is stopped (host/stop.h) before the search ends,
// std::invalid_argument for bounds that contain no start, and Refusal where there are fewer
// residuals than parameters or the model has no answer at the start.
Solution least_squares(const Residuals& residuals, std::size_t count,
                       std::span<const Parameter> parameters, const SolverOptions& options = {});

// The best of several starts; ties go to the earlier. `starts` hold one value per parameter.
Solution least_squares_from(const Residuals& residuals, std::size_t count,
                            std::span<const Parameter> parameters,
                            std::span<const std::vector<double>> starts,
                            const SolverOptions& options = {});

// Quantile 0.975 of Student's t: the half-width of a 95 % interval in standard errors.
double t_quantile(int freedom);
// Quantile 0.84 of it, of one degree within 2 %: the half-width of a 68 % interval.
double t_quantile_68(int freedom);

}  // namespace sinew::identify
