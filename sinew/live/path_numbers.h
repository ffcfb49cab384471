// live/path_numbers.h - numbers in the path of a request.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace sinew::live {

// Returns the number behind `begin`, which is the whole rest of the path.
inline std::optional<std::size_t> number_in(std::string_view path, std::string_view begin) {
  if (!path.starts_with(begin)) return std::nullopt;
  path.remove_prefix(begin.size());
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), out);
  if (error != std::errc{} || end != path.data() + path.size()) return std::nullopt;
  return out;
}

// Returns the numbers of a list "3,5,8"; nothing where anything else stands in it.
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

}  // namespace sinew::live
