// The play: its end does not depend on the steps, loops close, and friction dissipates.
#include "sinew/actuator/hysteresis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::hysteresis_test {
namespace {

constexpr double bar = 1e5;
constexpr double inch = 0.0254;

Actuator with(Hysteresis h) {
  Actuator a = thesis_actuator();
  a.hysteresis = h;
  return a;
}

struct Point {
  double length = 0, gauge_pressure = 0;
};

// Moves from one point to the next in n equal steps and returns the work that friction dissipates.
double go(const Actuator& a, Point from, Point to, int n, double& z) {
  double taken = 0;
  double volume_before = volume(a.braid, from.length);
  double s_before = from.gauge_pressure -
                    effective_pressure(a, from.length, from.gauge_pressure, z).gauge_pressure;
  for (int i = 1; i <= n; ++i) {
    const double part = static_cast<double>(i) / n;
    const double length = from.length + part * (to.length - from.length);
    const double p = from.gauge_pressure + part * (to.gauge_pressure - from.gauge_pressure);
    const EffectivePressure f = effective_pressure(a, length, p, z);
    z = f.play;
    const double v = volume(a.braid, length), s = p - f.gauge_pressure;
    taken += 0.5 * (s + s_before) * (v - volume_before);
    volume_before = v;
    s_before = s;
  }
  return taken;
}

TEST(Hysteresis, NoWidthIsNoFriction) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> pressures(-0.3 * bar, 8 * bar), lengths(2.5, 4.0);
  const Actuator a = with({.half_width = 0, .volume_pressure = 5 * bar});
  EXPECT_FALSE(has_hysteresis(a.hysteresis));
  double z = 0;
  for (int i = 0; i < 1000; ++i) {
    const double p = pressures(random);
    const EffectivePressure f = effective_pressure(a, lengths(random) * inch, p, z);
    z = f.play;
    EXPECT_NEAR(f.gauge_pressure, p, 1e-9 * bar);
  }
}

// Filling reduces the effective pressure by w, venting raises it by w; in between it is constant.
TEST(Hysteresis, FillAndVentStandTwoWidthsApart) {
  const Actuator a = with({.half_width = 0.02 * bar, .width_per_pressure = 0.01});
  const double l = 3.2 * inch;
  double z = play_at_rest(a, l, 0);
  go(a, {l, 0}, {l, 4 * bar}, 100, z);
  EXPECT_NEAR(effective_pressure(a, l, 4 * bar, z).gauge_pressure, 3.94 * bar, 1e-6);
  go(a, {l, 4 * bar}, {l, 6 * bar}, 7, z);
  go(a, {l, 6 * bar}, {l, 5.95 * bar}, 3, z);
  EXPECT_NEAR(effective_pressure(a, l, 5.95 * bar, z).gauge_pressure, 5.92 * bar,
              1e-6);  // as at 6 bar
  go(a, {l, 5.95 * bar}, {l, 4 * bar}, 50, z);
  EXPECT_NEAR(effective_pressure(a, l, 4 * bar, z).gauge_pressure, 4.06 * bar, 1e-6);
}

// Any number of steps through the same turning points ends at the same play.
TEST(Hysteresis, StepsOfAnySizeAgree) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> pressures(0, 7 * bar);
  const double l = 3.1 * inch;
  for (int trial = 0; trial < 200; ++trial) {
    const Actuator a = with({.half_width = 0.03 * bar, .width_per_pressure = 0.01 * (trial % 40)});
    double once = play_at_rest(a, l, 0), often = once, from = 0;
    for (int turn = 0; turn < 10; ++turn) {
      const double to = pressures(random);
      go(a, {l, from}, {l, to}, 1, once);
      go(a, {l, from}, {l, to}, 137, often);
      EXPECT_NEAR(once, often, 1e-9 * bar);
      from = to;
    }
  }
}

// A contracted mesh has slid further: the loop is wider by d per contraction, and no narrower than
// a beyond L_max.
TEST(Hysteresis, LoopsGrowWithTheContraction) {
  const Actuator a = with({.half_width = 0.01 * bar, .width_per_contraction = 0.4 * bar});
  for (const double contraction : {-0.02, 0.0, 0.1, 0.3}) {
    const double l = (1 - contraction) * a.long_end.length;
    double z = play_at_rest(a, l, 0);
    go(a, {l, 0}, {l, 5 * bar}, 10, z);
    const double fill = effective_pressure(a, l, 5 * bar, z).gauge_pressure;
    go(a, {l, 5 * bar}, {l, 7 * bar}, 10, z);
    go(a, {l, 7 * bar}, {l, 5 * bar}, 10, z);
    const double gap = effective_pressure(a, l, 5 * bar, z).gauge_pressure - fill;
    EXPECT_NEAR(gap, 0.02 * bar + 0.8 * bar * std::max(contraction, 0.0), 1e-6 * bar);
  }
}

// Filling pulls a share less than the mean, and venting as much more, at every length: exactly if
// the tension is linear in the pressure, and within a tenth of the loop for elastic ends and a toe.
TEST(Hysteresis, AShareOfTheTensionIsTheSameAtEveryLength) {
  for (const bool soft : {false, true}) {
    Actuator a = with({.width_per_tension = 0.025});
    a.effectiveness = {.threshold = 0.3 * bar};
    a.bladder = {.stiffness = 300, .rest_length = 3.6 * inch};
    if (soft) {
      a.series.compliance = 2e-5;
      a.toe.tension = 3;
    }
    for (const double length : {2.8, 3.1, 3.5}) {
      const double l = length * inch, p = 4 * bar;
      double z = play_at_rest(a, l, 0);
      go(a, {l, 0}, {l, p}, 100, z);
      const double fill = effective_pressure(a, l, p, z).gauge_pressure;
      go(a, {l, p}, {l, 7 * bar}, 100, z);
      go(a, {l, 7 * bar}, {l, p}, 100, z);
      const double vent = effective_pressure(a, l, p, z).gauge_pressure;
      const auto force = [&](double at) { return tension(a, l, 0, at, units::atmosphere); };
      EXPECT_NEAR(force(vent) - force(fill), 0.05 * force(p), (soft ? 5e-3 : 1e-9) * force(p));
    }
  }
}

TEST(Hysteresis, IsBoundedAndGrowsWithThePressure) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> pressures(-0.2 * bar, 7 * bar), lengths(2.5, 4.0),
      steps(0, 0.1 * bar);
  Actuator a = with({.half_width = 0.05 * bar,
                     .width_per_pressure = 0.3,
                     .width_per_contraction = 0.4 * bar,
                     .volume_pressure = 20 * bar});
  double z = 0;
  for (int i = 0; i < 10000; ++i) {
    if (i == 5000) {  // half the friction from the tension, with a bladder that pulls by itself
      a.hysteresis.width_per_tension = 0.2;
      a.effectiveness = {.threshold = 0.3 * bar};
      a.bladder = {.stiffness = 600, .rest_length = 3 * inch};
    }
    const double l = lengths(random) * inch, p = pressures(random);
    const EffectivePressure low = effective_pressure(a, l, p, z),
                            high = effective_pressure(a, l, p + steps(random), z);
    EXPECT_LE(std::abs(low.gauge_pressure - p), half_width(a, l, p) + 1e-9 * bar);
    EXPECT_GE(high.gauge_pressure, low.gauge_pressure - 1e-9 * bar);
    EXPECT_NEAR(effective_pressure(a, l, p, low.play).gauge_pressure, low.gauge_pressure,
                1e-9 * bar);
    z = low.play;
  }
}

// After one cycle, a loop of pressure or of length is closed.
TEST(Hysteresis, LoopsClose) {
  const Actuator a = with({.half_width = 0.04 * bar, .volume_pressure = 10 * bar});
  for (const auto& [one, other] :
       {std::pair{Point{3.2 * inch, 1 * bar}, Point{3.2 * inch, 5 * bar}},
        std::pair{Point{2.6 * inch, 4 * bar}, Point{3.7 * inch, 4 * bar}}}) {
    double z = play_at_rest(a, one.length, one.gauge_pressure);
    go(a, one, other, 200, z);
    const double first = z;
    go(a, other, one, 200, z);
    const double back = z;
    go(a, one, other, 200, z);
    EXPECT_NEAR(z, first, 1e-9 * bar);
    go(a, other, one, 200, z);
    EXPECT_NEAR(z, back, 1e-9 * bar);
    EXPECT_GT(std::abs(first - back), 0.04 * bar);
  }
}

// At constant pressure friction dissipates in every closed loop of length, and 2 w per volume in a
// wide one: twice w (DV - 2 w/K') with K' = K/V_max, for it yields by 2 w/K' at each reversal.
TEST(Hysteresis, LoopsOfLengthTake) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> lengths(2.45, 4.0);
  const double w = 0.05 * bar, p = 4 * bar;
  const Actuator a = with({.half_width = w, .volume_pressure = 40 * bar});
  Actuator wider = a;
  wider.hysteresis.width_per_contraction = 0.3 * bar;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Point> corners;
    for (int i = 0; i < 6; ++i) corners.push_back({lengths(random) * inch, p});
    const Actuator& one = trial % 2 ? wider : a;
    double z = play_at_rest(one, corners[0].length, p), taken = 0;
    for (int round = 0; round < 2; ++round) {  // the first reaches the loop
      taken = 0;
      for (std::size_t i = 0; i < corners.size(); ++i)
        taken += go(one, corners[i], corners[(i + 1) % corners.size()], 300, z);
    }
    EXPECT_GE(taken, -1e-7) << trial;  // [J]
  }

  const Point one{2.45 * inch, p}, other{3.9 * inch, p};
  double z = play_at_rest(a, one.length, p);
  go(a, one, other, 20000, z);
  go(a, other, one, 20000, z);
  double taken = go(a, one, other, 20000, z);
  taken += go(a, other, one, 20000, z);
  const double dv = volume(a.braid, one.length) - volume(a.braid, other.length);
  const double per_volume =
      a.hysteresis.volume_pressure / volume(a.braid, shortest_length(a.braid));
  EXPECT_NEAR(taken / (2 * w * (dv - 2 * w / per_volume)), 1, 1e-3);
}

// Loops of both: never less than -w V_max/K times the total change of pressure.
TEST(Hysteresis, LoopsOfBothReturnNoMoreThanTheBound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> lengths(2.45, 4.0), pressures(0.5 * bar, 7 * bar);
  const Actuator a = with({.half_width = 0.05 * bar, .volume_pressure = 40 * bar});
  const double greatest = volume(a.braid, shortest_length(a.braid));
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Point> corners;
    for (int i = 0; i < 4; ++i) corners.push_back({lengths(random) * inch, pressures(random)});
    double z = play_at_rest(a, corners[0].length, corners[0].gauge_pressure), taken = 0, way = 0;
    for (int round = 0; round < 2; ++round) {
      taken = way = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point& next = corners[(i + 1) % corners.size()];
        way += std::abs(next.gauge_pressure - corners[i].gauge_pressure);
        taken += go(a, corners[i], next, 500, z);
      }
    }
    const Hysteresis& h = a.hysteresis;
    EXPECT_GE(taken, -h.half_width * greatest / h.volume_pressure * way - 1e-6) << trial;
  }
}

// At constant pressure the mesh pulls harder while it is stretched than while it shortens.
TEST(Hysteresis, StretchingPullsHarder) {
  const Actuator a = with({.half_width = 0.1 * bar, .volume_pressure = 40 * bar});
  const double p = 4 * bar, l = 3.2 * inch;
  double z = play_at_rest(a, 2.8 * inch, p);
  go(a, {2.8 * inch, p}, {l, p}, 100, z);
  const double stretched = effective_pressure(a, l, p, z).gauge_pressure;
  go(a, {l, p}, {3.6 * inch, p}, 100, z);
  go(a, {3.6 * inch, p}, {l, p}, 100, z);
  const double shortened = effective_pressure(a, l, p, z).gauge_pressure;
  EXPECT_NEAR(stretched - shortened, 0.2 * bar, 1e-6 * bar);
  EXPECT_GT(clamped_tension(a, l, 0, stretched, thesis_atmosphere),
            clamped_tension(a, l, 0, shortened, thesis_atmosphere));
}

}  // namespace
}  // namespace sinew::actuator::hysteresis_test
