// units/complain.h - what a field table says when no single key is wrong but two do not go
// together.
//
//   units::complain(v, "polynomial", "4 coefficients", "at most 3");
//
// Reaches visitors that read (config::Reader has `complain`); one that only prints has no use for
// it.
#pragma once

#include <string>
#include <string_view>

namespace sinew::units {

template <class Visitor>
void complain(Visitor& v, std::string_view key, std::string found, std::string expected,
              std::string try_this = "") {
  if constexpr (requires { v.complain(key, found, expected, try_this); }) {
    v.complain(key, found, expected, try_this);
  }
}

}  // namespace sinew::units
