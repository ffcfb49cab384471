// Runs on a graphics card have the bits of the processor. Skipped where no card can be used.
//
//   SINEW_GUARD_COUNT=100000   number of walks that are compared with the processor; default: 1,000
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "sinew/analysis/state_hash.h"
#include "sinew/host/side_by_side.h"
#include "sinew/run/card/on_card.h"
#include "sinew/run/ensemble/device.h"
#include "sinew/run/simulation/run.h"
#include "tests/graphics_card/walks.h"

namespace sinew::device_test {
namespace {

using run::BatchedRun;

class OnCard : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      device_ = run::chosen({.kind = run::Device::Kind::gpu});
    } catch (const std::runtime_error& e) {
      GTEST_SKIP() << e.what();
    }
  }

  // Returns the state hash of each run on the card; empty for one that the card leaves to the
  // processor.
  std::vector<std::string> hashes(const std::vector<BatchedRun>& runs) const {
    run::Card& card = *device_.card;
    std::vector<std::string> out(runs.size());
    run::run_batch(
        runs, {[&](const run::Batched& b) { card.launch(b); }, [&] { return card.memory(); }},
        threads_, [] { return false; },
        [&](std::size_t i, const run::Outcome& outcome) {
          out[i] = analysis::state_hash(outcome.table);
        });
    return out;
  }

  run::Device device_;
  int threads_ = host::threads_of(0);
};

TEST_F(OnCard, RunsHaveTheHashesOfTheFile) {
  const std::deque<test::HashedRun> all = test::hashed_runs();
  std::vector<BatchedRun> runs;
  for (const test::HashedRun& r : all) runs.push_back({&r.experiment, nullptr, r.name});
  const std::vector<std::string> found = hashes(runs);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(found[i], all[i].hash) << all[i].name;
}

TEST_F(OnCard, NoWalkDiffersFromTheProcessor) {
  const char* text = std::getenv("SINEW_GUARD_COUNT");
  const int count = text ? std::atoi(text) : 1000;
  const int at_a_time = static_cast<int>(std::min<std::size_t>(1024, device_.card->runs()));
  const test::VariedWalks walks;
  std::atomic<int> same{0};
  for (int first = 1; first <= count; first += at_a_time) {
    std::vector<std::unique_ptr<run::Ensemble::Member>> members;
    std::vector<BatchedRun> runs;
    for (int seed = first; seed <= std::min(count, first + at_a_time - 1); ++seed) {
      members.push_back(walks.walk(seed));
      runs.push_back({&members.back()->experiment, nullptr, walks.plan(seed)});
    }
    const std::vector<std::string> found = hashes(runs);
    host::side_by_side(
        runs.size(),
        [&](std::size_t i) {
          if (found[i].empty()) return;
          EXPECT_EQ(found[i], analysis::state_hash(run::run(*runs[i].experiment).table))
              << "seed " << first + static_cast<int>(i);
          ++same;
        },
        nullptr, threads_);
    if (HasFailure()) return;
  }
  EXPECT_GT(same, count * 9 / 10) << "the others were left to the processor";
  std::printf("device: %d walks on %s, none differs from the processor\n", same.load(),
              run::name_of(device_).c_str());
}

}  // namespace
}  // namespace sinew::device_test
