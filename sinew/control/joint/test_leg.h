// control/joint/test_leg.h - configuration of the leg's joint controller with the numbers of
// appendix B, for tests and the firmware's self-test, which have no files to read. The leg itself
// is described in robots/leg.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/config.h"

namespace sinew::control {

enum TestLegJoint : std::size_t { hip, knee, cylinder };

// Channels 0..6 are scanned in this order: position of cylinder, hip and knee, then the tensions of
// hip flexor and extensor, knee flexor and extensor. Valves are 4 x joint + (0..3 in the order of
// Duties).
constexpr JointControllerConfig test_leg() noexcept {
  JointControllerConfig leg;
  leg.joints = 3;
  leg.conversions = 7;
  for (std::uint8_t i = 0; i < 7; ++i)
    leg.conversion[i] = {
        {i}, static_cast<std::uint16_t>(2 * i), static_cast<std::uint16_t>(2 * i + 1)};

  for (std::uint8_t j = 0; j < 3; ++j) {
    const auto valve = [j](int i) { return signals::Valve{static_cast<std::uint8_t>(4 * j + i)}; };
    leg.joint[j].flexor.inlet = valve(0);
    leg.joint[j].flexor.exhaust = valve(1);
    leg.joint[j].extensor.inlet = valve(2);
    leg.joint[j].extensor.exhaust = valve(3);
  }

  JointConfig& h = leg.joint[hip];
  h.angle = {1};
  h.flexor.tension = {3};
  h.extensor.tension = {4};
  h.law_tick = 9;
  h.angle_at_rest = 1895;
  h.gains = {.angle = 0.035f, .stiffness = 6.5f, .velocity = 0.0f};

  JointConfig& k = leg.joint[knee];
  k.angle = {2};
  k.flexor.tension = {5};
  k.extensor.tension = {6};
  k.law_tick = 13;
  k.angle_at_rest = 1175;
  k.flexion = -1;
  k.lengths_swapped = true;
  k.gains = {.angle = 0.12f, .stiffness = 5.0f, .velocity = 0.0f};

  JointConfig& c = leg.joint[cylinder];
  c.kind = JointKind::cylinder;
  c.angle = {0};
  c.law_tick = 1;
  c.angle_at_rest = 404;
  c.gains.angle = 0.9f;
  return leg;
}

}  // namespace sinew::control
