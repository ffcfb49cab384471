// config/origin.h - origin of a value: the provenance that `sinew show` prints.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

struct Origin {
  std::string path;    // muscle.hip_flexor.mount_length
  std::string unit;    // the field's, SI; empty for text, flags and whole numbers
  std::string text;    // as written; for a default: as it would be written
  std::string source;  // "table 6-1"; empty: the file gives none
  bool fit = false;
  bool guess = false;
  bool is_default = false;                        // not given in the file
  std::vector<std::string> range;                 // as written: lowest and highest, or empty
  std::optional<std::array<double, 2>> range_si;  // the range in SI, for `number` fields
  std::string uncertainty;                        // as written
  Location where;
};

using Origins = std::vector<Origin>;

// Returns the origin of the value at that path; nullptr if unknown.
const Origin* find_origin(const Origins& origins, std::string_view path);

}  // namespace sinew::config
