// live/request.h - requests of a page to the run that it shows, as JSON:
//
//   {"do": "pause"}   {"do": "resume"}   {"do": "pace", "value": 0.5}      0: no limit
//   {"do": "set", "key": "control.gains.hip.angle", "value": 0.003}        in the key's SI unit
//   {"do": "release", "key": "control.gains.hip.angle"}   {"do": "release all"}
//   {"do": "stop"}      for a machine that keeps its own time, instead of pause, resume and pace
#pragma once

#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/control/gait/change.h"

namespace sinew::live {

struct Request {
  // Action that a page requests.
  enum class Kind { pause, resume, pace, stop, set, release, release_all };

  Kind kind = Kind::pause;
  std::size_t setting = 0;  // index of the setting
  double value = 0;
};

inline constexpr std::size_t longest_request = 1024;  // [bytes]

// Reads a request. Throws std::invalid_argument with what was found and expected for any other
// text.
Request read_request(std::string_view text, const std::vector<gait::Setting>& settings);

// --- Numbers in the path of a request ---

// Returns the number after `begin`; empty if the rest of the path is not a number.
inline std::optional<std::size_t> number_in(std::string_view path, std::string_view begin) {
  if (!path.starts_with(begin)) return std::nullopt;
  path.remove_prefix(begin.size());
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), out);
  if (error != std::errc{} || end != path.data() + path.size()) return std::nullopt;
  return out;
}

// Returns the numbers of a list "3,5,8"; empty if the text is no such list.
inline std::optional<std::vector<std::size_t>> numbers_in(std::string_view list) {
  std::vector<std::size_t> out;
  while (true) {
    const std::size_t comma = list.find(',');
    const auto number = number_in(list.substr(0, comma), "");
    if (!number) return std::nullopt;
    out.push_back(*number);
    if (comma == list.npos) return out;
    list.remove_prefix(comma + 1);
  }
}

// --- Text of replies ---

// Type of a reply in plain text.
inline constexpr const char* plain = "text/plain; charset=utf-8";

// Returns a file's text; "" if it cannot be read.
inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace sinew::live
