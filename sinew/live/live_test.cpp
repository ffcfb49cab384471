// Runs in progress: observation does not change a run; requests of pages.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "sinew/config/compose.h"
#include "sinew/json/json.h"
#include "sinew/live/live_view.h"
#include "sinew/live/request.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/test_same.h"
#include "tests/places.h"

namespace sinew::live::live_test {
namespace {

using experiment::Experiment;
using run::Outcome;
using run::Steering;

Experiment in_air() {
  return experiment::load(sinew::test::source_dir() + "/experiments/leg-in-air.toml",
                          {"sequence.repeat=1"});
}

run::RunOptions fed(Feed& feed, const Experiment& e) {
  run::RunOptions o;
  o.tap = {&feed, [](void* to, std::uint16_t topic, std::int64_t time_ns,
                     std::span<const double> values) noexcept {
             static_cast<Feed*>(to)->push(topic, time_ns, values);
           }};
  for (std::size_t i = 0; i < run::topics(e).size(); ++i)
    o.tapped.push_back(static_cast<std::uint16_t>(i));
  return o;
}

// --- the feed ---

TEST(Feed, HandsOnWhatTheRunRecords) {
  const Experiment e = in_air();
  Feed feed(run::topics(e), 1 << 20);
  const Outcome o = run::run(e, fed(feed, e));
  feed.collect();
  Feed::Position position;
  const signals::Table seen = feed.since(position);
  EXPECT_EQ(feed.left_out(), 0u);
  run::expect_same(o.table, seen);
  for (const signals::Series& s : feed.since(position).series) EXPECT_TRUE(s.time_ns.empty());
}

TEST(Feed, NobodyWhoTakesChangesNothing) {
  const Experiment e = in_air();
  Feed feed(run::topics(e), 64);
  const Outcome watched = run::run(e, fed(feed, e));
  EXPECT_GT(feed.left_out(), 1000u);
  run::expect_same(run::run(e).table, watched.table);
}

// A slow reader gets fewer rows, and each of them is complete and correct.
TEST(Feed, ASlowWatcherChangesNothingAndSeesWholeRows) {
  const Experiment e = in_air();
  Feed feed(run::topics(e), 4096);
  std::atomic<bool> over{false};
  std::thread watcher([&] {
    while (!over) {
      feed.collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const Outcome watched = run::run(e, fed(feed, e));
  over = true;
  watcher.join();
  feed.collect();
  run::expect_same(run::run(e).table, watched.table);

  Feed::Position position;
  const signals::Table seen = feed.since(position);
  for (std::size_t t = 0; t < seen.series.size(); ++t) {
    const signals::Series &few = seen.series[t], &all = watched.table.series[t];
    std::size_t k = 0;
    for (std::size_t i = 0; i < few.time_ns.size(); ++i) {
      while (k < all.time_ns.size() && all.time_ns[k] != few.time_ns[i]) ++k;
      ASSERT_LT(k, all.time_ns.size()) << few.topic.name;
      const double a = few.columns[0][i], b = all.columns[0][k];
      ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << few.topic.name;
    }
  }
}

TEST(Feed, ARowThatLacksASampleIsLeftOut) {
  Feed feed({{"/a", "", {{"value", "1"}}},
             {"/b", "", {{"value", "1"}}},
             {"/valve/x/inlet/open", "", {{"value", "1"}}}});
  const auto push = [&](std::size_t topic, std::int64_t t) {
    const double value = static_cast<double>(t);
    feed.push(topic, t, {&value, 1});
  };
  push(0, 1), push(1, 1);
  push(0, 2);  // the other sample of the row was lost
  push(2, 2);
  push(0, 3), push(1, 3);
  push(0, 4);  // not complete yet
  feed.collect();
  Feed::Position position;
  const signals::Table table = feed.since(position);
  EXPECT_EQ(table.series[0].time_ns, (std::vector<std::int64_t>{1, 3}));
  EXPECT_EQ(table.series[1].time_ns, (std::vector<std::int64_t>{1, 3}));
  EXPECT_EQ(table.series[2].time_ns, (std::vector<std::int64_t>{2}));
}

// --- requests ---

std::string wrong(std::string_view text) {
  try {
    read_request(text, gait::settings(in_air().plan));
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(Request, ReportsWhatIsToBeDone) {
  const auto settings = gait::settings(in_air().plan);
  using Kind = Request::Kind;
  EXPECT_EQ(read_request(R"({"do":"pause"})", settings).kind, Kind::pause);
  EXPECT_EQ(read_request(R"({"do":"resume"})", settings).kind, Kind::resume);
  EXPECT_EQ(read_request(R"({"do":"release all"})", settings).kind, Kind::release_all);
  EXPECT_EQ(read_request(R"({"do":"pace","value":0})", settings).value, 0);
  EXPECT_EQ(read_request(R"({"do":"pace","value":0.25})", settings).value, 0.25);
  const Request set =
      read_request(R"({"do":"set","key":"control.stiffness.knee","value":1.5})", settings);
  EXPECT_EQ(set.kind, Kind::set);
  EXPECT_EQ(set.value, 1.5);
  EXPECT_EQ(settings[set.setting].key, "control.stiffness.knee");
}

TEST(Request, AnythingElseIsRefusedInWords) {
  const std::string key = R"("key":"control.stiffness.knee")";
  for (const std::string& bad : {
           std::string(),
           std::string("pause"),
           std::string("[]"),
           std::string("{"),
           std::string("{}"),
           std::string(R"({"do":1})"),
           std::string(R"({"do":"jump"})"),
           std::string(R"({"do":"pause","value":1})"),
           std::string(R"({"do":"pause","more":1})"),
           std::string(R"({"do":"pace"})"),
           std::string(R"({"do":"pace","value":"1"})"),
           std::string(R"({"do":"pace","value":-1})"),
           std::string(R"({"do":"pace","value":1e9})"),
           std::string(R"({"do":"pace","value":1e-9})"),
           std::string(R"({"do":"set"})"),
           R"({"do":"set",)" + key + "}",
           R"({"do":"set",)" + key + R"(,"value":-1})",
           R"({"do":"set",)" + key + R"(,"value":1e7})",
           R"({"do":"set",)" + key + R"(,"value":1e999})",
           R"({"do":"set",)" + key + R"(,"value":null})",
           R"({"do":"set",)" + key + R"(,"value":NaN})",
           std::string(R"({"do":"set","key":"seed","value":1})"),
           std::string(R"({"do":"set","key":["control.stiffness.knee"],"value":1})"),
           std::string(R"({"do":"release","key":"control.stiffness.elbow"})"),
           std::string("\xff\xfe{}"),
           std::string(100000, '['),
       })
    EXPECT_NE(wrong(bad), "") << bad.substr(0, 80);
  EXPECT_NE(wrong(R"({"do":"jump"})").find("found \"jump\"; expected pause, resume"),
            std::string::npos);
}

// --- the show ---

struct Stage {
  explicit Stage(Experiment of)
      : e(std::move(of)),
        resolved(config::parse_text(experiment::resolved(e, "test"), "resolved.toml")),
        feed(run::topics(e), 1 << 20),
        show(e, resolved, steering, feed, tick) {
    steering.pace(0);
  }
  Outcome run() {
    run::RunOptions o = fed(feed, e);
    o.steering = &steering;
    o.progress = &tick;
    return run::run(e, o);
  }

  Experiment e;
  config::Node resolved;
  Steering steering;
  Feed feed;
  std::atomic<std::int64_t> tick{0};
  LiveView show;
};

TEST(LiveView, SendsNothingBeforeThereIsSomething) {
  Stage stage(in_air());
  LiveView::Position position;
  EXPECT_EQ(stage.show.frame(position), "");
}

TEST(LiveView, EachPageGetsEverythingOnce) {
  Stage stage(in_air());
  const Outcome o = stage.run();
  const std::size_t rows = o.table.find("/plan/phase")->time_ns.size();
  LiveView::Position early, late;
  for (LiveView::Position* page : {&early, &late}) {
    const Json first = Json::parse(stage.show.frame(*page));
    EXPECT_EQ(first["piece"]["samples"]["clocks"][0], rows);
    EXPECT_EQ(first["state"]["values"].size(), 10u);
    const Json again = Json::parse(stage.show.frame(*page));
    EXPECT_FALSE(again.contains("piece"));
    EXPECT_TRUE(again.contains("state"));
  }
}

// A stand is drawn during the run, and has no settings.
TEST(LiveView, OfAStandHasItsDrawing) {
  Experiment e = experiment::load(sinew::test::source_dir() + "/experiments/rig/feedback.toml");
  e.stand->duration = 1;
  Stage stage(e);
  run::expect_same(run::run(e).table, stage.run().table);
  LiveView::Position page;
  const Json first = Json::parse(stage.show.frame(page));
  EXPECT_EQ(first["piece"]["samples"]["clocks"][0], 1001u);
  EXPECT_EQ(first["state"]["values"].size(), 0u);
  if (!report::has_page()) return;
  const std::string text = stage.show.page("127.0.0.1:1");
  EXPECT_NE(text.find("\"stand\":{"), text.npos);
  EXPECT_NE(text.find("\"scene\":null"), text.npos);
}

TEST(LiveView, SettingsAreReportedToEachPageOnce) {
  Stage stage(in_air());
  EXPECT_EQ(stage.show.handle(R"({"do":"set","key":"control.stiffness.knee","value":1.5})"), "");
  stage.run();
  stage.show.record_changes();
  stage.show.record_changes();  // nothing is new
  LiveView::Position early, late;
  for (LiveView::Position* page : {&early, &late}) {
    const Json first = Json::parse(stage.show.frame(*page));
    ASSERT_EQ(first["changes"].size(), 1u);
    const Json& change = first["changes"][0];
    EXPECT_EQ(change["key"], "control.stiffness.knee");
    EXPECT_EQ(change["value"], 1.5);
    EXPECT_EQ(change["unit"], "N m/rad");
    EXPECT_FALSE(Json::parse(stage.show.frame(*page)).contains("changes"));
  }
  const auto knee = static_cast<std::size_t>(
      gait::find_setting(gait::settings(stage.e.plan), "control.stiffness.knee"));
  stage.steering.show(knee, 2, false);
  stage.show.record_changes();
  const Json last = Json::parse(stage.show.frame(early))["changes"];
  ASSERT_EQ(last.size(), 1u);
  EXPECT_TRUE(last[0]["value"].is_null());
}

TEST(LiveView, RequestsOfAPageAreExecutedAndKept) {
  Stage stage(in_air());
  EXPECT_EQ(stage.show.handle(R"({"do":"set","key":"control.stiffness.knee","value":1.5})"), "");
  EXPECT_EQ(stage.show.handle(R"({"do":"pause"})"), "");
  EXPECT_TRUE(stage.steering.paused());
  EXPECT_EQ(stage.show.handle(R"({"do":"resume"})"), "");
  EXPECT_EQ(stage.show.handle(R"({"do":"pace","value":0})"), "");
  const Outcome o = stage.run();
  ASSERT_EQ(o.changes.size(), 1u);
  EXPECT_EQ(o.changes[0].key, "control.stiffness.knee");
  EXPECT_EQ(o.changes[0].value, 1.5);

  LiveView::Position position;
  const Json state = Json::parse(stage.show.frame(position))["state"];
  const auto knee = static_cast<std::size_t>(
      gait::find_setting(gait::settings(stage.e.plan), "control.stiffness.knee"));
  EXPECT_EQ(state["values"][knee], 1.5);
  EXPECT_EQ(state["overridden"][knee], true);
  EXPECT_EQ(state["paused"], false);
}

TEST(LiveView, AMachineIsStoppedAndNotPaused) {
  const Experiment e = in_air();
  const config::Node resolved = config::parse_text(experiment::resolved(e, "0"), "resolved.toml");
  Steering steering;
  Feed feed(run::topics(e));
  std::atomic<std::int64_t> tick{0};
  std::atomic<bool> stop{false};
  LiveView machine(e, resolved, steering, feed, tick, &stop),
      simulation(e, resolved, steering, feed, tick);
  for (const char* of_time :
       {R"({"do":"pause"})", R"({"do":"resume"})", R"({"do":"pace","value":2})"})
    EXPECT_NE(machine.handle(of_time).find("expected stop"), std::string::npos) << of_time;
  EXPECT_FALSE(steering.paused());
  EXPECT_NE(simulation.handle(R"({"do":"stop"})").find("expected pause"), std::string::npos);
  EXPECT_FALSE(stop.load());
  EXPECT_EQ(machine.handle(R"({"do":"stop"})"), "");
  EXPECT_TRUE(stop.load());
}

TEST(LiveView, WhatIsWrongIsAnsweredAndChangesNothing) {
  Stage stage(in_air());
  const Json answer = Json::parse(stage.show.handle(R"({"do":"set","key":"seed","value":1})"));
  EXPECT_NE(answer["error"].string().find("unknown key"), std::string::npos);
  EXPECT_TRUE(stage.run().changes.empty());
}

TEST(LiveView, ItsPageMayConnectToItsServerAlone) {
  Stage stage(in_air());
  if (!report::has_page()) GTEST_SKIP() << "built without npm";
  const std::string page = stage.show.page("127.0.0.1:1234");
  EXPECT_NE(page.find("; connect-src ws://127.0.0.1:1234\">"), std::string::npos);
  EXPECT_NE(page.find("\"live\":{\"controls\":[{\"key\":\"control.angle.hip\""), std::string::npos);
}

TEST(Largest, IsTheLargestOfThePlan) {
  Experiment e = in_air();
  const auto settings = gait::settings(e.plan);
  const auto hip = static_cast<std::size_t>(gait::find_setting(settings, "control.stiffness.hip"));
  const double own = largest(e.plan, settings[hip]);
  EXPECT_GE(own, e.plan.joints[0].stiffness);
  e.plan.phases[0].joints[0].stiffness = {own, 2 * own};
  EXPECT_EQ(largest(e.plan, settings[hip]), 2 * own);
}

}  // namespace
}  // namespace sinew::live::live_test
