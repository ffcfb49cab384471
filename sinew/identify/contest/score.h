// identify/contest/score.h - size of residuals, in total and by parts: a large error at one length
// shows where the problem is.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::identify {

// Size of residuals.
struct Score {
  std::size_t points = 0;
  double rmse = 0, max = 0;  // in the report's unit

  // Shares of `full_scale`, for instance the muscle's largest force [%].
  double rmse_percent = 0, max_percent = 0;

  // Comparison with the variation of the measured values; NaN if that is unknown or zero: R^2,
  // the explained share of their variance (rmse is sqrt(1 - R^2) standard deviations); rmse as
  // a share of their range, largest less smallest; and Pearson's correlation of measured and
  // predicted values.
  double explained = std::numeric_limits<double>::quiet_NaN();
  double nrmse = std::numeric_limits<double>::quiet_NaN();
  double correlation = std::numeric_limits<double>::quiet_NaN();
};

// Returns the score; `full_scale` is the value of 100 %, in the residuals' unit.
Score score(std::span<const double> residuals, double full_scale);

// Returns the score of residuals, predicted - measured, compared with `measured`.
Score score(std::span<const double> residuals, double full_scale, std::span<const double> measured);

// Returns the k-th smallest |residual|, k = ceil(chance (n + 1)): a further residual of the
// same kind is smaller with this probability, 0 < chance < 1 (split-conformal prediction). With
// fewer than chance/(1 - chance) residuals it is the largest, which has a smaller probability.
// Residuals of fitted data give too small a value. `residuals` must not be empty.
double half_width_of(std::span<const double> residuals, double chance);

// Constant half-widths about a model's values that contain 68 and 95 % of measured ones, in the
// report's unit.
struct Band {
  double half_68 = 0, half_95 = 0;
  std::string where;  // validity, e.g. "while the pressure rests"; empty: everywhere
};

// Returns the band of residuals that were left out of a fit; empty for fewer than 19, whose largest
// contains less than 95 %.
std::optional<Band> band_of(std::span<const double> left_out, std::string where = "");

// Error of one part of the rows: those of one length, or of a named branch.
struct PartError {
  std::string name;  // empty: identified by its value
  double value = 0;  // mean of its rows, in ErrorBy::unit
  Score score;
};

// Error by one quantity that was varied.
struct ErrorBy {
  std::string what, unit;        // "length", "m"
  std::vector<PartError> parts;  // each row is in one part
};

// Returns the error of each part, in the order of the parts' numbers; `part` and `value` have an
// entry for each residual.
ErrorBy error_by(std::string what, std::string unit, std::span<const double> residuals,
                 std::span<const int> part, std::span<const double> value, double full_scale);

}  // namespace sinew::identify
