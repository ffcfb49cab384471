#include "sinew/config/diagnostics.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sinew/config/utf8.h"

namespace sinew::config {

namespace {

constexpr std::string_view nothing = "nothing";  // found text for a missing key

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

void fail(Location where, std::string key, units::Mistake mistake) {
  fail(std::move(where), std::move(key), std::move(mistake.found), std::move(mistake.expected),
       std::move(mistake.try_this));
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

void Problems::add(int line, int column, std::string key, std::string found, std::string expected,
                   std::string try_this) {
  add({{file_, line, column},
       std::move(key),
       std::move(found),
       std::move(expected),
       std::move(try_this)});
}

void Problems::add(Problem problem) {
  ++count_;
  if (problems_.size() < most_) problems_.push_back(std::move(problem));
}

void Problems::finish() {
  if (problems_.empty()) return;
  if (count_ > problems_.size())
    problems_.back().expected += fmt::format(" (and {} more such)", count_ - problems_.size());
  throw Error(problems_);
}

}  // namespace sinew::config
