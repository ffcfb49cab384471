// Dry friction before slip, in slip and with fading, compared with closed forms; delayed sensors;
// files that are no recording of a pair.
#include "sinew/identify/pair/pair_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/pair/pair_fixture_test.h"

namespace sinew::identify::pair_law_test {
namespace {

PairRecord moved(const std::function<double(double)>& position, double seconds, double step) {
  PairRecord out;
  for (int i = 0; i * step <= seconds; ++i) {
    out.time.push_back(i * step);
    out.at.push_back(position(i * step));
  }
  out.rate = out.acceleration = std::vector<double>(out.size(), 0.0);
  return out;
}

std::vector<double> friction_of(PairFriction kind, const PairValues& values, const PairRecord& r,
                                double start = 0) {
  std::vector<double> out(r.size());
  pair_friction({.name = "", .law = "", .source = "", .friction = kind}, values, start, r, out);
  return out;
}

TEST(PairFriction, ASmallReversalIsASpringAndALargeOneSlips) {
  const PairValues values{.friction = 1, .presliding = 1e-5};
  const auto small = [](double t) { return 3e-6 * std::sin(t); };
  const PairRecord r = moved(small, 20, 0.01);
  const std::vector<double> w = friction_of(PairFriction::bristle, values, r);
  for (std::size_t i = 0; i < w.size(); ++i) EXPECT_NEAR(w[i], r.at[i] / 1e-5, 1e-12);

  // Loss of a cycle of amplitude X: 4 D (X - d).
  const double amplitude = 1e-4;
  const PairRecord large = moved([&](double t) { return amplitude * std::sin(t); }, 20, 1e-3);
  const std::vector<double> slips = friction_of(PairFriction::bristle, values, large);
  double work = 0;
  const auto cycle = static_cast<std::size_t>(2 * std::numbers::pi / 1e-3);
  for (std::size_t i = 5000; i < 5000 + cycle; ++i)
    work += 0.5 * (slips[i] + slips[i + 1]) * (large.at[i + 1] - large.at[i]);
  EXPECT_NEAR(work, 4 * (amplitude - 1e-5), 0.01 * work);
}

TEST(PairFriction, FadesAtRestAndIsViscousInASlowSlip) {
  const PairValues values{.friction = 1, .presliding = 1e-5, .fade_time = 0.5};
  const PairRecord still = moved([](double) { return 0.0; }, 2, 1e-3);
  const std::vector<double> w = friction_of(PairFriction::fading, values, still, 0.8);
  for (std::size_t i = 0; i < w.size(); i += 100)
    EXPECT_NEAR(w[i], 0.8 * std::exp(-still.time[i] / 0.5), 1e-9);

  const PairRecord slow = moved([](double t) { return 4e-6 * t; }, 10, 1e-3);
  EXPECT_NEAR(friction_of(PairFriction::fading, values, slow).back(), 4e-6 * 0.5 / 1e-5, 1e-3);
  const PairRecord fast = moved([](double t) { return 4e-5 * t; }, 10, 1e-3);
  EXPECT_EQ(friction_of(PairFriction::fading, values, fast).back(), 1);
}

TEST(PairRecord, RatesAreThoseOfTheMotionAndDoNotLag) {
  const PairRecord r = test_record({.noise = 0}, 1);
  for (std::size_t i = 50; i + 50 < r.size(); ++i) {
    const double t = r.time[i], h = 1e-4;
    const double rate = (test_position(t + h, 0) - test_position(t - h, 0)) / (2 * h);
    EXPECT_NEAR(r.rate[i], rate, 1e-5) << t;  // of 2e-3
  }
}

std::string refused(std::vector<Column> columns) {
  Measured data{.file = "x.csv", .columns = std::move(columns)};
  data.lines.resize(data.columns[0].values.size());
  try {
    (void)pair_record(data);
  } catch (const Refusal& e) {
    return e.what();
  }
  return "nothing";
}

TEST(PairRecord, WhatIsNoneIsRefused) {
  std::vector<double> many(200), still(200, 1.0);
  for (std::size_t i = 0; i < 200; ++i) many[i] = 0.01 * static_cast<double>(i);
  const Column time{.name = "time", .unit = "s", .values = many};
  const Column force{.name = "force", .unit = "N", .values = many};
  const Column at{.name = "displacement", .unit = "m", .values = many};
  EXPECT_EQ(refused({time, force}),
            "x.csv: found neither force and displacement nor torque and angle; expected the one or "
            "the other; try names.force=NAME, names.displacement=NAME");
  EXPECT_EQ(refused({time, force, {.name = "displacement", .unit = "m", .values = still}}),
            "x.csv: displacement: found 1 m throughout; expected a pair that is moved; try the "
            "column, or the sensor");
  EXPECT_EQ(refused({time, force, at}), "nothing");
  const std::vector<double> few(10, 1.0);
  EXPECT_EQ(refused({{.name = "time", .unit = "s", .values = few},
                     {.name = "force", .unit = "N", .values = few},
                     {.name = "displacement", .unit = "m", .values = few}}),
            "x.csv: found 10 samples; expected at least 100 of a motion; try a longer recording");
}

}  // namespace
}  // namespace sinew::identify::pair_law_test
