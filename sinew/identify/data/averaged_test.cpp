// Long tables are averaged within their settings, recordings over time; short ones are unchanged.
#include "sinew/identify/data/averaged.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace sinew::identify::averaged_test {
namespace {

Measured table_of(std::vector<Column> columns) {
  Measured out{.file = "long.csv", .columns = std::move(columns)};
  out.lines.resize(out.columns[0].values.size());
  std::iota(out.lines.begin(), out.lines.end(), 2);
  return out;
}

// Simulates a force of 1 N per Pa with noise of 1 N, at 50 pressures of two lengths.
Measured sweep(std::size_t rows) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0, 1);
  std::vector<double> length, pressure, force;
  for (std::size_t i = 0; i < rows; ++i) {
    length.push_back(i % 2 == 0 ? 0.2 : 0.25);
    pressure.push_back(static_cast<double>(i / 2 % 50));
    force.push_back(pressure.back() + noise(random));
  }
  return table_of({{.name = "length", .values = length},
                   {.name = "pressure", .values = pressure},
                   {.name = "force", .values = force}});
}

TEST(Averaged, AShortTableStaysAsItIs) {
  const Measured m = settings_averaged(sweep(most_rows), "force");
  EXPECT_EQ(m.rows(), most_rows);
  EXPECT_TRUE(m.notes.empty());
}

TEST(Averaged, RowsOfOneSettingBecomeTheirAverage) {
  const Measured m = settings_averaged(sweep(100000), "force");
  ASSERT_EQ(m.rows(), 100u);
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_TRUE(m.notes[0].starts_with(
      "100000 rows are averaged to 100 settings: within one each column but force differs by "
      "at most 1/4096 of its range"))
      << m.notes[0];
  for (std::size_t i = 0; i < m.rows(); ++i) {
    EXPECT_EQ(m.lines[i], 2 + static_cast<int>(i));
    EXPECT_NEAR(m["length"][i], i % 2 == 0 ? 0.2 : 0.25, 1e-12);
    EXPECT_NEAR(m["force"][i], m["pressure"][i], 4 / std::sqrt(1000.0));
  }
}

TEST(Averaged, ThereAreNeverMoreThanTwoThousandSettings) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<double> length(20000), pressure(20000);
  for (double& x : length) x = any(random);
  for (double& x : pressure) x = any(random);
  const Measured m = settings_averaged(
      table_of({{.name = "length", .values = length}, {.name = "pressure", .values = pressure}}),
      "force");
  EXPECT_LE(m.rows(), averaged_rows);
  EXPECT_GT(m.rows(), averaged_rows / 8);
}

// All averages together count as a table that is just short enough not to be averaged.
TEST(Averaged, AnAverageWeighsAsItsIndependentRows) {
  // 100 settings; at the second length each reading is logged ten times over.
  Measured m = sweep(100000);
  std::vector<double> held(100);
  for (std::size_t i = 0; i < m.rows(); ++i) {
    if (i / 100 % 10 == 0) held[i % 100] = m["force"][i];
    if (i % 2 == 1) m.columns[2].values[i] = held[i % 100];
  }
  const Measured out = settings_averaged(m, "force");
  ASSERT_EQ(out.rows(), 100u);
  double first = 0, second = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    (i % 2 == 0 ? first : second) += out.weights[i];
    EXPECT_NEAR(out.variances[i], 1, 0.6);
  }
  EXPECT_NEAR(first + second, most_rows, 1e-6);
  EXPECT_NEAR(first / second, 10, 2);
}

TEST(Averaged, RisingAndFallingPressureAreAveragedApart) {
  Measured m = sweep(100000);
  for (std::size_t i = 0; i < m.rows(); ++i) {
    const std::size_t step = i / 2 % 100;
    m.columns[1].values[i] = static_cast<double>(std::min(step, 99 - step));
    m.columns[2].values[i] = m.columns[1].values[i] + (step < 50 ? -8 : 8);
  }
  const Measured out = settings_averaged(m, "force");
  int above = 0, below = 0;
  for (std::size_t i = 0; i < out.rows(); ++i) {
    const double pressure = out["pressure"][i];
    if (pressure < 2 || pressure > 48) continue;
    const double away = out["force"][i] - pressure;
    EXPECT_NEAR(std::abs(away), 8, 1e-9);
    ++(away > 0 ? above : below);
  }
  // At each of two lengths, the 47 pressures from 2 to 48.
  EXPECT_EQ(above, 94);
  EXPECT_EQ(below, 94);
}

TEST(Averaged, RowsOfTwoKindsAreNotMixed) {
  std::vector<bool> fitted;
  for (int i = 0; i < 100000; ++i) fitted.push_back(i % 4 < 2);
  const Measured m = settings_averaged(sweep(fitted.size()), "force", &fitted);
  ASSERT_EQ(m.rows(), 100u);
  ASSERT_EQ(fitted.size(), m.rows());
  for (std::size_t i = 0; i < m.rows(); ++i) EXPECT_EQ(fitted[i], i % 4 < 2);
}

TEST(Averaged, ARecordingBecomesAveragesOfConsecutiveRows) {
  std::vector<double> time(10001);
  std::iota(time.begin(), time.end(), 0.0);
  const Measured m = times_averaged(table_of({{.name = "time", .values = time}}), 4000);
  ASSERT_EQ(m.rows(), 3334u);
  EXPECT_EQ(m.notes[0], "10001 rows are averaged to 3334, each of 3 rows");
  EXPECT_EQ(m["time"][0], 1);
  EXPECT_EQ(m["time"][3332], 9997);
  EXPECT_EQ(m["time"][3333], 9999.5);
  EXPECT_EQ(m.lines[1], 5);
  EXPECT_EQ(times_averaged(table_of({{.name = "force", .values = time}}), 4000).rows(),
            time.size());
}

TEST(Averaged, ARecordingKeepsItsQuickestChange) {
  std::vector<double> time(100000), pressure;
  for (std::size_t i = 0; i < time.size(); ++i) time[i] = 1e-3 * static_cast<double>(i);
  for (const double t : time) pressure.push_back(std::clamp((t - 50) / 0.8, 0.0, 1.0));
  const QuickChange quickest = quickest_change(time, pressure);
  EXPECT_NEAR(quickest.duration, 0.4, 2e-3);
  EXPECT_NEAR(quickest.from, 50, 0.401);
  const Measured m = times_averaged(
      table_of({{.name = "time", .values = time}, {.name = "pressure", .values = pressure}}), 1000,
      quickest);
  EXPECT_EQ(m.rows(), 1000u);
  EXPECT_EQ(m.notes[0],
            "100000 rows are averaged to 1000, each of 4 rows, those from 49.6 to 53.6 s: longer "
            "averages hide its changes");
}

// Two muscles that differ by 2 mm are not averaged together.
TEST(Averaged, LabelsAreKept) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  Measured m{.file = "t.csv"};
  m.columns = {{"rest_length", "m", {}},
               {"length", "m", {}},
               {"pressure", "Pa gauge", {}},
               {"force", "N", {}}};
  for (int row = 0; row < 12000; ++row) {
    const double rest = row % 3 == 0 ? 0.1 : row % 3 == 1 ? 0.102 : 0.3;
    m.columns[0].values.push_back(rest);
    m.columns[1].values.push_back(rest * (0.8 + 0.2 * share(random)));
    m.columns[2].values.push_back(6e5 * share(random));
    m.columns[3].values.push_back(100 * share(random));
    m.lines.push_back(row + 1);
  }
  const Measured out = settings_averaged(m, "force");
  EXPECT_LE(out.rows(), averaged_rows);
  const std::vector<double>& rest = out["rest_length"];
  for (const double r : rest)
    EXPECT_TRUE(std::abs(r - 0.1) < 1e-12 || std::abs(r - 0.102) < 1e-12 ||
                std::abs(r - 0.3) < 1e-12)
        << r;
}

}  // namespace
}  // namespace sinew::identify::averaged_test
