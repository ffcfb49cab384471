#include "sinew/run/stand/run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "sinew/run/setup/failure.h"
#include "sinew/run/setup/planar_setup.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/loop.h"
#include "sinew/run/stand/faulty_setup.h"
#include "sinew/run/stand/recorder.h"

namespace sinew::rig {

using signals::Tick;

Tick last_tick(const Experiment& e) { return std::llround(e.duration / signals::tick_seconds) + 1; }

namespace {

// Length, pressure and force over the last five periods, tick by tick.
struct Watch {
  plant::Stand& stand;
  Tick from;
  Settled sum;
  double shortest = 1e9, longest = 0;
  std::int64_t count = 0;

  void command(Tick) noexcept {}
  void edge(const signals::Edge&) noexcept {}
  void sample(Tick t) noexcept {
    if (t < from) return;
    const plant::StandTruth x = stand.truth(static_cast<double>(t) * signals::tick_seconds);
    sum.length += x.length;
    sum.pressure += x.pressure;
    sum.force += x.force;
    shortest = std::min(shortest, x.length);
    longest = std::max(longest, x.length);
    ++count;
  }
  Tick next(Tick t) const noexcept { return t < from ? from : t + 1; }
};

Settled settled(Experiment e, double duty) {
  e.drive.duty = duty;
  e.drive.duties.clear();
  const Tick period = std::llround(e.drive.period / signals::tick_seconds);
  const Tick end = std::llround(e.duration / signals::tick_seconds) / period * period;
  plant::Stand stand(faulty_setup_of(e));
  Controller controller(e, end);
  Wishes wishes(e);
  run::SimulatedClock clock;
  Watch watch{.stand = stand, .from = std::max<Tick>(0, end - 5 * period), .sum = {}};
  run::loop(controller, wishes, stand, clock, watch, end);
  const auto n = static_cast<double>(watch.count);
  return {.duty = duty,
          .length = watch.sum.length / n,
          .ripple = watch.longest - watch.shortest,
          .pressure = watch.sum.pressure / n,
          .force = watch.sum.force / n,
          .failure = stand.failure()};
}

signals::Table table_of(const Experiment& e, const std::vector<Settled>& all) {
  signals::Table table;
  double Settled::*const which[] = {&Settled::duty, &Settled::length, &Settled::ripple,
                                    &Settled::pressure, &Settled::force};
  std::size_t c = 0;
  for (const signals::Topic& topic : topics(e)) {
    signals::Series s{topic, {}, {{}}};
    for (std::size_t i = 0; i < all.size(); ++i) {
      s.time_ns.push_back(std::llround(1e9 * e.duration) * static_cast<std::int64_t>(i + 1));
      s.columns[0].push_back(all[i].*which[c]);
    }
    table.series.push_back(std::move(s));
    ++c;
  }
  return table;
}

}  // namespace

std::vector<signals::Topic> topics(const Experiment& e) {
  std::vector<signals::Topic> out;
  if (e.sweep.step > 0) {
    out.push_back({"/sweep/duty", "commanded, one stand each", {{"value", "1"}}});
    out.push_back({"/true/sweep/length", "mean of the last five periods", {{"value", "m"}}});
    out.push_back({"/true/sweep/ripple", "of the length in them", {{"value", "m"}}});
    out.push_back({"/true/sweep/pressure", "mean, absolute", {{"value", "Pa"}}});
    out.push_back({"/true/sweep/force", "mean, on the load", {{"value", "N"}}});
    return out;
  }
  for (Column& c : columns(e)) out.push_back(std::move(c.topic));
  for (signals::Topic& t : valve_topics(e)) out.push_back(std::move(t));
  return out;
}

run::LoggedTopics logged_topics(const Experiment& e) {
  return run::logged_topics(topics(e), e.log.channels, e.origins, e.path);
}

std::vector<Settled> sweep(const Experiment& e, int threads) {
  const auto count =
      static_cast<std::size_t>(std::floor((e.sweep.to - e.sweep.from) / e.sweep.step + 1e-9)) + 1;
  std::vector<Settled> out(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++)
      out[i] = settled(e, e.sweep.from + static_cast<double>(i) * e.sweep.step);
  };
  const unsigned all = threads > 0 ? static_cast<unsigned>(threads)
                                   : std::max(1u, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < all; ++i) others.emplace_back(work);
    work();
  }
  return out;
}

std::string cause_of(const Experiment& e, const Outcome& outcome) {
  if (!outcome.failure) return "a fault of a transducer";
  actuator::Actuator actuator;
  for (const actuator::Actuator& a : e.actuators)
    if (a.name == e.element.actuator) actuator = a;
  return run::in_words(outcome.failure, "element " + e.element.name, actuator, "step");
}

Outcome run(const Experiment& e, const RunOptions& options) {
  const auto before = std::chrono::steady_clock::now();
  Outcome out;
  out.duration = e.duration;
  if (e.sweep.step > 0) {
    const std::vector<Settled> all = sweep(e, options.threads);
    for (const Settled& s : all)
      if (!out.failure) out.failure = s.failure;
    out.table = table_of(e, all);
  } else {
    const Tick end = last_tick(e);
    plant::Stand stand(faulty_setup_of(e));
    Controller controller(e, end);
    Wishes wishes(e);
    Recorder recorder(e, controller, stand, end, options.every_tick);
    run::SimulatedClock clock;
    out.status = run::loop(controller, wishes, stand, clock, recorder, end);
    if (controller.seen().fault != signals::Status::ok) out.status = controller.seen().fault;
    out.failure = stand.failure();
    out.table = recorder.take();
    out.nodes = stand.nodes();
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;
  out.wall = wall.count();
  return out;
}

}  // namespace sinew::rig
