// identify/data/averaged.h - averaging of long tables: a million rows of a sensor determine a law
// no better than some thousands of averages, and take hundreds of times as long to fit.
//
// An average over a setting has the weight of its independent rows: their number, divided by
//
//   k var(m)/var(x) (1 + 2 sum of the autocorrelation of m)        at least 1
//
// x is the response in the order of the rows, m its averages over k consecutive ones. So a value
// that was held and logged quickly does not outweigh the others. All averages together count as
// 4000 readings at most, as the law's own errors are alike in neighbouring rows: a table that is
// logged more densely gives the intervals of one that is just short enough not to be averaged.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Longer tables are averaged, to at most `averaged_rows` rows.
inline constexpr std::size_t most_rows = 4000, averaged_rows = 2000;

// Returns a table of more than 4000 rows without a time as averages over settings, with a note of
// their number. The rows of a setting have the same rest length and branch - without a column of
// branches, the same sign of the pressure's change - and are in one cell of a grid over all other
// columns but `response`. The grid divides the range of each column into 4096 equal steps, halved
// until there are at most 2000 settings; in such wider cells the response follows the columns, and
// all rows count as independent. The note also states the scatter of the response within settings.
// Other tables are returned unchanged. Rows of two kinds are never averaged together: `kinds` is
// the kind of each row, on return that of each average. Null or empty: one kind.
Measured settings_averaged(Measured data, std::string_view response,
                           std::vector<bool>* kinds = nullptr);

// Start and duration of a change [s].
struct QuickChange {
  double from = 0, duration = 0;
};

// Returns the shortest interval in which the values change by half of their range. `time` ascends
// and has the size of `values`, at least two.
QuickChange quickest_change(std::span<const double> time, std::span<const double> values);

// Returns a recording of more than `most` rows as averages of equally many consecutive rows, at
// most `most` of them, with a note; a shorter one unchanged. If `quickest` is given, no average is
// longer than a hundredth of its duration; should that leave more than `most`, only the part that
// begins shortly before the change is kept.
Measured times_averaged(Measured data, std::size_t most,
                        const std::optional<QuickChange>& quickest = {});
// Averages a recording by the quickest change of the column `watched`.
Measured times_averaged(Measured data, std::size_t most, std::string_view watched);

}  // namespace sinew::identify
