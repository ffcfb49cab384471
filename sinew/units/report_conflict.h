// units/complain.h - reports that two keys of a field table exclude each other although each is
// valid.
//
//   units::complain(v, "polynomial", "4 coefficients", "at most 3");
//
// Only visitors that read handle it (config::Reader has `complain`); for others it does nothing.
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
