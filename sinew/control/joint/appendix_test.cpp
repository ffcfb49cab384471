// Compares class JointController with the thesis's interrupt routine (appendix B, pwm_isr),
// repeated here with the thesis's types: `short` outputs, float gains, expressions in the x87's
// extended precision, a state machine that checks every valve in every tick. Equal random readings,
// commands and enable switches must give equal duties and edges.
//
// The reference differs from the code where the laws do (laws.h): conversions to `short` saturate
// at +-16000, the first law has no speed, and a length of 0 keeps the last stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <utility>

#include "sinew/control/joint/joint_controller.h"
#include "sinew/control/joint/test_leg.h"

namespace sinew::control::appendix_test {
namespace {

using signals::Tick;

// --- the reference ------------------------------------------------------------------------------

struct Interrupt {
  enum : int { enabled_bit = 1, off = 2, on = 4, on_next = 8 };

  // Joints 0..2 are cylinder, hip, knee; valves of a joint in the order of Duties.
  struct Joint {
    std::array<short, 4> duty{};
    std::array<int, 4> state{off, off, off, off};
    short cycle_time = 0, enabled = 0, desired_angle = 0;
    bool open_loop = false;          // the lines that the listing has as comments:
    std::array<short, 4> forward{};  // fiducyc = ffiducyc, ...
    int pot = 0, previous_pot = -1;
    float desired_stiffness = 0, stiffness = 0, angle_gain = 0, stiffness_gain = 0,
          velocity_gain = 0;
    long double exact_u_k = 0.5L;
  };

  std::array<Joint, 3> joint;
  std::array<int, 4> gage{};
  std::array<short, 3> pot_offset{404, 1895, 1175};
  short forward_flexor = 0, forward_extensor = 0, free_length = 2416;
  signals::ValveTiming timing;
  std::array<bool, 12> commanded{}, driven{};  // 4 x joint + valve
  int global_cycle_time = -1;

  static short to_short(long double x) {
    return static_cast<short>(x > 16000 ? 16000 : x < -16000 ? -16000 : x);
  }

  // Returns the changes of the ports: pairs of valve and level.
  std::set<std::pair<int, bool>> output() {
    std::set<std::pair<int, bool>> changed;
    for (int v = 0; v < 12; ++v)
      if (driven[v] != commanded[v]) changed.emplace(v, commanded[v]);
    driven = commanded;
    if (++global_cycle_time >= 100) global_cycle_time = 0;
    return changed;
  }

  // Returns the joint whose law ran, or -1.
  int convert(const std::function<int(int channel)>& read) {
    const int channel = global_cycle_time / 2;
    if (channel >= 7 || global_cycle_time % 2 == 0) return -1;
    if (channel < 3) {
      joint[channel].pot = read(channel);
      if (joint[channel].previous_pot < 0) joint[channel].previous_pot = joint[channel].pot;
      if (channel > 0) return -1;
      position_law(joint[0]);
      begin_cycle(joint[0]);
      return 0;
    }
    const int g = channel - 3;
    gage[g] = read(channel);
    if (g % 2 == 0) return -1;
    const int j = (g + 1) / 2;
    two_laws(joint[j], j, gage[g - 1], gage[g]);
    begin_cycle(joint[j]);
    return j;
  }

  void position_law(Joint& j) {
    const short u = to_short(static_cast<long double>(j.angle_gain) * (j.desired_angle - j.pot));
    set_duties(j, forward_flexor + u, forward_flexor - u, forward_extensor - u,
               forward_extensor + u);
  }

  void two_laws(Joint& j, int index, int flexor, int extensor) {
    const short length1 = static_cast<short>(free_length + (j.pot - pot_offset[index]));
    const short length2 = static_cast<short>(free_length - (j.pot - pot_offset[index]));
    const long squared = 10465225L;
    if (length1 != 0 && length2 != 0)
      j.stiffness = static_cast<float>(5.5L * 6.L *
                                       (flexor / (3.L * length2 - squared / length2) +
                                        extensor / (3.L * length1 - squared / length1)));
    const long double gain = j.angle_gain, damping = j.velocity_gain, hundredth = 0.01;
    const short u_theta = index == 1 ? to_short(gain * (j.desired_angle - j.pot) -
                                                damping * ((j.pot - j.previous_pot) / hundredth))
                                     : to_short(gain * (-j.desired_angle + j.pot) -
                                                damping * ((j.previous_pot - j.pot) / hundredth));
    j.previous_pot = j.pot;
    j.exact_u_k = static_cast<long double>(j.stiffness_gain) *
                  (static_cast<long double>(j.desired_stiffness) - j.stiffness);
    const short u_k = to_short(j.exact_u_k);
    set_duties(j, u_k + u_theta, -u_k - u_theta, u_k - u_theta, -u_k + u_theta);
  }

  static void set_duties(Joint& j, int fi, int fe, int ei, int ee) {
    int duty[] = {fi, fe, ei, ee};
    if (j.open_loop) std::copy(j.forward.begin(), j.forward.end(), duty);
    for (int v = 0; v < 4; ++v)
      j.duty[v] = static_cast<short>(duty[v] > 100 ? 100 : duty[v] < 0 ? 0 : duty[v]);
  }

  static void begin_cycle(Joint& j) {
    j.cycle_time = 0;
    for (int& state : j.state) {
      if (state & on_next) state = on;
      state = (state & 0xFE) + j.enabled;
    }
  }

  void valves() {
    for (int i = 0; i < 3; ++i) {
      joint[i].cycle_time++;
      for (int v = 0; v < 4; ++v) look_at(joint[i], v, commanded[4 * i + v]);
    }
  }

  void look_at(Joint& j, int v, bool& command) {
    switch (j.state[v]) {
      case on + enabled_bit:
        if (j.cycle_time >= timing.closing[j.duty[v]])
          command = false, j.state[v] = off + enabled_bit;
        break;
      case off + enabled_bit:
        if (j.cycle_time >= timing.opening[j.duty[v]])
          command = true, j.state[v] = on_next + enabled_bit;
        break;
      case on:
        command = false, j.state[v] = off;
        break;
      default:
        break;
    }
  }
};

// --- the same readings and commands for both ----------------------------------------------------

constexpr std::array<int, 3> thesis_joint = {1, 2, 0};  // of the test leg's hip, knee, cylinder

class Duel {
 public:
  Duel(const JointControllerConfig& config, std::uint32_t seed, bool open_loop = false)
      : controller_(config), random_(seed), open_loop_(open_loop) {
    isr_.timing = config.timing;
    isr_.forward_flexor = static_cast<short>(config.joint[cylinder].feedforward.flexor_inlet);
    isr_.forward_extensor = static_cast<short>(config.joint[cylinder].feedforward.extensor_inlet);
    command_ = rest_command(config);
    hand_down();
  }

  int laws = 0, edges = 0, excluded = 0;

  void run(int periods) {
    for (Tick t = 0; t < 100 * periods && !testing::Test::HasFatalFailure(); ++t) {
      if (t % 100 == 0) {
        new_readings();
        new_command();
      }
      step(t);
    }
  }

 private:
  void step(Tick t) {
    std::set<std::pair<int, bool>> ours;
    for (const signals::Edge& e : controller_.edges(t)) ours.emplace(e.valve.index, e.open);
    std::set<std::pair<int, bool>> theirs;
    for (const auto& [valve, open] : isr_.output()) theirs.emplace(our_valve(valve), open);
    ASSERT_EQ(ours, theirs) << "tick " << t;
    edges += static_cast<int>(ours.size());

    if (const signals::Conversion* c = controller_.due(t))
      controller_.take(
          *c, {static_cast<std::uint16_t>(reading_[c->channel.index]), signals::Status::ok}, t);
    const int law = isr_.convert([&](int channel) { return reading_[channel]; });
    if (law >= 0) compare(law, t);
    isr_.valves();
  }

  void compare(int law, Tick t) {
    ++laws;
    const std::size_t j = law == 0 ? cylinder : law == 1 ? hip : knee;
    const Duties& d = controller_.state().joint[j].duties;
    const std::array<short, 4> ours = {
        static_cast<short>(d.flexor_inlet), static_cast<short>(d.flexor_exhaust),
        static_cast<short>(d.extensor_inlet), static_cast<short>(d.extensor_exhaust)};
    ASSERT_EQ(controller_.state().joint[j].law_at, t);
    Interrupt::Joint& theirs = isr_.joint[law];
    if (ours == theirs.duty) return;
    // The stiffness is a float on both sides, but is rounded differently.
    ASSERT_LT(std::abs(theirs.exact_u_k - std::round(theirs.exact_u_k)), 1e-3L)
        << "tick " << t << " joint " << j;
    theirs.duty = ours;
    ++excluded;
  }

  static int our_valve(int thesis_valve) {
    for (int j = 0; j < 3; ++j)
      if (thesis_joint[j] == thesis_valve / 4) return 4 * j + thesis_valve % 4;
    return -1;
  }

  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  // Half of the readings are near the leg's usual ones, the others anywhere, including the ends.
  void new_readings() {
    const std::array<int, 7> middle = {404, 1895, 1175, 1500, 1500, 1500, 1500};
    for (std::size_t i = 0; i < 7; ++i)
      reading_[i] = below(2)         ? std::min(4095, std::max(0, middle[i] + below(600) - 300))
                    : below(20) == 0 ? 4095 * below(2)
                                     : below(4096);
  }

  void new_command() {
    static constexpr std::array angle_gains = {0.035f, 0.12f, 0.9f, 0.005f, 0.05f, 0.3f};
    static constexpr std::array stiffness_gains = {6.5f, 5.0f, 0.7f, 3.3f};
    static constexpr std::array velocity_gains = {0.0f, 0.0f, 0.001f, 0.0035f, 0.01f};
    for (JointCommand& c : command_.joint) {
      if (below(3) == 0) c.angle = below(4096);
      if (below(4) == 0) c.stiffness = static_cast<float>(below(8000)) / 100.0f;
      if (below(10) == 0) c.enabled = !c.enabled;
      if (below(5) == 0)
        c.gains = {angle_gains[below(6)], stiffness_gains[below(4)], velocity_gains[below(5)]};
      if (below(20) == 0) c.gains.angle = static_cast<float>(below(1'000'000)) * 1e-6f;
      if (open_loop_) new_duties(c);
    }
    hand_down();
  }

  // Changes duties at random; at most one of a muscle's valves opens, as the code requires of its
  // user.
  void new_duties(JointCommand& c) {
    if (below(4) == 0) c.open_loop = !c.open_loop;
    const auto duty = [&] { return below(121) - 10; };
    if (below(2) == 0) c.duties = {duty(), 0, 0, duty()};
    if (below(2) == 0) c.duties = {0, duty(), duty(), 0};
  }

  void hand_down() {
    controller_.command(command_);
    for (int j = 0; j < 3; ++j) {
      const JointCommand& c = command_.joint[j];
      Interrupt::Joint& theirs = isr_.joint[thesis_joint[j]];
      theirs.enabled = c.enabled;
      theirs.open_loop = c.open_loop;
      const auto short_of = [](std::int32_t duty) { return static_cast<short>(duty); };
      theirs.forward = {short_of(c.duties.flexor_inlet), short_of(c.duties.flexor_exhaust),
                        short_of(c.duties.extensor_inlet), short_of(c.duties.extensor_exhaust)};
      theirs.desired_angle = static_cast<short>(c.angle);
      theirs.desired_stiffness = c.stiffness;
      theirs.angle_gain = c.gains.angle;
      theirs.stiffness_gain = c.gains.stiffness;
      theirs.velocity_gain = j == cylinder ? 0.0f : c.gains.velocity;
    }
  }

  JointController controller_;
  Interrupt isr_;
  Command command_;
  std::array<int, 7> reading_{};
  std::mt19937 random_;
  bool open_loop_;
};

// --- the tests ----------------------------------------------------------------------------------

JointControllerConfig as_printed() {
  JointControllerConfig config = test_leg();
  for (JointConfig& joint : config.joint) joint.pole_clamp = -10'000;  // the code has no clamp
  return config;
}

void expect_same(const JointControllerConfig& config, std::uint32_t seed, bool open_loop = false) {
  constexpr int periods = 3000;
  Duel duel(config, seed, open_loop);
  duel.run(periods);
  EXPECT_EQ(duel.laws, 3 * periods);
  EXPECT_GT(duel.edges, periods);
  EXPECT_LT(duel.excluded, duel.laws / 100);
  testing::Test::RecordProperty("excluded", duel.excluded);
}

TEST(Appendix, IdentityTiming) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) expect_same(as_printed(), seed);
}

TEST(Appendix, CompensatedTiming) {
  JointControllerConfig config = as_printed();
  config.timing = signals::compensated_timing(5, 12);
  expect_same(config, 11);
  config.timing = signals::compensated_timing(40, 10);
  expect_same(config, 12);
}

// Includes tables that close and open again within a period, or open at duty 0.
TEST(Appendix, AnyTiming) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint16_t> ticks(0, 101);
  JointControllerConfig config = as_printed();
  for (std::uint32_t seed = 21; seed <= 24; ++seed) {
    for (std::uint16_t& t : config.timing.closing) t = ticks(random);
    for (std::uint16_t& t : config.timing.opening) t = ticks(random);
    expect_same(config, seed);
  }
}

TEST(Appendix, CylinderWithFeedforward) {
  JointControllerConfig config = as_printed();
  config.joint[cylinder].feedforward = {55, 55, 45, 45};
  expect_same(config, 31);
}

// Tests the blocks that are comments in appendix B: duties from outside, of the cylinder too.
TEST(Appendix, OpenLoopDutiesOfAllJoints) {
  JointControllerConfig config = as_printed();
  config.joint[cylinder].feedforward = {55, 55, 45, 45};
  for (std::uint32_t seed = 41; seed <= 43; ++seed) expect_same(config, seed, true);
}

}  // namespace
}  // namespace sinew::control::appendix_test
