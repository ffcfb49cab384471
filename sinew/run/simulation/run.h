// run/simulation/run.h - an experiment from start to finish.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

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

// A machine that is there, at a card in this computer, and the clock by which it is driven.
struct RealBody {
  plant::ComediPort* port = nullptr;
  host::Beat* beat = nullptr;
};

// How a run goes, who watches it, and where its machine is.
struct RunOptions {
  double pace = 0;               // simulated per wall second; 0: as fast as it goes
  Steering* steering = nullptr;  // in place of pace; outlives the run
  Tap tap;
  std::vector<std::uint16_t> tapped;  // topic in the log of each of topics(), or not_tapped
  std::atomic<std::int64_t>* progress = nullptr;  // the tick that the run has reached
  const std::atomic<bool>* stop = nullptr;        // true: the run ends there, as it stands
  bool every_tick = false;                        // visit each tick: slower, the same bits
  bool recorded = true;                           // false: the outcome's table is empty
  int extra_readers = 0;                          // looks at the world per event: the same bits
  int threads = 0;  // of a sweep of duties; 0: as many as the computer has. The same bits
  RealBody body;    // in place of the simulated machine, in real time
  plant::RemoteBoard* board = nullptr;  // drives the machine in place of the simulation; armed
  int lead = 1;                         // of its commands [periods] (remote_boards.h)
  bool board_keeps_time = true;         // false: it waits for the host, who may set a pace
};

// Holds what came of a run.
struct Outcome {
  signals::Status status = signals::Status::ok;
  bool stopped = false;  // by RunOptions::stop
  signals::Table table;
  std::string line;                   // what was wrong with a card or the line to a board
  std::uint32_t lost = 0;             // periods of which a board's telemetry did not come
  std::uint32_t foreign = 0;          // edges and periods of valves or times that no board has
  std::string no_room;                // why the table is not complete, and what to do; empty: it is
  SeenTotals seen;                    // the low level's last word
  SupervisedTotals supervised;        // what was not believed, and what ended the run
  air::Failure failure;               // what of the machine was no number any more
  std::vector<gait::Change> changes;  // the plan's, and behind them what was steered
  std::int64_t unreachable_periods = 0;
  std::int64_t nodes = 0;  // steps of the integrator
  double duration = 0;     // simulated [s]
  double wall = 0;         // [s]

  // It did not come to its end: there is nothing to sum up.
  bool ended_early() const {
    return failure || !line.empty() || status != signals::Status::ok ||
           seen.fault != signals::Status::ok || supervised.trip.cause != control::Trip::Cause::none;
  }
};

// Why a run ended early, when, and what to do: "the air of muscle knee_flexor was no number any
// more at 0 s: …".
std::string cause_of(const experiment::Experiment& experiment, const Outcome& outcome);

// Throws std::invalid_argument for a robot that no plant can hold; nothing once the loop runs.
Outcome run(const experiment::Experiment& experiment, const RunOptions& options = {});

// The recorded readings of a run through today's controller. Returns the edges it decides, to be
// compared with the recorded ones.
Outcome replay(const experiment::Experiment& experiment, const signals::Table& recorded);

}  // namespace sinew::run
