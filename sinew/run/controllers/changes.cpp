#include "sinew/run/controllers/changes.h"

#include <algorithm>
#include <cmath>

namespace sinew::run {

using signals::Tick;

Changes::Changes(const gait::Plan& plan, std::span<const robot::LegParts> legs, Steering* steering)
    : planned_(plan.changes), overrides_(legs.size(), gait::Overrides(plan)), steering_(steering) {
  for (const robot::LegParts& leg : legs) legs_.push_back(leg.name);
  for (const gait::Change& c : planned_) {
    const int setting = gait::find_setting(settings(), c.key);
    const auto leg = std::ranges::find(legs_, c.leg);
    const bool all = c.leg.empty();
    if (setting < 0 || (!all && leg == legs_.end()))
      continue;  // gait::contradictions has refused it
    due_.push_back({std::llround(c.time / signals::tick_seconds),
                    {static_cast<std::size_t>(setting), c.value, c.release,
                     all ? -1 : static_cast<int>(leg - legs_.begin())}});
  }
  std::ranges::stable_sort(due_, {}, &Due::at);
  if (steering_) steered_.reserve(most);
}

bool Changes::is_there(const Steering::Wish& wish) const noexcept {
  return wish.setting < settings().size() && wish.leg < static_cast<int>(legs_.size());
}

bool Changes::wish(const Steering::Wish& wish) noexcept {
  if (!is_there(wish)) return false;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    if (is_of(wish, leg)) waiting_[leg][wish.setting] = {true, wish};
  waits_ = true;
  return true;
}

Changes::State Changes::state() const noexcept {
  State out{.next = next_, .waiting = waiting_, .waits = waits_};
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) out.overrides[leg] = overrides_[leg].state();
  return out;
}

void Changes::restore(const State& state) noexcept {
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    overrides_[leg].restore(state.overrides[leg]);
  next_ = state.next;
  waiting_ = state.waiting;
  waits_ = state.waits;
}

void Changes::follow(const Steering::Wish& wish, std::size_t leg) noexcept {
  if (wish.release)
    overrides_[leg].release(wish.setting);
  else
    overrides_[leg].set(wish.setting, wish.value);
}

void Changes::follow(const Steering::Wish& wish) noexcept {
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    if (is_of(wish, leg)) follow(wish, leg);
}

void Changes::follow_waiting() noexcept {
  if (!waits_) return;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    for (Waiting& w : waiting_[leg]) {
      if (w.given) follow(w.wish, leg);
      w.given = false;
    }
  waits_ = false;
}

void Changes::apply(Tick t, std::span<gait::Desired> legs) noexcept {
  for (; next_ < due_.size() && due_[next_].at <= t; ++next_) follow(due_[next_].wish);
  if (steering_)
    steering_->take([&](const Steering::Wish& wish) {
      if (!is_there(wish) || steered_.size() == most) return steering_->refuse();
      steered_.push_back({t, wish});
      follow(wish);
    });
  follow_waiting();

  for (std::size_t leg = 0; leg < legs.size(); ++leg) overrides_[leg].apply(legs[leg]);
  if (!steering_ || legs.empty()) return;
  const gait::Overrides& first = overrides_.front();
  for (std::size_t i = 0; i < settings().size(); ++i)
    steering_->show(i, gait::value_of(settings()[i], legs.front()), first.given(i));
}

std::vector<gait::Change> Changes::all() const {
  std::vector<gait::Change> out = planned_;
  for (const Due& d : steered_) {
    // A division, so that 5.81 s is printed as 5.81.
    gait::Change c{.time = static_cast<double>(d.at * signals::tick_nanoseconds) / 1e9,
                   .key = settings()[d.wish.setting].key,
                   .release = d.wish.release};
    if (d.wish.leg >= 0) c.leg = legs_[static_cast<std::size_t>(d.wish.leg)];
    if (!c.release) c.value = d.wish.value;
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace sinew::run
