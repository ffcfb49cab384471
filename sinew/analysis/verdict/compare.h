// analysis/verdict/compare.h - two runs against each other: the samples of a channel, the figures.
//
// Samples of two recordings a and b meet in one of these ways:
//
//   together   both have one within half a tick (50 us): those two. What only one has is left out.
//   between    fewer than half of the sparser one's samples have one that near, as with other
//              periods: at its times, the other on the straight line between the two samples around
//   held       edges of a valve, shut before the first one: each holds until the next
//
//   d_i = b_i - a_i        not a number where one of them is none, so gaps stay gaps
//   rms = sqrt(mean d_i^2) over the samples that met; of edges over time, which makes it the root
//                          of the share of time in which one is open and the other shut
//   bias = mean d_i        what one is above the other throughout; rms^2 = bias^2 + var(d)
//   r = cov(a, b)/sqrt(var(a)·var(b))    over the same samples; none where one is constant
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

// How the samples of two channels meet: not at all, at the same times, between each other's, or as
// edges that hold until the next one.
enum class Meeting { never, together, between, held };
// Returns it in words.
std::string_view to_text(Meeting how);

// A channel's samples, in ascending time; points into a table.
struct Recording {
  const signals::Times* time_ns = nullptr;
  const signals::Column* values = nullptr;
};

// Where the samples of two channels meet, and by how much they differ there.
struct Meetings {
  Meeting how = Meeting::never;
  signals::Times time_ns;      // of the first; of the sparser one where it is `between`
  signals::Column difference;  // b - a
};

// Brings two channels together. Where neither has the other's times, the denser one is taken
// between its samples.
Meetings meet(Recording a, Recording b);
// Edges within [from, to)  [ns]. A time for every change of their difference, the first at `from`.
Meetings meet_edges(Recording a, Recording b, std::int64_t from, std::int64_t to);

// How far two channels are from each other.
struct Difference {
  Meeting how = Meeting::never;
  bool same = false;        // the same times, and the same bits in every sample
  std::size_t samples = 0;  // that met and are numbers in both
  std::size_t gaps = 0;     // that met and are none in one or both
  double rms = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();      // in magnitude, with its sign
  double at = std::numeric_limits<double>::quiet_NaN();           // when it first was so [s]
  double bias = std::numeric_limits<double>::quiet_NaN();         // mean
  double correlation = std::numeric_limits<double>::quiet_NaN();  // of both, not of edges
  double span = 0;  // greatest less least value of both: what a difference is large or small beside

  bool equal() const { return samples > 0 && largest == 0; }  // wherever they meet
  // rms beside the span; 0 where they are equal.
  double share() const { return span > 0 && std::isfinite(rms) ? rms / span : 0; }
};

// Sums up where two channels meet; the second one is of edges within [from, to)  [ns].
Difference difference(Recording a, Recording b, const Meetings& met);
Difference difference_of_edges(Recording a, Recording b, std::int64_t from, std::int64_t to);

// --- tables ---

// One field of a channel that two tables have, and how far they are from each other.
struct ChannelDifference {
  std::string topic, field, unit;
  Difference difference;
};

bool is_edges(std::string_view topic);  // "/valve/…/open"

// First and last time of any channel but edges  [ns]; nothing of an empty table.
struct Times {
  std::int64_t first = 0, last = 0;
};
// Returns them for a table.
std::optional<Times> times_of(const signals::Table&);

// Of all fields that both have, by name and unit, in the first one's order.
std::vector<ChannelDifference> differences(const signals::Table& a, const signals::Table& b);

// Every time less `by`  [ns].
void shift(signals::Table&, std::int64_t by);

// --- figures ---

// One key of several summaries.
struct FigureRow {
  std::string key;
  std::vector<std::optional<double>> values;  // one per run
};

// Every key that a summary has: in the first one's order, then what only others have.
std::vector<FigureRow> figures_beside(const std::vector<const Summary*>&);

// (other - first)/|first|  [-]; nothing where the first is 0 and the other is not.
std::optional<double> relative_difference(double first, double other);

// The largest |other - first|/max(|first|, |other|) of a row, from 0 to 2: by which rows are
// ordered. 0 where there are not two values.
double size_of_change(const FigureRow&);

}  // namespace sinew::analysis
