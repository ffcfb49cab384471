// Muscles and their valves without a body; the motion is given (drill.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/peers/drill.h"
#include "bench/peers/row.h"

namespace sinew::bench {

namespace {

using DrillFunction = Counts (*)(const Drill&, Pressures*);

constexpr int finer = 8;                            // the limit: steps of an eighth of a tick
constexpr int strides[] = {50, 20, 10, 5, 2, 1};    // [ticks]
constexpr int machine_stride = 10, pow_stride = 1;  // step of our machines, and of other programs

double largest_difference(const Pressures& a, const Pressures& b) {  // relative
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::fabs(a[i] - b[i]) / std::fabs(b[i]));
  return most;
}

Pressures pressures_of(DrillFunction run_drill, const Drill& d) {
  Pressures p(drill_machines * drill_muscles * drill_samples);
  run_drill(d, &p);
  return p;
}

// One implementation of the drill and its limit for small steps.
struct Side {
  std::string name;
  DrillFunction run_drill;
  Pressures limit;

  Side(const std::string& of, DrillFunction how)
      : name(of), run_drill(how), limit(pressures_of(how, drill(finer))) {}

  double error(const Drill& d) const {
    return largest_difference(pressures_of(run_drill, d), limit);
  }
  Accuracy accuracy(const Drill& d) const {
    return {name, "pressure, largest relative difference from steps of 12.5 us", error(d), "1"};
  }
  // Returns the longest steps with an error of at most `exact`.
  int stride(double exact) const {
    for (const int s : strides)
      if (error(drill(1, s)) <= exact) return s;
    return 1;
  }
};

std::vector<Accuracy> accuracies(const Side& own, const Drill& mine, const Side& peer,
                                 const Drill& other) {
  return {own.accuracy(mine),
          peer.accuracy(other),
          {"both", "pressure, largest relative difference of the two limits",
           largest_difference(own.limit, peer.limit), "1"}};
}

// Compares both with steps of one tick.
Row step_for_step(Row row, const Side& own, const Side& peer, int rounds) {
  const Drill d = drill(1);
  row.per = "step of 100 us of one muscle";
  row.accuracy = accuracies(own, d, peer, d);
  return times_faster(std::move(row), by_turns([&] { return own.run_drill(d, nullptr).steps; },
                                               [&] { return peer.run_drill(d, nullptr).steps; },
                                               rounds, Clock::processor));
}

// Compares both, each with its own steps.
Row second_for_second(Row row, const Side& own, int mine, const Side& peer, int other, int rounds) {
  const Drill a = drill(1, mine), b = drill(1, other);
  row.per = "simulated second of one muscle";
  row.what += fmt::format(" (steps of {:g} and {:g} ms)", 0.1 * mine, 0.1 * other);
  row.accuracy = accuracies(own, a, peer, b);
  return times_faster(std::move(row), by_turns([&] { return own.run_drill(a, nullptr).seconds; },
                                               [&] { return peer.run_drill(b, nullptr).seconds; },
                                               rounds, Clock::processor));
}

Row against_the_divider(const Wide& wide, int rounds, bool widest) {
  const Drill d = drill(1);
  const Counts counts = wide.run(d, nullptr);
  const double packs = counts.steps / wide.width;
  Row row{.name = fmt::format("actuator/divider-{}", wide.width),
          .what = fmt::format("RK4 step of {} machines' muscles side by side against the divisions "
                              "and square roots in it, {:.2f} and {:.2f} for a pack, back to back",
                              wide.width, counts.divisions / packs, counts.roots / packs),
          .per = "step of 100 us of one muscle"};
  if (widest) row.goal = 1.5;
  volatile double sink = 0;
  const auto bound = [&] {
    sink = wide.divide(static_cast<std::int64_t>(counts.divisions),
                       static_cast<std::int64_t>(counts.roots));
    return counts.steps;
  };
  return times_slower(
      row, by_turns([&] { return wide.run(d, nullptr).steps; }, bound, rounds, Clock::processor));
}

}  // namespace

std::vector<Row> actuator_rows(const Effort& effort) {
  const Side peer("pow", by_pow), alone("sinew", by_network);
  const std::vector<Wide> wide = widths();
  const int rounds = effort.rounds;
  std::vector<Row> rows;
  rows.push_back(step_for_step({.name = "actuator/pow-one-machine",
                                .what = "RK4 step of one machine's four muscles in the machine's "
                                        "own lanes against scalar RK4 with the C library's pow"},
                               alone, peer, rounds));
  for (const Wide& w : wide)
    rows.push_back(
        step_for_step({.name = fmt::format("actuator/pow-{}", w.width),
                       .what = fmt::format("the same with {} machines side by side", w.width),
                       .goal = w.width == wide.back().width ? std::optional(10.0) : std::nullopt},
                      Side("sinew", w.run), peer, rounds));
  rows.push_back(second_for_second({.name = "actuator/pow-as-used",
                                    .what = "one machine's muscles by a machine's nodes against "
                                            "scalar pow RK4 at the controller's tick",
                                    .goal = 10.0},
                                   alone, machine_stride, peer, pow_stride, rounds));
  rows.push_back(second_for_second({.name = "actuator/pow-as-used-lanes",
                                    .what = "the same, ours side by side in the processor's lanes",
                                    .goal = 10.0},
                                   Side("sinew", wide.back().run), machine_stride, peer, pow_stride,
                                   rounds));
  rows.push_back(second_for_second(
      {.name = "actuator/pow-1e-4",
       .what = "one machine's muscles, both by the longest steps that keep pressures to 1e-4"},
      alone, alone.stride(1e-4), peer, peer.stride(1e-4), rounds));
  for (const Wide& w : wide) rows.push_back(against_the_divider(w, rounds, &w == &wide.back()));
  return rows;
}

}  // namespace sinew::bench
