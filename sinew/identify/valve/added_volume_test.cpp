// Two fillings, one with a known volume joined, determine conductance and volume separately.
#include "sinew/identify/valve/added_volume.h"

#include <cmath>
#include <random>

#include "sinew/gas/orifice.h"
#include "sinew/identify/valve/chamber.h"
#include "sinew/identify/valve/fixtures_test.h"

namespace sinew::identify::added_volume_test {
namespace {

constexpr double true_conductance = 1e-8, true_volume = 5e-4;  // [m3/(s Pa)], [m3]

// A filling with noise, of the chamber and the joined volume.
AddedFill filled(double added, double noise, unsigned seed,
                 gas::Flow::Law law = gas::Flow::Law::iso6358) {
  const gas::Air air;
  const double k = true_conductance / (true_volume + added);
  const Chamber chamber{.law = law,
                        .conductance = k,
                        .critical_ratio = 0.3,
                        .exponent = 1,
                        .port = 7e5,
                        .start = 1.02e5};
  Values time, pressure;
  for (int i = 0; i < 120; ++i) time.push_back(i * 2.6e-7 / k);
  pressure.resize(time.size());
  const Opening opening{8 * 2.6e-7 / k, true};
  EXPECT_TRUE(simulate(chamber, air, {&opening, 1}, time, pressure));
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  for (double& p : pressure) p += normal(random);
  return {table({{"time", "s", time}, {"pressure", "Pa abs", pressure}}), added};
}

ValveOptions isothermal() {
  ValveOptions options;
  options.exponent = 1;
  return options;
}

TEST(ValveAddedVolume, TwoFillingsGiveConductanceAndVolume) {
  const std::vector<AddedFill> fills{filled(0, 500, 1), filled(5e-4, 500, 2)};
  const ValveResult r = identify_added(fills, isothermal());
  EXPECT_TRUE(r.refused.empty()) << r.refused;
  EXPECT_TRUE(r.flow_known);
  EXPECT_EQ(r.report.best().model, "iso isothermal");
  EXPECT_NEAR(r.valve.flow.sonic_conductance / true_conductance, 1, 0.02);
  EXPECT_NEAR(r.valve.flow.critical_pressure_ratio, 0.3, 0.02);
  EXPECT_NEAR(parameter(r, "volume").value / true_volume, 1, 0.02);
}

// For 100 pairs with noise of 0.3 % of the range, 90 to 99 intervals of 95 % contain each truth.
TEST(ValveAddedVolume, IntervalsHoldTheTruth) {
  const FillModel* rigid = nullptr;
  for (const FillModel& m : fill_models())
    if (m.name == "orifice isothermal") rigid = &m;
  ASSERT_NE(rigid, nullptr);
  int conductance = 0, volume = 0;
  constexpr auto law = gas::Flow::Law::orifice;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const std::vector<AddedFill> fills{filled(0, 2e3, 2 * seed, law),
                                       filled(5e-4, 2e3, 2 * seed + 1, law)};
    const std::vector<Curve> curves{curve_of(fills[0].data), curve_of(fills[1].data)};
    const ValveOptions options = isothermal();
    Report report{.full_scale = 1};
    fit_added(fills, curves, options, report, {rigid, 1});
    const Fit& fit = report.fits[0];
    ASSERT_TRUE(fit.refused.empty()) << fit.refused;
    const Estimate &c = fit.parameters[0], &v = fit.parameters[1];
    conductance += c.low <= true_conductance && true_conductance <= c.high;
    volume += v.low <= true_volume && true_volume <= v.high;
  }
  EXPECT_GE(conductance, 90);
  EXPECT_GE(volume, 90);
  EXPECT_LE(conductance + volume, 198);
}

// The volume does not depend on the exponent: a wrong one changes all C/V by one factor, and C with
// them.
TEST(ValveAddedVolume, AWrongExponentMovesTheConductanceAndNotTheVolume) {
  const std::vector<AddedFill> fills{filled(0, 100, 1, gas::Flow::Law::orifice),
                                     filled(5e-4, 100, 2, gas::Flow::Law::orifice)};
  ValveOptions options = isothermal();
  options.exponent = 1.15;
  options.worst_fit = 20;
  const ValveResult r = identify_added(fills, options);
  const double c = r.valve.flow.law == gas::Flow::Law::orifice
                       ? gas::sonic_conductance_of(r.valve.flow.area, gas::Air())
                       : r.valve.flow.sonic_conductance;
  EXPECT_GT(std::abs(c / true_conductance - 1), 0.03);
  EXPECT_NEAR(parameter(r, "volume").value / true_volume, 1, 0.02);
}

// The predicted accuracy of a second filling is the scatter of many.
TEST(ValveAddedVolume, ThePromisedSeparationIsThatOfManyTrials) {
  constexpr double half = 0.02;
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, half / 1.96);
  for (const double ratio : {0.5, 1.0, 3.0}) {
    double cc = 0, vv = 0;
    constexpr int trials = 20000;
    for (int i = 0; i < trials; ++i) {
      const double first = 1 + normal(random), second = (1 + ratio) * (1 + normal(random));
      const double c = ratio / (second - first), v = c * first;
      cc += (c - 1) * (c - 1) / trials;
      vv += (v - 1) * (v - 1) / trials;
    }
    const Separation s = expected_separation(half, ratio);
    EXPECT_NEAR(1.96 * std::sqrt(cc) / s.conductance, 1, 0.1) << ratio;
    EXPECT_NEAR(1.96 * std::sqrt(vv) / s.volume, 1, 0.1) << ratio;
  }
}

// Rows of both in one table, one after the other or alternating.
TEST(ValveAddedVolume, AColumnPartsTheRowsOfOneTable) {
  const AddedFill first = filled(0, 100, 1), second = filled(5e-4, 100, 2);
  Values time, pressure, added;
  for (std::size_t i = 0; i < first.data.rows(); ++i)
    for (const AddedFill* fill : {&first, &second}) {
      time.push_back(fill->data["time"][i]);
      pressure.push_back(fill->data["pressure"][i]);
      added.push_back(fill->added);
    }
  const std::vector<AddedFill> parts = fills_by_column(table(
      {{"time", "s", time}, {"pressure", "Pa abs", pressure}, {"added_volume", "m3", added}}));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].data["pressure"], first.data["pressure"]);
  EXPECT_EQ(parts[1].data["time"], second.data["time"]);
  EXPECT_EQ(parts[1].added, 5e-4);
}

TEST(ValveAddedVolume, DataWithoutInformationAreRefused) {
  const AddedFill one = filled(0, 100, 1), other = filled(5e-4, 100, 2);
  const auto refused = [](std::vector<AddedFill> fills) {
    return refusal_of([&] { identify_added(fills, isothermal()); });
  };
  expect_says(refused({one}), "added_volume: found one filling; expected two at least");
  expect_says(refused({one, one}), "found 2 fillings with the same volume joined");
  // Exchanged: a larger volume that fills faster.
  std::vector<AddedFill> exchanged{other, one};
  exchanged[0].added = 0;
  exchanged[1].added = 5e-4;
  expect_says(refused(exchanged), "fills no slower with more volume joined to it");
}

TEST(ValveFill, RowsOfTwoValvesThatAlternateAreDistinguished) {
  const AddedFill first = filled(0, 100, 1), second = filled(1e-3, 100, 2);
  Values time, pressure;
  for (std::size_t i = 0; i < first.data.rows(); ++i) {
    time.push_back(first.data["time"][i]);
    pressure.push_back(first.data["pressure"][i]);
    time.push_back(first.data["time"][i] + 1e-6);
    pressure.push_back(0.5 * second.data["pressure"][i]);
  }
  const Measured mixed = table({{"time", "s", time}, {"pressure", "Pa abs", pressure}});
  expect_says(refusal_of([&] { identify_fill(mixed, isothermal()); }),
              "found 2 curves whose rows take turns; expected the rows of one filling or venting; "
              "try where=");
}

}  // namespace
}  // namespace sinew::identify::added_volume_test
