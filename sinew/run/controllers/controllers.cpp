#include "sinew/run/controllers/controllers.h"

#include <cstring>
#include <type_traits>

namespace sinew::run {
namespace {

static_assert(std::is_trivially_copyable_v<HighLevel::State>);

using Parts = std::variant<Controllers::OfRobot, Controllers::OfStand>;

Parts parts_of(const experiment::Experiment& e, Steering* steering) {
  if (e.stand) return Controllers::OfStand{Drive(e, experiment::last_tick(e)), DriveSchedule(e)};
  return Controllers::OfRobot{Boards(e), HighLevel(e.robot, e.plan, steering)};
}

}  // namespace

Controllers::Controllers(const experiment::Experiment& e, Steering* steering)
    : of_(parts_of(e, steering)) {}

signals::Scan Controllers::scan() const noexcept {
  return std::visit([](const auto& of) { return signals::Scan(of.joint.scan()); }, of_);
}

control::Phase Controllers::phase() const noexcept {
  return std::visit([](const auto& of) { return of.joint.seen().phase; }, of_);
}

signals::Tick Controllers::first_sample(signals::Tick period) const noexcept {
  const signals::Scan its = scan();
  const bool at_law = robot() && period % its.period == 0 && !its.conversions.empty();
  return at_law ? its.conversions.back().read : 0;
}

std::size_t Controllers::most_edges(signals::Tick end) const noexcept {
  if (const OfStand* of = stand()) return of->joint.most_edges(end);
  return 4 * static_cast<std::size_t>(end / scan().period + 2);
}

SeenTotals Controllers::seen_totals() const {
  if (robot()) return robot()->joint.seen_totals();
  const DriveSeen& seen = stand()->joint.seen();
  return {.phase = seen.phase, .fault = seen.fault, .fault_channel = seen.fault_channel};
}

SupervisedTotals Controllers::supervised_totals() const {
  return robot() ? robot()->joint.supervised_totals() : SupervisedTotals{};
}

const std::vector<gait::Setting>& Controllers::settings() const noexcept {
  static const std::vector<gait::Setting> none;
  return robot() ? robot()->gait.settings() : none;
}

std::size_t Controllers::state_size() const noexcept {
  if (const OfStand* of = stand()) return of->joint.state_size();
  return robot()->joint.state_size() + sizeof(HighLevel::State);
}

void Controllers::save(std::span<std::byte> out) const noexcept {
  if (const OfStand* of = stand()) return of->joint.save(out);
  const std::size_t boards = robot()->joint.state_size();
  robot()->joint.save(out.first(boards));
  const HighLevel::State state = robot()->gait.state();
  std::memcpy(out.data() + boards, &state, sizeof state);
}

void Controllers::restore(std::span<const std::byte> saved) noexcept {
  if (auto* of = std::get_if<OfStand>(&of_)) return of->joint.restore(saved);
  const std::size_t boards = robot()->joint.state_size();
  robot()->joint.restore(saved.first(boards));
  HighLevel::State state;
  std::memcpy(&state, saved.data() + boards, sizeof state);
  robot()->gait.restore(state);
}

}  // namespace sinew::run
