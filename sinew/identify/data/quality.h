// identify/data/quality.h - what a column of measured numbers gives away about the sensor behind
// it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// A sensor that has met its end repeats one extreme value, which noise would not.
struct Clipping {
  std::size_t at_top = 0, at_bottom = 0;  // samples in plateaus at the extreme
  double top = 0, bottom = 0;
  bool clipped = false;
};

// Plateaus of at least `shortest` equal samples at the largest or smallest value, if the other
// samples show that values do vary from sample to sample. A sensor that rests at zero is not
// clipped: plateaus at exactly 0 do not count.
Clipping clipping(std::span<const double> values, std::size_t shortest = 5);

// Each is 0 where there are no values.
double smallest(std::span<const double> values);
double largest(std::span<const double> values);
double median(std::span<const double> values);

// Scale of the spread that outliers do not move: 1.4826 times the median distance from the median,
// the standard deviation of normal noise.
double spread(std::span<const double> values);

// Residuals that stand apart from the others: farther from their median than eight times their
// spread and than `at_least`. Slips of the pen do; fewer than five residuals tell nothing.
std::vector<std::size_t> outliers(std::span<const double> residuals, double at_least);

// Returns a value of the column [SI] in the unit that its file has, for messages: "29 psi gauge".
std::string in_unit_of_file(const Measured& data, std::string_view column, double value,
                            int digits);

// Throws Refusal if all values of the column lie within `tolerance` of each other.
void refuse_constant(const Measured& data, std::string_view column, double tolerance,
                     std::string_view why, std::string_view try_this);

// Throws Refusal if the column is clipped.
void refuse_clipped(const Measured& data, std::string_view column, std::string_view try_this);

// Returns a table whose rows each differ from those before them, with a note that counts the
// others: a row that repeats an earlier one in every column is no new evidence. A recording, which
// has a time, stays as it is.
Measured each_row_once(Measured data);
// Does the same for rows of two kinds, for example fitted and held-out ones: a row repeats only
// others of its kind. `kinds` has the kind of each row and loses the rows that the table loses.
Measured each_row_once(Measured data, std::vector<bool>& kinds);

}  // namespace sinew::identify
