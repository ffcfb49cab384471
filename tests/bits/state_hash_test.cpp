// State hashes of reference runs: those in docs/reliability.md, alone, in lanes and in threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <fstream>
#include <functional>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "sinew/analysis/state_hash.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::state_hash_test {
namespace {

struct ReferenceRun {
  std::string name, hash;
  experiment::Experiment experiment;
};

// Reads the table, whose rows are "| `walk-test-1` | `0123456789abcdef` |".
std::deque<ReferenceRun> reference_runs() {
  std::deque<ReferenceRun> out;
  std::ifstream docs(sinew::test::source_dir() + "/docs/reliability.md");
  const std::regex row("\\| `([a-z0-9/-]+)` \\| `([0-9a-f]{16})` \\|");
  std::smatch match;
  for (std::string line; std::getline(docs, line);)
    if (std::regex_match(line, match, row))
      out.push_back({match[1], match[2],
                     experiment::load(sinew::test::source_dir() + "/experiments/" + match[1].str() +
                                      ".toml")});
  return out;
}

std::string hash_of(const run::Outcome& outcome) { return analysis::state_hash(outcome.table); }

// Runs all of them in lanes of one thread, and compares their hashes.
void compare_in_lanes(const std::deque<ReferenceRun>& runs, int lanes) {
  std::size_t next = 0;
  run::run_in_lanes(
      {.next = [&] { return next < runs.size() ? &runs[next++].experiment : nullptr; },
       .done =
           [&](const experiment::Experiment& e, const run::Outcome& outcome,
               const std::exception_ptr& thrown) {
             EXPECT_FALSE(thrown);
             const auto is_its = [&](const ReferenceRun& r) { return &r.experiment == &e; };
             const ReferenceRun& r = *std::ranges::find_if(runs, is_its);
             EXPECT_EQ(hash_of(outcome), r.hash) << r.name << ", lanes: " << lanes;
           },
       .most = lanes});
}

TEST(StateHash, OfReferenceRunsAreThoseOfTheDocs) {
  const std::deque<ReferenceRun> runs = reference_runs();
  EXPECT_EQ(runs.size(), 12u);
  for (const ReferenceRun& r : runs)
    EXPECT_EQ(hash_of(run::run(r.experiment)), r.hash) << r.name << ", alone";
}

TEST(StateHash, IsTheSameInLanesAndThreads) {
  const std::deque<ReferenceRun> runs = reference_runs();
  std::vector<std::thread> threads;
  for (const int lanes : {2, 4, 8}) threads.emplace_back(compare_in_lanes, std::cref(runs), lanes);
  for (std::thread& thread : threads) thread.join();
}

TEST(StateHash, OfAnotherSeedDiffers) {
  const std::string walk = sinew::test::source_dir() + "/experiments/walk-test-1.toml";
  const auto hash = [&](const std::string& seed) {
    return hash_of(run::run(experiment::load(walk, {"seed=" + seed, "sequence.repeat=1"})));
  };
  EXPECT_EQ(hash("1"), hash("1"));
  EXPECT_NE(hash("1"), hash("2"));
}

}  // namespace
}  // namespace sinew::state_hash_test
