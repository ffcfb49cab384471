// run/simulation/loop.h - the one loop. Simulation, replay and hardware all use it; the joint
// controller has no access to the port, and the port none to the gait controller.
#pragma once

#include <span>

#include "sinew/control/joint/seen.h"
#include "sinew/signals/port.h"

namespace sinew::run {

// Returns whether the watcher stops the loop. A watcher without stopped() never does.
template <class Watch>
bool ends_it(Watch& watch) noexcept {
  if constexpr (requires { watch.stopped(); }) return watch.stopped();
  return false;
}

// Position of a loop. Copied as bytes.
struct LoopState {
  signals::Tick at = 0;  // the next tick with an event
  signals::Status status = signals::Status::ok;
  bool started = false;  // whether the body was given the scan
};

// Returns the boards of a low level; a single controller is its own board.
template <class JointController>
auto each_board(JointController& spine) noexcept {
  if constexpr (requires { spine.each(); })
    return spine.each();
  else
    return std::span<JointController, 1>(&spine, 1);
}

// JointController   scan(), seen().phase, command(command), edges(t), due(t),
//         take(conversion, reading, t), next_event(t), missed(t), shut_down(t):
//         control::Supervisor, control::JointController alone; or Boards, whose each() returns
//         boards with edges(t), due(t) and take()
// GaitController   update(seen, t) -> Command, finished()
// Clock   wait_until(t) -> false if late
// Watch   command(t), edge(e), sample(t), next(t): a recorder, which changes nothing. It may have
//         stopped(): true ends the loop
//
// Runs the ticks before `until`. The result does not depend on the number of calls. Ends early if
// the body ends or fails, or if the joint controller has shut down.
template <class JointController, class GaitController, class Clock, class Watch>
void advance(LoopState& loop, JointController& spine, GaitController& brain, signals::Port& port,
             Clock& clock, Watch& watch, signals::Tick until) noexcept {
  using signals::Status;
  using signals::Tick;

  if (!loop.started) loop.status = port.start(spine.scan());
  loop.started = true;
  Status& status = loop.status;
  Tick& t = loop.at;
  while (status == Status::ok && t < until && spine.seen().phase != control::Phase::off &&
         !ends_it(watch)) {
    if (!clock.wait_until(t)) spine.missed(t);

    // The high level's setpoints for this period; its last ones shut the joint controller down.
    if (t % spine.scan().period == 0) {
      spine.command(brain.update(spine.seen(), t));
      watch.command(t);
      if (brain.finished() && spine.seen().phase == control::Phase::running) spine.shut_down(t);
    }

    // Edges that were decided earlier, then the conversions that are due, one per board.
    for (auto& board : each_board(spine))
      for (const signals::Edge& edge : board.edges(t)) {
        const Status driven = port.drive(edge);
        status = status == Status::ok ? driven : status;
        watch.edge(edge);
      }
    for (auto& board : each_board(spine))
      if (const signals::Conversion* c = board.due(t)) board.take(*c, port.read(c->channel, t), t);
    watch.sample(t);

    const Tick next = spine.next_event(t), sample = watch.next(t);
    t = sample < next ? sample : next;
  }
}

// Stops the body and leaves it safe. Returns the first status that was not ok, if any.
inline signals::Status finish(LoopState& loop, signals::Port& port) noexcept {
  const signals::Status safe = port.stop(loop.at);
  return loop.status == signals::Status::ok ? safe : loop.status;
}

// Runs from the first tick to `end`, or to an earlier end.
template <class JointController, class GaitController, class Clock, class Watch>
signals::Status loop(JointController& spine, GaitController& brain, signals::Port& port,
                     Clock& clock, Watch& watch, signals::Tick end) noexcept {
  LoopState state;
  advance(state, spine, brain, port, clock, watch, end);
  return finish(state, port);
}

}  // namespace sinew::run
