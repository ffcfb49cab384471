// config/key_places.h - where the keys of a TOML text stand in it, to the byte, so that one can be
// written otherwise and all else stays: comments, blanks, order, ends of lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::config {

// One mention of a key: in `key = value`, in a dotted key, in the header of a table. A table that
// is mentioned in three headers has three.
struct KeyPlace {
  std::vector<std::string> path;   // from the root; lists have no index
  std::size_t begin = 0, end = 0;  // of its own segment, quotes included  [bytes]
  int line = 1;
  std::size_t value = 0;  // where its value begins; 0: it is a header's or a table's
};

// In order of appearance. The text is TOML that the parser took: of another one the places mean
// nothing.
std::vector<KeyPlace> key_places(std::string_view text);

// "joint.hip.damping".
std::string dotted(const std::vector<std::string>& path);

}  // namespace sinew::config
