// run/simulation/test_log.h - comparison of the log of a run on a board with that of the
// simulation.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/signals/table.h"

namespace sinew::run {

// Checks that everything that a board can provide is there with the same bits, and nothing else.
inline void expect_same_log(const signals::Table& simulated, const signals::Table& far) {
  ASSERT_EQ(simulated.series.size(), far.series.size());
  for (std::size_t s = 0; s < far.series.size(); ++s) {
    const signals::Series &a = simulated.series[s], &b = far.series[s];
    ASSERT_EQ(a.topic.name, b.topic.name);
    if (a.topic.name.starts_with("/true/")) {
      EXPECT_TRUE(b.time_ns.empty()) << "only a simulation knows " << a.topic.name;
      continue;
    }
    ASSERT_EQ(a.time_ns.size(), b.time_ns.size()) << a.topic.name;
    for (std::size_t i = 0; i < a.time_ns.size(); ++i) {
      ASSERT_EQ(a.time_ns[i], b.time_ns[i]) << a.topic.name << " sample " << i;
      for (std::size_t c = 0; c < a.columns.size(); ++c) {
        const double x = a.columns[c][i], y = b.columns[c][i];
        ASSERT_TRUE(x == y || (std::isnan(x) && std::isnan(y)))
            << a.topic.name << " at " << 1e-9 * double(a.time_ns[i]) << " s: " << x << ", " << y;
      }
    }
  }
}

}  // namespace sinew::run
