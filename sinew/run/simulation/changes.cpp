#include "sinew/run/simulation/changes.h"

#include <algorithm>
#include <cmath>

namespace sinew::run {

using signals::Tick;

Changes::Changes(const gait::Plan& plan, Steering* steering)
    : planned_(plan.changes), overrides_(plan), steering_(steering) {
  for (const gait::Change& c : planned_) {
    const int setting = gait::find_setting(overrides_.settings(), c.key);
    if (setting < 0) continue;  // gait::contradictions has refused it
    due_.push_back({std::llround(c.time / signals::tick_seconds),
                    {static_cast<std::size_t>(setting), c.value, c.release}});
  }
  std::ranges::stable_sort(due_, {}, &Due::at);
  if (steering_) steered_.reserve(most);
}

bool Changes::wish(const Steering::Wish& wish) noexcept {
  if (wish.setting >= overrides_.settings().size()) return false;
  waiting_[wish.setting] = {true, wish};
  waits_ = true;
  return true;
}

void Changes::restore(const State& state) noexcept {
  overrides_.restore(state.overrides);
  next_ = state.next;
  waiting_ = state.waiting;
  waits_ = state.waits;
}

void Changes::follow(const Steering::Wish& wish) noexcept {
  if (wish.release)
    overrides_.release(wish.setting);
  else
    overrides_.set(wish.setting, wish.value);
}

void Changes::apply(Tick t, std::span<gait::Desired> legs) noexcept {
  for (; next_ < due_.size() && due_[next_].at <= t; ++next_) follow(due_[next_].wish);
  if (steering_)
    steering_->take([&](const Steering::Wish& wish) {
      if (wish.setting >= overrides_.settings().size() || steered_.size() == most)
        return steering_->refuse();
      steered_.push_back({t, wish});
      follow(wish);
    });
  for (Waiting& w : waiting_) {
    if (!waits_) break;
    if (w.given) follow(w.wish);
    w.given = false;
  }
  waits_ = false;

  for (gait::Desired& desired : legs) overrides_.apply(desired);
  if (!steering_ || legs.empty()) return;
  const gait::Desired& desired = legs.front();
  for (std::size_t i = 0; i < overrides_.settings().size(); ++i)
    steering_->show(i, gait::value_of(overrides_.settings()[i], desired), overrides_.given(i));
}

std::vector<gait::Change> Changes::all() const {
  std::vector<gait::Change> out = planned_;
  for (const Due& d : steered_) {
    // Divided, so that 5.81 s reads as that.
    gait::Change c{.time = static_cast<double>(d.at * signals::tick_nanoseconds) / 1e9,
                   .key = overrides_.settings()[d.wish.setting].key,
                   .release = d.wish.release};
    if (!c.release) c.value = d.wish.value;
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace sinew::run
