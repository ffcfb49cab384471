#include "sinew/recording/problems.h"

#include <fmt/format.h>

#include <utility>

namespace sinew::recording {

namespace {

constexpr std::size_t most_told = 8;

}  // namespace

void Problems::add(int line, int column, std::string key, std::string found, std::string expected,
                   std::string try_this) {
  ++count_;
  if (told_.size() < most_told)
    told_.push_back({{file_, line, column},
                     std::move(key),
                     std::move(found),
                     std::move(expected),
                     std::move(try_this)});
}

void Problems::finish() {
  if (told_.empty()) return;
  if (count_ > told_.size())
    told_.back().expected += fmt::format(" (and {} more such)", count_ - told_.size());
  throw config::Error(told_);
}

}  // namespace sinew::recording
