#include "sinew/run/controllers/controllers.h"

#include <cstring>
#include <type_traits>

#include "sinew/run/setup/installation.h"

namespace sinew::run {
namespace {

static_assert(std::is_trivially_copyable_v<HighLevel::State>);

using Levels = std::variant<HighLevel, Drive>;

Levels high_level(const experiment::Experiment& e, Steering* steering) {
  if (e.stand) return Levels(std::in_place_type<Drive>, e);
  return Levels(std::in_place_type<HighLevel>, e.robot, e.plan, steering);
}

}  // namespace

Controllers::Controllers(const experiment::Experiment& e, Steering* steering)
    : boards_(boards_of(e)), high_level_(high_level(e, steering)) {}

signals::Tick Controllers::first_sample(signals::Tick period) const noexcept {
  const signals::Scan its = scan();
  if (!gait() || its.conversions.empty()) return 0;
  const signals::Tick read = its.conversions.back().read;
  return period % its.period == 0 ? read : (read + period - 1) / period * period;
}

std::size_t Controllers::most_edges(signals::Tick end) const noexcept {
  if (const Drive* of = drive()) return of->most_edges(end);
  return 4 * static_cast<std::size_t>(end / scan().period + 2);
}

const std::vector<gait::Setting>& Controllers::settings() const noexcept {
  static const std::vector<gait::Setting> none;
  return gait() ? gait()->settings() : none;
}

std::size_t Controllers::state_size() const noexcept {
  return boards_.state_size() + (gait() ? sizeof(HighLevel::State) : sizeof(Drive::State));
}

void Controllers::save(std::span<std::byte> out) const noexcept {
  boards_.save(out.first(boards_.state_size()));
  std::visit(
      [rest = out.subspan(boards_.state_size())](const auto& of) {
        const auto state = of.state();
        std::memcpy(rest.data(), &state, sizeof state);
      },
      high_level_);
}

void Controllers::restore(std::span<const std::byte> saved) noexcept {
  boards_.restore(saved.first(boards_.state_size()));
  std::visit(
      [rest = saved.subspan(boards_.state_size())](auto& of) {
        auto state = of.state();
        std::memcpy(&state, rest.data(), sizeof state);
        of.restore(state);
      },
      high_level_);
}

}  // namespace sinew::run
