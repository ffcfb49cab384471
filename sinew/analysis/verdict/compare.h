// analysis/verdict/compare.h - comparison of two runs: the samples of a channel, the figures.
//
// Samples of two recordings a and b meet in one of these ways:
//
//   together   samples within half a tick (50 us) of each other form pairs; others are left out
//   between    if fewer than half of the sparser one's samples have a partner, as with other
//              periods: at its times, the other one interpolated linearly
//   held       edges of a valve, shut before the first one: each holds until the next
//
//   d_i = b_i - a_i        NaN if one of them is, so that gaps stay gaps
//   rms = sqrt(mean d_i^2) over the samples that met; for edges over time, which makes it the root
//                          of the share of time in which one is open and the other shut
//   bias = mean d_i        rms^2 = bias^2 + var(d)
//   r = cov(a, b)/sqrt(var(a)·var(b))    over the same samples; NaN if one is constant
//
// Exchanging a and b changes the sign of every d_i and nothing else.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// The way in which the samples of two channels meet, see above.
enum class Pairing { never, together, between, held };
// Returns its name.
std::string_view to_text(Pairing how);

// A channel's samples, in ascending time; points into a table.
struct Recording {
  const signals::Times* time_ns = nullptr;
  const signals::Column* values = nullptr;
};

// Times at which the samples of two channels meet, and their differences.
struct PairedSamples {
  Pairing how = Pairing::never;
  signals::Times time_ns;      // a's times; the sparser one's if they meet `between`
  signals::Column difference;  // b - a
};

// Pairs the samples of two channels, `together` or `between`.
PairedSamples pair_samples(Recording a, Recording b);
// Compares edges within [from, to)  [ns]: a time for every change of their difference, the first at
// `from`.
PairedSamples pair_edges(Recording a, Recording b, std::int64_t from, std::int64_t to);

// Difference of two channels.
struct Difference {
  Pairing how = Pairing::never;
  bool same = false;        // equal times, and equal bits in every sample
  std::size_t samples = 0;  // pairs that are finite in both
  std::size_t gaps = 0;     // pairs that are not finite in one or both
  double rms = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();  // in magnitude, with its sign
  double at = std::numeric_limits<double>::quiet_NaN();       // time of its first occurrence [s]
  double bias = std::numeric_limits<double>::quiet_NaN();     // mean
  double correlation = std::numeric_limits<double>::quiet_NaN();  // r; not for edges
  double span = 0;  // greatest less least value of both, the scale of share()

  // Returns whether all pairs are equal.
  bool equal() const { return samples > 0 && largest == 0; }
  // Returns rms/span; 0 if the span is 0 or no samples met.
  double share() const { return span > 0 && std::isfinite(rms) ? rms / span : 0; }
};

// Return the difference of two channels, from their pairs; or of edges within [from, to)  [ns].
Difference difference(Recording a, Recording b, const PairedSamples& met);
Difference difference_of_edges(Recording a, Recording b, std::int64_t from, std::int64_t to);

// --- tables ---

// Difference of one field of a channel that two tables have.
struct ChannelDifference {
  std::string topic, field, unit;
  Difference difference;
};

bool is_edges(std::string_view topic);  // "/valve/…/open"

// First and last time of a table  [ns].
struct Times {
  std::int64_t first = 0, last = 0;
};
// Returns the times of a table without its channels of edges; empty if no such channel has samples.
std::optional<Times> times_of(const signals::Table&);

// Returns the differences of all fields that both have, by name and unit, in the first one's order.
std::vector<ChannelDifference> differences(const signals::Table& a, const signals::Table& b);

// Subtracts `by` from every time  [ns].
void shift(signals::Table&, std::int64_t by);

// --- figures ---

// Values of one key in several summaries.
struct FigureRow {
  std::string key;
  std::vector<std::optional<double>> values;  // one per run
};

// Returns a row for every key: those of the first summary in its order, then those that only others
// have.
std::vector<FigureRow> compare_figures(const std::vector<const Summary*>&);

// Returns (other - first)/|first|  [-]; empty if the first is 0 and the other is not.
std::optional<double> relative_difference(double first, double other);

// Returns the largest |other - first|/max(|first|, |other|) of a row, from 0 to 2, for sorting
// rows; 0 if the first or all others are missing.
double size_of_change(const FigureRow&);

}  // namespace sinew::analysis
