// Derivatives of functions with a closed form, and delayed series.
#include "sinew/identify/data/series.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::identify::series_test {
namespace {

// The fit of a parabola is exact, also with uneven steps and at the ends.
TEST(Series, RatesOfAParabolaAreExact) {
  std::vector<double> time, values;
  for (int i = 0; i < 60; ++i) {
    time.push_back(0.01 * i + 0.003 * (i % 3));
    values.push_back(2 - 3 * time.back() + 5 * time.back() * time.back());
  }
  const Rates rates = rates_of(time, values, 0.1);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_NEAR(rates.first[i], -3 + 10 * time[i], 1e-9);
    EXPECT_NEAR(rates.second[i], 10, 1e-7);
  }
}

TEST(Series, ADelayIsAShiftInTime) {
  std::vector<double> time, values, out(500);
  for (int i = 0; i < 500; ++i) {
    time.push_back(0.01 * i + 0.002 * (i % 2));  // no even steps
    values.push_back(std::sin(time.back()));
  }
  delayed(time, values, 0.0234, out);
  for (std::size_t i = 5; i < 500; ++i) EXPECT_NEAR(out[i], std::sin(time[i] - 0.0234), 1e-5);
}

}  // namespace
}  // namespace sinew::identify::series_test
