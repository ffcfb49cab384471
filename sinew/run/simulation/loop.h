// run/simulation/loop.h - the one loop. Simulation, replay and hardware all use it; the joint
// controller has no access to the port, and the port none to the gait controller.
#pragma once

#include <span>
#include <type_traits>

#include "sinew/control/joint/state.h"
#include "sinew/signals/port.h"

namespace sinew::run {

// Returns whether the watcher stops the loop. A watcher without stopped() never does.
template <class Watch>
bool is_stopped(Watch& watch) noexcept {
  if constexpr (requires { watch.stopped(); }) return watch.stopped();
  return false;
}

// Waits for a tick. Returns whether it is in time; a clock that returns nothing is never late.
template <class Clock>
bool wait(Clock& clock, signals::Tick t) noexcept {
  if constexpr (!std::is_void_v<decltype(clock.wait_until(t))>) return clock.wait_until(t);
  clock.wait_until(t);
  return true;
}

// Position of a loop. Copied as bytes.
struct LoopState {
  signals::Tick at = 0;  // the next tick with an event
  signals::Status status = signals::Status::ok;
  bool started = false;  // whether the body was given the scan
};

// Returns the boards of a low level; a single controller is its own board.
template <class JointController>
auto each_board(JointController& joint_controller) noexcept {
  if constexpr (requires { joint_controller.each(); })
    return joint_controller.each();
  else
    return std::span<JointController, 1>(&joint_controller, 1);
}

// Returns the phase of a low level.
template <class JointController>
control::Phase phase_of(const JointController& joint_controller) noexcept {
  if constexpr (requires { joint_controller.phase(); })
    return joint_controller.phase();
  else
    return joint_controller.state().phase;
}

// JointController   scan(), state().phase, command(command), edges(t), due(t),
//         take(conversion, reading, t), next_event(t), missed(t), shut_down(t):
//         control::Supervisor, control::JointController alone; or Boards, whose each() returns
//         boards with edges(t), due(t) and take()
// GaitController   update(state, t) -> Command, finished()
// Body    a signals::Port, or a machine with its functions
// Clock   wait_until(t) -> false if late, or nothing
// Watch   command(t), edge(e), sample(t), next(t): a recorder, which changes nothing. It may have
//         stopped(): true ends the loop
//
// Runs the ticks before `until`. The result does not depend on the number of calls. Ends early if
// the body ends or fails, or if the joint controller has shut down.
template <class JointController, class GaitController, class Body, class Clock, class Watch>
void advance(LoopState& loop, JointController& joint_controller, GaitController& gait_controller,
             Body& port, Clock& clock, Watch& watch, signals::Tick until) noexcept {
  using signals::Status;
  using signals::Tick;

  if (!loop.started) loop.status = port.start(joint_controller.scan());
  loop.started = true;
  Status& status = loop.status;
  Tick& t = loop.at;
  while (status == Status::ok && t < until && phase_of(joint_controller) != control::Phase::off &&
         !is_stopped(watch)) {
    if (!wait(clock, t)) joint_controller.missed(t);

    // The high level's setpoints for this period; its last ones shut the joint controller down.
    if (t % joint_controller.scan().period == 0) {
      joint_controller.command(gait_controller.update(joint_controller.state(), t));
      watch.command(t);
      if (gait_controller.finished() && phase_of(joint_controller) == control::Phase::running)
        joint_controller.shut_down(t);
    }

    // Edges that were decided earlier, then the conversions that are due, one per board.
    for (auto& board : each_board(joint_controller))
      for (const signals::Edge& edge : board.edges(t)) {
        const Status driven = port.drive(edge);
        status = status == Status::ok ? driven : status;
        watch.edge(edge);
      }
    for (auto& board : each_board(joint_controller))
      if (const signals::Conversion* c = board.due(t)) board.take(*c, port.read(c->channel, t), t);
    watch.sample(t);

    const Tick next = joint_controller.next_event(t), sample = watch.next(t);
    t = sample < next ? sample : next;
  }
}

// Stops the body and leaves it safe. Returns the first status that was not ok, if any.
template <class Body>
signals::Status finish(LoopState& loop, Body& port) noexcept {
  const signals::Status safe = port.stop(loop.at);
  return loop.status == signals::Status::ok ? safe : loop.status;
}

// Runs from the first tick to `end`, or to an earlier end.
template <class JointController, class GaitController, class Clock, class Watch>
signals::Status loop(JointController& joint_controller, GaitController& gait_controller,
                     signals::Port& port, Clock& clock, Watch& watch, signals::Tick end) noexcept {
  LoopState state;
  advance(state, joint_controller, gait_controller, port, clock, watch, end);
  return finish(state, port);
}

}  // namespace sinew::run
