#include "sinew/control/link/telemetry.h"

#include "sinew/control/link/bytes.h"

namespace sinew::link {
namespace {

// These detect added fields, which have to be listed in reports.h.
static_assert(members<control::ControllerState>() == 9 && members<control::JointState>() == 10);
static_assert(members<control::Supervised>() == 8 && members<control::SensorStatistics>() == 4);
static_assert(members<control::Trip>() == 8 && members<control::Levels>() == 2);

// A part after state and readings.
struct Place {
  Type type = Type::counters;
  std::size_t first = 0, count = 0;
};

std::size_t least(std::size_t a, std::size_t b) noexcept { return a < b ? a : b; }

Place place_of(std::size_t part, std::size_t joints, std::size_t channels) noexcept {
  const std::size_t of_channels = messages_for(channels, counters_in_message);
  std::size_t first = (part - 2) * counters_in_message;
  if (part - 2 < of_channels)
    return {Type::counters, first, least(channels - first, counters_in_message)};
  first = (part - 2 - of_channels) * joints_in_message;
  return {Type::joints, first, least(joints - first, joints_in_message)};
}

StateView state_of(const Telemetry& t, const Part& part) noexcept {
  return {.of = part,
          .state = t.state,
          .fault = t.fault,
          .joints = t.joints,
          .channels = t.channels,
          .controller = t.controller,
          .supervised = t.supervised,
          .link = t.link};
}

Readings readings_of(const Telemetry& t, const Part& part) noexcept {
  Readings out{.of = part, .count = t.channels};
  for (std::size_t i = 0; i < t.channels; ++i)
    out.channel[i] = {t.controller.reading[i], t.supervised.sensor[i].counts};
  return out;
}

Counters counters_of(const Telemetry& t, const Part& part, const Place& place) noexcept {
  Counters out{.of = part,
               .first = static_cast<std::uint8_t>(place.first),
               .count = static_cast<std::uint8_t>(place.count)};
  for (std::size_t i = 0; i < place.count; ++i)
    out.sensor[i] = t.supervised.sensor[place.first + i];
  return out;
}

Joints joints_of(const Telemetry& t, const Part& part, const Place& place) noexcept {
  Joints out{.of = part,
             .first = static_cast<std::uint8_t>(place.first),
             .count = static_cast<std::uint8_t>(place.count)};
  for (std::size_t i = 0; i < place.count; ++i) out.joint[i] = t.controller.joint[place.first + i];
  return out;
}

}  // namespace

std::uint8_t channels_of(const control::JointControllerConfig& config) noexcept {
  std::uint8_t out = 0;
  for (std::size_t i = 0; i < config.conversions; ++i) {
    const std::uint8_t index = config.conversion[i].channel.index;
    if (index >= out) out = static_cast<std::uint8_t>(index + 1);
  }
  return out;
}

TelemetryMessage part_of(const Telemetry& t, std::uint8_t part) noexcept {
  if (t.joints > control::max_joints || t.channels > control::max_channels) return {};
  const std::size_t parts = parts_of(t.joints, t.channels);
  if (part >= parts) return {};
  const Part of{t.tick, part, static_cast<std::uint8_t>(parts)};
  if (part == 0) return {Type::state, body_of(state_of(t, of))};
  if (part == 1) return {Type::readings, body_of(readings_of(t, of))};
  const Place place = place_of(part, t.joints, t.channels);
  if (place.type == Type::counters) return {Type::counters, body_of(counters_of(t, of, place))};
  return {Type::joints, body_of(joints_of(t, of, place))};
}

const Telemetry* TelemetryJoiner::take(std::uint8_t type,
                                       std::span<const std::uint8_t> body) noexcept {
  const bool is_state = type == static_cast<std::uint8_t>(Type::state);
  const bool is_part = is_state || type == static_cast<std::uint8_t>(Type::readings) ||
                       type == static_cast<std::uint8_t>(Type::counters) ||
                       type == static_cast<std::uint8_t>(Type::joints);
  if (!is_part) return nullptr;
  if (!(is_state ? begin(body) : next_ > 0 && add(type, body))) {
    next_ = 0;
    return nullptr;
  }
  if (++next_ < parts_of(now_.joints, now_.channels)) return nullptr;
  next_ = 0;
  count_lost();
  return &now_;
}

Readings readings_alone(const Telemetry& telemetry) noexcept {
  return readings_of(telemetry, {.tick = telemetry.tick, .part = 0, .parts = 1});
}

bool TelemetryJoiner::begin(std::span<const std::uint8_t> body) noexcept {
  State state;
  next_ = 0;
  if (read(body, state) != Code::done || state.of.part != 0 ||
      state.of.parts != parts_of(state.joints, state.channels))
    return false;
  now_ = {.tick = state.of.tick,
          .state = state.state,
          .fault = state.fault,
          .joints = state.joints,
          .channels = state.channels,
          .controller = state.controller,
          .supervised = state.supervised,
          .link = state.link};
  return true;
}

bool TelemetryJoiner::add(std::uint8_t type, std::span<const std::uint8_t> body) noexcept {
  const Type expected =
      next_ == 1 ? Type::readings : place_of(next_, now_.joints, now_.channels).type;
  if (type != static_cast<std::uint8_t>(expected)) return false;
  if (expected == Type::readings) return add_readings(body);
  return expected == Type::counters ? add_counters(body) : add_joints(body);
}

bool TelemetryJoiner::continues(const Part& part) const noexcept {
  return part.tick == now_.tick && part.part == next_ &&
         part.parts == parts_of(now_.joints, now_.channels);
}

bool TelemetryJoiner::add_readings(std::span<const std::uint8_t> body) noexcept {
  Readings m;
  if (read(body, m) != Code::done || !continues(m.of) || m.count != now_.channels) return false;
  for (std::size_t i = 0; i < m.count; ++i) {
    now_.controller.reading[i] = m.channel[i].reading;
    now_.supervised.sensor[i].counts = m.channel[i].counts;
  }
  return true;
}

bool TelemetryJoiner::add_counters(std::span<const std::uint8_t> body) noexcept {
  Counters m;
  const Place place = place_of(next_, now_.joints, now_.channels);
  if (read(body, m) != Code::done || !continues(m.of) || m.first != place.first ||
      m.count != place.count)
    return false;
  for (std::size_t i = 0; i < m.count; ++i) {
    control::SensorStatistics& to = now_.supervised.sensor[m.first + i];
    const std::uint16_t counts = to.counts;  // came with the readings
    to = m.sensor[i];
    to.counts = counts;
  }
  return true;
}

bool TelemetryJoiner::add_joints(std::span<const std::uint8_t> body) noexcept {
  Joints m;
  const Place place = place_of(next_, now_.joints, now_.channels);
  if (read(body, m) != Code::done || !continues(m.of) || m.first != place.first ||
      m.count != place.count)
    return false;
  for (std::size_t i = 0; i < m.count; ++i) now_.controller.joint[m.first + i] = m.joint[i];
  return true;
}

void TelemetryJoiner::count_lost() noexcept {
  const signals::Tick since = now_.tick - last_;
  constexpr signals::Tick most = 0xffffffff;  // 64-bit quotients are a call on a small machine
  if (last_ >= 0 && since > period_ && since <= most)
    lost_ += static_cast<std::uint32_t>(since) / period_ - 1;
  last_ = now_.tick;
}

}  // namespace sinew::link
