#include "sinew/world/driven/driven_muscle.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sinew::plant {

template class World<DrivenLength, air::AirNetwork<driven_lanes>>;

}  // namespace sinew::plant

namespace sinew::air {
namespace {

using Kind = gas::Valve::Kind;

// Throws for a command that does not suit the kind of valve.
[[noreturn]] void refuse(const char* command, Kind kind) {
  std::string has = "on-off valves; expected inlet() or exhaust()";
  if (kind == Kind::three_way) has = "a 3-way valve, which has one coil; expected inlet()";
  if (kind == Kind::regulator) has = "a pressure regulator; expected set_point()";
  throw std::invalid_argument(std::string(command) + ": found a muscle with " + has);
}

}  // namespace

DrivenMuscle::DrivenMuscle(const Muscle& muscle, const gas::Air& air, const gas::Supply& supply,
                           double length, double pressure)
    : kind_(muscle.inlet.kind), world_({muscle, air, supply, length, pressure}) {
  if (!(world_.air().volume(0, length) > 0))
    throw std::invalid_argument("at a length of " + std::to_string(length) +
                                " m the muscle has no room for air: give it an external volume, or "
                                "another length");
}

void DrivenMuscle::command(int valve, bool on, std::uint16_t level) noexcept {
  world_.command({.valve = {static_cast<std::uint8_t>(valve)}, .open = on, .level = level});
}

void DrivenMuscle::inlet(bool on) {
  if (kind_ == Kind::regulator) refuse("inlet", kind_);
  command(0, on, 0);
}

void DrivenMuscle::exhaust(bool on) {
  if (kind_ != Kind::two_way) refuse("exhaust", kind_);
  command(1, on, 0);
}

void DrivenMuscle::set_point(double share) {
  if (kind_ != Kind::regulator) refuse("set_point", kind_);
  const double level = std::clamp(share, 0.0, 1.0) * signals::max_level;
  command(0, share > 0, static_cast<std::uint16_t>(level + 0.5));
}

void DrivenMuscle::advance(double step, double length) noexcept {
  if (failed() || !(step > 0)) return;
  world_.set_motion({.length = this->length(), .rate = (length - this->length()) / step});
  world_.node_at(time() + step);
  world_.mutable_state().now.motion.length = length;  // the exact value
}

}  // namespace sinew::air
