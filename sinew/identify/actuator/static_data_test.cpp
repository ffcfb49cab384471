// Tables and recordings become points, with units, branches and zeros; unusable ones are refused.
#include "sinew/identify/actuator/static_data.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/averaged.h"

namespace sinew::identify::static_data_test {
namespace {

constexpr double bar = 1e5, rest = 0.25;

StaticSetting truth() {
  StaticSetting s = setting_of({.rest_length = rest, .full_scale = 540, .top_pressure = 6.5 * bar});
  s.actuator.braid = {.thread_length = 0.28, .turns = 3.0};
  s.actuator.effectiveness.threshold = 0.4 * bar;
  s.actuator.bladder.saturating_tension = 130;
  s.actuator.bladder.saturation_length = 0.006;
  return s;
}

double force_at(double length, double pressure) {
  return predicted(truth(), {.rest_length = rest},
                   {.length = length, .pressure = pressure, .rest_length = rest});
}

// Four mounts, each filled and vented once, with friction of 8 kPa that no column shows.
Measured filled_and_vented(std::size_t rows) {
  std::mt19937 random(6);
  std::normal_distribution<double> noise(0, 1);
  Measured out{.file = "log.csv",
               .columns = {{"length", "m", {}}, {"pressure", "Pa gauge", {}}, {"force", "N", {}}}};
  for (std::size_t i = 0; i < rows; ++i) {
    const double share = std::fmod(4.0 * static_cast<double>(i) / static_cast<double>(rows), 1.0);
    const double length =
        rest - 0.01 * std::floor(4.0 * static_cast<double>(i) / static_cast<double>(rows));
    const double pressure = 6 * bar * (1 - std::abs(2 * share - 1));
    const double friction = share < 0.5 ? 8e3 : -8e3;
    out.columns[0].values.push_back(length);
    out.columns[1].values.push_back(pressure);
    out.columns[2].values.push_back(force_at(length, pressure - friction) + noise(random));
    out.lines.push_back(static_cast<int>(i) + 2);
  }
  return out;
}

// Filled for 20 s, vented for 10 s, 200 Hz; vented and at rest before.
std::string recording(double length, double zero_force, double zero_kpa, unsigned seed,
                      double clip = 1e9) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::string out = "time [s],force [N],pressure [kPa gauge]\n";
  for (int i = 0; i < 6200; ++i) {
    const double t = i / 200.0, s = t - 1;
    const double p = s < 0    ? 0
                     : s < 20 ? 600 * (1 - std::exp(-s / 5)) / (1 - std::exp(-4))
                              : 600 * std::exp(-(s - 20) / 2.5);
    const double f = force_at(length, 1e3 * p) + 1.5 * normal(random) + zero_force;
    out += fmt::format("{},{},{}\n", t, std::min(f, clip), p + 0.4 * normal(random) + zero_kpa);
  }
  return out;
}

Measured read(const std::string& text, Source source = {.path = "muscle.csv"}) {
  return parse_measured(text, source, static_columns());
}

// Reads a file of one length.
Measured read_at(double length, const std::string& text) {
  return read(text, {.path = "muscle.csv", .values = {fmt::format("length={} m", length)}});
}

std::string refusal_of(const std::string& text, const StaticInput& input = {}) {
  StaticData data;
  try {
    add_points(read(text), input, data);
    sort_points(data.points);
    identify_static(data, {});
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

// A table of 3900 rows is fitted row by row; logged ten times more densely it is averaged.
// Parameters agree to a tenth of their intervals, and the intervals to a tenth.
TEST(StaticData, ATableThatIsLoggedMoreDenselyGivesTheSameLaw) {
  const auto law_of = [](std::size_t rows) {
    StaticData data;
    add_points(settings_averaged(filled_and_vented(rows), "force"), {.rest_length = rest}, data);
    return identify_static(data, {.model = "threshold"}).report.best().parameters;
  };
  const std::vector<Estimate> once = law_of(3900), dense = law_of(39000);
  ASSERT_EQ(once.size(), dense.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    const double half = 0.5 * (once[i].high - once[i].low);
    EXPECT_NEAR(dense[i].value, once[i].value, 0.1 * half) << once[i].name;
    EXPECT_NEAR(0.5 * (dense[i].high - dense[i].low), half, 0.1 * half) << once[i].name;
  }
}

TEST(StaticData, TheScatterOfALoadIsThatOfItsWeight) {
  Measured m{.file = "loads.csv",
             .columns = {{"load", "kg", {0, 5, 20}},
                         {"pressure", "Pa gauge", {1e5, 2e5, 4e5}},
                         {"length", "m", {0.2, 0.22, 0.24}}},
             .lines = {2, 3, 4}};
  m.weights = {3, 3, 3};
  m.variances = {1e-4, 1e-4, 1e-4};
  StaticData data;
  add_points(m, {.rest_length = rest}, data);
  ASSERT_EQ(data.points.size(), 3u);
  for (const StaticPoint& p : data.points)
    EXPECT_DOUBLE_EQ(p.variance, 1e-4 * units::standard_gravity * units::standard_gravity);
}

TEST(StaticData, BranchesAndZerosOfARecordingAreFound) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> force(-30, 30), pressure(-10, 10);
  for (unsigned trial = 0; trial < 10; ++trial) {
    const double f0 = force(random), p0 = pressure(random);
    StaticData data;
    const Zero zero = add_points(read_at(0.235, recording(0.235, f0, p0, trial)), {}, data);
    EXPECT_NEAR(zero.force, f0, 0.5);
    EXPECT_NEAR(zero.pressure, 1e3 * p0, 150);
    int fill = 0, vent = 0;
    for (const StaticPoint& p : data.points) {
      (p.branch == Branch::fill ? fill : vent) += 1;
      EXPECT_NEAR(p.force, force_at(0.235, p.pressure), 6) << p.pressure;
    }
    EXPECT_GT(fill, 15);
    EXPECT_GT(vent, 15);
  }
}

// A hold stays a hold if single readings of its length are wild, and gives the same points.
TEST(StaticData, WildLengthsMakeNoSweepOfAHold) {
  Measured clean = read_at(0.235, recording(0.235, 0, 0, 1)), wild = clean;
  const auto length =
      std::ranges::find(wild.columns, "length", &recording::Column::name) - wild.columns.begin();
  for (const std::size_t row : {0, 500, 2000})
    wild.columns[static_cast<std::size_t>(length)].values[row] = row == 0 ? 0.0559 : 0.4;
  StaticData expected, found;
  add_points(clean, {}, expected);
  add_points(wild, {}, found);
  ASSERT_EQ(found.points.size(), expected.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    EXPECT_EQ(found.points[i].length, 0.235);
    EXPECT_NEAR(found.points[i].force, expected.points[i].force, 1);
    EXPECT_EQ(found.points[i].branch, expected.points[i].branch);
  }
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.back().find("3 of 6200 samples left out"), std::string::npos)
      << found.warnings.back();
}

// Checks that the sensors' zeros do not change the law.
TEST(StaticData, ZerosDoNotMatterToTheParameters) {
  const auto identify = [](double f0, double p0) {
    StaticData data;
    unsigned seed = 7;
    for (const double length : {0.25, 0.24, 0.22})
      add_points(read_at(length, recording(length, f0, p0, seed++)), {.rest_length = rest}, data);
    return identify_static(data, {.model = "saturating"});
  };
  const StaticResult clean = identify(0, 0), off = identify(-27, 9);
  for (std::size_t i = 0; i < clean.fit.free_parameters.size(); ++i) {
    const Estimate& e = clean.fit.solution.estimates[i];
    EXPECT_NEAR(off.fit.solution.values[i], e.value, e.high - e.low) << e.name;
  }
  EXPECT_LT(off.report.best().fit.rmse_percent, 1);
}

std::string table(double newton, double pascal, double zero = 0) {
  std::string out = fmt::format("length [mm],force [{}],pressure [{}]\n", newton == 1 ? "N" : "lbf",
                                pascal == 1e3 ? "kPa gauge" : "psi gauge");
  for (const double l : {250.0, 240.0, 225.0, 210.0})
    for (double p = 30e3; p <= 630e3; p += 40e3)
      out += fmt::format("{},{:.17g},{:.17g}\n", l, (force_at(l / 1e3, p) + zero) / newton,
                         p / pascal);
  return out;
}

TEST(StaticData, UnitsChangeNothing) {
  StaticData metric, inch;
  add_points(read(table(1, 1e3)), {.rest_length = rest}, metric);
  add_points(read(table(4.4482216152605, 6894.757293168361)), {.rest_length = rest}, inch);
  ASSERT_EQ(metric.points.size(), inch.points.size());
  for (std::size_t i = 0; i < metric.points.size(); ++i) {
    EXPECT_NEAR(metric.points[i].force, inch.points[i].force, 1e-9);
    EXPECT_NEAR(metric.points[i].pressure, inch.points[i].pressure, 1e-6);
  }
}

TEST(StaticData, SlackRowsOfATableDetermineTheZeroOfTheForce) {
  for (const double zero : {-30.0, 0.0, 20.0}) {
    StaticData data;
    EXPECT_NEAR(add_points(read(table(1, 1e3, zero)), {.rest_length = rest}, data).force, zero,
                1e-9);
  }
}

// A hanging mass pulls with its weight.
TEST(StaticData, MassesAreWeighed) {
  StaticData data;
  add_points(read("load [kg],length [mm],pressure [kPa gauge]\n1,200,100\n2,210,200\n"), {}, data);
  EXPECT_NEAR(data.points[1].force, 19.6133, 1e-9);
}

TEST(StaticData, AColumnMaySayTheBranchInWordsAndRowsMayBeChosen) {
  Source source{.path = "bins.csv"};
  const std::string text =
      "length [mm],force [N],pressure [kPa gauge],branch,muscle\n"
      "200,10,100,fill,a\n200,20,200,vent,a\n200,30,300,fill,b\n";
  StaticData data;
  source.where = {{"muscle", "a, c"}};
  add_points(read(text, source), {}, data);
  ASSERT_EQ(data.points.size(), 2u);
  EXPECT_EQ(data.points[0].branch, Branch::fill);
  EXPECT_EQ(data.points[1].branch, Branch::vent);
}

TEST(StaticData, GroupsFollowGapsAndElseSteps) {
  EXPECT_EQ(groups_of(std::vector{3.0, 1.0, 1.1, 2.9}, 0.5, 1), (std::vector{1, 0, 0, 1}));
  const std::vector<int> even = groups_of(std::vector{0.0, 0.4, 0.8, 1.2, 1.6}, 0.5, 1);
  EXPECT_EQ(even, (std::vector{0, 0, 1, 2, 3}));
}

TEST(StaticData, ASweepOfLengthsIsNoMountAndAMountIsOneWhateverItsReadings) {
  // Two mounts with readings that scatter by 0.2 %, and a sweep between them.
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> off(-2.5e-4, 2.5e-4);
  std::vector<double> lengths;
  for (int i = 0; i < 40; ++i) lengths.push_back((i % 2 ? 0.200 : 0.250) + off(random));
  const std::vector<int> mounts = mount_groups(lengths, 1e-3, widest_mount * 0.25);
  EXPECT_EQ(mounts, groups_of(lengths, 1e-3, 1e9));
  for (int i = 0; i <= 25; ++i) lengths.push_back(0.210 + 8e-4 * i);
  const std::vector<int> all = mount_groups(lengths, 1e-3, widest_mount * 0.25);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(all[i], i % 2 ? 0 : all[0]);
  // 20 mm in steps of 2.5 mm, none of them empty.
  EXPECT_EQ(all[40], 1);
  EXPECT_EQ(all[65], 8);
  EXPECT_EQ(all[0], 9);
  EXPECT_TRUE(std::ranges::is_sorted(all.begin() + 40, all.end()));
}

// A tensile testing machine pulls at constant pressure: 205 to 249.8 mm in steps of 0.8 mm at three
// pressures.
TEST(StaticData, ASweepOfLengthsGivesTheBraid) {
  const actuator::Braid braid{.thread_length = 0.3, .turns = 2.2};
  std::string text = "length [mm],pressure [bar gauge],force [N]\n";
  for (const int pressure : {2, 4, 6})
    for (int i = 0; i <= 56; ++i) {
      const double mm = 205 + 0.8 * i, l = 1e-3 * mm;
      const double area_law = (3 * l * l - braid.thread_length * braid.thread_length) /
                              (4 * std::numbers::pi * braid.turns * braid.turns);
      text += fmt::format("{:.1f},{},{:.3f}\n", mm, pressure, 1e5 * pressure * area_law);
    }
  StaticData data;
  add_points(read(text), {.rest_length = 0.25}, data);
  const StaticResult result = identify_static(data, {.model = "ideal"});
  std::map<std::string, double> found;
  for (const Estimate& e : result.report.best().parameters) found[e.name] = e.value;
  EXPECT_NEAR(found["thread_length"], braid.thread_length, 1e-6);
  EXPECT_NEAR(found["turns"], braid.turns, 1e-4);
}

// --- refusals state their reason ---

void expect_refused(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words)
    EXPECT_NE(message.find(word), message.npos) << "\"" << word << "\" in: " << message;
}

TEST(StaticRefusal, ConstantPressure) {
  expect_refused(refusal_of("length [mm],force [N],pressure [kPa gauge]\n"
                            "250,100,300\n240,80,300\n230,50,301\n"),
                 {"pressure", "throughout", "several pressures"});
}

TEST(StaticRefusal, OneLengthAndNoGeometry) {
  std::string text = "length [mm],force [N],pressure [kPa gauge]\n";
  for (int p = 50; p <= 600; p += 25)
    text += fmt::format("240,{},{}\n", force_at(0.24, 1e3 * p), p);
  expect_refused(refusal_of(text), {"one length only", "actuator=FILE"});
}

TEST(StaticRefusal, TooFewPoints) {
  expect_refused(refusal_of("length [mm],force [N],pressure [kPa gauge]\n"
                            "250,100,300\n240,80,400\n230,50,500\n"),
                 {"3 points", "at least", "more measurements"});
}

// Test rigs report the contraction as often as the length.
TEST(StaticData, AContractionCountsFromTheRestLength) {
  const auto lengths = [](const std::string& text, const StaticInput& input) {
    StaticData data;
    add_points(read(text), input, data);
    std::vector<double> out;
    for (const StaticPoint& p : data.points) out.push_back(p.length);
    return out;
  };
  const std::string rows = "0,100,100\n10,100,50\n20,200,60\n";
  const std::vector<double> right{0.25, 0.225, 0.2};
  const std::string columns = "contraction [%],pressure [kPa gauge],force [N]";
  const auto percent = lengths(columns + "\n" + rows, {.rest_length = rest});
  const auto share =
      lengths("contraction,pressure [kPa gauge],force [N]\n0,100,100\n0.1,100,50\n0.2,200,60\n",
              {.rest_length = rest});
  const auto own = lengths(columns +
                               ",rest_length [mm]\n0,100,100,250\n10,100,50,250\n"
                               "20,200,60,250\n",
                           {});
  // A contraction is ignored if there is a length, in any unit.
  const auto both = lengths(
      "length [mm]," + std::string("contraction [mm],pressure [kPa gauge],"
                                   "force [N]\n250,0,100,100\n225,25,100,50\n200,50,200,60\n"),
      {});
  for (const auto& found : {percent, share, own, both}) {
    ASSERT_EQ(found.size(), right.size());
    for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(found[i], right[i], 1e-12);
  }
  expect_refused(refusal_of(columns + "\n" + rows),
                 {"a contraction, and no rest length", "rest_length=\"250 mm\""});
  expect_refused(refusal_of("contraction,pressure [kPa gauge],force [N]\n" + rows),
                 {"values up to 20; expected between 0 and 0.6", "units.contraction=\"%\""});
}

TEST(StaticRefusal, NoLength) {
  expect_refused(refusal_of("force [N],pressure [kPa gauge]\n1,100\n2,200\n"),
                 {"no length", "values.length=\"205 mm\""});
}

TEST(StaticRefusal, SwappedColumns) {
  expect_refused(refusal_of("length [mm],pressure [kPa gauge],force [N]\n"
                            "250,0.9,300\n240,0.8,400\n230,0.5,500\n"),
                 {"pressure", "wrong unit, or another column"});
  std::string falling = "length [mm],force [N],pressure [kPa gauge]\n";
  for (int p = 50; p <= 600; p += 50)
    falling += fmt::format("240,{},{}\n", -force_at(0.24, 1e3 * p), p);
  expect_refused(refusal_of(falling), {"falls while the pressure rises", "sign"});
}

TEST(StaticRefusal, WrongUnit) {
  expect_refused(refusal_of("length [m],force [N],pressure [kPa gauge]\n"
                            "250,100,300\n240,80,400\n230,50,500\n"),
                 {"length", "wrong unit", "units.length=", "mm"});
}

TEST(StaticRefusal, ASensorAtItsEnd) {
  StaticData data;
  try {
    add_points(read_at(0.25, recording(0.25, 0, 0, 3, 300)), {}, data);
    FAIL();
  } catch (const Refusal& e) {
    expect_refused(e.what(), {"force", "stay at", "at its end"});
  }
}

// Stretched and released at a regulated pressure: an ideal braid, with noise.
std::string sweep(double gauge, double pressure_noise) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1);
  std::string text = "time [s],length [mm],force [N],pressure [kPa gauge]\n";
  for (int i = 0; i <= 800; ++i) {
    const double l = 205e-3 + 45e-3 * (1 - std::abs(i - 400) / 400.0);
    const double f = gauge * (3 * l * l - 0.09) / (4 * std::numbers::pi * 2.2 * 2.2);
    text += fmt::format("{},{},{},{}\n", 0.05 * i, 1e3 * l, f + 0.1 * noise(random),
                        1e-3 * gauge + pressure_noise * noise(random));
  }
  return text;
}

// A recorded length sweep needs no preparation: one file for each pressure.
TEST(StaticData, ASweepOfLengthsIsARecordingToo) {
  StaticData data;
  for (const double gauge : {2e5, 4e5, 6e5})
    add_points(read(sweep(gauge, 1)), {.rest_length = 0.25}, data);
  ASSERT_GT(data.points.size(), 120u);
  EXPECT_EQ(count_of(pressure_groups(data.points)), 3);
  EXPECT_GT(count_of(length_groups(data.points)), 10);
  for (const StaticPoint& p : data.points) {
    const double f =
        p.pressure * (3 * p.length * p.length - 0.09) / (4 * std::numbers::pi * 2.2 * 2.2);
    EXPECT_NEAR(p.force, f, 3);
    EXPECT_EQ(p.branch, Branch::unknown);
  }
  const StaticResult found = identify_static(data, {.model = "ideal"});
  EXPECT_NEAR(found.muscles[0].actuator.braid.thread_length, 0.3, 1e-3);
  EXPECT_NEAR(found.muscles[0].actuator.braid.turns, 2.2, 0.01);
}

TEST(StaticRefusal, ASweepOfTooFewRows) {
  std::string text = "time [s],length [mm],force [N],pressure [kPa gauge]\n";
  for (int i = 0; i < 10; ++i) text += fmt::format("{},{},{},{}\n", i, 200 + 5 * i, 20 * i, 400);
  expect_refused(refusal_of(text), {"a length that changes, in 10 rows", "slower sweep"});
}

// Noise of a regulated pressure does not make a second pressure.
TEST(StaticData, ASweepAtOnePressureHasOne) {
  StaticData data;
  add_points(read(sweep(4e5, 1)), {.rest_length = 0.25}, data);
  EXPECT_EQ(count_of(pressure_groups(data.points)), 1);
}

TEST(StaticRefusal, AModelThatThereIsNot) {
  StaticData data;
  add_points(read(table(1, 1e3)), {.rest_length = rest}, data);
  try {
    identify_static(data, {.model = "cubik"});
    FAIL();
  } catch (const Refusal& e) {
    expect_refused(e.what(), {"cubik", "elastic-cubic"});
  }
}

}  // namespace
}  // namespace sinew::identify::static_data_test
