#include "sinew/control/gait/legs.h"

#include <algorithm>
#include <limits>

namespace sinew::gait {

Legs::Legs(const robot::Robot& robot, const Plan& plan) : parts_(robot::legs_of(robot)) {
  controllers_.reserve(parts_.size());
  for (std::size_t l = 0; l < parts_.size(); ++l)
    controllers_.emplace_back(robot::only_leg(robot, l), plan_of_leg(plan, parts_[l]),
                              parts_[l].offset);
}

Measured Legs::of_leg(const MachineMeasured& machine, const robot::LegParts& leg) const noexcept {
  Measured out;
  out.cylinder = machine.cylinder;
  for (std::size_t i = 0; i < leg.joints.size(); ++i) {
    const auto j = static_cast<std::size_t>(leg.joints[i]);
    out.angle[i] = machine.angle[j];
    out.velocity[i] = machine.velocity[j];
    out.stiffness[i] = machine.stiffness[j];
  }
  for (std::size_t i = 0; i < leg.muscles.size(); ++i)
    out.tension[i] = machine.tension[static_cast<std::size_t>(leg.muscles[i])];
  return out;
}

void Legs::update(const MachineMeasured& machine, std::int64_t period_index) noexcept {
  std::int64_t slowest = std::numeric_limits<std::int64_t>::max();
  for (const GaitController& controller : controllers_)
    if (!controller.finished()) slowest = std::min(slowest, controller.planned_periods());
  for (std::size_t l = 0; l < controllers_.size(); ++l) {
    GaitController& controller = controllers_[l];
    controller.update(of_leg(machine, parts_[l]), period_index,
                      controller.planned_periods() > slowest);
  }
}

Legs::State Legs::state() const noexcept {
  State out{};
  for (std::size_t l = 0; l < controllers_.size(); ++l) out[l] = controllers_[l].state();
  return out;
}

void Legs::restore(const State& state) noexcept {
  for (std::size_t l = 0; l < controllers_.size(); ++l) controllers_[l].restore(state[l]);
}

bool Legs::finished() const noexcept {
  return std::ranges::all_of(controllers_, [](const GaitController& b) { return b.finished(); });
}

std::int64_t Legs::unreachable_periods() const noexcept {
  std::int64_t sum = 0;
  for (const GaitController& b : controllers_) sum += b.unreachable_periods();
  return sum;
}

}  // namespace sinew::gait
