// run/simulation/run.h - run of an experiment from start to finish, and texts about its outcome.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/air/failure.h"
#include "sinew/experiment/experiment.h"
#include "sinew/host/realtime.h"
#include "sinew/port/comedi/comedi_port.h"
#include "sinew/port/hardware/remote_board.h"
#include "sinew/run/controllers/controllers.h"
#include "sinew/run/controllers/steering.h"
#include "sinew/run/simulation/recorder.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// A real machine, at a card in this computer, and the clock that drives it.
struct RealBody {
  plant::ComediPort* port = nullptr;
  host::TickTimer* beat = nullptr;
};

// Pace, observers and place of a run.
struct RunOptions {
  double pace = 0;               // simulated per wall second; 0: as fast as possible
  Steering* steering = nullptr;  // overrides pace; must outlive the run
  Tap tap;
  std::vector<std::uint16_t> tapped;  // topic in the log for each of topics(), or not_tapped
  std::atomic<std::int64_t>* progress = nullptr;  // the tick that the run has reached
  const std::atomic<bool>* stop = nullptr;        // true: the run ends at its present state
  bool every_tick = false;                        // visits each tick: slower, same bits
  bool recorded = true;                           // false: the outcome's table is empty
  const signals::TopicNames* topics = nullptr;    // those that the table records; nullptr: all
  int extra_readers = 0;                          // additional readings per event: same bits
  int threads = 0;                      // for a sweep of duties; 0: all processors. Same bits
  RealBody body;                        // replaces the simulated machine, in real time
  plant::RemoteBoard* board = nullptr;  // replaces the simulation; must be armed
  int lead = 1;                         // lead of its commands [periods] (remote_boards.h)
  bool board_keeps_time = true;         // false: it waits for the host, which may set a pace
};

// The result of a run.
struct Outcome {
  signals::Status status = signals::Status::ok;
  bool stopped = false;  // stopped by RunOptions::stop
  signals::Table table;
  std::string line;                   // fault of a card or of the line to a board
  std::uint32_t lost = 0;             // periods without a board's telemetry
  std::uint32_t foreign = 0;          // edges and periods with invalid valves or times
  std::string no_room;                // why the table is incomplete, and the remedy; or empty
  ControllerTotals controller;        // last state of the low level
  SupervisedTotals supervised;        // rejected readings and commands, and what ended the run
  air::Failure failure;               // part of the machine that was not finite
  std::vector<gait::Change> changes;  // the plan's, followed by steered ones
  std::int64_t unreachable_periods = 0;
  std::int64_t nodes = 0;  // steps of the integrator
  bool took_air = false;   // a muscle of the simulated machine took air from the supply
  double duration = 0;     // simulated [s]
  double wall = 0;         // [s]

  // Returns whether the run ended before its plan and has no summary.
  bool ended_early() const {
    return failure || !line.empty() || status != signals::Status::ok ||
           controller.fault != signals::Status::ok ||
           supervised.trip.cause != control::Trip::Cause::none;
  }
};

// Returns why and when a run ended early, and the remedy: "the air of muscle knee_flexor was no
// number any more at 0 s: …".
std::string cause_of(const experiment::Experiment& experiment, const Outcome& outcome);

// Runs the experiment. Throws std::invalid_argument for a robot that exceeds the limits of the
// plant; never throws once the loop runs.
Outcome run(const experiment::Experiment& experiment, const RunOptions& options = {});

// Feeds the recorded readings of a run to the present controller. Returns the edges that it
// decides, for comparison with the recorded ones.
Outcome replay(const experiment::Experiment& experiment, const signals::Table& recorded);

// Returns "the air of muscle knee_flexor was not finite at 0.012 s: …; try …". `who` is the
// muscle's name in its file, `step` the key of the step's length.
std::string to_text(const air::Failure& failure, const std::string& who,
                    const actuator::Actuator& actuator, const std::string& step);

// Returns a sentence for each kind of lateness on this computer, for rejected readings without a
// channel of their own, and for faults and changes that never acted.
std::vector<std::string> warnings_outside_log(const experiment::Experiment& experiment,
                                              const run::Outcome& outcome);

// Returns why the run ended early, with the last record of every topic.
std::string last_records(const experiment::Experiment& experiment, const run::Outcome& outcome);

}  // namespace sinew::run
