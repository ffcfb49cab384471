#include "sinew/config/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "sinew/config/utf8.h"

namespace sinew::config {

namespace {

constexpr std::size_t longest_quote = 60;
constexpr std::string_view nothing = "nothing";  // found text for a missing key

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

std::string to_text(const Problem& problem) {
  std::string text = problem.where.file;
  if (problem.where.line > 0) {
    text += fmt::format(":{}:{}", problem.where.line, problem.where.column);
  }
  if (!text.empty()) text += ": ";
  if (!problem.key.empty()) text += problem.key + ": ";
  const bool missing = !problem.key.empty() && problem.found == nothing;
  text += missing ? "missing" : "found " + problem.found;
  text += "; expected " + problem.expected;
  if (!problem.try_this.empty()) text += "; try " + problem.try_this;
  return printable(text, "");  // on one line
}

std::string to_text(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_text(problem);
  }
  return text;
}

Error::Error(std::vector<Problem> problems)
    : problems_(std::move(problems)), text_(to_text(problems_)) {}

Error::Error(const Problem& problem) : Error(std::vector<Problem>(1, problem)) {}

void fail(Location where, std::string key, std::string found, std::string expected,
          std::string try_this) {
  Problem problem;
  problem.where = std::move(where);
  problem.key = std::move(key);
  problem.found = std::move(found);
  problem.expected = std::move(expected);
  problem.try_this = std::move(try_this);
  throw Error(problem);
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

std::string closest_in_quotes(std::string_view word,
                              const std::vector<std::string_view>& candidates) {
  const std::string_view near = closest(word, candidates);
  return near.empty() ? "" : in_quotes(near);
}

std::string either(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string listed(const std::vector<std::string>& words, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i)
    text += (i > 0 ? ", " : "") + words[i];
  return words.size() > most ? fmt::format("{} and {} more", text, words.size() - most) : text;
}

std::string in_quotes(std::string_view text) {
  if (text.size() <= longest_quote) return fmt::format("\"{}\"", text);
  // Does not split a UTF-8 character.
  std::size_t end = longest_quote;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return fmt::format("\"{}…\"", text.substr(0, end));
}

}  // namespace sinew::config
