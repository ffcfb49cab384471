// Comparison of two threads with one, by wall time.
#include <numeric>
#include <string>
#include <vector>

#include "bench/peers/experiments.h"
#include "bench/peers/row.h"
#include "sinew/tune/sweep.h"

namespace sinew::bench {

namespace {

constexpr int walks = 64;  // of one sweep

// Returns the results by point, which do not depend on the number of threads.
std::vector<std::string> sweep(const tune::Runner& runner, int threads) {
  std::vector<std::size_t> points(walks);
  std::iota(points.begin(), points.end(), std::size_t{0});
  std::vector<std::string> rows(walks);
  runner.run(points, threads, [&](const tune::Row& row) {
    for (const std::string& cell : row.cells) rows[row.point] += cell + ",";
  });
  return rows;
}

}  // namespace

std::vector<Row> thread_rows(const Effort& effort) {
  const tune::Sweep s{.experiment = experiment_file("walk-test-1.toml"),
                      .axes = {tune::seeds(walks)},
                      .report = tune::parse_figures("trolley.distance_m")};
  const tune::Runner runner(s);
  Row row{.name = "threads/two",
          .what = "a sweep of walks on two threads against one, wall time",
          .goal = 1.85,
          .per = "walk"};
  const bool same = sweep(runner, 2) == sweep(runner, 1);
  row.accuracy = {{"both", "rows of the sweep that are the same to the last digit",
                   same ? 1.0 * walks : 0.0, "of 64"}};
  Row work{.name = "threads/work",
           .what =
               "processor time of the same, two threads together against one: what they cost "
               "each other",
           .per = "walk"};
  const Work two = [&] { return static_cast<double>(sweep(runner, 2).size()); };
  const Work one = [&] { return static_cast<double>(sweep(runner, 1).size()); };
  return {times_faster(row, by_turns(two, one, effort.rounds, Clock::wall)),
          times_slower(work, by_turns(two, one, effort.rounds, Clock::all_threads))};
}

}  // namespace sinew::bench
