// identify/contest/refusal.h - error for data that cannot support a model: the file is well-formed,
// but a result would be useless.
#pragma once

#include <stdexcept>
#include <string>

namespace sinew::identify {

// Thrown by identifications. what() reads `subject: found …; expected …; try …`.
class Refusal : public std::runtime_error {
 public:
  // Builds the message from four parts; `try_this` may be empty.
  Refusal(const std::string& subject, const std::string& found, const std::string& expected,
          const std::string& try_this)
      : std::runtime_error(subject + ": found " + found + "; expected " + expected +
                           (try_this.empty() ? "" : "; try " + try_this)) {}
  // Uses a complete message.
  explicit Refusal(const std::string& words) : std::runtime_error(words) {}
};

}  // namespace sinew::identify
