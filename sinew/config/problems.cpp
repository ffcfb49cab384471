#include "sinew/config/problems.h"

#include <fmt/format.h>

#include <utility>

namespace sinew::config {

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
