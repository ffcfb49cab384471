// Tests the joint controller as a whole: events, safety, states, bad readings, no heap.
#include "sinew/control/joint/joint_controller.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "sinew/control/joint/test_leg.h"
#include "tests/counted_heap.h"

namespace sinew::control::joint_controller_test {
namespace {

using signals::Reading;
using signals::Status;
using signals::Tick;

// --- a plant with random readings and commands that depend on the tick only ---

struct World {
  std::uint32_t seed = 1;
  int bad_per_thousand = 0;
  bool commands = true;  // false: the first command holds
  std::function<void(JointController&, Tick)> interfere = [](JointController&, Tick) {};

  std::uint32_t random(Tick t, std::uint32_t what) const {
    std::uint64_t x =
        static_cast<std::uint64_t>(t) * 0x9E3779B97F4A7C15u + seed * 0xBF58476D1CE4E5B9u + what;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return static_cast<std::uint32_t>(x >> 33);
  }

  Reading read(signals::Channel c, Tick t) const {
    const bool bad = static_cast<int>(random(t, 100) % 1000) < bad_per_thousand;
    return {static_cast<std::uint16_t>(random(t, c.index) % 4096), !bad ? Status::ok
                                                                   : random(t, 101) % 2
                                                                       ? Status::late
                                                                       : Status::invalid};
  }

  Command command(const JointControllerConfig& config, Tick t) const {
    Command command = rest_command(config);
    if (!commands) t = 0;
    for (std::uint32_t j = 0; j < max_joints; ++j) {
      JointCommand& c = command.joint[j];
      c.angle = static_cast<std::int32_t>(random(t, 200 + j) % 4096);
      c.stiffness = static_cast<float>(random(t, 210 + j) % 60);
      c.enabled = !commands || random(t, 220 + j) % 6 != 0;
      c.open_loop = commands && random(t, 230 + j) % 6 == 0;
      const auto duty = [&](std::uint32_t v) {
        return static_cast<std::int32_t>(random(t, 240 + 4 * j + v) % 150);
      };
      c.duties = {duty(0), duty(1), duty(2), duty(3)};
    }
    return command;
  }
};

struct Event {
  Tick at;
  int valve;
  bool open;
  friend bool operator==(const Event&, const Event&) = default;
};

struct Trace {
  std::vector<Event> edges;
  std::vector<ControllerState> states;  // at each period's start
  int visited = 0;
};

Trace run(JointController& controller, const World& world, Tick end, bool every_tick = false) {
  Trace trace;
  for (Tick t = 0; t < end; t = every_tick ? t + 1 : controller.next_event(t)) {
    ++trace.visited;
    if (t % controller.scan().period == 0) {
      trace.states.push_back(controller.state());
      controller.command(world.command(controller.config(), t));
    }
    for (const signals::Edge& e : controller.edges(t)) {
      EXPECT_EQ(e.at, t);
      trace.edges.push_back({e.at, e.valve.index, e.open});
    }
    if (const signals::Conversion* c = controller.due(t))
      controller.take(*c, world.read(c->channel, t), t);
    world.interfere(controller, t);
  }
  return trace;
}

Trace run(const JointControllerConfig& config, const World& world, Tick end,
          bool every_tick = false) {
  JointController controller(config);
  return run(controller, world, end, every_tick);
}

JointControllerConfig leg_with(const signals::ValveTiming& timing, std::uint16_t delay = 1) {
  JointControllerConfig config = test_leg();
  config.timing = timing;
  config.output_delay = delay;
  return config;
}

bool same(const ControllerState& a, const ControllerState& b) {
  for (std::size_t j = 0; j < max_joints; ++j)
    if (a.joint[j].duties != b.joint[j].duties || a.joint[j].stiffness != b.joint[j].stiffness ||
        a.joint[j].law_at != b.joint[j].law_at || a.joint[j].pole_holds != b.joint[j].pole_holds)
      return false;
  return a.phase == b.phase && a.late == b.late && a.invalid == b.invalid;
}

// --- events -------------------------------------------------------------------------------------

TEST(JointController, NextEventSkipsOnlyEmptyTicks) {
  for (const std::uint16_t delay : {1, 3, 99, 100})
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      JointControllerConfig config = leg_with(
          seed % 2 ? signals::identity_timing() : signals::compensated_timing(5, 12), delay);
      config.startup_vent = 37 * seed;
      const World world{
          .seed = seed, .bad_per_thousand = 20, .interfere = [](JointController& s, Tick t) {
            if (t == 40'013) s.shut_down(t);
          }};
      const Trace jumps = run(config, world, 60'000), all = run(config, world, 60'000, true);
      ASSERT_EQ(jumps.edges, all.edges);
      ASSERT_GT(jumps.edges.size(), 300u);
      ASSERT_EQ(jumps.states.size(), all.states.size());
      for (std::size_t i = 0; i < all.states.size(); ++i)
        ASSERT_TRUE(same(jumps.states[i], all.states[i])) << i;
      ASSERT_LT(jumps.visited, all.visited / 5);
    }
}

TEST(JointController, VisitsPeriodsAndConversionsWithoutValves) {
  JointControllerConfig config = test_leg();
  config.joints = 0;
  JointController controller(config);
  std::vector<Tick> ticks;
  for (Tick t = 0; t < 200; t = controller.next_event(t)) ticks.push_back(t);
  EXPECT_EQ(ticks,
            (std::vector<Tick>{0, 1, 3, 5, 7, 9, 11, 13, 100, 101, 103, 105, 107, 109, 111, 113}));
}

// --- safety -------------------------------------------------------------------------------------

// Follows the edges one by one, so that an overlap of zero length is found too.
void expect_never_both(const JointControllerConfig& config, const World& world, Tick end) {
  std::array<bool, 12> open{};
  for (const Event& e : run(config, world, end).edges) {
    ASSERT_NE(open[e.valve], e.open) << "an edge changes its valve";
    open[e.valve] = e.open;
    if (e.valve < 8) {  // of a muscle
      ASSERT_FALSE(open[e.valve & ~1] && open[e.valve | 1])
          << "tick " << e.at << " valve " << e.valve;
    }
  }
}

TEST(JointController, InletAndExhaustAreNeverOpenTogether) {
  std::mt19937 random(3);
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    signals::ValveTiming timing = signals::identity_timing();
    if (seed % 3 == 1) timing = signals::compensated_timing(seed, 2 * seed);
    if (seed % 3 == 2)
      for (std::size_t d = 1; d <= 100; ++d)
        timing.closing[d] = random() % 102, timing.opening[d] = random() % 102;
    JointControllerConfig config = leg_with(timing, seed % 4 == 0 ? 60 : 1);
    config.startup_vent = seed % 2 ? 250 : 0;
    ASSERT_EQ(problem(config), nullptr);
    const World world{
        .seed = seed, .bad_per_thousand = 10, .interfere = [](JointController& s, Tick t) {
          if (t == 200'003) s.shut_down(t);
        }};
    expect_never_both(config, world, 220'000);
  }
}

TEST(JointController, StartupVentsThenRuns) {
  JointControllerConfig config = test_leg();
  config.startup_vent = 250;
  JointController controller(config);
  const Trace trace = run(controller, {.commands = false}, 1000);
  const std::vector<Event> vent = {{0, 1, true},    {0, 3, true},    {0, 5, true},
                                   {0, 7, true},    {0, 9, true},    {0, 11, true},
                                   {250, 1, false}, {250, 3, false}, {250, 5, false},
                                   {250, 7, false}, {250, 9, false}, {250, 11, false}};
  ASSERT_GE(trace.edges.size(), vent.size());
  EXPECT_TRUE(std::equal(vent.begin(), vent.end(), trace.edges.begin()));
  for (std::size_t i = vent.size(); i < trace.edges.size(); ++i) EXPECT_GT(trace.edges[i].at, 301);
  EXPECT_EQ(trace.states[2].phase, Phase::startup);
  EXPECT_EQ(trace.states[3].phase, Phase::running);
  EXPECT_EQ(trace.states[3].joint[hip].law_at, -1);
  EXPECT_EQ(trace.states[4].joint[hip].law_at, 309);
}

// Expects inlets shut and exhausts open from tick `at` on, all shut `vent` later, then no edges.
void expect_safe_after(const Trace& trace, Tick at, Tick vent) {
  std::array<bool, 12> open{};
  std::array<int, 12> edges_after{};
  for (const Event& e : trace.edges) {
    open[e.valve] = e.open;
    if (e.at <= at) continue;
    ++edges_after[e.valve];
    ASSERT_TRUE(e.at == at + 1 || e.at == at + 1 + vent) << e.at;
    ASSERT_TRUE(e.at == at + 1 ? e.open == (e.valve % 2 == 1) : !e.open);
  }
  for (int v = 0; v < 12; ++v) {
    EXPECT_FALSE(open[v]);
    if (v % 2) {
      EXPECT_GE(edges_after[v], 1);
    }
  }
}

TEST(JointController, ShutDownVentsThenShuts) {
  JointControllerConfig config = test_leg();
  config.shutdown_vent = 3000;
  for (const std::uint32_t startup : {0, 6000})
    for (const Tick at : {0, 5009, 5010, 5050, 5108, 7313}) {
      config.startup_vent = startup;
      JointController controller(config);
      const World world{.interfere = [at](JointController& s, Tick t) {
        if (t >= at && t < at + 1000) s.shut_down(t);  // a repeated request changes nothing
      }};
      const Trace trace = run(controller, world, 20'000, true);
      expect_safe_after(trace, at, 3000);
      EXPECT_EQ(controller.state().phase, Phase::off);
      EXPECT_EQ(controller.state().fault, Status::ok);
    }
}

TEST(JointController, FaultAndEndLeadToTheSafeState) {
  for (const Status status : {Status::fault, Status::ended}) {
    JointController controller(test_leg());
    const World world{.commands = false};
    const Trace before = run(controller, world, 5000);
    EXPECT_EQ(controller.state().phase, Phase::running);
    controller.take({{4}, 8, 9}, {123, status}, 5009);
    EXPECT_EQ(controller.state().phase, Phase::venting);
    EXPECT_EQ(controller.state().fault, status);
    EXPECT_EQ(controller.state().fault_channel.index, 4);
    EXPECT_NE(controller.state().reading[4].counts, 123);
    EXPECT_LT(controller.state().joint[hip].law_at, 5009);
    EXPECT_EQ(controller.next_event(5009), 5010);
    for (const signals::Edge& e : controller.edges(5010)) EXPECT_EQ(e.open, e.valve.index % 2 == 1);
  }
}

// --- readings -----------------------------------------------------------------------------------

TEST(JointController, BadReadingsHoldTheLastGoodOnes) {
  JointController controller(test_leg());
  run(controller, {.commands = false}, 1000);
  const std::uint16_t good = controller.state().reading[1].counts;
  controller.take({{1}, 2, 3}, {7, Status::late}, 1003);
  controller.take({{1}, 2, 3}, {7, Status::invalid}, 1103);
  EXPECT_EQ(controller.state().reading[1].counts, good);
  EXPECT_EQ(controller.state().reading[1].status, Status::invalid);
  EXPECT_EQ(controller.state().late, 1u);
  EXPECT_EQ(controller.state().invalid, 1u);
  EXPECT_EQ(controller.state().phase, Phase::running);
  controller.take({{1}, 2, 3}, {60'000, Status::ok}, 1203);  // limited to 12 bits
  EXPECT_EQ(controller.state().reading[1].counts, 4095);
  controller.missed(1203);
  EXPECT_EQ(controller.state().missed, 1u);
}

TEST(JointController, HoldLimitEndsTheRun) {
  JointControllerConfig config = test_leg();
  config.hold_limit = 3;
  JointController controller(config);
  run(controller, {.commands = false}, 1000);
  for (const Tick t : {1003, 1103}) controller.take({{1}, 2, 3}, {0, Status::late}, t);
  controller.take({{1}, 2, 3}, {0, Status::ok}, 1203);
  for (const Tick t : {1303, 1403}) controller.take({{1}, 2, 3}, {0, Status::late}, t);
  EXPECT_EQ(controller.state().phase, Phase::running);
  controller.take({{1}, 2, 3}, {0, Status::late}, 1503);
  EXPECT_EQ(controller.state().phase, Phase::venting);
  EXPECT_EQ(controller.state().fault, Status::late);
}

TEST(JointController, NoLawBeforeItsChannelsAnswered) {
  JointController controller(test_leg());
  for (Tick t = 0; t < 1000; t = controller.next_event(t)) {
    controller.edges(t);
    const signals::Conversion* c = controller.due(t);
    if (c) controller.take(*c, {2000, c->channel.index == 3 ? Status::late : Status::ok}, t);
  }
  EXPECT_EQ(controller.state().joint[hip].law_at, -1);
  EXPECT_EQ(controller.state().joint[knee].law_at, 913);
}

TEST(JointController, StiffnessIsHeldNearThePole) {
  JointController controller(test_leg());
  const auto period = [&](Tick start, std::uint16_t angle) {
    for (Tick t = start; t < start + 100; t = controller.next_event(t)) {
      controller.edges(t);
      if (const signals::Conversion* c = controller.due(t))
        controller.take(*c, {c->channel.index == 1 ? angle : std::uint16_t{1000}, Status::ok}, t);
    }
    return controller.state().joint[hip];
  };
  const JointState rest = period(0, 1895);
  EXPECT_NEAR(rest.stiffness, 2 * 33 * 1000 / 2917.0, 0.01);
  EXPECT_FALSE(rest.pole_held);
  const JointState held = period(100, 1895 + 500);  // 48 counts from the pole
  EXPECT_TRUE(held.pole_held);
  EXPECT_EQ(held.stiffness, rest.stiffness);
  EXPECT_EQ(held.pole_holds, 1u);
  const JointState again = period(200, 1895 + 300);
  EXPECT_FALSE(again.pole_held);
  EXPECT_GT(again.stiffness, rest.stiffness);
}

// --- commands -----------------------------------------------------------------------------------

TEST(JointController, EachJointIsEnabledOnItsOwn) {
  JointControllerConfig config = test_leg();
  config.joint[cylinder].enabled = false;  // permanently
  JointController controller(config);
  Command command = rest_command(config);
  command.joint[knee].enabled = command.joint[cylinder].enabled = true;
  for (JointCommand& c : command.joint) c.open_loop = true, c.duties = {30, 0, 0, 40};
  bool knee_moved = false;
  for (Tick t = 0; t < 2000; t = controller.next_event(t)) {
    if (controller.starts_period(t)) controller.command(command);
    for (const signals::Edge& e : controller.edges(t)) {
      EXPECT_TRUE(e.valve.index == 4 || e.valve.index == 7);
      knee_moved = true;
    }
    if (const signals::Conversion* c = controller.due(t))
      controller.take(*c, {1500, Status::ok}, t);
  }
  EXPECT_TRUE(knee_moved);
  EXPECT_EQ(controller.state().joint[hip].duties, (Duties{30, 0, 0, 40}));  // computed, not driven
  EXPECT_FALSE(controller.state().joint[hip].enabled);
}

// --- configuration, heap ------------------------------------------------------------------------

TEST(JointControllerConfig, ProblemsAreNamed) {
  const auto with = [](void (*change)(JointControllerConfig&)) {
    JointControllerConfig config = test_leg();
    change(config);
    const char* p = problem(config);
    return std::string(p ? p : "");
  };
  EXPECT_EQ(problem(test_leg()), nullptr);
  EXPECT_NE(with([](JointControllerConfig& c) { c.joint[hip].law_tick = 10; }), "");
  EXPECT_NE(with([](JointControllerConfig& c) { c.joint[knee].flexion = 0; }), "");
  EXPECT_NE(with([](JointControllerConfig& c) {
              c.joint[knee].flexor.inlet = c.joint[hip].flexor.inlet;
            }),
            "");
  EXPECT_NE(with([](JointControllerConfig& c) { c.conversion[3].start = c.conversion[3].read; }),
            "");
  EXPECT_NE(with([](JointControllerConfig& c) { std::swap(c.conversion[3], c.conversion[4]); }),
            "");
  EXPECT_NE(with([](JointControllerConfig& c) { c.output_delay = 0; }), "");
  EXPECT_NE(with([](JointControllerConfig& c) { c.timing.closing[0] = 5; }), "");
  EXPECT_NE(with([](JointControllerConfig& c) { c.joint[hip].flexor.tension = {12}; }), "");
}

TEST(JointController, NeverAllocates) {
  const World world{.bad_per_thousand = 5};
  JointControllerConfig config = test_leg();
  config.startup_vent = 300;
  test::allocations = 0;
  test::counting = true;
  JointController controller(config);
  std::size_t edges = 0;
  for (Tick t = 0; t < 100'000; t = controller.next_event(t)) {
    if (controller.starts_period(t)) controller.command(world.command(config, t));
    edges += controller.edges(t).size();
    if (const signals::Conversion* c = controller.due(t))
      controller.take(*c, world.read(c->channel, t), t);
    if (t == 90'000) controller.shut_down(t);
  }
  test::counting = false;
  EXPECT_EQ(test::allocations, 0);
  EXPECT_GT(edges, 1000u);
}

}  // namespace
}  // namespace sinew::control::joint_controller_test
