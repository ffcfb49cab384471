// tests/robots/runs.h - shipped experiments as numbers.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/bands/shipped.h"

namespace sinew::test {

// NaN, which no comparison passes, where the summary has no such key.
inline double figure(const analysis::Summary& s, const char* key) {
  const double* value = s.find(key);
  EXPECT_NE(value, nullptr) << key;
  return value ? *value : std::numeric_limits<double>::quiet_NaN();
}

inline std::string seed(int n) { return "seed=" + std::to_string(n); }

}  // namespace sinew::test
