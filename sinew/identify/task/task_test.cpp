// Methods are called with tables and settings as users give them; errors of a setting begin with
// its name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "sinew/config/diagnostics.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/task/methods.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "tests/places.h"

namespace sinew::identify::task_test {
namespace {

const std::string actuator = sinew::test::source_dir() + "/robots/leg/actuator.toml";

std::vector<Source> table(const std::string& text, const std::string& name = "numbers") {
  return {{.path = name, .text = text}};
}

// A braid whose threads are 100 mm long and wind around once.
std::vector<Source> mesh() {
  std::string text = "length [mm],diameter [mm]\n";
  for (double length = 60; length <= 90; length += 5) {
    const double diameter = std::sqrt(1e4 - length * length) / std::numbers::pi;
    text += std::to_string(length) + "," + std::to_string(diameter) + "\n";
  }
  return table(text);
}

std::string refusal(const std::function<void()>& ask) {
  try {
    ask();
  } catch (const config::Error& error) {
    return error.what();
  } catch (const Refusal& error) {
    return error.what();
  }
  return "nothing";
}

// A diameter that does not match the force is red.
TEST(Task, CheckFindsAForceThatIsNotOfTheDiameter) {
  std::string text = "length [mm],pressure [kPa gauge],force [N]\n";
  for (const int length : {250, 240, 230})
    for (int p = 50; p <= 600; p += 50)
      text += std::to_string(length) + "," + std::to_string(p) + "," +
              std::to_string(0.9 * p - 3.0 * (250 - length)) + "\n";
  const auto light_of = [&](const StaticSettings& settings, const std::string& name) {
    for (const Check& c : find(table(text, "rig.csv"), CheckSettings{settings}).checkup.checks)
      if (c.name == name) return std::string(word(c.light));
    return std::string("absent");
  };
  EXPECT_EQ(light_of({.diameter = "11 mm"}, "force unit"), "green");
  EXPECT_EQ(light_of({.diameter = "40 mm"}, "force unit"), "red");
  EXPECT_NE(
      refusal([&] { find(table(text), CheckSettings{{.diameter = "11 kg"}}); }).find("diameter"),
      std::string::npos);
}

void expect_begins(const std::string& said, const std::string& begin) {
  EXPECT_EQ(said.substr(0, begin.size()), begin);
}

TEST(Task, FindsTheBraidOfATable) {
  const GeometryFound found = find(mesh(), GeometrySettings{});
  EXPECT_NEAR(found.braid.thread_length, 0.1, 1e-6);
  EXPECT_NEAR(found.braid.turns, 1, 1e-5);
  EXPECT_NE(found.file().find("sinew identify geometry numbers"), std::string::npos);
  const Json json = found.json;
  EXPECT_EQ(json["format"], "sinew.identification/1");
  EXPECT_EQ(json["thread_length_m"], found.braid.thread_length);
}

TEST(Task, CountsTrapezoidsWithoutATable) {
  const GeometryFound found = find({}, GeometrySettings{.trapezoids = "37,16", .side = "0.057 in"});
  EXPECT_TRUE(found.reports.empty());
  EXPECT_FALSE(found.json.contains("format"));
  expect_begins(refusal([] { find({}, GeometrySettings{.trapezoids = "37", .side = "1 mm"}); }),
                "trapezoids: found \"37\"");
  expect_begins(refusal([] { find({}, GeometrySettings{.trapezoids = "37,16", .side = "2 m"}); }),
                "side: found \"2 m\"");
}

TEST(Task, WantsItsTables) {
  expect_begins(refusal([] { find({}, CreepSettings{}); }), "data: found 0 files; expected one");
  expect_begins(refusal([] { find({}, StaticSettings{}); }), "data: found no files");
  expect_begins(refusal([] { sources_of({"a.csv", "a.csv"}, {}); }), "data: found a.csv twice");
  expect_begins(refusal([] { refuse_fitted({{.path = actuator}}, "hold_out", actuator); }),
                "hold_out: found ");
  expect_begins(refusal([] { atmosphere_setting("14.7 in"); }), "atmosphere: found ");
}

// A method's settings have unique names, each has a description, and the defaults are valid.
TEST(Task, DescribesEachSettingOnce) {
  std::size_t methods = 0;
  for_each_method([&](const auto& settings) {
    const SettingList list(settings);
    EXPECT_FALSE(list.of.doc.empty()) << list.of.name;
    std::set<std::string> names;
    for (const Json& row : list.rows) {
      EXPECT_TRUE(names.insert(row["name"].string()).second) << row.text();
      EXPECT_TRUE(names.insert("as " + row["keyword"].string()).second) << row.text();
      EXPECT_GT(row["doc"].string().size(), 5u) << row.text();
    }
    const std::string wrong = refusal([&] { (void)SettingValues(settings); });
    EXPECT_TRUE(wrong == "nothing" || wrong.find(": found nothing; expected") != wrong.npos)
        << wrong;
    ++methods;
  });
  EXPECT_EQ(methods, 12u);
}

// Records a joint with a spring of 12 N m/rad and 0.8 N m of dry friction, moved by hand.
std::vector<Source> moved_pair(const std::string& name = "pair.csv") {
  std::string text = "time [s],torque [N m],angle [rad]\n";
  double share = 0, before = 0;
  for (int i = 0; i < 500; ++i) {
    const double t = 0.01 * i, angle = 0.2 * std::sin(2 * t) + 0.05 * std::sin(7 * t);
    share = std::clamp(share + (angle - before) / 0.01, -1.0, 1.0);
    before = angle;
    const double torque = 12 * angle + 0.8 * share + 0.01 * std::sin(977 * t);
    text += std::to_string(t) + "," + std::to_string(torque) + "," + std::to_string(angle) + "\n";
  }
  return table(text, name);
}

TEST(Task, FindsAPairAndWritesItsJoint) {
  const PairFound found = find(moved_pair(), PairSettings{.hold_out = {{"4 s.."}, {}},
                                                          .model = "spring_bristle",
                                                          .constraints = {.freeze = {"delay=0 s"}},
                                                          .joint = "knee"});
  EXPECT_NEAR(found.result.values.stiffness, 12, 0.1);
  EXPECT_NEAR(found.result.values.friction, 0.8, 0.03);
  EXPECT_EQ(found.result.report.held_out_is, "each recording from 4 s on");
  EXPECT_GT(found.result.report.best().held_out->explained, 0.999);
  const std::string file = found.file();
  EXPECT_NE(file.find("dry_friction"), std::string::npos) << file;
  EXPECT_NE(file.find("knee"), std::string::npos) << file;
  EXPECT_EQ(file.find("damping"), std::string::npos) << file;
  const Json json = found.json;
  EXPECT_FALSE(json.contains("stiffness_N_per_m"));
  EXPECT_EQ(json["stiffness_Nm_per_rad"], found.result.stiffness.value);
  EXPECT_TRUE(json["held_out"].contains("r_squared"));
}

TEST(Task, ReportsAQuantityThatAPairLacksByItsName) {
  const auto asked = [&](const PairSettings& s) {
    return refusal([&] { (void)find(moved_pair(), s); });
  };
  expect_begins(asked({.rigs = "a,b"}), "rigs: found 2 names; expected 1");
  expect_begins(asked({.hold_out = {{"9 s..4 s"}, {}}}),
                "hold_out: found \"9 s..4 s\"; expected a time");
  expect_begins(asked({.hold_out = {{"late"}, {}}}), "hold_out: found \"late\"; expected times");
  expect_begins(asked({.window = "0 s"}), "window: found");
  expect_begins(asked({.constraints = {.freeze = {"delay=1 m"}}}), "freeze: found \"1 m\"");
  EXPECT_TRUE(is_time_range("7 s..") && is_time_range("..3 s") && is_time_range("1 s..2 s"));
  EXPECT_FALSE(is_time_range("../other.csv") || is_time_range("a.csv") || is_time_range(".."));
}

TEST(Task, ReportsASettingByItsName) {
  const std::vector<Source> any = table("time [s],pressure [Pa gauge]\n0,1\n");
  const auto dynamic = [&](const DynamicSettings& s) { return [&any, s] { find(any, s); }; };
  expect_begins(refusal(dynamic({.actuator = actuator, .mass = "-1 kg"})), "mass: found \"-1 kg\"");
  expect_begins(refusal(dynamic({.actuator = actuator, .mass = "1 kg,2 kg"})),
                "mass: found 2 values");
  expect_begins(refusal(dynamic({.actuator = actuator, .name = "x", .mass = "1 kg"})),
                "name: found");
  expect_begins(refusal(dynamic({.actuator = actuator, .mass = "1 kg", .count = 0})),
                "count: found");
  expect_begins(
      refusal([&] { find(any, JointSettings{.actuator = actuator, .names = {.flexion = "up"}}); }),
      "flexion: found \"up\"");
  expect_begins(refusal([&] { find(any, JointSettings{.actuator = actuator, .lever = "1 s"}); }),
                "lever: found");
  expect_begins(refusal([&] { find(any, ValveSettings{.kind = "curve"}); }),
                "kind: found \"curve\"");
  expect_begins(refusal([&] { find(any, ValveSettings{.temperature = "0 K"}); }),
                "temperature: found");
  expect_begins(refusal([&] { find(any, SensorSettings{.bits = 40}); }), "bits: found 40");
  expect_begins(refusal([] { find(mesh(), GeometrySettings{.thread_thickness = "1 m"}); }),
                "thread_thickness: found");
  expect_begins(refusal([&] { find(any, StaticSettings{}); }), "numbers");
  expect_begins(refusal([&] { find(any, StaticSettings{.branch = "up"}); }),
                "branch: found \"up\"");
  expect_begins(refusal([&] { find(any, DynamicSettings{.actuator = actuator}); }),
                "mass: found nothing");
}

}  // namespace
}  // namespace sinew::identify::task_test
