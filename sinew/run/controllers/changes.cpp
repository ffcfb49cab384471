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

bool Changes::is_there(const Steering::Request& request) const noexcept {
  return request.setting < settings().size() && request.leg < static_cast<int>(legs_.size());
}

bool Changes::request_change(const Steering::Request& request) noexcept {
  if (!is_there(request)) return false;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    if (is_of(request, leg)) state_.waiting[leg][request.setting] = {true, request};
  state_.waits = true;
  return true;
}

Changes::State Changes::state() const noexcept {
  State out = state_;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) out.overrides[leg] = overrides_[leg].state();
  return out;
}

void Changes::restore(const State& state) noexcept {
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    overrides_[leg].restore(state.overrides[leg]);
  state_ = state;
}

void Changes::override_setting(const Steering::Request& request, std::size_t leg) noexcept {
  if (request.release)
    overrides_[leg].release(request.setting);
  else
    overrides_[leg].set(request.setting, request.value);
}

void Changes::override_setting(const Steering::Request& request) noexcept {
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    if (is_of(request, leg)) override_setting(request, leg);
}

void Changes::apply_waiting() noexcept {
  if (!state_.waits) return;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg)
    for (Waiting& w : state_.waiting[leg]) {
      if (w.given) override_setting(w.request, leg);
      w.given = false;
    }
  state_.waits = false;
}

void Changes::apply(Tick t, std::span<gait::Desired> legs) noexcept {
  for (std::size_t& next = state_.next; next < due_.size() && due_[next].at <= t; ++next)
    override_setting(due_[next].request);
  if (steering_)
    steering_->take([&](const Steering::Request& request) {
      if (!is_there(request) || steered_.size() == most) return steering_->refuse();
      steered_.push_back({t, request});
      override_setting(request);
    });
  apply_waiting();

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
                   .key = settings()[d.request.setting].key,
                   .release = d.request.release};
    if (d.request.leg >= 0) c.leg = legs_[static_cast<std::size_t>(d.request.leg)];
    if (!c.release) c.value = d.request.value;
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace sinew::run
