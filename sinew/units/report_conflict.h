// units/report_conflict.h - reports that two keys of a field table exclude each other although each
// is valid.
//
//   units::report_conflict(v, "polynomial", "4 coefficients", "at most 3");
//
// A visitor without the function `report_conflict` ignores it.
#pragma once

#include <string>
#include <string_view>

namespace sinew::units {

template <class Visitor>
void report_conflict(Visitor& v, std::string_view key, std::string found, std::string expected,
                     std::string try_this = "") {
  if constexpr (requires { v.report_conflict(key, found, expected, try_this); }) {
    v.report_conflict(key, found, expected, try_this);
  }
}

}  // namespace sinew::units
