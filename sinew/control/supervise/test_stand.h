// control/supervise/test_stand.h - a supervised leg whose readings a test can falsify.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "sinew/control/supervise/supervisor.h"
#include "sinew/control/supervise/test_fuzz.h"

namespace sinew::control {

using signals::Status;
using signals::Tick;

inline constexpr std::uint8_t hip_angle = 1, hip_tension = 3;

// Limits of a leg whose potentiometers read 100 to 4000 and change by at most 50 counts per scan.
inline SuperviseConfig limits() {
  SuperviseConfig out;
  for (const std::uint8_t channel : {0, 1, 2}) {
    out.sensor[channel] = {.low = 100, .high = 4000, .max_step = 50};
    out.sensor[channel].joint = channel == 0 ? cylinder : channel == 1 ? hip : knee;
  }
  for (const std::uint8_t channel : {3, 4, 5, 6}) {
    out.sensor[channel].joint = channel < 5 ? hip : knee;
    out.sensor[channel].rests_at_ends = true;
    out.sensor[channel].of_flexor = channel % 2 == 1;
    out.sensor[channel].of_extensor = channel % 2 == 0;
  }
  return out;
}

// A supervised leg at its rest angles. `replace_reading` changes its readings.
struct Stand {
  explicit Stand(const SuperviseConfig& config = limits(),
                 const JointControllerConfig& leg = test_leg())
      : supervisor(leg, config), valves(leg) {
    EXPECT_EQ(problem(config), nullptr);
    command = rest_command(leg);
    for (JointCommand& c : command.joint) {
      c.enabled = c.open_loop = true;  // valves open independent of the readings
      c.duties = {30, 0, 0, 30};
    }
  }

  // Runs one tick and returns the loop's next one.
  Tick visit(Tick t) {
    if (supervisor.starts_period(t)) supervisor.command(command);
    for (const signals::Edge& e : supervisor.edges(t)) {
      valves.drive(e);
      EXPECT_FALSE(valves.both_open()) << t;
    }
    if (const signals::Conversion* c = supervisor.due(t)) {
      const int scan = static_cast<int>(t / 100);
      signals::Reading r{rest(c->channel.index), Status::ok};
      if (replace_reading) r = replace_reading(c->channel.index, scan, r);
      supervisor.take(*c, r, t);
    }
    if (!vented && supervisor.state().phase == Phase::venting && valves.all_exhausts_open() &&
        !valves.an_inlet_open())
      vented = t;
    return supervisor.next_event(t);
  }
  void run(int periods) {
    for (const Tick end = now + 100 * periods; now < end;) now = visit(now);
  }

  static std::uint16_t rest(std::uint8_t channel) {
    constexpr std::uint16_t counts[] = {404, 1895, 1175, 800, 800, 800, 800};
    return counts[channel];
  }
  // Fills the flexors of hip and knee all the time.
  void fill() {
    for (JointCommand& c : command.joint) c.duties = {100, 0, 0, 100};
  }
  const Supervised& supervised() const { return supervisor.supervised(); }
  const Trip& trip() const { return supervised().trip; }

  Supervisor supervisor;
  ValveWatch valves;
  Command command;
  std::function<signals::Reading(std::uint8_t channel, int scan, signals::Reading)> replace_reading;
  Tick now = 0;
  std::optional<Tick> vented;  // first tick with all exhausts open and all inlets shut after a trip
};

// Returns a function that falsifies one channel from a scan on, for a number of scans.
inline auto constant_reading(std::uint8_t channel, std::uint16_t counts, int from,
                             int scans = 1'000'000) {
  return [=](std::uint8_t c, int scan, signals::Reading r) {
    if (c == channel && scan >= from && scan < from + scans) r.counts = counts;
    return r;
  };
}

}  // namespace sinew::control
