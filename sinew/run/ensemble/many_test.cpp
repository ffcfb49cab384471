// Runs in batches have the results of runs in lanes: where memory is short, a launch fails or has
// wrong bits, and with runs that a batch cannot hold.
#include "sinew/run/ensemble/batches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/message.h"
#include "tests/places.h"

namespace sinew::run::many_test {
namespace {

// Short walks with different noise.
class Batches : public ::testing::Test {
 protected:
  static constexpr std::size_t rows = 9;

  using Run = std::function<void(const Many&)>;

  // Returns the figures of all rows, and NaN for those that are not done.
  std::vector<double> figures(const Run& run) const {
    std::vector<double> out(rows, std::nan(""));
    std::atomic<std::size_t> taken{0};
    const auto next = [&]() -> std::optional<std::size_t> {
      const std::size_t row = taken++;
      return row < rows ? std::optional(row) : std::nullopt;
    };
    const auto begin = [&](std::size_t row) {
      const std::vector<double> values = {1.0 + static_cast<double>(row)};
      return BegunRun{{std::shared_ptr<void>(), &walks_}, walks_.member(values)};
    };
    const auto done = [&](std::size_t row, const RunResult& result) {
      if (const double* figure = result.summary.find("air_used_kg")) out[row] = *figure;
    };
    run({.next = next, .begin = begin, .done = done});
    return out;
  }

  // Returns batches of four runs that are launched by `launch` in this memory, two in parallel.
  static Run batches(std::function<void(const Batched&)> launch, bool continues,
                     std::size_t memory = std::size_t{1} << 30) {
    return [=](const Many& many) {
      run_many_in_batches(many, {{launch, [=] { return memory; }}, 4, continues}, 2);
    };
  }

  static std::size_t done(const std::vector<double>& figures) {
    return static_cast<std::size_t>(
        std::ranges::count_if(figures, [](double x) { return !std::isnan(x); }));
  }

  const Ensemble walks_{test::source_dir() + "/experiments/walk-test-1.toml",
                        {"sequence.repeat=1"},
                        {"seed"},
                        {"air_used_kg"}};
  const std::vector<double> in_lanes_ = figures(run_many);
};

TEST_F(Batches, LittleMemoryTakesMoreLaunches) {
  EXPECT_EQ(done(in_lanes_), rows);
  for (const auto& [memory, launches] :
       {std::pair<std::size_t, std::size_t>{1 << 30, 3}, {1, rows}}) {
    std::size_t count = 0;
    const auto launch = [&](const Batched& batched) {
      ++count;
      launch_on_processor(batched);
    };
    EXPECT_EQ(figures(batches(launch, false, memory)), in_lanes_);
    EXPECT_EQ(count, launches);
  }
}

TEST_F(Batches, TheProcessorContinuesAfterAFailure) {
  int count = 0;
  const auto launch = [&](const Batched& batched) {
    if (++count == 2) throw std::runtime_error("the card failed");
    launch_on_processor(batched);
  };
  EXPECT_EQ(figures(batches(launch, true)), in_lanes_);
  EXPECT_EQ(count, 2) << "a card that has failed is not used again";
}

TEST_F(Batches, AFailureEndsTheRunsOfARequestedCard) {
  std::size_t launches = 0, ended = 0;
  const auto launch = [&](const Batched& batched) {
    if (++launches == 2) throw std::runtime_error("the card failed");
    launch_on_processor(batched);
  };
  const auto counted = [&](const Many& many) {
    std::atomic<std::size_t> count{0};
    Many its = many;
    its.done = [&](std::size_t, const RunResult&) { ended = ++count; };
    batches(launch, false)(its);
  };
  EXPECT_EQ(test::message([&] { (void)figures(counted); }), "the card failed");
  EXPECT_EQ(ended, 4u) << "those before the failure have their results";
}

// The results of a card with wrong bits are not replaced without notice.
TEST_F(Batches, WrongBitsEndTheRuns) {
  const auto launch = [](const Batched& batched) {
    launch_on_processor(batched);
    batched.sample[0] ^= 1;  // the first run has another value
  };
  for (const bool continues : {false, true})
    EXPECT_THROW((void)figures(batches(launch, continues)), WrongBits);
}

// Runs of other robots, stands, plans and faults are rows of the same table.
TEST(ManyInBatches, WhatABatchCannotHoldIsRunInLanes) {
  struct Case {
    const char* file;
    std::vector<std::string> sets;
    bool fits = false;
  };
  const std::vector<std::string> once = {"sequence.repeat=1"};
  const std::vector<Case> cases = {
      {"walk-test-1", once, true},
      {"leg-in-air", once, true},
      {"rig/pwm-50hz-1lb", {}},         // a stand
      {"ground-force", once},           // a plan that measures
      {"touchdown", {}},                // a phase that ends at a level
      {"faults/valve-stuck-open", {}},  // a fault
      {"walk-two-legs", once},
      {"walk-with-ankle", once},  // three links
      {"three-muscles", {}},
      {"walk-with-hoses", once},
      {"walk-with-regulators", once},
      {"walk-test-1",
       {"sequence.repeat=1", "actuator.bpa.loss.coulomb_scale=sealed"}},  // sealed friction
  };
  std::vector<std::string> files;
  for (const Case& c : cases)
    files.push_back(test::source_dir() + "/experiments/" + c.file + ".toml");
  Ensembles ensembles({"duration_s", "air_used_kg"});
  const auto table = [&](const std::function<void(const Many&)>& run) {
    std::vector<std::string> out(2 * cases.size());
    std::atomic<std::size_t> taken{0};
    run({.next = [&]() -> std::optional<std::size_t> {
           const std::size_t row = taken++;
           return row < out.size() ? std::optional(row) : std::nullopt;
         },
         .begin =
             [&](std::size_t row) {
               std::vector<std::string> sets = cases[row / 2].sets;
               sets.push_back("seed=" + std::to_string(row));
               return ensembles.begin(files[row / 2], sets);
             },
         .done =
             [&](std::size_t row, const RunResult& result) {
               out[row] = result.status;
               for (const char* key : {"duration_s", "air_used_kg"})
                 if (const double* figure = result.summary.find(key))
                   out[row] += fmt::format(" {:a}", *figure);
             }});
    return out;
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_EQ(fits_batch(ensembles.begin(files[i], cases[i].sets).member->experiment),
              cases[i].fits)
        << cases[i].file;
  experiment::Experiment two_boards = ensembles.begin(files[0], once).member->experiment;
  EXPECT_TRUE(fits_batch(two_boards));
  two_boards.robot.joints[1].board = 2;
  EXPECT_FALSE(fits_batch(two_boards));
  EXPECT_EQ(table([](const Many& many) {
              run_many_in_batches(many, {{launch_on_processor}, 12, false}, 2);
            }),
            table(run_many));
}

}  // namespace
}  // namespace sinew::run::many_test
