// identify/fit/refusal.h - "these data cannot support this model": no fault of the file's form, and
// no reason to print a number nobody should use.
#pragma once

#include <stdexcept>
#include <string>

namespace sinew::identify {

// what() reads `subject: found …; expected …; try …`.
class Refusal : public std::runtime_error {
 public:
  // Makes the words of these four; `try_this` may be empty.
  Refusal(const std::string& subject, const std::string& found, const std::string& expected,
          const std::string& try_this)
      : std::runtime_error(subject + ": found " + found + "; expected " + expected +
                           (try_this.empty() ? "" : "; try " + try_this)) {}
  // In words that somebody has already found.
  explicit Refusal(const std::string& words) : std::runtime_error(words) {}
};

}  // namespace sinew::identify
