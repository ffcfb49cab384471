// units/mistake.h - reason why a text is not valid, the parts of a message.
#pragma once

#include <string>

namespace sinew::units {

// Text as it was found, its expected form, and advice.
struct Mistake {
  std::string found;
  std::string expected;
  std::string try_this;  // empty: no suggestion
};

// Returns "found …; expected …; try …".
inline std::string to_text(const Mistake& m) {
  return "found " + m.found + "; expected " + m.expected +
         (m.try_this.empty() ? "" : "; try " + m.try_this);
}

}  // namespace sinew::units
