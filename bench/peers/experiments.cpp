#include "bench/peers/experiments.h"

#include <exception>

#include "sinew/run/controllers/boards.h"
#include "sinew/run/controllers/high_level.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/lanes.h"
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

std::vector<experiment::Experiment> walks(int count) {
  std::vector<experiment::Experiment> out(static_cast<std::size_t>(count), walk());
  for (int i = 0; i < count; ++i) out[static_cast<std::size_t>(i)].seed = i + 1;
  return out;
}

double in_lanes(const std::vector<experiment::Experiment>& each, int lanes, bool recorded) {
  std::size_t next = 0;
  run::run_in_lanes(
      {.next = [&] { return next < each.size() ? &each[next++] : nullptr; },
       .done = [](const experiment::Experiment&, const run::Outcome&, const std::exception_ptr&) {},
       .most = lanes,
       .recorded = recorded});
  return static_cast<double>(each.size());
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
