// identify/data/averaged.h - long tables as averages of their rows: a million rows of a sensor show
// no more of a law than some thousands of averages, and take hundreds of times as long to fit.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Longer tables are averaged, to at most this many rows.
inline constexpr std::size_t most_rows = 4000, averaged_rows = 2000;

// Returns a table of more than 4000 rows without a time as averages, with a note that counts them:
// of the rows of each setting, which are those with the same rest length and branch in one cell of
// a grid over all other columns but `response`. The grid divides the range of each column into 4096
// equal steps, or half as many until there are at most 2000 settings. The note has the scatter of
// the response within a setting, too. Other tables are returned as they are.
Measured settings_averaged(Measured data, std::string_view response);
// Does the same for rows of two kinds, of which no average is mixed; `kinds` has the kind of each
// row and then that of each average. Empty: there is one kind.
Measured settings_averaged(Measured data, std::string_view response, std::vector<bool>& kinds);

// When something changes, and in what time  [s].
struct QuickChange {
  double from = 0, duration = 0;
};

// Returns the shortest stretch of time in which values change by half of their range. `time`
// ascends, and there are as many values, two at least.
QuickChange quickest_change(std::span<const double> time, std::span<const double> values);

// Returns a recording of more than `most` rows as averages of as many consecutive rows each as
// leave no more than `most`, with a note; a shorter one is returned as it is. With a quickest
// change, no average lasts longer than a hundredth of it, and where that leaves more than `most`,
// only so many are kept, from shortly before the change on.
Measured times_averaged(Measured data, std::size_t most,
                        const std::optional<QuickChange>& quickest = {});
// Uses the quickest change of one of its columns.
Measured times_averaged(Measured data, std::size_t most, std::string_view watched);

}  // namespace sinew::identify
