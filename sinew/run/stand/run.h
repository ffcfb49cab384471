// run/stand/run.h - an experiment on the stand from start to finish.
#pragma once

#include <string>
#include <vector>

#include "sinew/air/failure.h"
#include "sinew/experiment/rig/rig.h"
#include "sinew/mechanism/slide/setup.h"
#include "sinew/run/simulation/logged.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"
#include "sinew/signals/tick.h"

namespace sinew::rig {

// Holds what came of a run of the stand.
struct Outcome {
  signals::Status status = signals::Status::ok;
  signals::Table table;
  air::Failure failure;  // what of the stand was no number any more
  std::int64_t nodes = 0;
  double duration = 0;  // simulated [s]
  double wall = 0;      // [s]
};

// Why a run ended early, when, and what to do.
std::string cause_of(const Experiment& experiment, const Outcome& outcome);

struct RunOptions {
  bool every_tick = false;  // visit each tick: slower, the same bits
  int threads = 0;          // of a sweep; 0: as many as the machine has. The same bits
};

// Returns the tick at which a run ends: one more than its duration has, so that the last instant is
// sampled too.
signals::Tick last_tick(const Experiment& experiment);

// What a run records, in the order of its table.
std::vector<signals::Topic> topics(const Experiment& experiment);

// Returns the topics that its log holds. Throws config::Error where a pattern matches no topic.
run::LoggedTopics logged_topics(const Experiment& experiment);

// A run, or the runs of a sweep, of which the table has one row per duty.
Outcome run(const Experiment& experiment, const RunOptions& options = {});

// Of the last five periods of a pulsed stand.
struct Settled {
  double duty = 0;                // commanded
  double length = 0, ripple = 0;  // mean, greatest less smallest [m]
  double pressure = 0;            // mean, absolute [Pa]
  double force = 0;               // mean [N]
  air::Failure failure;
};
std::vector<Settled> sweep(const Experiment& experiment, int threads);

}  // namespace sinew::rig
