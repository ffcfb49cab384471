// identify/data/quality.h - signs of sensor problems in a column of measured values.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Clipping of a sensor: at its limit it repeats one extreme value, which noise would not.
struct Clipping {
  std::size_t at_top = 0, at_bottom = 0;  // samples in plateaus at the extreme
  double top = 0, bottom = 0;
  bool clipped = false;
};

// Finds plateaus of at least `shortest` equal samples at the largest or smallest value, if other
// samples show that values vary from sample to sample. Plateaus at exactly 0 do not count: a
// sensor that rests at zero is not clipped.
Clipping clipping(std::span<const double> values, std::size_t shortest = 5);

// Return 0 if there are no values.
double smallest(std::span<const double> values);
double largest(std::span<const double> values);
double median(std::span<const double> values);

// Returns the median of the values up to `reach` places away from each; fewer at the ends.
std::vector<double> running_medians(std::span<const double> values, std::size_t reach);

// Returns the differences of neighbouring values.
std::vector<double> steps_of(std::span<const double> values);

// Returns a robust standard deviation: 1.4826 times the median distance from the median, which is
// the standard deviation of normal noise.
double spread(std::span<const double> values);

// Returns the indices of residuals farther from their median than eight times their spread and than
// `at_least`, such as typing errors. Empty for fewer than five residuals.
std::vector<std::size_t> outliers(std::span<const double> residuals, double at_least);

// Returns a value of the column [SI] as text in the unit of its file, for messages: "29 psi gauge".
std::string in_unit_of_file(const Measured& data, std::string_view column, double value,
                            int digits);

// Throws Refusal if all values of the column are within `tolerance` of each other.
void refuse_constant(const Measured& data, std::string_view column, double tolerance,
                     std::string_view why, std::string_view try_this);

// Throws Refusal if the column is clipped.
void refuse_clipped(const Measured& data, std::string_view column, std::string_view try_this);

// Returns the table without rows that repeat an earlier one in every column, with a note of their
// number: they are no new evidence. A recording, which has a time, is returned unchanged. Of rows
// of two kinds, for example fitted and held-out ones, a row repeats only others of its kind:
// `kinds` is the kind of each row; entries of removed rows are removed. Null or empty: one kind.
Measured each_row_once(Measured data, std::vector<bool>* kinds = nullptr);

}  // namespace sinew::identify
