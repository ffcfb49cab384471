// Tests that both sides of each comparison compute the same laws.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/appendix_a.h"
#include "bench/peers/drill.h"
#include "bench/peers/pair.h"
#include "bench/peers/stand_peers.h"

namespace sinew::bench {
namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] / b[i] - 1.0));
  return most;
}

TEST(Drill, AllWaysFillTheMusclesAlike) {
  const Drill d = drill(1);
  Pressures by(drill_machines * drill_muscles * drill_samples), other = by;
  by_network(d, &by);
  by_pow(d, &other);
  EXPECT_LT(largest_difference(other, by), 1e-6);
  for (const Wide& wide : widths()) {
    wide.run(d, &other);
    EXPECT_LT(largest_difference(other, by), 1e-9) << wide.width;
    wide.run(drill(1, 10), &other);
    EXPECT_LT(largest_difference(other, by), 1e-6) << wide.width << " by nodes";
  }
}

// Appendix A with small steps agrees with the adaptive integrators.
TEST(Stand, AdaptiveIntegratorsAgreeWithTheThesis) {
  Lengths exact(appendix_a_milliseconds);
  appendix_a(1000, exact.data());
  const auto worst = [&](void (*run)(double, int, Lengths&)) {
    Lengths l(appendix_a_milliseconds);
    run(1e-10, 1, l);
    return largest_difference(l, exact);
  };
  for (const StandPeer& peer : stand_peers()) EXPECT_LT(worst(peer.run), 2e-6) << peer.name;
}

TEST(Quantile, InterpolatesBetweenSortedValues) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  for (const double share : {0.0, 0.05, 0.25, 0.5, 0.755, 1.0})
    EXPECT_DOUBLE_EQ(quantile(values, share), 100 * share);
}

}  // namespace
}  // namespace sinew::bench
