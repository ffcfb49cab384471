#include "sinew/analysis/state_hash.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "sinew/units/hash.h"

namespace sinew::analysis {
namespace {

// Returns the hash after eight more bytes, the lowest first.
std::uint64_t with_word(std::uint64_t hash, std::uint64_t word) {
  std::array<std::byte, 8> bytes{};
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(word & 0xff);
    word >>= 8;
  }
  return units::hash(bytes, hash);
}

std::uint64_t bits_of(double value) {
  return std::isnan(value) ? 0x7ff8000000000000 : std::bit_cast<std::uint64_t>(value);
}

}  // namespace

std::string state_hash(const signals::Table& table) {
  return state_hash(table, [](const std::string&) { return true; });
}

std::string state_hash(const signals::Table& table,
                       const std::function<bool(const std::string& name)>& chosen) {
  std::map<std::string_view, const signals::Series*> by_name;
  for (const signals::Series& series : table.series)
    if (chosen(series.topic.name)) by_name[series.topic.name] = &series;
  std::uint64_t hash = units::hash("");
  for (const auto& [name, series] : by_name) {
    hash = units::hash(name, hash);
    for (const std::int64_t t : series->time_ns)
      hash = with_word(hash, static_cast<std::uint64_t>(t));
    for (const signals::Column& column : series->columns)
      for (const double value : column) hash = with_word(hash, bits_of(value));
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace sinew::analysis
