// Runs as blocks of bytes have the same bits as alone: the source of graphics cards, compiled for
// the processor.
#include "sinew/run/card/batch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <vector>

#include "sinew/run/card/kernel.h"
#include "sinew/run/ensemble/ensemble.h"
#include "tests/places.h"

namespace sinew::run::batch_test {
namespace {

using experiment::Experiment;

template <class Samples>
void expect_same_samples(const Samples& a, const Samples& b, const std::string& topic) {
  ASSERT_EQ(a.size(), b.size()) << topic;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = a[i], y = b[i];
    ASSERT_EQ(std::memcmp(&x, &y, sizeof x), 0)
        << topic << ", sample " << i << ": " << x << ", " << y;
  }
}

// Compares all that a run has recorded, and its end.
void expect_same(const Outcome& a, const Outcome& b) {
  ASSERT_EQ(a.table.series.size(), b.table.series.size());
  for (std::size_t s = 0; s < a.table.series.size(); ++s) {
    const signals::Series &x = a.table.series[s], &y = b.table.series[s];
    ASSERT_EQ(x.topic.name, y.topic.name);
    expect_same_samples(x.time_ns, y.time_ns, x.topic.name);
    for (std::size_t c = 0; c < x.columns.size(); ++c)
      expect_same_samples(x.columns[c], y.columns[c], x.topic.name);
  }
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_EQ(a.unreachable_periods, b.unreachable_periods);
  EXPECT_EQ(a.changes.size(), b.changes.size());
  EXPECT_EQ(a.controller.late + a.controller.invalid, b.controller.late + b.controller.invalid);
  EXPECT_EQ(a.supervised.rejected, b.supervised.rejected);
}

// A parameter with sixteen values between two ends, in another order than those of other
// parameters.
struct Varied {
  std::string key;
  double low, high;  // in SI

  double of_set(int set, int number) const {
    return low + (high - low) * ((set * (2 * number + 3) + number) % 16) / 15.0;
  }
};

// Runs them on the processor, one after the other.
void launch_on_processor(const Batched& batched) {
  const Launch launch{
      batched.commands.data(),
      {batched.wanted.data(), static_cast<std::int32_t>(batched.wanted.size()), batched.samples,
       batched.edges, static_cast<std::int64_t>(batched.walks.size()), batched.sample.data(),
       batched.edge.data()}};
  for (std::size_t i = 0; i < batched.walks.size(); ++i)
    run_thread(batched.walks.data(), launch, static_cast<std::int64_t>(i),
               [](bool x) { return x; });
}

// 200 seeds with sixteen sets of parameters of all parts: body, contacts, air, controllers and
// plan.
TEST(Batch, WalksHaveTheBitsOfRunsAlone) {
  const std::vector<Varied> varied = {{"trolley.drag", 3, 5},
                                      {"trolley.payload", 0, 2},
                                      {"joint.hip.dry_friction", 0, 0.3},
                                      {"joint.knee.damping", 0, 0.4},
                                      {"foot.friction", 0.3, 1},
                                      {"ground.normal_stiffness", 2e4, 8e4},
                                      {"air.supply.pressure", 6e5, 9e5},
                                      {"muscle.hip_flexor.bladder_stiffness", 100, 600},
                                      {"control.stiffness.hip", 2, 6},
                                      {"joint.knee.angle_gain", 0.0008, 0.0016},
                                      {"phase.swing.duration", 1.2, 1.6}};
  std::vector<std::string> keys = {"seed"};
  for (const Varied& v : varied) keys.push_back(v.key);
  const Ensemble walks(test::source_dir() + "/experiments/walk-test-1.toml", {}, keys, {});
  std::vector<std::unique_ptr<Ensemble::Member>> members;
  for (int seed = 1; seed <= 200; ++seed) {
    std::vector<double> values = {static_cast<double>(seed)};
    for (std::size_t k = 0; k < varied.size(); ++k)
      values.push_back(varied[k].of_set(seed % 16, static_cast<int>(k)));
    members.push_back(walks.member(values));
  }
  std::vector<BatchedRun> runs;
  for (std::size_t i = 0; i < members.size(); ++i)
    runs.push_back({&members[i]->experiment, nullptr, std::to_string(i % 16)});
  std::atomic<int> held = 0;
  run_batch(
      runs, {launch_on_processor}, 2, [] { return false; },
      [&](std::size_t i, const Outcome& outcome) {
        ++held;
        expect_same(outcome, run(*runs[i].experiment));
      });
  EXPECT_GT(held, 190);  // the others are run by themselves
}

}  // namespace
}  // namespace sinew::run::batch_test
