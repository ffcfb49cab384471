// Recorded valve commands in the plant: the same model repeats its motion, another one parts from
// it.
#include "sinew/run/simulation/replay_plant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/buildable.h"
#include "tests/places.h"

namespace sinew::run::replay_plant_test {
namespace {

experiment::Experiment load(const std::string& name, std::vector<std::string> sets = {}) {
  return buildable(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

bool is_of_plant(const std::string& topic) {
  return topic.starts_with("/true/") || topic.ends_with("/count");
}

// Compares every channel of the machine, up to the end of the shorter one, bit for bit.
void expect_same_motion(const signals::Table& a, const signals::Table& b) {
  std::size_t compared = 0;
  for (const signals::Series& s : a.series) {
    if (!is_of_plant(s.topic.name) || s.time_ns.empty()) continue;
    const signals::Series* other = b.find(s.topic.name);
    ASSERT_TRUE(other) << s.topic.name;
    ASSERT_GE(other->time_ns.size() + 1, s.time_ns.size()) << s.topic.name;
    for (std::size_t i = 0; i < other->time_ns.size(); ++i)
      for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const double x = s.columns[c][i], y = other->columns[c][i];
        ASSERT_TRUE(x == y || (std::isnan(x) && std::isnan(y)))
            << s.topic.name << " at " << 1e-9 * static_cast<double>(s.time_ns[i]) << " s: " << x
            << ", " << y;
        ++compared;
      }
  }
  EXPECT_GT(compared, 5000u);
}

void leave_out(signals::Table& table, auto condition) {
  std::erase_if(table.series, [&](const signals::Series& s) { return condition(s.topic.name); });
}

TEST(ReplayPlant, TheSameModelMovesAsItDidBitForBit) {
  for (const char* name : {"one-joint", "walk-test-1"}) {
    const experiment::Experiment e = load(name, {"seed=7"});
    const Outcome ran = run(e);
    const PlantReplay again = replay_plant(e, ran.table);
    EXPECT_FALSE(again.outcome.ended_early()) << cause_of(e, again.outcome);
    EXPECT_TRUE(again.rebuilt.empty());
    expect_same_motion(ran.table, again.outcome.table);
  }
}

TEST(ReplayPlant, EdgesMadeFromDutiesAreThoseOfTheLowLevel) {
  const experiment::Experiment e = load("walk-test-1");
  const Outcome ran = run(e);
  signals::Table duties = ran.table;
  leave_out(duties, [](const std::string& topic) { return signals::is_of_valve(topic); });
  const ValveCommands made = valve_commands(e, duties), were = valve_commands(e, ran.table);
  EXPECT_EQ(made.rebuilt.size(), 8u);
  ASSERT_GT(made.edges.size(), 8000u);

  // The duties do not contain the vent at the end.
  std::size_t equal = 0;
  for (std::size_t i = 0; i < std::min(made.edges.size(), were.edges.size()); ++i)
    equal += made.edges[i].at == were.edges[i].at &&
             made.edges[i].valve.index == were.edges[i].valve.index &&
             made.edges[i].open == were.edges[i].open;
  EXPECT_GT(static_cast<double>(equal), 0.999 * static_cast<double>(made.edges.size()));
}

TEST(ReplayPlant, AnotherModelPartsFromTheRecording) {
  const Outcome ran = run(load("one-joint"));
  const PlantReplay other =
      replay_plant(load("one-joint", {"joint.lever.damping=1.6 lbf in s/rad"}), ran.table);
  const signals::Column& was = *ran.table.column("/true/joint/lever/angle");
  const signals::Column& is = *other.outcome.table.column("/true/joint/lever/angle");
  double apart = 0;
  for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i)
    apart = std::max(apart, std::abs(is[i] - was[i]));
  EXPECT_GT(apart, 0.02) << "rad";
}

TEST(ReplayPlant, WhatIsMissingIsNamed) {
  const experiment::Experiment e = load("one-joint");
  signals::Table table = run(e).table;
  leave_out(table, [](const std::string& topic) {
    return signals::is_of_valve(topic) || topic.ends_with("_duty");
  });
  try {
    (void)replay_plant(e, table);
    ADD_FAILURE() << "replayed";
  } catch (const config::Error& error) {
    const std::string text = error.what();
    for (const std::string& topic : edge_topics(e)) EXPECT_NE(text.find(topic), text.npos) << text;
    EXPECT_NE(text.find("inlet_duty"), text.npos) << text;
  }
}

}  // namespace
}  // namespace sinew::run::replay_plant_test
