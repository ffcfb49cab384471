// control/supervise/test_fuzz.h - runs of controllers with skipped ticks, false readings and
// impossible commands, and conditions that must always hold: for the folder's tests and the guard.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "sinew/control/joint/joint_controller.h"
#include "sinew/control/joint/test_leg.h"
#include "sinew/control/supervise/supervisor.h"

namespace sinew::control {

// ValveWatch tracks the state of a machine's valves from the edges that are driven.
class ValveWatch {
 public:
  explicit ValveWatch(const JointControllerConfig& config) : config_(config) {
    inverted_exhausts();
  }

  void drive(const signals::Edge& e) { open_[e.valve.index] = e.open != inverted_[e.valve.index]; }

  // Returns whether inlet and exhaust of a muscle are both open; a cylinder's valves may be (B.1).
  bool both_open() const {
    for (std::size_t j = 0; j < config_.joints; ++j) {
      const JointConfig& joint = config_.joint[j];
      if (joint.kind != JointKind::antagonist) continue;
      for (const MuscleConfig* m : {&joint.flexor, &joint.extensor})
        if (m->present && open_[m->inlet.index] && open_[m->exhaust.index]) return true;
    }
    return false;
  }

  // Return whether a valve of that kind is open at any muscle or chamber.
  bool an_inlet_open() const { return any(&MuscleConfig::inlet); }
  bool an_exhaust_open() const { return any(&MuscleConfig::exhaust); }
  bool all_exhausts_open() const {
    bool all = true;
    each(&MuscleConfig::exhaust, [&](bool open) { all = all && open; });
    return all;
  }
  bool is_open(int valve) const { return open_[static_cast<std::size_t>(valve)]; }

 private:
  template <class Use>
  void each(signals::Valve MuscleConfig::*which, Use use) const {
    for (std::size_t j = 0; j < config_.joints; ++j)
      for (const MuscleConfig* m : {&config_.joint[j].flexor, &config_.joint[j].extensor})
        if (m->present) use(open_[(m->*which).index]);
  }
  bool any(signals::Valve MuscleConfig::*which) const {
    bool some = false;
    each(which, [&](bool open) { some = some || open; });
    return some;
  }
  void inverted_exhausts() {
    for (std::size_t j = 0; j < config_.joints; ++j)
      for (const MuscleConfig* m : {&config_.joint[j].flexor, &config_.joint[j].extensor})
        inverted_[m->exhaust.index] = m->exhaust_inverted;
  }

  JointControllerConfig config_;
  std::array<bool, 256> open_{}, inverted_{};
};

// Returns a random command, which may be impossible.
inline Command any_command(std::mt19937& random, const JointControllerConfig& config,
                           bool impossible) {
  std::uniform_real_distribution<float> unit(0, 1);
  const auto below = [&](unsigned n) { return static_cast<std::int32_t>(random() % n); };
  Command command = rest_command(config);
  for (JointCommand& c : command.joint) {
    c.angle = below(4096);
    c.stiffness = 60 * unit(random);
    c.gains = {0.3f * unit(random), 8 * unit(random), 0.002f * unit(random)};
    c.enabled = below(16) != 0;
    c.open_loop = below(8) == 0;
    c.duties = {below(101), below(101), below(101), below(101)};
  }
  if (!impossible) return command;
  constexpr float wrong[] = {std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(), 1e30f, -1e30f};
  JointCommand& c = command.joint[random() % config.joints];
  const float value = wrong[random() % 4];
  switch (random() % 5) {
    case 0:
      c.stiffness = value;
      break;
    case 1:
      c.gains.angle = value;
      break;
    case 2:
      c.gains.velocity = value;
      break;
    case 3:
      c.angle = random() % 2 ? std::numeric_limits<std::int32_t>::min() : 40'000;
      break;
    default:
      c.open_loop = true;
      c.duties.extensor_exhaust = random() % 2 ? -1 : 101;
  }
  return command;
}

// Returns a random delay: mostly 1 to 3 ticks, rarely up to 20 ms.
inline signals::Tick any_gap(std::mt19937& random) {
  return 1 + static_cast<signals::Tick>(random() % (random() % 8 == 0 ? 200 : 3));
}

struct FuzzOptions {
  unsigned gap_every = 0;         // events, on average; 0: no skipped ticks
  unsigned impossible_every = 0;  // commands
  unsigned late_every = 0;        // readings
  unsigned counts = 4096;         // upper bound of readings; 4095 is the converter's last
};

struct FuzzCount {
  std::int64_t periods = 0, both_open = 0, not_finite = 0, edges = 0, gaps = 0;
};

inline bool finite(const JointState& s) {
  return std::isfinite(s.stiffness) && std::isfinite(s.stiffness_output) &&
         std::isfinite(s.angle_output) && std::isfinite(s.velocity);
}

// Runs a JointController or a Supervisor with random readings.
template <class Controller>
void fuzz(Controller& controller, int periods, const FuzzOptions& options, std::mt19937& random,
          FuzzCount& count) {
  const JointControllerConfig& config = controller.config();
  ValveWatch valves(config);
  const auto one_in = [&](unsigned n) { return n > 0 && random() % n == 0; };
  const signals::Tick end = static_cast<signals::Tick>(periods) * config.period;
  for (signals::Tick t = 0; t < end && controller.state().phase != Phase::off;) {
    if (controller.starts_period(t)) {
      ++count.periods;
      controller.command(any_command(random, config, one_in(options.impossible_every)));
    }
    for (const signals::Edge& e : controller.edges(t)) {
      ++count.edges;
      valves.drive(e);
      count.both_open += valves.both_open();
    }
    if (const signals::Conversion* c = controller.due(t)) {
      const auto status = one_in(options.late_every) ? signals::Status::late : signals::Status::ok;
      controller.take(*c, {static_cast<std::uint16_t>(random() % options.counts), status}, t);
    }
    for (std::size_t j = 0; j < config.joints; ++j)
      count.not_finite += !finite(controller.state().joint[j]);
    t = controller.next_event(t);
    if (one_in(options.gap_every)) {
      ++count.gaps;
      t += any_gap(random);
    }
  }
}

// Returns a leg with random joints, delays and timings.
inline JointControllerConfig any_leg(std::mt19937& random) {
  JointControllerConfig config = test_leg();
  config.joint[cylinder].feedforward = {55, 55, 45, 45};
  if (random() % 2) config.timing = signals::compensated_timing(5, 12);
  config.output_delay = static_cast<std::uint16_t>(random() % 4 ? 1 : 1 + random() % 100);
  config.startup_vent = random() % 2 ? static_cast<std::uint32_t>(random() % 3000) : 0;
  config.truncation = static_cast<Truncation>(random() % 3);
  if (random() % 3 == 0 && config.startup_vent > 0)
    config.joint[hip].flexor.exhaust_inverted = true;
  return config;
}

}  // namespace sinew::control
