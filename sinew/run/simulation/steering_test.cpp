// Steering of a run: changes take effect at the start of a period and can be repeated; pause and
// pace change no bit.
#include "sinew/run/controllers/steering.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/run/simulation/test_same.h"
#include "tests/places.h"

namespace sinew::run::steering_test {
namespace {

using std::chrono::milliseconds;

const std::string source = sinew::test::source_dir();

experiment::Experiment in_air() {
  return experiment::load(source + "/experiments/leg-in-air.toml",
                          {"sequence.repeat=1", "log.gains=true"});
}

std::size_t setting(const experiment::Experiment& e, const std::string& key) {
  return static_cast<std::size_t>(gait::find_setting(gait::settings(e.plan), key));
}

experiment::Experiment with(experiment::Experiment e, std::vector<gait::Change> changes) {
  e.plan.changes = std::move(changes);
  return e;
}

// Repeats the run from the file that it leaves.
experiment::Experiment again(experiment::Experiment e, std::vector<gait::Change> changes) {
  e = with(std::move(e), std::move(changes));
  return experiment::load(config::parse_text(experiment::resolved(e, "test"), "resolved.toml"),
                          "resolved.toml");
}

const signals::Series& series(const signals::Table& table, const std::string& name) {
  const signals::Series* found = table.find(name);
  if (!found) throw std::out_of_range(name);
  return *found;
}

// Returns the first time at which the value occurs, or -1 [ns].
std::int64_t first_at(const signals::Series& s, double value) {
  for (std::size_t i = 0; i < s.time_ns.size(); ++i)
    if (s.columns[0][i] == value) return s.time_ns[i];
  return -1;
}

TEST(Change, OfTheListTakesEffectAtTheNextPeriodStart) {
  const experiment::Experiment plain = in_air();
  const std::string key = "control.stiffness.hip";
  // Samples follow the last law of a period, 1 ms after its start at the earliest.
  for (const auto& [time, start] : {std::pair{1.0, 1000}, std::pair{1.0001, 1010}}) {
    const Outcome o = run(with(plain, {{.time = time, .key = key, .value = 1.5}}));
    const std::int64_t at = first_at(series(o.table, "/desired/joint/hip/stiffness"), 1.5);
    EXPECT_GE(at, start * 1'000'000LL);
    EXPECT_LT(at, (start + 10) * 1'000'000LL);
  }
}

TEST(Change, BeforeItsTimeNothingDiffers) {
  const experiment::Experiment plain = in_air();
  const Outcome a = run(plain);
  const Outcome b = run(with(plain, {{.time = 1, .key = "control.gains.knee.angle", .value = 0}}));
  const auto& x = series(a.table, "/joint/knee/angle");
  const auto& y = series(b.table, "/joint/knee/angle");
  bool differs = false;
  for (std::size_t i = 0; i < x.time_ns.size(); ++i)
    if (x.time_ns[i] < 1'000'000'000)
      ASSERT_EQ(x.columns[0][i], y.columns[0][i]) << i;
    else
      differs = differs || x.columns[0][i] != y.columns[0][i];
  EXPECT_TRUE(differs) << "a gain of zero is seen";
}

TEST(Change, ReleasedThePlansOwnValueCountsAgain) {
  const experiment::Experiment plain = in_air();
  const std::string key = "control.gains.hip.angle", topic = "/desired/gain/hip/angle";
  const Outcome o = run(with(
      plain, {{.time = 2, .key = key, .release = true}, {.time = 1, .key = key, .value = 0.25}}));
  const Outcome own = run(plain);
  const auto& s = series(o.table, topic);
  const auto& plan = series(own.table, topic);
  for (std::size_t i = 0; i < s.time_ns.size(); ++i) {
    const bool within = s.time_ns[i] >= 1'000'000'000 && s.time_ns[i] < 2'000'000'000;
    ASSERT_EQ(s.columns[0][i], within ? 0.25 : plan.columns[0][i]) << s.time_ns[i];
  }
}

TEST(Change, OfOneTimeTheLastOneOfTheListCounts) {
  const Outcome o = run(with(in_air(), {{.time = 1, .key = "control.stiffness.hip", .value = 3},
                                        {.time = 1, .key = "control.stiffness.hip", .value = 2}}));
  const auto& s = series(o.table, "/desired/joint/hip/stiffness");
  EXPECT_EQ(first_at(s, 3), -1);
  EXPECT_GE(first_at(s, 2), 1'000'000'000);
}

TEST(Change, GoesThroughTheFileAndBack) {
  const std::vector<gait::Change> list = {
      {.time = 0.1, .key = "control.gains.hip.velocity", .value = 0.1 / 3},
      {.time = 0.7, .key = "control.gains.hip.velocity", .release = true}};
  const experiment::Experiment back = again(in_air(), list);
  ASSERT_EQ(back.plan.changes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.plan.changes[i].time, list[i].time);
    EXPECT_EQ(back.plan.changes[i].key, list[i].key);
    EXPECT_EQ(back.plan.changes[i].release, list[i].release);
  }
  EXPECT_EQ(back.plan.changes[0].value, 0.1 / 3);
  EXPECT_TRUE(std::isnan(back.plan.changes[1].value));
}

std::string refusal(const std::string& change, const std::string& base = "walk-test-1") {
  const std::string text = "format = \"sinew.experiment/2\"\nbase = \"" + source + "/experiments/" +
                           base + ".toml\"\n[[change]]\n" + change;
  const std::string file = ::testing::TempDir() + "steering_test_change.toml";
  std::ofstream(file) << text;
  try {
    experiment::load(file);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Change, ThatIsWrongIsRefusedWithItsLine) {
  using ::testing::TempDir;
  const auto expect = [](const std::string& change, std::initializer_list<const char*> parts) {
    const std::string text = refusal(change);
    for (const char* part : parts) EXPECT_NE(text.find(part), text.npos) << part << "\nin " << text;
  };
  const std::string at = "time = \"1 s\"\n";
  EXPECT_EQ(refusal(at + "key = \"control.gains.hip.angle\"\nvalue = \"0.1 %/count\""), "nothing");
  expect(at + "key = \"control.gains.hip.angel\"\nvalue = \"1\"",
         {":5:", "change[0].key", "control.gains.<joint>.angle"});
  expect(at + "key = \"control.gains.elbow.angle\"\nvalue = \"0.1 1/count\"",
         {"change[0].key", "elbow", "hip, knee"});
  expect(at + "key = \"control.stiffness.hip\"\nvalue = \"35 lbf\"", {":6:", "change[0].value"});
  expect(at + "key = \"control.stiffness.hip\"\nvalue = \"-1 N m/rad\"", {"change[0].value", "0"});
  expect(at + "key = \"control.stiffness.hip\"", {"no value", "release = true"});
  expect("key = \"control.stiffness.hip\"\nvalue = \"1 N m/rad\"", {"change[0].time"});
  expect("time = \"-1 s\"\nkey = \"control.stiffness.hip\"\nvalue = \"1 N m/rad\"",
         {"change[0].time"});
}

// --- several legs ---

experiment::Experiment on_two_legs(std::vector<gait::Change> changes) {
  return with(experiment::load(source + "/experiments/walk-two-legs.toml", {"sequence.repeat=1"}),
              std::move(changes));
}

const signals::Column& knee(const Outcome& out, const std::string& leg) {
  return series(out.table, "/desired/leg/" + leg + "/joint/knee/stiffness").columns[0];
}

// A change of one leg leaves the other to the plan; without a leg it applies to both.
TEST(Change, OfOneLegLeavesTheOther) {
  const std::string key = "control.stiffness.knee";
  const Outcome plain = run(on_two_legs({}));
  const Outcome left = run(on_two_legs({{.time = 1, .key = key, .value = 4, .leg = "left"}}));
  const Outcome both = run(on_two_legs({{.time = 1, .key = key, .value = 4},
                                        {.time = 2, .key = key, .release = true, .leg = "right"}}));
  const signals::Times& time =
      series(plain.table, "/desired/leg/left/joint/knee/stiffness").time_ns;
  const std::size_t rows =
      std::min({time.size(), knee(left, "left").size(), knee(both, "left").size()});
  int changed = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const bool after = time[i] >= 1'010'000'000, before = time[i] < 1'000'000'000;
    const bool released = time[i] >= 2'010'000'000;
    if (!after && !before) continue;
    EXPECT_EQ(knee(left, "right")[i], knee(plain, "right")[i]) << time[i];
    EXPECT_EQ(knee(left, "left")[i], after ? 4 : knee(plain, "left")[i]) << time[i];
    EXPECT_EQ(knee(both, "left")[i], after ? 4 : knee(plain, "left")[i]) << time[i];
    const bool set = after && time[i] < 2'000'000'000;
    if (set || released || before) {
      EXPECT_EQ(knee(both, "right")[i], set ? 4 : knee(plain, "right")[i]) << time[i];
    }
    changed += knee(left, "left")[i] != knee(plain, "left")[i];
  }
  EXPECT_GT(changed, 50);

  // The file that the run leaves names the leg of each change.
  const experiment::Experiment back =
      again(on_two_legs({}), {{.time = 1, .key = key, .value = 4, .leg = "left"}});
  expect_same(run(back).table, left.table);
}

TEST(Change, NamesALegThatIsThere) {
  const std::string change = "time = \"1 s\"\nkey = \"control.stiffness.hip\"\nrelease = true\n";
  const std::string none = refusal(change + "leg = \"left\"");
  EXPECT_NE(none.find(":7:"), none.npos) << none;
  EXPECT_NE(none.find("change[0].leg: found \"left\"; expected no leg"), none.npos) << none;
  const std::string other = refusal(change + "leg = \"lefd\"", "walk-two-legs");
  EXPECT_NE(other.find("change[0].leg: found \"lefd\"; expected left or right"), other.npos)
      << other;
  EXPECT_EQ(refusal(change + "leg = \"left\"", "walk-two-legs"), "nothing");
}

// A change in a controlled simulation and one by the list give the same run.
TEST(Change, OfOneLegByWhoHoldsTheRunIsThatOfTheList) {
  const std::string key = "control.stiffness.knee";
  Simulation held(on_two_legs({}));
  Simulation listed(on_two_legs({{.time = 1, .key = key, .value = 4, .leg = "right"}}));
  held.advance_to(10'000);
  held.change(key, 4, "right");
  held.advance_to(20'000);
  listed.advance_to(20'000);
  for (const Simulation::Channel& c : held.channels())
    EXPECT_EQ(held.read(c.name), listed.read(c.name)) << c.name;
  EXPECT_EQ(held.read("/desired/leg/right/joint/knee/stiffness"), 4);
  EXPECT_NE(held.read("/desired/leg/left/joint/knee/stiffness"), 4);
  EXPECT_THROW(held.change(key, 4, "middle"), std::invalid_argument);
}

TEST(Steering, ThatDoesNothingLeavesTheBits) {
  const experiment::Experiment e = in_air();
  Steering steering;
  steering.pace(0);
  expect_same(run(e).table, run(e, {.steering = &steering}).table);
}

// Uses all controls except those that change a value.
TEST(Steering, PauseAndSpeedLeaveTheBits) {
  const experiment::Experiment e = in_air();
  Steering steering;
  steering.pace(20);
  std::atomic<std::int64_t> tick{0};
  std::atomic<bool> over{false};
  std::thread person([&] {
    for (int i = 0; !over; ++i) {
      steering.pause(i % 3 == 1);
      steering.pace(i % 2 ? 300 : 5);
      std::this_thread::sleep_for(milliseconds(3));
    }
  });
  const Outcome o = run(e, {.steering = &steering, .progress = &tick});
  over = true;
  person.join();
  expect_same(run(e).table, o.table);
  EXPECT_EQ(o.controller.missed, 0u);
}

TEST(Steering, APausedRunStandsStillAndGoesOn) {
  const experiment::Experiment e = in_air();
  Steering steering;
  steering.pace(1);
  std::atomic<std::int64_t> tick{0};
  Outcome o;
  std::thread runner([&] { o = run(e, {.steering = &steering, .progress = &tick}); });
  while (tick < 500) std::this_thread::sleep_for(milliseconds(1));
  steering.pause(true);
  std::this_thread::sleep_for(milliseconds(50));
  const std::int64_t stood = tick;
  std::this_thread::sleep_for(milliseconds(150));
  EXPECT_EQ(tick, stood);
  EXPECT_LT(tick, experiment::last_tick(e) / 2);
  steering.pace(0);
  steering.pause(false);
  runner.join();
  expect_same(run(e).table, o.table);
}

// A run that starts paused has one sample, so that there is data to show.
TEST(Steering, ARunThatStartsPausedHasOneSample) {
  const experiment::Experiment e = in_air();
  for (const double pace : {0.0, 1.0}) {
    Steering steering;
    steering.pace(pace);
    steering.pause(true);
    std::atomic<std::int64_t> tick{-1};
    std::atomic<int> samples{0};
    RunOptions o{.steering = &steering, .progress = &tick};
    o.tap = {&samples, [](void* n, std::uint16_t, std::int64_t, std::span<const double>) noexcept {
               ++*static_cast<std::atomic<int>*>(n);
             }};
    o.tapped.assign(1000, 0);
    std::thread runner([&] { run(e, o); });
    while (samples == 0) std::this_thread::sleep_for(milliseconds(1));
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_LE(tick, 400);
    steering.pace(0);
    steering.pause(false);
    runner.join();
  }
}

TEST(Steering, ARunThatWasChangedCanBeRepeated) {
  const experiment::Experiment e = in_air();
  Steering steering;
  steering.pace(3);
  std::atomic<std::int64_t> tick{0};
  Outcome o;
  std::thread runner([&] { o = run(e, {.steering = &steering, .progress = &tick}); });
  const std::size_t hip = setting(e, "control.gains.hip.angle");
  const std::size_t knee = setting(e, "control.stiffness.knee");
  // The run waits while it is paused, however busy this computer is.
  const auto at = [&](std::int64_t t, auto act) {
    while (tick < t) std::this_thread::sleep_for(milliseconds(1));
    steering.pause(true);
    act();
    steering.pause(false);
  };
  at(2000, [&] { EXPECT_TRUE(steering.change(hip, 0.1 / 3)); });
  at(4000, [&] {
    EXPECT_TRUE(steering.overridden(hip));
    EXPECT_EQ(steering.value(hip), 0.1 / 3);
    EXPECT_TRUE(steering.change(knee, 0.5));
    EXPECT_TRUE(steering.change(hip, 0.002));
  });
  at(9000, [&] { EXPECT_TRUE(steering.release(hip)); });
  at(11000, [&] {
    EXPECT_FALSE(steering.overridden(hip));
    EXPECT_NE(steering.value(hip), 0.002);
    steering.pace(0);
  });
  runner.join();

  ASSERT_EQ(o.changes.size(), 4u);
  for (const gait::Change& c : o.changes) {
    const double periods = c.time / 0.01;
    EXPECT_NEAR(periods, std::round(periods), 1e-6) << "not at a period start";
  }
  EXPECT_FALSE(std::ranges::equal(series(run(e).table, "/joint/hip/angle").columns[0],
                                  series(o.table, "/joint/hip/angle").columns[0]));
  expect_same(o.table, run(again(e, o.changes)).table);
}

TEST(Steering, AListAndAPersonGoTogether) {
  const experiment::Experiment e =
      with(in_air(), {{.time = 1.0001, .key = "control.stiffness.hip", .value = 3}});
  Steering steering;
  steering.pace(0);
  steering.change(setting(e, "control.stiffness.hip"), 2);  // at once
  const Outcome o = run(e, {.steering = &steering});
  ASSERT_EQ(o.changes.size(), 2u);
  EXPECT_EQ(o.changes[1].time, 0);
  const auto& s = series(o.table, "/desired/joint/hip/stiffness");
  EXPECT_EQ(s.columns[0].front(), 2);
  EXPECT_EQ(s.columns[0].back(), 3);
  expect_same(o.table, run(again(e, o.changes)).table);
}

TEST(Steering, WhatIsNoSettingIsRefused) {
  Steering steering;
  steering.pace(0);
  steering.change(1000, 1);
  const Outcome o = run(in_air(), {.steering = &steering});
  EXPECT_EQ(steering.refused(), 1u);
  EXPECT_TRUE(o.changes.empty());
}

TEST(Steering, MoreThanThereIsRoomForIsReported) {
  Steering steering;
  int taken = 0;
  while (taken < 100000 && steering.change(0, 1)) ++taken;
  EXPECT_EQ(taken, 256);
  EXPECT_FALSE(steering.release(0));
}

TEST(SteeredClock, RunsAtTheRequestedPace) {
  Steering steering;
  steering.pace(2);
  SteeredClock clock(steering);
  const auto from = std::chrono::steady_clock::now();
  for (signals::Tick t = 0; t <= 4000; t += 100) clock.wait_until(t);  // 0.4 s
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - from;
  EXPECT_GE(took.count(), 0.2 - 1e-3);
  EXPECT_LT(took.count(), 2.0);
}

}  // namespace
}  // namespace sinew::run::steering_test
