// analysis/state_hash.h - one number for everything that a run recorded: two runs have the same
// hash if every sample of every channel, true values included, and every valve edge have equal
// bits.
//
// The hash is FNV-1a with 64 bits of these bytes, channel by channel in the order of their names:
//
//   the name, without an end
//   its times         64-bit integers [ns], lowest byte first
//   field by field    64-bit IEEE 754 numbers in SI, lowest byte first; each NaN as
//   7ff8000000000000
//
// It depends on neither the order of the channels in the table nor the layout of a struct.
#pragma once

#include <functional>
#include <string>

#include "sinew/signals/table.h"

namespace sinew::analysis {

// Returns the hash as 16 hexadecimal digits, of all channels or of those for which chosen(name)
// holds.
std::string state_hash(const signals::Table& table);
std::string state_hash(const signals::Table& table,
                       const std::function<bool(const std::string& name)>& chosen);

}  // namespace sinew::analysis
