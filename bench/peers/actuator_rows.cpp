// Muscles and their valves without a body; the motion is given (drill.h).
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/peers/drill.h"
#include "bench/peers/pair.h"

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
  DrillFunction run_drill;
  Pressures limit;

  explicit Side(DrillFunction how) : run_drill(how), limit(pressures_of(how, drill(finer))) {}

  double error(const Drill& d) const {
    return largest_difference(pressures_of(run_drill, d), limit);
  }
  // Returns the longest steps with an error of at most `exact`.
  int stride(double exact) const {
    for (const int s : strides)
      if (error(drill(1, s)) <= exact) return s;
    return 1;
  }
};

// Returns errors of both sides with these steps, and the difference of their limits.
std::map<std::string, double> errors(const Side& own, const Drill& mine, const Side& peer,
                                     const Drill& other) {
  return {{"our_error", own.error(mine)},
          {"their_error", peer.error(other)},
          {"limits_differ", largest_difference(own.limit, peer.limit)}};
}

// Compares both with steps of one tick, by the step of one muscle.
Pair step_for_step(DrillFunction ours, const std::string& label) {
  const Side own(ours), peer(by_pow);
  const Drill d = drill(1);
  return {.ours = [=] { return ours(d, nullptr).steps; },
          .theirs = [=] { return by_pow(d, nullptr).steps; },
          .label = label,
          .figures = errors(own, d, peer, d)};
}

// Compares both, each with its own steps in ticks, by the simulated second of one muscle.
Pair second_for_second(const Side& own, int mine, const Side& peer, int other,
                       const std::string& label) {
  const Drill a = drill(1, mine), b = drill(1, other);
  return {.ours = [=, ours = own.run_drill] { return ours(a, nullptr).seconds; },
          .theirs = [=, theirs = peer.run_drill] { return theirs(b, nullptr).seconds; },
          .label = fmt::format("{} (steps of {:g} and {:g} ms)", label, 0.1 * mine, 0.1 * other),
          .figures = errors(own, a, peer, b)};
}

Pair against_the_divider(const Wide& wide) {
  const Drill d = drill(1);
  const Counts counts = wide.run(d, nullptr);
  const double packs = counts.steps / wide.width;
  const auto bound = [=] {
    benchmark::DoNotOptimize(wide.divide(static_cast<std::int64_t>(counts.divisions),
                                         static_cast<std::int64_t>(counts.roots)));
    return counts.steps;
  };
  return {
      .ours = [=] { return wide.run(d, nullptr).steps; },
      .theirs = bound,
      .label = fmt::format("a step, against its divisions and square roots back to back, {:.2f} "
                           "and {:.2f} of a pack",
                           counts.divisions / packs, counts.roots / packs)};
}

const Registration rows([] {
  compare("actuator/pow-one-machine", [] {
    return step_for_step(by_network, "a step of one machine's four muscles, against scalar pow");
  });
  for (const Wide& wide : widths()) {
    compare(fmt::format("actuator/pow-{}", wide.width), [wide] {
      return step_for_step(wide.run, fmt::format("the same with {} machines", wide.width));
    });
    compare(fmt::format("actuator/divider-{}", wide.width),
            [wide] { return against_the_divider(wide); });
  }
  compare("actuator/pow-as-used", [] {
    return second_for_second(Side(by_network), machine_stride, Side(by_pow), pow_stride,
                             "one machine's muscles by its nodes, against scalar pow by ticks");
  });
  compare("actuator/pow-as-used-lanes", [] {
    return second_for_second(Side(widths().back().run), machine_stride, Side(by_pow), pow_stride,
                             "the same, ours in the processor's lanes");
  });
  compare("actuator/pow-1e-4", [] {
    const Side own(by_network), peer(by_pow);
    return second_for_second(own, own.stride(1e-4), peer, peer.stride(1e-4),
                             "both by the longest steps that keep pressures to 1e-4");
  });
});

}  // namespace

}  // namespace sinew::bench
