#include "sinew/control/supervise/output_stage.h"

#include <bit>

namespace sinew::control {
namespace {

// Returns the valve's bit, or zero for a valve that no board has.
constexpr OpenMask bit(signals::Valve valve) noexcept {
  return valve.index < max_valves ? OpenMask{1} << valve.index : 0u;
}

// std::popcount would need a function of the compiler's library on this processor.
constexpr std::uint32_t count(OpenMask valves) noexcept {
  std::uint32_t out = 0;
  for (; valves != 0; valves &= valves - 1) ++out;
  return out;
}

}  // namespace

OutputStage::OutputStage(const JointControllerConfig& machine, std::uint32_t refractory) noexcept
    : refractory_(refractory) {
  for (std::size_t j = 0; j < machine.joints; ++j) {
    const JointConfig& joint = machine.joint[j];
    if (!has_exhausts(joint.kind)) continue;
    for (const MuscleConfig* m : {&joint.flexor, &joint.extensor}) {
      if (!m->present) continue;
      exhausts_ |= bit(m->exhaust);
      if (m->exhaust_inverted) inverted_ |= bit(m->exhaust);
      if (joint.kind != JointKind::cylinder) pair_[pairs_++] = {bit(m->inlet), bit(m->exhaust)};
    }
  }
}

void OutputStage::drive(const signals::Edge& edge) noexcept {
  const OpenMask valve = bit(edge.valve);
  if (valve == 0) return;
  const bool open = edge.open != ((inverted_ & valve) != 0);
  requested_ = open ? requested_ | valve : requested_ & ~valve;
  level_[edge.valve.index] = edge.level;
}

void OutputStage::shut_all() noexcept {
  requested_ = 0;
  for (std::uint16_t& level : level_) level = 0;
}

void OutputStage::vent(signals::Tick now) noexcept {
  shut_all();
  requested_ = exhausts_;
  has_shut_ &= ~exhausts_;  // without a refractory time
  (void)at(now);
}

OpenMask OutputStage::at(signals::Tick now) noexcept {
  if (requested_ == processed_ && kept_ == 0) return open_;
  processed_ = requested_;
  OpenMask allowed = requested_, locked = 0, kept = 0;
  for (std::size_t i = 0; i < pairs_; ++i)
    if (requested_ & pair_[i].exhaust) locked |= allowed & pair_[i].inlet;
  allowed &= ~locked;
  for (std::size_t v = 0; v < max_valves && refractory_ > 0; ++v) {
    const OpenMask one = OpenMask{1} << v;
    if ((allowed & ~open_ & has_shut_ & one) == 0) continue;
    if (now - shut_at_[v] < static_cast<signals::Tick>(refractory_)) kept |= one;
  }
  allowed &= ~kept;
  for (OpenMask left = open_ & ~allowed; left != 0; left &= left - 1)
    shut_at_[static_cast<std::size_t>(std::countr_zero(left))] = now;
  interlocks_ += count(locked & ~locked_);
  refractories_ += count(kept & ~kept_);
  has_shut_ |= open_ & ~allowed;
  locked_ = locked;
  kept_ = kept;
  return open_ = allowed;
}

}  // namespace sinew::control
