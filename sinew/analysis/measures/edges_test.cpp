// The first difference of two trains of edges is found: a time, a direction or an additional edge.
#include "sinew/analysis/measures/valves.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace sinew::analysis::edges_test {
namespace {

signals::Series train(const std::string& topic, std::mt19937_64& random, int edges) {
  signals::Series s{{topic, "", {{"value", "1"}}}, {}, {{}}};
  std::int64_t time = 0;
  for (int i = 0; i < edges; ++i) {
    time += 1 + static_cast<std::int64_t>(random() % 5'000'000);
    s.time_ns.push_back(time);
    s.columns[0].push_back(i % 2 == 0 ? 1 : 0);
  }
  return s;
}

signals::Table machine(std::mt19937_64& random) {
  signals::Table out;
  for (const char* valve : {"/valve/a/inlet/open", "/valve/a/exhaust/open", "/valve/b/inlet/open"})
    out.series.push_back(train(valve, random, 40));
  return out;
}

template <class Samples>
Samples without(const Samples& samples, std::size_t left_out) {
  Samples out;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (i != left_out) out.push_back(samples[i]);
  return out;
}

TEST(CompareEdges, EqualTrainsAreEqualAndCounted) {
  std::mt19937_64 random(1);
  const signals::Table table = machine(random);
  const EdgeComparison c = compare_edges(table, table);
  EXPECT_EQ(c.recorded, 120u);
  EXPECT_EQ(c.replayed, 120u);
  EXPECT_FALSE(c.first);
}

TEST(CompareEdges, AnyOneChangeIsFoundWhereItIs) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const signals::Table recorded = machine(random);
    signals::Table replayed = recorded;
    signals::Series& s = replayed.series[random() % 3];
    const std::size_t i = random() % 40;
    const std::int64_t was = s.time_ns[i];
    switch (trial % 3) {
      case 0:
        s.time_ns.set(i, was - 1);
        break;
      case 1:
        s.columns[0].set(i, 1 - s.columns[0][i]);
        break;
      default:
        s.time_ns = without(s.time_ns, i);
        s.columns[0] = without(s.columns[0], i);
    }
    const EdgeComparison c = compare_edges(recorded, replayed);
    ASSERT_TRUE(c.first);
    EXPECT_EQ(c.first->topic, s.topic.name);
    EXPECT_EQ(c.first->time_ns, trial % 3 == 0 ? was - 1 : was);
    EXPECT_NE(c.first->recorded, c.first->replayed);
  }
}

TEST(CompareEdges, ALogThatWasCutOffIsComparedAsFarAsAllOfItGoes) {
  std::mt19937_64 random(3);
  const signals::Table whole = machine(random);
  signals::Table cut = whole;
  cut.complete = false;
  const std::int64_t end = whole.series[0].time_ns[20];
  cut.series.push_back({{"/sensor/s/count", "", {{"value", "count"}}}, {0, end}, {{0, 0}}});
  for (signals::Series& s : cut.series)
    while (!s.time_ns.empty() && s.time_ns.back() > end) {
      s.time_ns.pop_back();
      s.columns[0].pop_back();
    }
  EXPECT_FALSE(compare_edges(cut, whole).first);
  EXPECT_LT(compare_edges(cut, whole).replayed, 120u);
  cut.complete = true;
  EXPECT_TRUE(compare_edges(cut, whole).first);
}

TEST(CompareEdges, AValveThatTheLogLacksIsAnError) {
  std::mt19937_64 random(4);
  const signals::Table all = machine(random);
  signals::Table fewer = all;
  fewer.series.pop_back();
  EXPECT_THROW((void)compare_edges(fewer, all), std::invalid_argument);
  EXPECT_NO_THROW((void)compare_edges(all, fewer));
}

TEST(CompareEdges, MovedAndLoneEdgesAreCountedByValve) {
  std::mt19937_64 random(4);
  signals::Table recorded = machine(random);
  signals::Series& s = recorded.series[1];
  for (std::size_t i = 0; i < s.time_ns.size(); ++i)  // far apart, so that each has one partner
    s.time_ns.set(i, 20'000'000 * static_cast<std::int64_t>(i + 1));
  signals::Table replayed = recorded;
  signals::Series& r = replayed.series[1];
  r.time_ns.set(3, r.time_ns[3] + 400'000);
  r.time_ns.set(8, r.time_ns[8] - 1'000'000);
  r.time_ns = without(r.time_ns, 39);
  r.columns[0] = without(r.columns[0], 39);
  const EdgeComparison c = compare_edges(recorded, replayed);
  EXPECT_EQ(c.valves[0].differing(), 0u);
  EXPECT_EQ(c.valves[2].differing(), 0u);
  const ValveEdges& v = c.valves[1];
  EXPECT_EQ(v.topic, "/valve/a/exhaust/open");
  EXPECT_EQ(v.moved, 2u);
  EXPECT_EQ(v.only_recorded, 1u);
  EXPECT_EQ(v.only_replayed, 0u);
  EXPECT_DOUBLE_EQ(v.largest_move, -0.001);
  EXPECT_DOUBLE_EQ(v.mean_move, -0.0003);
}

}  // namespace
}  // namespace sinew::analysis::edges_test
