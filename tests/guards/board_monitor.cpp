#include "tests/guards/board_monitor.h"

#include <algorithm>

#include "sinew/control/setup/boards.h"
#include "sinew/run/simulation/remote_boards.h"

namespace sinew::run {

using signals::Tick;

Monitor::Monitor(const experiment::Experiment& e) {
  const std::vector<std::uint8_t> valve = only_board(e).valve;
  for (std::size_t i = 0; i < valve.size(); ++i) {
    const bool of_muscle = valve[i] < 2 * e.robot.muscles.size();
    if (valve[i] % 2 == 0) inlets_ |= 1u << i;
    if (valve[i] % 2 == 1 && of_muscle) exhausts_ |= 1u << i;
    if (of_muscle && i + 1 < valve.size() && valve[i] % 2 == 0 && valve[i + 1] == valve[i] + 1)
      pairs_.push_back(3u << i);
  }
}

plant::Wires Monitor::at(plant::Wires body, Tick from, plant::BoardFailure failure) {
  plant::Wires out;
  out.valves = [this, body](Tick tick, std::uint32_t open, bool current) {
    see(tick, open, current);
    body.valves(tick, open, current);
  };
  out.read = [this, body](signals::Channel c, Tick tick) {
    pass(tick);
    return body.read(c, tick);
  };
  if (failure.what == plant::BoardFailure::What::none) return out;
  out.failure = [this, from, failure](Tick tick) -> plant::BoardFailure {
    const std::lock_guard guard(lock_);
    if (facts_.failure >= 0 || tick < from || (facts_.open & inlets_) == 0) return {};
    facts_.failure = tick;
    return failure;
  };
  return out;
}

// --- recording ----------------------------------------------------------------------------------

void Monitor::host_speaks(Tick now) {
  const std::lock_guard guard(lock_);
  heard_ = now;
}

void Monitor::board_suffers() {
  const std::lock_guard guard(lock_);
  facts_.failure = facts_.now;
}

void Monitor::pass(Tick tick) {
  const std::lock_guard guard(lock_);
  Facts& f = facts_;
  f.runs = tick >= 0;
  f.now = std::max(f.now, tick);
  if ((f.open & inlets_) != 0) f.unheard = std::max(f.unheard, f.now - heard_);
}

void Monitor::see(Tick tick, std::uint32_t open, bool current) {
  pass(tick);
  const std::lock_guard guard(lock_);
  Facts& f = facts_;
  f.open = current ? open : 0;
  f.has_current = current;
  f.open_without_run |= tick < 0 && f.open != 0;
  for (const std::uint32_t pair : pairs_) f.both_open |= (f.open & pair) == pair;
  seen_.push_back({f.now, f.open});
}

// --- queries ------------------------------------------------------------------------------------

Monitor::Facts Monitor::facts() const {
  const std::lock_guard guard(lock_);
  return facts_;
}

Tick Monitor::last_inlet(Tick from, Tick until) const {
  const std::lock_guard guard(lock_);
  Tick last = -1;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Tick end = i + 1 < seen_.size() ? seen_[i + 1].tick : facts_.now;
    if ((seen_[i].open & inlets_) != 0 && end > from && seen_[i].tick < until)
      last = std::max(last, std::min(end, until));
  }
  return last;
}

Tick Monitor::first(Tick from, std::uint32_t of, std::uint32_t open) const {
  const std::lock_guard guard(lock_);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const bool lasts = i + 1 == seen_.size() || seen_[i + 1].tick > from;
    if (lasts && (seen_[i].open & of) == open) return std::max(seen_[i].tick, from);
  }
  return -1;
}

}  // namespace sinew::run
