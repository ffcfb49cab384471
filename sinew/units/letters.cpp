#include "sinew/units/letters.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sinew::units {

namespace {

constexpr std::size_t longest_quote = 60;

// Returns the number of letters to change, add, drop or swap with their neighbour to turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({change, last[j] + 1, now[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = std::exchange(last, now);
  }
  return last[b.size()];
}

}  // namespace

std::string in_quotes(std::string_view text) {
  if (text.size() <= longest_quote) return '"' + std::string(text) + '"';
  // Does not split a UTF-8 character.
  std::size_t end = longest_quote;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return '"' + std::string(text.substr(0, end)) + "…\"";
}

std::string_view closest(std::string_view word, const std::vector<std::string_view>& candidates) {
  // Up to a third of the letters may be wrong, but not all letters of a short word.
  const std::size_t limit = std::max<std::size_t>(word.size() / 3, word.size() > 2 ? 1 : 0);
  std::string_view best;
  std::size_t best_distance = limit + 1;
  for (std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace sinew::units
