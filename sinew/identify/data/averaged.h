// identify/data/averaged.h - long tables as averages of their rows: a million rows of a sensor show
// no more of a law than some thousands of averages, and take hundreds of times as long to fit.
#pragma once

#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Longer tables are averaged, to at most this many rows.
inline constexpr std::size_t most_rows = 4000, averaged_rows = 2000;

// Returns a table of more than 4000 rows without a time as averages, with a note that counts them:
// of the rows of each setting, which are those in one cell of a grid over all columns but
// `response`. The grid divides the range of each column into 4096 equal steps, or half as many
// until there are at most 2000 settings. Other tables are returned as they are.
Measured settings_averaged(Measured data, std::string_view response);
// Does the same for rows of two kinds, of which no average is mixed; `kinds` has the kind of each
// row and then that of each average. Empty: there is one kind.
Measured settings_averaged(Measured data, std::string_view response, std::vector<bool>& kinds);

// Returns a recording of more than `most` rows as averages of as many consecutive rows each as
// leave no more than `most`, with a note. A shorter one is returned as it is.
Measured times_averaged(Measured data, std::size_t most = most_rows);

}  // namespace sinew::identify
