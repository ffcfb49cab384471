#include "sinew/recording/assemble.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/recorded.h"

namespace sinew::recording::assemble_test {
namespace {

namespace fs = std::filesystem;

std::vector<signals::Topic> one_joint() {
  const auto scalar = [](const char* name, const char* unit) {
    return signals::Topic{name, "", {{"value", unit}}};
  };
  return {
      scalar("/sensor/elbow_angle/count", "count"),     scalar("/joint/elbow/angle", "rad"),
      scalar("/desired/joint/elbow/angle", "rad"),      scalar("/muscle/flexor/tension", "N"),
      scalar("/muscle/flexor/pressure", "Pa"),          scalar("/muscle/extensor/pressure", "Pa"),
      {"/foot/position", "", {{"x", "m"}, {"y", "m"}}}, scalar("/valve/flexor/inlet/open", "1")};
}

class AssembleTest : public ::testing::Test {
 protected:
  AssembleTest() {
    std::string name = (fs::temp_directory_path() / "sinew-assemble-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~AssembleTest() override { fs::remove_all(folder_); }

  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  AssembledRecording take(const std::vector<std::string>& files, const Mapping& mapping = {},
                          const Joining& joining = {}) const {
    std::vector<Recorded> read;
    for (const std::string& file : files) read.push_back(read_recording(file, mapping));
    return assemble(read, mapping, one_joint(), joining);
  }

  std::string error_of(const std::vector<std::string>& files, const Mapping& mapping = {},
                       const Joining& joining = {}) const {
    try {
      (void)take(files, mapping, joining);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "no error";
  }

  fs::path folder_;
};

Mapping angle_is(const std::string& column, const std::string& unit = "") {
  Mapping out;
  map_channel(out, "/joint/elbow/angle", column);
  if (!unit.empty()) map_unit(out, column, unit);
  return out;
}

const signals::Series& series(const AssembledRecording& of, const std::string& topic) {
  const signals::Series* found = of.table.find(topic);
  if (!found) throw std::runtime_error("no " + topic);
  return *found;
}

bool has_note(const AssembledRecording& of, const std::string& part) {
  for (const std::string& note : of.notes)
    if (note.find(part) != note.npos) return true;
  return false;
}

// --- values ---

TEST_F(AssembleTest, ValueIsScaleTimesNumberInItsUnitPlusOffset) {
  Mapping m = angle_is("Winkel", "deg");
  map_scale(m, "Winkel", -1);
  map_offset(m, "Winkel", "90 deg");
  const AssembledRecording a = take({put("a.csv", "time [s],Winkel\n0,0\n0.01,30\n0.02,90\n")}, m);
  const signals::Series& s = series(a, "/joint/elbow/angle");
  ASSERT_EQ(s.time_ns.size(), 3u);
  for (const auto& [i, degrees] : {std::pair{0, 90.0}, {1, 60.0}, {2, 0.0}})
    EXPECT_NEAR(s.columns[0][static_cast<std::size_t>(i)], degrees * M_PI / 180, 1e-15);
}

TEST_F(AssembleTest, AGaugePressureBecomesAnAbsoluteOne) {
  const AssembledRecording a = take(
      {put("a.csv", "time [s],flexor_pressure [bar gauge]\n0,0\n1,2\n")}, {}, {.atmosphere = 1e5});
  const signals::Series& s = series(a, "/muscle/flexor/pressure");
  EXPECT_DOUBLE_EQ(s.columns[0][0], 1e5);
  EXPECT_DOUBLE_EQ(s.columns[0][1], 3e5);
}

TEST_F(AssembleTest, UnitsAreReadAsOthersWriteThem) {
  Mapping m;
  map_channel(m, "/muscle/flexor/pressure", "p");
  map_unit(m, "p", "psig");
  const AssembledRecording a =
      take({put("a.csv", "time [s],p\n0,0\n1,10\n")}, m, {.atmosphere = 1e5});
  const signals::Series& s = series(a, "/muscle/flexor/pressure");
  EXPECT_DOUBLE_EQ(s.columns[0][0], 1e5);
  EXPECT_NEAR(s.columns[0][1], 1e5 + 68947.57, 0.1);
}

TEST_F(AssembleTest, AGivenUnitReplacesThatOfTheHeader) {
  const std::string file = put("a.csv", "time [s],p [mbar(g)]\n0,500\n1,600\n");
  for (const auto& [unit, pascals] : {std::pair{"", 5e4}, {"mbar gauge", 5e4}, {"kPa(g)", 5e5}}) {
    Mapping m;
    map_channel(m, "/muscle/flexor/pressure", "p");
    if (*unit) map_unit(m, "p", unit);
    const AssembledRecording a = take({file}, m, {.atmosphere = 1e5});
    EXPECT_NEAR(series(a, "/muscle/flexor/pressure").columns[0][0], 1e5 + pascals, 1e-6) << unit;
  }
}

TEST_F(AssembleTest, AColumnIsCalledByItsNameByItsHeadingOrByTheEndOfItsName) {
  const std::string file = put("a.csv", "time [s],log.p [mbar(g)]\n0,500\n1,600\n");
  for (const char* name : {"log.p", "log.p [mbar(g)]", "p"}) {
    Mapping m;
    map_channel(m, "/muscle/flexor/pressure", name);
    const AssembledRecording a = take({file}, m, {.atmosphere = 1e5});
    EXPECT_NEAR(series(a, "/muscle/flexor/pressure").columns[0][0], 1.5e5, 1e-6);
  }
}

TEST_F(AssembleTest, AKeptColumnIsInANearUnitOfSinew) {
  Mapping m;
  m.keep_others = true;
  const AssembledRecording a =
      take({put("a.csv", "time [s],p [mbar(g)],angle [rad]\n0,500,1\n1,600,1\n")}, m);
  EXPECT_EQ(series(a, "/recorded/p").topic.fields[0].unit, "bar gauge");
  EXPECT_DOUBLE_EQ(series(a, "/recorded/p").columns[0][1], 0.6);
}

TEST_F(AssembleTest, AnOffsetOfAKeptColumnIsInItsUnit) {
  Mapping m;
  m.keep_others = true;
  map_offset(m, "p", "10 kPa diff");
  map_offset(m, "wide", "1 cm");
  const std::string file =
      put("a.csv", "time [s],p [bar gauge],wide [mm],x [foo]\n0,1,1,1\n1,2,2,1\n");
  const AssembledRecording a = take({file}, m);
  EXPECT_DOUBLE_EQ(series(a, "/recorded/p").columns[0][0], 1.1);
  EXPECT_DOUBLE_EQ(series(a, "/recorded/wide").columns[0][0], 11);
  map_offset(m, "x", "1");
  EXPECT_NE(error_of({file}, m).find("Sinew does not have the unit \"foo\""), std::string::npos);
}

TEST_F(AssembleTest, AChannelsOwnNameAndUnitKeepEveryBit) {
  const AssembledRecording a = take({put("a.csv",
                                         "time [s],/joint/elbow/angle [rad],/foot/position.x [m],"
                                         "/foot/position.y [m],/muscle/flexor/pressure [Pa]\n"
                                         "0.0013,0.1,-0,1e-300,101325.00000000001\n"
                                         "0.0113,0.30000000000000004,,2,3\n")});
  EXPECT_EQ(series(a, "/joint/elbow/angle").columns[0][1], 0.1 + 0.2);
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns[0], 1'300'000);
  const signals::Series& foot = series(a, "/foot/position");
  ASSERT_EQ(foot.time_ns.size(), 2u);
  EXPECT_TRUE(std::signbit(foot.columns[0][0]));
  EXPECT_EQ(foot.columns[1][0], 1e-300);
  EXPECT_TRUE(std::isnan(foot.columns[0][1]));
  EXPECT_EQ(series(a, "/muscle/flexor/pressure").columns[0][0], 101325.00000000001);
  EXPECT_TRUE(a.used.columns.size() == 4);
}

TEST_F(AssembleTest, ValvesHaveTheEdgesWhereTheyChange) {
  const AssembledRecording a = take({put("a.csv",
                                         "time [s],/valve/flexor/inlet/open [1]\n"
                                         "0,0\n0.01,1\n0.02,1\n0.03,0\n0.04,0\n")});
  const signals::Series& s = series(a, "/valve/flexor/inlet/open");
  ASSERT_EQ(s.time_ns.size(), 2u);
  EXPECT_EQ(s.time_ns[0], 10'000'000);
  EXPECT_EQ(s.columns[0][0], 1);
  EXPECT_EQ(s.time_ns[1], 30'000'000);
  EXPECT_EQ(s.columns[0][1], 0);
}

// Rows with a valve that is open for the first `open` ticks of each period of 100 ticks.
std::string pulses(int open, const std::vector<int>& ticks) {
  std::string out = "time [s],/valve/flexor/inlet/open [1]\n";
  for (const int tick : ticks)
    out += fmt::format("{},{}\n", 1e-4 * tick, tick % 100 < open ? 1 : 0);
  return out;
}

std::vector<int> rows_every(int ticks) {
  std::vector<int> out;
  for (int tick = 0; tick < 1000; tick += ticks) out.push_back(tick);
  return out;
}

// A row of a tick, rows much shorter than period and pulses, and a list of edges give the pulses.
// Rows of a whole period show a pulsed valve as always open.
TEST_F(AssembleTest, PulsesNeedRowsThatAreMuchShorter) {
  std::vector<int> edges;
  for (int period = 0; period < 10; ++period)
    edges.insert(edges.end(), {100 * period, 100 * period + 30});
  const auto is_coarse = [&](const std::string& text, const Mapping& mapping = {}) {
    return signals::has_coarse_edges(
        series(take({put("a.csv", text)}, mapping), "/valve/flexor/inlet/open").topic);
  };
  EXPECT_FALSE(is_coarse(pulses(1, rows_every(1))));
  EXPECT_FALSE(is_coarse(pulses(30, rows_every(5))));
  EXPECT_FALSE(is_coarse(pulses(40, rows_every(10))));
  EXPECT_FALSE(is_coarse(pulses(30, edges)));
  EXPECT_TRUE(is_coarse(pulses(30, rows_every(10)))) << "three rows for a pulse";
  EXPECT_TRUE(is_coarse(pulses(100, rows_every(20)))) << "open throughout, as far as it is seen";
  EXPECT_TRUE(is_coarse(pulses(30, rows_every(100))));
  Mapping slow;
  slow.clock.scale = 2;
  EXPECT_TRUE(is_coarse(pulses(40, rows_every(10)), slow));
}

TEST_F(AssembleTest, WhatIsNoNumberIsLeftOutAndCounted) {
  const AssembledRecording a =
      take({put("a.csv", "time [s],elbow_angle [rad]\n0,1\n0.01,\n0.02,NaN\n0.03,4\n")});
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns.size(), 2u);
  EXPECT_EQ(a.files[0].left_out, 2u);
  EXPECT_TRUE(has_note(a, "2 of 4 values left out"));
}

// --- names ---

TEST_F(AssembleTest, NamesThatSayTheChannelNeedNoMapping) {
  for (const char* name : {"elbow_angle", "Elbow angle", "joint.elbow.angle", "/joint/elbow/angle",
                           "angle", "log/elbow_angle"}) {
    const AssembledRecording a =
        take({put("a.csv", "time [s]," + std::string(name) + " [deg]\n0,0\n0.01,180\n")});
    EXPECT_DOUBLE_EQ(series(a, "/joint/elbow/angle").columns[0][1], M_PI) << name;
  }
  // Counts of a sensor with the same name are distinguished by their unit.
  const AssembledRecording counts =
      take({put("a.csv", "time [s],elbow_angle [count]\n0,5\n0.01,6\n")});
  EXPECT_EQ(series(counts, "/sensor/elbow_angle/count").columns[0][0], 5);
  // Two pressures: the name is ambiguous.
  EXPECT_NE(
      error_of({put("a.csv", "time [s],pressure [kPa abs]\n0,1\n0.01,2\n")}).find("no column"),
      std::string::npos);
}

TEST_F(AssembleTest, ColumnsWithoutAChannelAreReportedOrKept) {
  const std::string file =
      put("a.csv", "time [s],elbow_angle [rad],Raum T [degC]\n0,1,20\n1,2,21\n");
  EXPECT_TRUE(
      has_note(take({file}), "1 column is not a channel of this machine, left out: Raum T"));
  const AssembledRecording all = take({file}, {.keep_others = true});
  EXPECT_EQ(series(all, "/recorded/Raum_T").columns[0][1], 21);
}

// --- clocks ---

TEST_F(AssembleTest, TimeBeginsAtTheFirstSampleUnlessItIsARuns) {
  const Mapping m = angle_is("w", "rad");
  EXPECT_EQ(series(take({put("a.csv", "time [s],w\n123.4,1\n123.41,2\n")}, m), "/joint/elbow/angle")
                .time_ns[1],
            10'000'000);
  EXPECT_EQ(
      series(take({put("a.csv", "time [s],w\n0.0013,1\n0.0113,2\n")}, m), "/joint/elbow/angle")
          .time_ns[0],
      1'300'000);
  Mapping from = m;
  from.clock.start = "123.405 s";
  const AssembledRecording later = take({put("a.csv", "time [s],w\n123.4,1\n123.41,2\n")}, from);
  EXPECT_EQ(series(later, "/joint/elbow/angle").time_ns[0], 5'000'000);
  EXPECT_EQ(later.files[0].left_out, 1u);
}

TEST_F(AssembleTest, AClockThatRunsFastIsScaled) {
  Mapping m = angle_is("w", "rad");
  m.clock.scale = 0.997;
  const AssembledRecording a = take({put("a.csv", "time [s],w\n0,1\n10,2\n20,3\n")}, m);
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns[2], 19'940'000'000);
}

TEST_F(AssembleTest, TwoLoggersKeepTheirOwnTimes) {
  const std::string fast = put("fast.csv", "time [s],elbow_angle [rad]\n0,1\n0.001,2\n0.002,3\n");
  const std::string slow = put("slow.csv", "time [s],tension [N]\n0,5\n0.01,6\n");
  const AssembledRecording a = take({fast, slow}, {}, {.shifts = {{slow, "0.12 s"}}});
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns.size(), 3u);
  EXPECT_EQ(series(a, "/muscle/flexor/tension").time_ns[1], 130'000'000);
}

TEST_F(AssembleTest, ClocksOnTheWallLieBesideEachOther) {
  const std::string a = put(
      "a.csv", "time,elbow_angle [rad]\n2026-11-24T10:15:30.000,1\n2026-11-24T10:15:30.010,2\n");
  const std::string b =
      put("b.csv", "time,tension [N]\n2026-11-24T10:15:31.500,1\n2026-11-24T10:15:31.600,2\n");
  const AssembledRecording both = take({a, b});
  EXPECT_EQ(series(both, "/joint/elbow/angle").time_ns[0], 0);
  EXPECT_EQ(series(both, "/muscle/flexor/tension").time_ns[0], 1'500'000'000);
  EXPECT_NE(both.started.find("2026-11-24T10:15:30"), std::string::npos) << both.started;
}

TEST_F(AssembleTest, ZonesPlaceFilesSideBySide) {
  const std::string a =
      put("a.csv", "time,elbow_angle [rad]\n2026-11-24T10:15:30Z,1\n2026-11-24T10:15:31Z,2\n");
  const std::string b =
      put("b.csv", "time,tension [N]\n2026-11-24T11:15:30+01:00,1\n2026-11-24T11:15:31+01:00,2\n");
  for (const auto& files : {std::vector{a, b}, {b, a}}) {
    const AssembledRecording both = take(files);
    for (const char* topic : {"/joint/elbow/angle", "/muscle/flexor/tension"})
      EXPECT_EQ(series(both, topic).time_ns.in_memory(),
                (std::vector<std::int64_t>{0, 1'000'000'000}));
    EXPECT_FALSE(has_note(both, "no other file"));
    EXPECT_EQ(both.started, files[0] == a ? "2026-11-24T10:15:30Z" : "2026-11-24T11:15:30+01:00");
  }
  // Times of day are a common clock as well, also over midnight; files that do not overlap are
  // reported.
  const std::string c = put("c.csv", "time,elbow_angle [rad]\n23:59:59,1\n00:00:01,2\n");
  const std::string d = put("d.csv", "time,tension [N]\n00:00:00,1\n00:00:05,2\n");
  EXPECT_EQ(series(take({c, d}), "/muscle/flexor/tension").time_ns[0], 1'000'000'000);
  const std::string e = put("e.csv", "time,tension [N]\n00:10:00,1\n00:10:05,2\n");
  EXPECT_TRUE(has_note(take({c, e}), "no other file has a sample"));
}

TEST_F(AssembleTest, ASecondClockIsThatOfTheColumnsToItsRight) {
  std::string text = "Time,Angle,Time.1,Pressure\ns,rad,s,bar gauge\n";
  for (int i = 0; i < 100; ++i)
    text += fmt::format("{:.3f},{},{}\n", 0.01 * i, i,
                        i < 50 ? fmt::format("{:.3f},{}", 0.04 * i, 0.1 * i) : std::string(","));
  for (const bool same_name : {false, true}) {
    if (same_name) text.replace(text.find("Time.1"), 6, "Time");
    Mapping m = angle_is("Angle");
    map_channel(m, "/muscle/flexor/pressure", "Pressure");
    const AssembledRecording a = take({put("a.csv", text)}, m);
    const signals::Series &angle = series(a, "/joint/elbow/angle"),
                          &pressure = series(a, "/muscle/flexor/pressure");
    ASSERT_EQ(angle.time_ns.size(), 100u);
    ASSERT_EQ(pressure.time_ns.size(), 50u);
    EXPECT_EQ(angle.time_ns.back(), 990'000'000);
    EXPECT_EQ(pressure.time_ns.back(), 1'960'000'000);
    EXPECT_TRUE(has_note(a, "each is the clock of the columns to its right"));
  }
}

TEST_F(AssembleTest, AUnitOfAClockIsThatOfEachClockOfItsName) {
  const std::string file =
      put("a.csv", "time,flexor_pressure [bar gauge],time,tension [N]\n0,1,0,5\n10,2,20,6\n");
  Mapping of_clock, of_column;
  map_channel(of_clock, "time", "time");
  of_clock.clock.unit = "ms";
  map_unit(of_column, "time", "ms");
  for (const Mapping& m : {of_clock, of_column}) {
    const AssembledRecording a = take({file}, m);
    EXPECT_EQ(series(a, "/muscle/flexor/pressure").time_ns[1], 10'000'000);
    EXPECT_EQ(series(a, "/muscle/flexor/tension").time_ns[1], 20'000'000);
  }
}

TEST_F(AssembleTest, SecondsAndTheirRestAreOneStamp) {
  std::string text = "header.stamp.sec,header.stamp.nanosec,w [rad]\n";
  for (int i = 95; i < 205; ++i)
    text += fmt::format("{},{},{}\n", 1732340000 + i / 100, i % 100 * 10'000'000, i);
  const AssembledRecording a = take({put("a.csv", text)}, angle_is("w"));
  const signals::Series& s = series(a, "/joint/elbow/angle");
  for (std::size_t i = 0; i < s.time_ns.size(); ++i)
    EXPECT_EQ(s.time_ns[i], static_cast<std::int64_t>(i) * 10'000'000);
  EXPECT_EQ(a.started, "2024-11-23T05:33:20.95Z");
}

TEST_F(AssembleTest, ACoarseClockIsSpreadWithinItsDigits) {
  // Rows every 10 ms with times in whole seconds; the first and the last second are cut: 5 and 30
  // rows.
  std::string text = "time,w [rad]\n";
  for (int i = 95; i < 330; ++i) text += fmt::format("{},{}\n", 1732340000 + i / 100, i);
  Mapping m = angle_is("w");
  m.table.spread_times = true;
  const AssembledRecording a = take({put("a.csv", text)}, m);
  const signals::Series& s = series(a, "/joint/elbow/angle");
  ASSERT_EQ(s.time_ns.size(), 235u);
  for (std::size_t i = 0; i < s.time_ns.size(); ++i)
    EXPECT_NEAR(static_cast<double>(s.time_ns[i]), 1e7 * static_cast<double>(i), 1e3);
  // A pause is not a step of the clock.
  const std::string pause = "time [s],w [rad]\n0,1\n0,2\n1,3\n1,4\n9,5\n9,6\n";
  EXPECT_EQ(series(take({put("b.csv", pause)}, m), "/joint/elbow/angle").time_ns[3], 1'500'000'000);
  // A single time gives no rate: the rate of the rows must be given.
  const std::string six = "time,w [rad]\n1.73234e+09,1\n1.73234e+09,2\n";
  EXPECT_NE(error_of({put("c.csv", six)}, m).find("rate=\"100 Hz\""), std::string::npos);
  m.table.spread_times = false;
  m.clock.rate = "100 Hz";
  EXPECT_EQ(series(take({put("c.csv", six)}, m), "/joint/elbow/angle").time_ns[1], 10'000'000);
}

TEST_F(AssembleTest, ACounterThatBeginsAgainIsContinued) {
  struct Counter {
    double range, step, unit;  // unit of the file's numbers; s
    const char* name;
    double begin;
  };
  for (const Counter& c : {Counter{4294967296.0, 10000, 1e-6, "micros [us]", 0},
                           {4294967.296, 10, 1e-3, "millis [ms]", 0},
                           {65536, 7, 1e-3, "t [ms]", 0},
                           {4294967296.0, 1, 1e-3, "t [ms]", -2147483648.0}}) {
    std::string text = fmt::format("{},w [rad]\n", c.name);
    for (int i = 0; i < 400; ++i)
      text += fmt::format("{:.3f},{}\n",
                          c.begin + std::fmod(c.range - 199.5 * c.step + i * c.step, c.range), i);
    const AssembledRecording a = take({put("a.csv", text)}, angle_is("w"));
    const signals::Series& s = series(a, "/joint/elbow/angle");
    ASSERT_EQ(s.time_ns.size(), 400u) << c.name;
    for (std::size_t i = 1; i < 400; ++i)
      EXPECT_NEAR(static_cast<double>(s.time_ns[i] - s.time_ns[i - 1]), 1e9 * c.step * c.unit, 2e3);
    EXPECT_TRUE(has_note(a, "wrapped once"));
  }
  // A recording that restarts is not a counter that overflows.
  std::string text = "t [ms],w [rad]\n";
  for (int i = 0; i < 400; ++i) text += fmt::format("{},{}\n", 10 * (i % 200), i);
  EXPECT_NE(error_of({put("a.csv", text)}, angle_is("w")).find("2 recordings"), std::string::npos);
}

TEST_F(AssembleTest, RowsOfOneTimeWithoutACommonCellAreOneRow) {
  const AssembledRecording a = take(
      {put("a.csv", "time [s],elbow_angle [rad],tension [N]\n0,1,\n0,,5\n0.01,2,\n0.01,,6\n")});
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns.in_memory(),
            (std::vector<std::int64_t>{0, 10'000'000}));
  EXPECT_EQ(series(a, "/muscle/flexor/tension").columns[0].in_memory(),
            (std::vector<double>{5, 6}));
}

TEST_F(AssembleTest, AUnitOfTheClockIsGivenAsThatOfAnyColumn) {
  Mapping m = angle_is("w", "rad");
  map_unit(m, "t", "ms");
  const AssembledRecording a = take({put("a.csv", "t,w\n0,1\n10,2\n")}, m);
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns[1], 10'000'000);
}

TEST_F(AssembleTest, AClockIsCalledByItsNameByItsHeadingOrByTheEndOfItsName) {
  const std::string file = put("a.csv", "log.t [s],w [rad]\n0,1\n10,2\n");
  for (const char* name : {"log.t", "log.t [s]", "t"}) {
    Mapping of_column = angle_is("w"), of_clock = angle_is("w");
    map_channel(of_column, "time", "log.t");
    map_unit(of_column, name, "ms");
    map_channel(of_clock, "time", name);
    of_clock.clock.unit = "ms";
    for (const Mapping& m : {of_column, of_clock})
      EXPECT_EQ(series(take({file}, m), "/joint/elbow/angle").time_ns[1], 10'000'000) << name;
  }
}

TEST_F(AssembleTest, RecordingsThatFollowEachOtherAreOne) {
  const std::string a = put("a.csv", "time [s],elbow_angle [rad]\n0,1\n0.01,2\n");
  const std::string b = put("b.csv", "time [s],elbow_angle [rad]\n7,3\n7.01,4\n");
  const AssembledRecording both = take({a, b}, {}, {.at_end = true});
  const signals::Series& s = series(both, "/joint/elbow/angle");
  ASSERT_EQ(s.time_ns.size(), 4u);
  EXPECT_EQ(s.time_ns[2], 20'000'000);
  EXPECT_EQ(s.columns[0][3], 4);
  EXPECT_NE(error_of({a, b}).find("join them at their ends"), std::string::npos);
}

TEST_F(AssembleTest, AKeptColumnOfSeveralFilesIsInTheUnitOfTheFirst) {
  const Mapping all{.keep_others = true};
  const auto files = [&](const std::string& first, const std::string& second) {
    return std::vector{put("a.csv", "time [s]," + first + "\n0,1\n1,1\n"),
                       put("b.csv", "time [s]," + second + "\n0,2\n1,2\n")};
  };
  const auto last = [&](const std::string& first, const std::string& second) {
    return series(take(files(first, second), all, {.at_end = true}), "/recorded/A").columns[0][3];
  };
  EXPECT_DOUBLE_EQ(last("A [mm]", "A [m]"), 2000);
  EXPECT_NEAR(last("A [bar]", "A [psi]"), 0.1378951, 1e-7);
  EXPECT_DOUBLE_EQ(last("A [bar gauge]", "A [mbar(g)]"), 0.002);
  for (const char* second : {"A [N]", "A [bar abs]", "A"}) {
    const std::string text = error_of(files("A [bar gauge]", second), all, {.at_end = true});
    for (const char* part : {"a.csv", "b.csv", "bar gauge", "/recorded/A"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST_F(AssembleTest, ARateStandsInPlaceOfAColumn) {
  Mapping m = angle_is("w", "rad");
  m.clock.rate = "200 Hz";
  const AssembledRecording a = take({put("a.csv", "w\n1\n2\n3\n")}, m);
  EXPECT_EQ(series(a, "/joint/elbow/angle").time_ns[2], 10'000'000);
}

// --- refused input ---

TEST_F(AssembleTest, ReportsWhatIsWrongAndWhatToDo) {
  const std::string file = put("a.csv", "time [s],Winkel [deg],F [N],p\n0,1,2,3\n0.01,2,3,4\n");
  const auto wrong = [&](const Mapping& m, std::vector<std::string> parts,
                         const Joining& joining = {}) {
    const std::string text = error_of({file}, m, joining);
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << "\nin: " << text;
  };
  wrong(angle_is("Winkl"),
        {"no column \"Winkl\"", "Winkel, F, p", "try names./joint/elbow/angle=\"Winkel\""});
  Mapping channel;
  map_channel(channel, "/joint/elbwo/angle", "Winkel");
  wrong(channel, {"/joint/elbwo/angle", "try \"/joint/elbow/angle\""});
  wrong(angle_is("F"), {"the unit \"N\"", "rad", "/joint/elbow/angle"});
  wrong(angle_is("p"), {"the column \"p\" without a unit", "units.p="});
  wrong(angle_is("Winkel", "dge"), {"the unit \"dge\"", "deg"});
  Mapping offset = angle_is("Winkel");
  map_offset(offset, "Winkel", "3 N");
  wrong(offset, {"Winkel.offset", "3 N"});
  wrong(angle_is("Winkel"), {"\"b.csv\"", "a.csv"}, {.shifts = {{"b.csv", "1 s"}}});
  wrong({}, {"no column that is a channel", "Winkel, F, p"});

  const auto refused = [&](const std::string& text, const Mapping& m, const std::string& part) {
    const std::string error = error_of({put("b.csv", text)}, m);
    EXPECT_NE(error.find(part), std::string::npos) << part << "\nin: " << error;
  };
  refused("time [s],elbow_angle [deg]\n0,NaN\n0.01,\n", {},
          "2 values of channels, each empty or not finite");
  Mapping late;
  late.clock.start = "100 s";
  refused("time [s],elbow_angle [deg]\n0,1\n0.01,2\n", late,
          "start: found \"100 s\", and the last sample of");
  const std::string pressure = "time [s],flexor_pressure [bar gauge]\n0,1\n0.01,";
  refused(pressure + "-3\n", {}, "/muscle/flexor/pressure: found -3 bar gauge at 0.01 s");
  EXPECT_EQ(error_of({put("vacuum.csv", pressure + "-1.01325\n")}), "no error");
  // A name of two words and its unit are one word of a shell.
  Mapping vacuum;
  map_channel(vacuum, "/muscle/flexor/pressure", "flexor p");
  const std::string below =
      error_of({put("v.csv", "time [s],flexor p [bar abs]\n0,1\n0.01,-0.4\n")}, vacuum);
  for (const char* part :
       {"an absolute pressure of -40 kPa", "none below 0", "try units.\"flexor p=bar gauge\", if"})
    EXPECT_NE(below.find(part), std::string::npos) << part << "\nin: " << below;

  const std::string none = error_of({put("n.csv", "Winkel [deg]\n1\n2\n")}, angle_is("Winkel"));
  EXPECT_NE(none.find("time"), std::string::npos) << none;
  EXPECT_NE(error_of({file, file}, angle_is("Winkel")).find("a second time"), std::string::npos);
  const std::string two = put("t.csv", "time [s],elbow_angle [deg],angle [deg]\n0,1,1\n0.01,2,2\n");
  EXPECT_NE(error_of({two}).find("two columns for it: elbow_angle and angle"), std::string::npos);
}

}  // namespace
}  // namespace sinew::recording::assemble_test
