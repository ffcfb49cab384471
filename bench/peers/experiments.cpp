#include "bench/peers/experiments.h"

#include "sinew/run/controllers/boards.h"
#include "sinew/run/controllers/high_level.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/loop.h"

namespace sinew::bench {

namespace {

struct Nobody {
  void command(signals::Tick) noexcept {}
  void edge(const signals::Edge&) noexcept {}
  void sample(signals::Tick) noexcept {}
  signals::Tick next(signals::Tick t) const noexcept { return t + 1'000'000; }
};

}  // namespace

std::string experiment_file(const std::string& name) {
  return std::string(SINEW_SOURCE_DIR) + "/experiments/" + name;
}

const experiment::Experiment& walk() {
  static const experiment::Experiment e = experiment::load(experiment_file("walk-test-1.toml"));
  return e;
}

double drive(signals::Port& body, const experiment::Experiment& e) {
  const signals::Tick end = experiment::last_tick(e);
  run::Boards boards(run::boards_of(e));
  run::HighLevel high(e.robot, e.plan);
  run::SimulatedClock clock;
  Nobody nobody;
  run::loop(boards, high, body, clock, nobody, end);
  return static_cast<double>(end) * signals::tick_seconds;
}

}  // namespace sinew::bench
