// Muscles and their valves alone, the body's motion given (drill.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/peers/drill.h"
#include "bench/peers/row.h"

namespace sinew::bench {

namespace {

constexpr int finer = 8;  // the limit: steps an eighth as long

double largest_difference(const Pressures& a, const Pressures& b) {  // relative
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::fabs(a[i] - b[i]) / std::fabs(b[i]));
  return most;
}

struct Side {
  Pressures coarse, fine;

  template <class Run>
  Side(const Drill& d, const Drill& small, const Run& run)
      : coarse(drill_machines * drill_muscles * drill_samples), fine(coarse) {
    run(d, &coarse);
    run(small, &fine);
  }
  Accuracy error(const std::string& of) const {
    return {of, "pressure, largest relative difference from steps of 12.5 us",
            largest_difference(coarse, fine), "1"};
  }
};

Row against_pow(const Drill& d, const Drill& small, const std::string& name,
                const std::string& what, std::optional<double> goal,
                Counts (*ours)(const Drill&, Pressures*), const Side& peer, int rounds) {
  const Side own(d, small, ours);
  Row row{.name = name, .what = what, .goal = goal, .per = "step of 100 us of one muscle"};
  row.accuracy = {own.error("sinew"),
                  peer.error("pow"),
                  {"both", "pressure, largest relative difference of the two limits",
                   largest_difference(own.fine, peer.fine), "1"}};
  return times_faster(row,
                      by_turns([&] { return ours(d, nullptr).steps; },
                               [&] { return by_pow(d, nullptr).steps; }, rounds, Clock::processor));
}

Row against_the_divider(const Drill& d, const Wide& wide, int rounds, bool widest) {
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
  const Drill d = drill(1), small = drill(finer);
  const Side peer(d, small, by_pow);
  const std::vector<Wide> wide = widths();
  std::vector<Row> rows;
  rows.push_back(against_pow(d, small, "actuator/pow-one-machine",
                             "RK4 step of one machine's four muscles in the machine's own lanes "
                             "against scalar RK4 with the C library's pow",
                             std::nullopt, by_network, peer, effort.rounds));
  for (const Wide& w : wide)
    rows.push_back(against_pow(d, small, fmt::format("actuator/pow-{}", w.width),
                               fmt::format("the same with {} machines side by side", w.width),
                               w.width == wide.back().width ? std::optional(10.0) : std::nullopt,
                               w.run, peer, effort.rounds));
  for (const Wide& w : wide)
    rows.push_back(against_the_divider(d, w, effort.rounds, w.width == wide.back().width));
  return rows;
}

}  // namespace sinew::bench
