// identify/fit/score.h - how large residuals are, all together and by parts: an error that is large
// at one length only says where to look.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::identify {

// How large residuals are.
struct Score {
  std::size_t points = 0;
  double rmse = 0, max = 0;  // of the residuals, in the report's unit

  // These are shares of `full_scale`, for instance the muscle's largest force  [%].
  double rmse_percent = 0, max_percent = 0;

  // These compare with how much the measured values vary; NaN where that is unknown or zero: R^2,
  // the share of their variance that is explained, so that rmse is sqrt(1 - R^2) of their standard
  // deviation; rmse as a share of their range, largest less smallest; and Pearson's correlation of
  // measured and predicted values.
  double explained = std::numeric_limits<double>::quiet_NaN();
  double nrmse = std::numeric_limits<double>::quiet_NaN();
  double correlation = std::numeric_limits<double>::quiet_NaN();
};

// Returns it; `full_scale` is what 100 % are, in the residuals' unit.
Score score(std::span<const double> residuals, double full_scale);

// Returns the score of residuals, predicted less measured, with the comparison with `measured`.
Score score(std::span<const double> residuals, double full_scale, std::span<const double> measured);

// Returns the k-th smallest |residual|, k = ceil(chance (n + 1)): one more residual of the same
// kind lies within it with that chance, of (0, 1) (split-conformal prediction). Of fewer than
// chance/(1 - chance) it is the largest, which holds less. Residuals that a fit saw say too little.
// Not empty.
double half_width_of(std::span<const double> residuals, double chance);

// Half-widths about a model's values, everywhere alike, that hold 68 and 95 % of measured ones, in
// the report's unit.
struct Band {
  double half_68 = 0, half_95 = 0;
  std::string where;  // they hold: "while the pressure rests"; empty: everywhere
};

// Returns those that residuals tell which a fit had not seen; none of fewer than 19, the largest of
// which holds less than 95 %.
std::optional<Band> band_of(std::span<const double> unseen, std::string where = "");

// The error of one part of the rows: those of a length, or of a branch, which has a name.
struct PartError {
  std::string name;  // empty: its value tells it
  double value = 0;  // the mean of its rows, in ErrorBy::unit
  Score score;
};

// The error by one thing that was varied.
struct ErrorBy {
  std::string what, unit;        // "length", "m"
  std::vector<PartError> parts;  // each row is in one of them
};

// Returns the error of each part, in the order of the parts' numbers; `part` and `value` are those
// of each residual.
ErrorBy error_by(std::string what, std::string unit, std::span<const double> residuals,
                 std::span<const int> part, std::span<const double> value, double full_scale);

}  // namespace sinew::identify
