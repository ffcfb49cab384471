// control/link/configuration_fields.h - fields of a board's configuration in the order of the wire
// (docs/reference/wire.md).
//
// Fields are listed since the memory layout of a struct depends on the compiler. All joints,
// conversions and sensors up to the maximum are written, so that every configuration has the same
// size. The assertions detect a field that was added to one of these structs: it has to be listed
// here, with a new configuration_layout and an entry in docs/reference/wire.md.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/config.h"
#include "sinew/control/link/bytes.h"
#include "sinew/control/link/messages.h"
#include "sinew/control/supervise/safety.h"

namespace sinew::link {

// Configuration of a board for its machine.
struct Configuration {
  control::JointControllerConfig joint_controller;
  control::SuperviseConfig limits;
  control::SafetyConfig safety;
};

inline constexpr std::uint16_t configuration_layout = 1;

static_assert(members<control::Gains>() == 3 && members<control::Duties>() == 4);

static_assert(members<control::MuscleConfig>() == 16);
template <class Io, Is<control::MuscleConfig> M>
constexpr void fields(Io& io, M& m) noexcept {
  flag(io, m.present);
  io.whole(m.tension.index);
  io.whole(m.inlet.index);
  io.whole(m.exhaust.index);
  flag(io, m.exhaust_inverted);
  io.whole(m.free_length);
  io.whole(m.thread_length_squared);
  io.finite(m.tension_ratio);
  io.whole(m.pressure.index);
  io.whole(m.pressure_at_zero);
  io.finite(m.pressure_factor);
  for (auto& e : m.effectiveness) io.finite(e);
  io.finite(m.valid_from);
  io.finite(m.valid_to);
  io.finite(m.share);
  io.finite(m.other_travel);
}

static_assert(members<control::VelocityConfig>() == 14);
template <class Io, Is<control::VelocityConfig> M>
constexpr void fields(Io& io, M& v) noexcept {
  choice(io, v.estimator, control::Estimator::sensor);
  io.whole(v.samples);
  for (auto& w : v.weight) io.finite(w);
  io.finite(v.decay);
  io.finite(v.speed_gain);
  io.finite(v.margin);
  io.finite(v.limit);
  io.finite(v.travel);
  io.finite(v.travel_gain);
  io.finite(v.angle_share);
  io.finite(v.speed_share);
  io.whole(v.channel.index);
  io.whole(v.at_rest);
  io.finite(v.scale);
}

static_assert(members<control::RegulatorConfig>() == 2);
template <class Io, Is<control::RegulatorConfig> M>
constexpr void fields(Io& io, M& r) noexcept {
  io.finite(r.angle_integral);
  io.finite(r.stiffness_integral);
}

static_assert(members<control::JointConfig>() == 18);
template <class Io, Is<control::JointConfig> M>
constexpr void fields(Io& io, M& j) noexcept {
  flag(io, j.enabled);
  choice(io, j.kind, control::JointKind::timed_three_way);
  io.whole(j.angle.index);
  fields(io, j.flexor);
  fields(io, j.extensor);
  io.whole(j.law_tick);
  io.whole(j.angle_at_rest);
  io.limited(j.flexion, std::int8_t{-1}, std::int8_t{1});
  flag(io, j.lengths_swapped);
  choice(io, j.stiffness_source, control::StiffnessSource::none);
  io.finite(j.stiffness_factor);
  io.finite(j.moment_arm_factor);
  io.whole(j.pole_clamp);
  fields(io, j.velocity);
  fields(io, j.regulator);
  io.whole(j.bias);
  fields(io, j.gains);
  fields(io, j.feedforward);
}

static_assert(members<signals::Conversion>() == 3);
template <class Io, Is<signals::Conversion> M>
constexpr void fields(Io& io, M& c) noexcept {
  io.whole(c.channel.index);
  io.whole(c.start);
  io.whole(c.read);
}

static_assert(members<signals::ValveTiming>() == 2);
template <class Io, Is<signals::ValveTiming> M>
constexpr void fields(Io& io, M& t) noexcept {
  for (auto& ticks : t.closing) io.whole(ticks);
  for (auto& ticks : t.opening) io.whole(ticks);
}

static_assert(members<control::JointControllerConfig>() == 13);
template <class Io, Is<control::JointControllerConfig> M>
constexpr void fields(Io& io, M& c) noexcept {
  count(io, c.joints, control::max_joints);
  for (auto& j : c.joint) fields(io, j);
  count(io, c.conversions, control::max_conversions);
  for (auto& one : c.conversion) fields(io, one);
  io.whole(c.period);
  io.whole(c.output_delay);
  choice(io, c.truncation, control::Truncation::none);
  fields(io, c.timing);
  io.whole(c.dead_band);
  io.whole(c.startup_vent);
  io.whole(c.shutdown_vent);
  io.whole(c.hold_limit);
  flag(io, c.laws_overrun);
}

static_assert(members<control::SensorLimits>() == 8);
template <class Io, Is<control::SensorLimits> M>
constexpr void fields(Io& io, M& s) noexcept {
  io.whole(s.low);
  io.whole(s.high);
  io.whole(s.max_step);
  io.whole(s.frozen_limit);
  io.limited(s.joint, std::int8_t{-1}, std::int8_t{control::max_joints - 1});
  flag(io, s.of_flexor);
  flag(io, s.of_extensor);
  flag(io, s.rests_at_ends);
}

static_assert(members<control::CommandLimits>() == 5);
template <class Io, Is<control::CommandLimits> M>
constexpr void fields(Io& io, M& c) noexcept {
  io.whole(c.low);
  io.whole(c.high);
  io.whole(c.max_step);
  io.finite(c.max_stiffness);
  io.finite(c.max_gain);
}

static_assert(members<control::SuperviseConfig>() == 8);
template <class Io, Is<control::SuperviseConfig> M>
constexpr void fields(Io& io, M& c) noexcept {
  for (auto& s : c.sensor) fields(io, s);
  for (auto& limits : c.command) fields(io, limits);
  io.whole(c.bad_readings);
  io.whole(c.hold_commands);
  io.whole(c.vent_commands);
  io.whole(c.frozen_scans);
  io.whole(c.gap_shut);
  io.whole(c.gap_vent);
}

static_assert(members<control::SafetyConfig>() == 9);
template <class Io, Is<control::SafetyConfig> M>
constexpr void fields(Io& io, M& c) noexcept {
  io.whole(c.host_hold);
  io.whole(c.host_vent);
  io.whole(c.hold_limit);
  io.whole(c.arm_window);
  for (auto& at : c.empty_at) io.whole(at);
  io.whole(c.empty_scans);
  io.whole(c.vent_limit);
  io.whole(c.check_every);
  io.whole(c.refractory);
}

template <class Io, Is<Configuration> M>
constexpr void fields(Io& io, M& c) noexcept {
  std::uint16_t layout = configuration_layout;
  if constexpr (Io::reads)
    io.limited(layout, configuration_layout, configuration_layout);
  else
    io.whole(layout);
  fields(io, c.joint_controller);
  fields(io, c.limits);
  fields(io, c.safety);
}

}  // namespace sinew::link
