// Flows with slopes have the values of the flows, and their slopes are the derivatives.
#include "sinew/gas/slopes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace sinew::gas::slopes_test {
namespace {

// A flow against its law, and its slopes against differences over 2e-6 of y, except next to a
// kink, where a difference covers both sides.
template <class Law, class Sloped>
void expect_slopes(const Law& law, const Sloped& sloped, double y_a, double y_b, double scale) {
  constexpr double h = 1e-6;
  const SlopedFlow f = sloped(y_a, y_b);
  EXPECT_NEAR(f.flow, law(y_a, y_b), 1e-12 * scale);
  const double before_a = law(y_a - h, y_b), after_a = law(y_a + h, y_b);
  const double before_b = law(y_a, y_b - h), after_b = law(y_a, y_b + h);
  const double bend_a = after_a - 2 * f.flow + before_a, bend_b = after_b - 2 * f.flow + before_b;
  if (std::abs(bend_a) > 1e-7 * scale || std::abs(bend_b) > 1e-7 * scale) return;
  EXPECT_NEAR(f.by_a, (after_a - before_a) / (2 * h), 2e-4 * (scale + std::abs(f.by_a)));
  EXPECT_NEAR(f.by_b, (after_b - before_b) / (2 * h), 2e-4 * (scale + std::abs(f.by_b)));
}

class Slopes : public ::testing::Test {
 protected:
  double y() { return std::uniform_real_distribution<double>(0.95, 1.35)(random_); }

  const Air air_{};
  std::mt19937 random_{7};
};

TEST_F(Slopes, OfEveryValveLaw) {
  const Flow orifice{.area = 1e-6}, rounded{.law = Flow::Law::appendix_a, .area = 1e-6};
  const Flow iso{
      .law = Flow::Law::iso6358, .sonic_conductance = 2e-9, .critical_pressure_ratio = 0.3};
  for (const Flow& flow : {orifice, rounded, iso}) {
    const FlowConstants c = flow_constants(flow, air_);
    for (int k = 0; k < 2000; ++k) {
      const double a = y(), b = k % 4 == 0 ? a * (1 + 1e-4 * (y() - 1.1)) : y();
      expect_slopes([&](double ya, double yb) { return flow_y(c, ya, yb); },
                    [&](double ya, double yb) { return sloped_flow_y(c, ya, yb); }, a, b, c.gain);
    }
  }
}

TEST_F(Slopes, SideBySideAreThoseOfEachLane) {
  using S = units::Pack<4>;
  const Flow orifice{.area = 1e-6}, rounded{.law = Flow::Law::appendix_a, .area = 1e-6};
  const Flow iso{
      .law = Flow::Law::iso6358, .sonic_conductance = 2e-9, .critical_pressure_ratio = 0.3};
  const std::array<FlowConstants, 4> each{flow_constants(orifice, air_), flow_constants(iso, air_),
                                          flow_constants(rounded, air_), flow_constants(iso, air_)};
  const auto c = units::side_by_side<FlowConstantsOf<S>>(each);
  for (int k = 0; k < 2000; ++k) {
    S a, b;
    for (int lane = 0; lane < 4; ++lane) {
      a.set(lane, y());
      b.set(lane, k % 4 == 0 ? a[lane] * (1 + 1e-4 * (y() - 1.1)) : y());
    }
    const SlopedFlowOf<S> all = sloped_flow_side_by_side(c, a, b);
    for (int lane = 0; lane < 4; ++lane) {
      const FlowConstants& one = each[static_cast<std::size_t>(lane)];
      const SlopedFlow f = sloped_flow_y(one, a[lane], b[lane]);
      EXPECT_NEAR(all.flow[lane], f.flow, 1e-12 * one.gain);
      EXPECT_NEAR(all.by_a[lane], f.by_a, 1e-12 * (one.gain + std::abs(f.by_a)));
      EXPECT_NEAR(all.by_b[lane], f.by_b, 1e-12 * (one.gain + std::abs(f.by_b)));
    }
  }
}

TEST_F(Slopes, OfHosesAndLeaks) {
  const Hose pipe{.law = Hose::Law::pipe, .length = 0.7, .inner_diameter = 2.5e-3};
  const Hose fitting{
      .law = Hose::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = 0.4};
  const LeakConstants leak = leak_constants({.area = 2e-8, .conductance = 1e-11}, air_);
  for (int k = 0; k < 4000; ++k) {
    const double a = y(), b = y();
    for (const Hose& hose : {pipe, fitting}) {
      const HoseConstants c = hose_constants(hose, air_);
      expect_slopes([&](double ya, double yb) { return hose_flow_y(c, ya, yb); },
                    [&](double ya, double yb) { return sloped_hose_flow_y(c, ya, yb); }, a, b,
                    1e-3);
    }
    expect_slopes([&](double ya, double yb) { return leak_flow_y(leak, ya, yb); },
                  [&](double ya, double yb) { return sloped_leak_flow_y(leak, ya, yb); }, a, b,
                  leak.hole.gain);
  }
}

}  // namespace
}  // namespace sinew::gas::slopes_test
