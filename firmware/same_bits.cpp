// firmware/same_bits.cpp - self-test: runs the joint controller over seeded random periods, alone
// and supervised, and the wire over random messages. It prints a hash of all results: duties,
// edges, stiffnesses, counters and frames, bit for bit. firmware/same-bits.sh compares
// microcontroller and host.
#include <bit>
#include <cstddef>
#include <cstdint>

#include "firmware/same_bits.h"
#if !__STDC_HOSTED__
#include "firmware/board.h"
#include "firmware/semihosting.h"
#endif
#include "sinew/control/joint/joint_controller.h"
#include "sinew/control/joint/test_leg.h"
#include "sinew/control/supervise/supervisor.h"
#include "sinew/signals/timing.h"

namespace sinew::firmware {

#if __STDC_HOSTED__
void print(const char* text);  // below
#endif

namespace {

using control::Command;
using control::JointController;
using control::JointControllerConfig;
using control::Truncation;
using signals::Tick;

constexpr Tick periods = 5000;  // per run

void random_command(Random& random, Command& command, bool timed = false) {
  for (std::size_t j = 0; j < 3; ++j) {
    control::JointCommand& c = command.joint[j];
    c.angle = static_cast<std::int32_t>(random.below(4096));
    c.stiffness = 60.0f * random.unit();
    c.gains = {0.3f * random.unit(), 8.0f * random.unit(), 0.002f * random.unit()};
    c.enabled = random.below(8) != 0;
    c.open_loop = random.below(16) == 0;
    c.duties.flexor_inlet = static_cast<std::int32_t>(random.below(120));
    c.duties.extensor_exhaust = static_cast<std::int32_t>(random.below(120));
    c.timed = timed && random.below(8) != 0;
    if (!c.timed) continue;
    const auto tick = [&] { return static_cast<std::uint16_t>(random.below(101)); };
    c.openings = {.inlet = {tick(), tick()}, .exhaust = {tick(), tick()}};
  }
}

// Runs one random run; some readings are late.
void run(const JointControllerConfig& config, std::uint32_t seed, Hash& hash) {
  JointController controller(config);
  Random random(seed);
  Command command = control::rest_command(config);
  for (Tick t = 0; t < periods * config.period; t = controller.next_event(t)) {
    if (controller.starts_period(t)) {
      random_command(random, command, is_timed(config.joint[control::hip].kind));
      controller.command(command);
    }
    for (const signals::Edge& e : controller.edges(t)) {
      hash.add(static_cast<std::uint32_t>(e.at));
      hash.add(2u * e.valve.index + e.open);
      hash.add(static_cast<std::uint32_t>(e.level));
    }
    if (const signals::Conversion* c = controller.due(t)) {
      const auto status = random.below(50) == 0 ? signals::Status::late : signals::Status::ok;
      controller.take(*c, {static_cast<std::uint16_t>(random.below(4096)), status}, t);
    }
    for (std::size_t j = 0; j < config.joints; ++j) {
      const control::JointState& s = controller.state().joint[j];
      hash.add(s.stiffness);
      hash.add(s.stiffness_output);
      hash.add(s.angle_output);
      hash.add(s.velocity);
      for (const std::int32_t d : {s.duties.flexor_inlet, s.duties.flexor_exhaust,
                                   s.duties.extensor_inlet, s.duties.extensor_exhaust})
        hash.add(d);
    }
  }
}

// Runs a supervised controller with skipped ticks, impossible commands and false readings.
void run_supervised(std::uint32_t seed, Hash& hash) {
  control::SuperviseConfig limits;
  limits.vent_commands = 1000;  // else the run would end early
  limits.bad_readings = seed % 2 ? 3 : 1000;
  limits.gap_vent = seed % 2 ? 100 : 1'000'000;
  for (std::size_t i = 0; i < 7; ++i)
    limits.sensor[i] = {.low = 100, .high = 4000, .max_step = 2500, .joint = 0};
  control::Supervisor controller(control::test_leg(), limits);
  Random random(seed);
  Command command = control::rest_command(controller.config());
  for (Tick t = 0; t < periods * controller.config().period;) {
    if (controller.starts_period(t)) {
      random_command(random, command);
      if (random.below(4) == 0)
        command.joint[1].stiffness = random.below(2) ? 2e6f : std::bit_cast<float>(0x7fc00000u);
      controller.command(command);
    }
    for (const signals::Edge& e : controller.edges(t)) {
      hash.add(static_cast<std::uint32_t>(e.at));
      hash.add(2u * e.valve.index + e.open);
    }
    if (const signals::Conversion* c = controller.due(t))
      controller.take(*c, {static_cast<std::uint16_t>(random.below(4096)), signals::Status::ok}, t);
    const control::Supervised& s = controller.supervised();
    for (const std::uint32_t n : {s.rejected, s.rejected_commands, s.gaps, s.worst_gap, s.holds,
                                  static_cast<std::uint32_t>(s.trip.at)})
      hash.add(n);
    t = controller.next_event(t);
    if (random.below(64) == 0) t += 1 + random.below(random.below(64) == 0 ? 200 : 20);
  }
}

void print_hex(std::uint64_t x) {
  char text[18];
  for (int i = 0; i < 16; ++i) text[i] = "0123456789abcdef"[x >> (60 - 4 * i) & 15];
  text[16] = '\n';
  text[17] = '\0';
  print(text);
}

// Returns a configuration with one velocity estimator per joint (hip, knee), and stiffness from
// pressure.
JointControllerConfig other_sensors(control::Estimator hip, control::Estimator knee) {
  JointControllerConfig config = control::test_leg();
  const auto set = [&](control::JointConfig& joint, control::Estimator estimator) {
    joint.velocity = {.estimator = estimator,
                      .samples = 5,
                      .weight = control::line_weights(5, 100.0f),
                      .decay = 0.93f,
                      .speed_gain = 0.11f,
                      .margin = 150.0f,
                      .limit = 3000.0f,
                      .travel = 0.0096f,
                      .travel_gain = 0.0006f,
                      .angle_share = 0.31f,
                      .speed_share = 7.7f,
                      .channel = {0},
                      .at_rest = 2048,
                      .scale = 1.7f};
    joint.stiffness_source = control::StiffnessSource::pressure;
    for (control::MuscleConfig* m : {&joint.flexor, &joint.extensor}) {
      m->pressure = m->tension;
      m->pressure_factor = 3e-6f;
      m->effectiveness = {0.997f, 1e-5f, -3e-9f};
    }
  };
  set(config.joint[control::hip], hip);
  set(config.joint[control::knee], knee);
  config.dead_band = 3;
  return config;
}

// Runs 3-way valves at the hip with regulators at the knee, a muscle over both joints, and
// valves that a host times.
void other_machines(Hash& hash) {
  using enum control::Estimator;
  JointControllerConfig config = other_sensors(weighted_average, kalman);
  run(config, 3, hash);
  control::JointConfig &hip = config.joint[control::hip], &knee = config.joint[control::knee];
  knee.extensor.inlet = hip.extensor.inlet;
  knee.extensor.exhaust = hip.extensor.exhaust;
  knee.extensor.share = 0.3f, hip.extensor.share = 0.7f;
  knee.extensor.other_travel = -0.43f;
  run(config, 4, hash);
  config = other_sensors(bounded_observer, sensor);
  config.joint[control::hip].kind = control::JointKind::three_way;
  config.joint[control::knee].kind = control::JointKind::regulated;
  config.joint[control::knee].regulator = {0.003f, 0.1f};
  run(config, 5, hash);
  for (const auto kind : {control::JointKind::timed, control::JointKind::timed_three_way}) {
    config.joint[control::hip].kind = kind;
    config.joint[control::hip].extensor.present = false;
    run(config, 6, hash);
  }
}

}  // namespace

void same_bits() {
  Hash hash;
  JointControllerConfig config = control::test_leg();
  config.joint[control::cylinder].feedforward = {55, 55, 45, 45};
  for (const Truncation mode : {Truncation::each_law, Truncation::sum, Truncation::none}) {
    config.truncation = mode;
    config.timing = signals::identity_timing();
    run(config, 1, hash);
    config.timing = signals::compensated_timing(5, 12);
    config.joint[control::knee].lengths_swapped ^= true;
    config.joint[control::hip].pole_clamp = -10'000;  // reaches the pole as well
    run(config, 2, hash);
  }
  other_machines(hash);
  for (std::uint32_t seed = 1; seed <= 6; ++seed) run_supervised(seed, hash);
  run_link(7, hash);
  print_hex(hash.value());
}

}  // namespace sinew::firmware

#if __STDC_HOSTED__
#include <cstdio>

void sinew::firmware::print(const char* text) { std::fputs(text, stdout); }

int main() { sinew::firmware::same_bits(); }
#else
void sinew::firmware::run() {
  same_bits();
  quit(0);
}
#endif
