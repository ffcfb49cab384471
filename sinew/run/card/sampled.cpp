#include "sinew/run/card/sampled.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace sinew::run {
namespace {

using Words = std::array<std::uint64_t, words_of<Shown>>;

// Bits to change in a word: the lowest of each byte, which changes a flag, a count, or digits and
// exponent of a number; and the sign of a number.
constexpr std::uint64_t changed_bits[] = {0x0101010101010101, std::uint64_t{1} << 63};

// Returns the samples in which words are changed: with different true values, in all phases of the
// controller, with its flags set and not set.
std::vector<Words> samples() {
  std::vector<Words> out;
  for (const double value : {1.5, -0.3, 7e4})
    for (const control::Phase phase : {control::Phase::startup, control::Phase::running,
                                       control::Phase::venting, control::Phase::off})
      for (const int flags : {0, 1}) {
        Shown shown{};
        std::memset(static_cast<void*>(&shown.controller), flags, sizeof shown.controller);
        std::memset(static_cast<void*>(&shown.supervised), flags, sizeof shown.supervised);
        shown.controller.phase = phase;
        Words words;
        std::memcpy(words.data(), &shown, sizeof shown);
        for (std::size_t w = 0; w < words_of<plant::Truth>; ++w)
          words[w] = std::bit_cast<std::uint64_t>(value);
        out.push_back(words);
      }
  return out;
}

// Returns the values of all columns for a sample.
std::vector<double> values_of(std::span<const Column> columns, const Words& words,
                              Controllers& controllers) {
  Shown shown;
  std::memcpy(static_cast<void*>(&shown), words.data(), sizeof shown);
  plant::Truths truths;
  truths.robot = shown.truth;
  controllers.boards().show(shown.controller, shown.supervised,
                            {0, std::numeric_limits<signals::Tick>::max()});
  std::vector<double> out;
  controllers.with_snapshot(0, &truths, [&](const Snapshot& now) {
    for (const Column& column : columns) {
      double values[2] = {};
      column.value(now, values);
      out.insert(out.end(), {values[0], values[1]});
    }
  });
  return out;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

std::vector<std::uint16_t> words_behind(std::span<const Column> columns, Controllers& controllers) {
  std::array<bool, words_of<Shown>> needed{};
  for (Words words : samples()) {
    const std::vector<double> before = values_of(columns, words, controllers);
    for (std::size_t w = 0; w < words.size(); ++w) {
      for (const std::uint64_t bits : changed_bits) {
        words[w] ^= bits;
        needed[w] = needed[w] || !same(before, values_of(columns, words, controllers));
        words[w] ^= bits;
      }
    }
  }
  std::vector<std::uint16_t> out;
  for (std::size_t w = 0; w < needed.size(); ++w)
    if (needed[w]) out.push_back(static_cast<std::uint16_t>(w));
  return out;
}

}  // namespace sinew::run
