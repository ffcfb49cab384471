// Runs as blocks of bytes have the same bits as alone: the source of graphics cards, compiled for
// the processor.
#include "sinew/run/card/batch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <vector>

#include "tests/graphics_card/walks.h"

namespace sinew::run::batch_test {
namespace {

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
  EXPECT_EQ(a.took_air, b.took_air);
}

// Compares walks of these seeds, which record these topics (nullptr: all), with runs alone. Returns
// the number of those that a batch has held.
int compare_walks(const test::VariedWalks& walks, int first, int last,
                  const signals::TopicNames* topics) {
  std::vector<std::unique_ptr<Ensemble::Member>> members;
  std::vector<BatchedRun> runs;
  for (int seed = first; seed <= last; ++seed) {
    members.push_back(walks.walk(seed));
    runs.push_back({&members.back()->experiment, topics, walks.plan(seed)});
  }
  std::atomic<int> held = 0;
  run_batch(
      runs, {launch_on_processor}, 2, [] { return false; },
      [&](std::size_t i, const Outcome& outcome) {
        ++held;
        expect_same(outcome, run(*runs[i].experiment, {.topics = topics}));
      });
  return held;
}

TEST(Batch, WalksHaveTheBitsOfRunsAlone) {
  const test::VariedWalks walks;
  int held = compare_walks(walks, 1, 16, nullptr);
  // The motion, all readings and all edges of the others.
  signals::TopicNames topics;
  for (const signals::Topic& topic : run::topics(walks.walk(1)->experiment))
    if (topic.name.starts_with("/sensor/") || topic.name.starts_with("/plan/") ||
        topic.name == "/true/trolley/position" || signals::is_of_valve(topic.name))
      topics.insert(topic.name);
  ASSERT_GT(topics.size(), 15u);
  held += compare_walks(walks, 17, 200, &topics);
  EXPECT_GT(held, 190);  // the others are run by themselves
}

}  // namespace
}  // namespace sinew::run::batch_test
