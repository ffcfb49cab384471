// tests/guards/board_line.h - a line between a host and a board that disturbs the bytes on it, for
// a time and in one direction or both.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace sinew::run {

double in(std::mt19937& random, double low, double high);

enum class Spoil { nothing, drop, flip, delay, duplicate, truncate, reorder, babble, silence };
constexpr int spoils = 8;  // without `nothing`
constexpr const char* spoil_names[] = {"nothing",  "drop",    "flip",   "delay",  "duplicate",
                                       "truncate", "reorder", "babble", "silence"};

// One direction, with a probability in each portion of bytes.
class Spoiler {
 public:
  Spoiler(Spoil kind, double share, unsigned seed) : kind_(kind), share_(share), random_(seed) {}

  // The output for a portion of input; while it is not active only the bytes that it had held back.
  std::vector<std::uint8_t> operator()(std::vector<std::uint8_t> bytes, bool active);

  Spoil kind() const { return kind_; }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  std::vector<std::uint8_t> spoil(std::vector<std::uint8_t> bytes);

  Spoil kind_;
  double share_;
  std::mt19937 random_;
  std::vector<std::uint8_t> held_;
};

}  // namespace sinew::run
