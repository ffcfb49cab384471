// run/controllers/board.cpp - also compiled for graphics cards (run/card/kernel.cu).
#include "sinew/run/controllers/board.h"

namespace sinew::run {

using signals::Conversion;
using signals::Edge;
using signals::Tick;

Board::Board(const control::JointControllerConfig& config, const control::SuperviseConfig& limits,
             std::span<const std::uint8_t> joints, std::span<const std::uint8_t> channels,
             std::span<const std::uint8_t> valves)
    : supervisor(config, limits), joint_(joints), channel_(channels), valve_(valves) {
  for (std::size_t i = 0; i < config.conversions; ++i) {
    Conversion c = config.conversion[i];
    c.channel.index = channel_[c.channel.index];
    conversion_.push_back(c);
  }
}

std::span<const Edge> Board::edges(Tick t) noexcept {
  const std::span<const Edge> decided = supervisor.edges(t);
  for (std::size_t i = 0; i < decided.size(); ++i) {
    out_[i] = decided[i];
    out_[i].valve.index = valve_[decided[i].valve.index];
  }
  return {out_.data(), decided.size()};
}

const Conversion* Board::due(Tick t) noexcept {
  const Conversion* its = supervisor.due(t);
  return its ? &conversion_[static_cast<std::size_t>(its - supervisor.config().conversion.data())]
             : nullptr;
}

void Board::take(const Conversion& conversion, signals::Reading reading, Tick t) noexcept {
  const auto i = static_cast<std::size_t>(&conversion - conversion_.data());
  supervisor.take(supervisor.config().conversion[i], reading, t);
}

control::Trip Board::trip() const noexcept {
  control::Trip trip = supervised().trip;
  if (trip.channel.index < channel_.size()) trip.channel.index = channel_[trip.channel.index];
  if (trip.joint < joint_.size()) trip.joint = joint_[trip.joint];
  return trip;
}

}  // namespace sinew::run
