#include "sinew/control/link/baud.h"

#include "sinew/control/link/telemetry.h"

namespace sinew::link {
namespace {

template <class M>
std::uint32_t frame_size(const M& message) noexcept {
  Sizer io;
  fields(io, message);
  return static_cast<std::uint32_t>(min_frame + io.size());
}

// Returns the size of frames with up to `most` items each; `of(n)` is a message with n items.
template <class Of>
std::uint32_t frames_size(std::size_t things, std::size_t most, Of of) noexcept {
  std::uint32_t out = 0;
  for (; things > 0; things -= things < most ? things : most)
    out += frame_size(of(static_cast<std::uint8_t>(things < most ? things : most)));
  return out;
}

std::uint32_t telemetry_size(std::size_t joints, std::size_t channels) noexcept {
  return frame_size(State{}) + frame_size(Readings{.count = static_cast<std::uint8_t>(channels)}) +
         frames_size(channels, counters_in_message,
                     [](std::uint8_t n) { return Counters{.count = n}; }) +
         frames_size(joints, joints_in_message, [](std::uint8_t n) { return Joints{.count = n}; });
}

std::uint32_t edges_size(const control::JointControllerConfig& config) noexcept {
  std::size_t valves = 0;
  for (std::size_t j = 0; j < config.joints; ++j)
    for (const control::MuscleConfig* m : {&config.joint[j].flexor, &config.joint[j].extensor})
      if (m->present) valves += 2;
  return frames_size(4 * valves, max_edges, [](std::uint8_t n) { return Edges{.count = n}; });
}

}  // namespace

LineLoad load_of(const control::JointControllerConfig& config, bool edges_wanted) noexcept {
  LineLoad out;
  out.to_host = telemetry_size(config.joints, channels_of(config)) +
                (edges_wanted ? edges_size(config) : 0) + frame_size(Reply{}) + frame_size(Event{});
  out.to_board = frame_size(CommandFor{.joints = static_cast<std::uint8_t>(config.joints)}) +
                 frame_size(SetGains{});
  return out;
}

// bytes x 10 bits <= 90 % x baud x period x 100 us, without a division
bool carries(std::uint32_t baud, const LineLoad& load, std::uint16_t period) noexcept {
  const std::uint32_t most = load.to_host > load.to_board ? load.to_host : load.to_board;
  constexpr std::uint64_t ticks_per_second = 10'000;
  return std::uint64_t{most} * 10 * ticks_per_second * 10 <= std::uint64_t{baud} * period * 9;
}

std::uint32_t choose_baud(const control::JointControllerConfig& config, bool edges_wanted,
                          std::span<const std::uint32_t> choices) noexcept {
  const LineLoad load = load_of(config, edges_wanted);
  std::uint32_t out = 0;
  for (const std::uint32_t baud : choices)
    if (carries(baud, load, config.period) && (out == 0 || baud < out)) out = baud;
  return out;
}

}  // namespace sinew::link
