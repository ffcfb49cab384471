// run/simulation/test_same.h - bitwise comparison of two tables.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sinew/signals/table.h"

namespace sinew::run {

// Checks topics, times and numbers, bit for bit; NaN equals NaN.
inline void expect_same(const signals::Table& a, const signals::Table& b) {
  ASSERT_EQ(a.series.size(), b.series.size());
  for (std::size_t s = 0; s < a.series.size(); ++s) {
    const std::string& name = a.series[s].topic.name;
    ASSERT_EQ(name, b.series[s].topic.name);
    ASSERT_EQ(a.series[s].time_ns, b.series[s].time_ns) << name;
    for (std::size_t c = 0; c < a.series[s].columns.size(); ++c)
      for (std::size_t i = 0; i < a.series[s].columns[c].size(); ++i) {
        const double x = a.series[s].columns[c][i], y = b.series[s].columns[c][i];
        ASSERT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << name << " sample " << i;
      }
  }
}

}  // namespace sinew::run
