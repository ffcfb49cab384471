// run/card/sampled.h - the words of a sample (walk.h) from which a run's columns are computed.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/run/card/walk.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/controllers/controllers.h"

namespace sinew::run {

// Returns the numbers of the words that these columns depend on, ascending. They are found by
// trial: each word is changed in several samples, and the columns are computed again. `controllers`
// are left in another state.
std::vector<std::uint16_t> words_behind(std::span<const Column> columns, Controllers& controllers);

}  // namespace sinew::run
