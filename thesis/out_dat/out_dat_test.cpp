// out.dat is written as in B.1 and read back.
#include "thesis/out_dat/out_dat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::thesis::out_dat_test {
namespace {

const std::string source = sinew::test::source_dir();

experiment::Experiment walk(std::vector<std::string> sets = {}) {
  sets.push_back("sequence.repeat=2");
  return experiment::load(source + "/experiments/walk-test-1.toml", sets);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::string message(const std::string& text, const experiment::Experiment& e) {
  try {
    parse_out_dat(text, "out.dat", e);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "";
}

constexpr const char* heading =
    "mode timer pot[0] fi[0] ee[0] fe[0] ei[0] thetades[1] pot[1] gage[0] gage[1] stiffdes[1] "
    "stiffness[1] fi[1] ee[1] fe[1] ei[1] thetades[2] pot[2] gage[2] gage[3] stiffdes[2] "
    "stiffness[2] fi[2] ee[2] fe[2] ei[2]\n";
constexpr const char* first =
    "swing 0 404 0 0 0 0 2185 2190 12 3456 35.000000 12.500000 50 0 7 0 933 920 0 99 20.000000 "
    "-1.250000 0 1 2 3\n";

// The lines of a run with the code's loops: 151 + 2 + 151 per step, the timers from 0.
TEST(OutDat, HasTheLinesThatTheCodeWrites) {
  const experiment::Experiment e = walk({"sequence.thesis_timing=true"});
  const auto lines = lines_of(write_out_dat(run::run(e).table, e));
  ASSERT_EQ(lines.size(), 1U + 2U * (151U + 2U + 151U));
  EXPECT_EQ(lines[0] + "\n", heading);
  EXPECT_EQ(lines[1].find("swing 0 404 0 0 0 0 "), 0U);
  EXPECT_EQ(lines[151].find("swing 150 "), 0U);
  EXPECT_EQ(lines[152].find("plant 0 "), 0U);
  EXPECT_EQ(lines[154].find("stance 0 "), 0U);
  EXPECT_EQ(lines[305].find("swing 0 "), 0U);
}

// A finer log has the same lines, except for values that change within a period.
TEST(OutDat, HasALinePerPeriodWhateverWasLogged) {
  const experiment::Experiment e = walk({"log.period=1 ms"});
  EXPECT_EQ(lines_of(write_out_dat(run::run(e).table, e)).size(), 1U + 2U * (150U + 3U + 150U));
}

// B.1: thetades = (theta - 4.858) * 767 + 1895, in whole counts; the rest are counts and percents.
TEST(OutDat, IsReadByTheControllersScales) {
  const experiment::Experiment e = walk();
  const signals::Table t = parse_out_dat(std::string(heading) + first, "out.dat", e);
  const auto at = [&](const char* topic) { return t.column(topic)->front(); };
  const double degree = std::acos(-1.0) / 180;
  EXPECT_NEAR(at("/desired/joint/hip/angle"), 278 * degree + (2185 - 1895) / 767.0, 1e-12);
  EXPECT_NEAR(at("/joint/knee/angle"), 314 * degree + (920 - 1175) / 767.0, 1e-12);
  EXPECT_NEAR(at("/joint/hip/stiffness"), 12.5 * 0.1129848290, 1e-8);
  EXPECT_EQ(at("/sensor/hip_extensor_tension/count"), 3456);
  EXPECT_EQ(at("/sensor/cylinder_position/count"), 404);
  EXPECT_NEAR(at("/muscle/hip_extensor/tension"), 3456 / 819.2 / 0.1610 * 4.4482216, 1e-4);
  EXPECT_EQ(at("/muscle/hip_flexor/inlet_duty"), 0.5);
  EXPECT_EQ(at("/muscle/hip_flexor/exhaust_duty"), 0.07);
  EXPECT_EQ(at("/muscle/knee_extensor/exhaust_duty"), 0.01);
  EXPECT_EQ(at("/muscle/knee_flexor/exhaust_duty"), 0.02);
  EXPECT_EQ(at("/muscle/knee_extensor/inlet_duty"), 0.03);
  for (const signals::Series& s : t.series) EXPECT_FALSE(s.topic.name.starts_with("/true"));
}

// Writing, reading and writing again gives the same file, and the values are recovered.
TEST(OutDat, GoesRoundWithoutChange) {
  const experiment::Experiment e = walk();
  const signals::Table ran = run::run(e).table;
  const std::string text = write_out_dat(ran, e);
  const signals::Table back = parse_out_dat(text, "out.dat", e);

  const std::string again = write_out_dat(back, e);
  // A desired angle that is a whole count may be truncated again, one count lower.
  EXPECT_EQ(lines_of(again).size(), lines_of(text).size());

  const auto* phase = ran.column("/plan/phase");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < phase->size(); ++i)
    if ((*phase)[i] >= 0) rows.push_back(i);
  const auto compare = [&](const char* topic, double tolerance) {
    const auto *a = ran.column(topic), *b = back.column(topic);
    ASSERT_TRUE(a && b) << topic;
    ASSERT_EQ(b->size(), rows.size()) << topic;
    for (std::size_t i = 0; i < rows.size(); ++i)
      ASSERT_NEAR((*b)[i], (*a)[rows[i]], tolerance) << topic << " in row " << i;
  };
  const double count = 1 / 767.0, percent = 1e-12;
  for (const char* exact :
       {"/plan/phase", "/plan/step", "/sensor/hip_angle/count", "/sensor/knee_flexor_tension/count",
        "/joint/hip/angle", "/joint/knee/angle"})
    compare(exact, 0);
  for (const char* angle : {"/desired/joint/hip/angle", "/desired/joint/knee/angle"})
    compare(angle, count);
  for (const char* duty : {"/muscle/hip_flexor/inlet_duty", "/muscle/knee_extensor/exhaust_duty"})
    compare(duty, percent);
  compare("/muscle/hip_flexor/tension", 1e-9);
  compare("/joint/knee/stiffness", 1e-6);
  compare("/desired/joint/knee/stiffness", 1e-6);
}

TEST(OutDat, ReportsTheWrongLine) {
  const experiment::Experiment e = walk();
  const std::string h = heading, row = first;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = row;
    return message(h + row + changed.replace(changed.find(from), from.size(), to), e);
  };
  EXPECT_EQ(message("", e).find("out.dat:1:1: found \"\"; expected the heading of out.dat"), 0U);
  EXPECT_EQ(message(row, e).find("out.dat:1:1: found \"swing 0"), 0U);
  EXPECT_EQ(message(h, e),
            "out.dat:2:1: found no line with values; expected one per period of 10 ms");
  EXPECT_EQ(with("swing 0", "swnig 1"),
            "out.dat:3:1: mode: found \"swnig\"; expected swing, plant or stance; try \"swing\"");
  EXPECT_EQ(with("swing 0 404", "swing 1 4096"),
            "out.dat:3:9: pot[0]: found \"4096\"; expected a whole number from 0 to 4095");
  EXPECT_EQ(with("swing 0 404 0", "swing 1 404 101"),
            "out.dat:3:13: fi[0]: found \"101\"; expected a whole number from 0 to 100");
  EXPECT_EQ(with("2190", "2,19").find("out.dat:3:26: pot[1]: found \"2,19\""), 0U);
  EXPECT_EQ(with(" 3\n", "\n"),
            "out.dat:3:1: found 26 columns; expected 27, as the heading; try a fresh copy: this "
            "line is cut short");
  std::string second = row, third = row;
  second.replace(0, 7, "swing 7"), third.replace(0, 7, "swing 5");
  EXPECT_EQ(message(h + row + second + third, e),
            "out.dat:4:1: timer: found 5 after 7; expected a timer that counts up, or 0 where a "
            "phase begins");
}

// A missing line leaves a gap in time, not a shift.
TEST(OutDat, KeepsTimeOverALostLine) {
  const experiment::Experiment e = walk();
  auto lines = lines_of(write_out_dat(run::run(e).table, e));
  lines.erase(lines.begin() + 11);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  const signals::Table t = parse_out_dat(text, "out.dat", e);
  const auto& times = t.find("/plan/phase")->time_ns;
  EXPECT_EQ(times[9], 90'000'000);
  EXPECT_EQ(times[10], 110'000'000);
  EXPECT_EQ(times.back(), (2 * 303 - 1) * 10'000'000LL);
}

TEST(OutDat, NeedsAColumnsChannels) {
  const experiment::Experiment e = walk();
  signals::Table table = run::run(e).table;
  std::erase_if(table.series,
                [](const auto& s) { return s.topic.name == "/sensor/hip_angle/count"; });
  try {
    write_out_dat(table, e);
    FAIL() << "no error";
  } catch (const config::Error& error) {
    EXPECT_NE(std::string(error.what()).find("/sensor/hip_angle/count: found no such channel"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace sinew::thesis::out_dat_test
