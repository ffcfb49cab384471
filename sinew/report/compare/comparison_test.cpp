#include "sinew/report/compare/comparison.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sinew/config/compose.h"
#include "sinew/report/page/test_run.h"
#include "tests/places.h"

namespace sinew::report::comparison_test {
namespace {

using Json = nlohmann::ordered_json;

const std::string experiments = sinew::test::source_dir() + "/experiments/";

config::Node resolved(const std::vector<std::string>& sets = {}) {
  return config::compose(experiments + "walk-test-1.toml", sets);
}

signals::Table table() { return test::walking(analysis::read_machine(resolved())); }

signals::Column& values(signals::Table& table, const std::string& topic) {
  for (signals::Series& s : table.series)
    if (s.topic.name == topic) return s.columns[0];
  throw std::invalid_argument(topic);
}

void add(double what, signals::Column& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to.set(i, to[i] + what);
}

Comparison two(signals::Table a, signals::Table b, const std::vector<std::string>& sets = {},
               Align align = Align::start) {
  std::vector<NamedRun> runs;
  runs.push_back({"one", std::move(a), resolved()});
  runs.push_back({"other", std::move(b), resolved(sets)});
  return compare(std::move(runs), align);
}

const Json& panel(const Json& page, const std::string& topic) {
  for (const Json& p : page["panels"])
    if (p["topic"] == topic) return p;
  throw std::invalid_argument(topic);
}

std::vector<std::string> keys(const std::vector<ParameterRow>& rows) {
  std::vector<std::string> out;
  for (const ParameterRow& row : rows) out.push_back(row.key);
  return out;
}

TEST(Comparison, OfARunWithItselfIsNothing) {
  const Comparison c = two(table(), table());
  EXPECT_TRUE(c.parameters.empty());
  for (const analysis::FigureRow& row : c.figures)
    EXPECT_EQ(row.values[0], row.values[1]) << row.key;
  EXPECT_GT(c.channels.size(), 20u);
  for (const ChannelRow& row : c.channels) {
    EXPECT_FALSE(row.differences[0]);
    EXPECT_TRUE(row.differences[1]->same) << row.channel.topic;
  }
}

TEST(Comparison, AChangedGainShowsExactlyItsKey) {
  const Comparison c = two(table(), table(), {"control.gains.hip.angle=0.001 1/count"});
  EXPECT_EQ(keys(c.parameters), std::vector<std::string>{"control.gains.hip.angle"});
  EXPECT_NE(c.parameters[0].values[0], c.parameters[0].values[1]);
}

TEST(Comparison, TitlesAndSourcesAreNoParameters) {
  EXPECT_TRUE(two(table(), table(), {"title=Another", "reproduces=nothing"}).parameters.empty());
  std::vector<Parameter> a = {{.key = "x", .value = "1 m", .source = "here"}},
                         b = {{.key = "x", .value = "1 m", .mark = "guess", .source = "there"}};
  EXPECT_TRUE(differing({&a, &b}).empty());
  b.push_back({.key = "y", .value = "2 m"});
  const auto rows = differing({&a, &b});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].values[0]) << "the first one has no such key";
}

TEST(Comparison, DerivedChannelsFollowWhatTheyComeFrom) {
  signals::Table b = table();
  add(0.1, values(b, "/joint/hip/angle"));
  const Comparison c = two(table(), std::move(b));
  for (const ChannelRow& row : c.channels) {
    const bool follows =
        row.channel.topic == "/foot/position" || row.channel.topic == "/foot/force" ||
        row.channel.topic == "/joint/hip/angle" || row.channel.topic == "/joint/hip/error" ||
        row.channel.topic == "/joint/hip/oscillation" ||
        row.channel.topic.starts_with("/trolley/") || row.channel.topic == "/joint/hip/torque";
    EXPECT_TRUE(follows || row.differences[1]->same) << row.channel.topic;
    if (row.channel.topic == "/joint/hip/error") {
      EXPECT_NEAR(row.differences[1]->largest, 0.1, 1e-12);
    }
  }
}

TEST(Comparison, SequencesAreLaidOnEachOther) {
  signals::Table late = table();
  analysis::shift(late, -250'000'000);
  const Comparison apart = two(table(), late), laid = two(table(), late, {}, Align::sequence);
  EXPECT_EQ(laid.runs[1].shift, 0.25);
  EXPECT_EQ(laid.runs[1].first, laid.runs[0].first);
  for (const ChannelRow& row : laid.channels)
    EXPECT_TRUE(row.differences[1]->same) << row.channel.topic;
  EXPECT_FALSE(apart.channels.front().differences[1]->same);
}

TEST(Comparison, ReportsWhatCannotBeCompared) {
  const auto message = [](auto does) -> std::string {
    try {
      does();
    } catch (const config::Error& e) {
      return e.what();
    }
    return "";
  };
  signals::Table without = table();
  std::erase_if(without.series,
                [](const signals::Series& s) { return s.topic.name.starts_with("/plan"); });
  EXPECT_NE(message([&] { two(table(), without, {}, Align::sequence); }).find("align=start"),
            std::string::npos);
  EXPECT_NE(message([&] { two(table(), {}); }).find("no channel that one has too"),
            std::string::npos);
}

// --- the page's part ---

TEST(Comparison, HasAPlotForEveryLineThatBothHave) {
  signals::Table b = table();
  std::erase_if(b.series, [](const signals::Series& s) {  // the true one would replace it
    return s.topic.name == "/joint/hip/angle" || s.topic.name == "/true/joint/hip/angle";
  });
  const Json page = Json::parse(content(two(table(), std::move(b))).json);
  EXPECT_THROW(panel(page, "/joint/hip/angle"), std::invalid_argument);
  EXPECT_EQ(panel(page, "/joint/knee/angle")["columns"].size(), 2u);
  EXPECT_EQ(page["foot"], "");  // unknown without the hip's angle
}

TEST(Comparison, KeepsOneColumnOfWhatIsTheSame) {
  signals::Table b = table();
  add(1e-9, values(b, "/joint/hip/angle"));
  values(b, "/joint/knee/angle").set(5, std::nan(""));
  const Content made = content(two(table(), std::move(b)));
  const Json page = Json::parse(made.json);

  const Json same = panel(page, "/true/joint/hip/angle");
  EXPECT_EQ(same["columns"][0], same["columns"][1]);
  EXPECT_TRUE(same["differences"][1].is_null());
  // Small differences are stored separately, because they are lost in the digits of the values.
  const Json shifted = panel(page, "/joint/hip/angle");
  EXPECT_TRUE(shifted["columns"][1].is_null());
  EXPECT_TRUE(shifted["differences"][1].is_number());
  // A gap of the other run alone is a gap of the difference.
  EXPECT_TRUE(panel(page, "/joint/knee/angle")["columns"][1].is_null());

  const std::size_t columns = page["samples"]["columns"].size();
  for (const Json& p : page["panels"])
    for (const char* of : {"columns", "differences"})
      for (const Json& column : p[of]) EXPECT_TRUE(column.is_null() || column < columns);
}

TEST(Comparison, KeepsBothColumnsWhereASumWouldNotDo) {
  signals::Table a = table(), b = table();
  values(a, "/joint/knee/angle").set(5, std::nan(""));
  for (signals::Series& s : b.series)
    if (s.topic.name == "/joint/hip/angle") s.time_ns.pop_back(), s.columns[0].pop_back();
  const Json page = Json::parse(content(two(std::move(a), std::move(b))).json);
  for (const char* topic : {"/joint/knee/angle", "/joint/hip/angle"}) {
    EXPECT_TRUE(panel(page, topic)["columns"][1].is_number()) << topic;
    EXPECT_TRUE(panel(page, topic)["differences"][1].is_number()) << topic;
  }
}

TEST(Comparison, ShowsTheFootAsAllRunsKnowIt) {
  const auto foot = [](bool third_knows) {
    std::vector<NamedRun> runs;
    for (int i = 0; i < 3; ++i) {
      signals::Table t = table();
      signals::Series truth = *t.find("/desired/foot/position");
      truth.topic.name = "/true/foot/position";
      if (i < 2 || third_knows) t.series.push_back(std::move(truth));
      runs.push_back({std::to_string(i), std::move(t), resolved()});
    }
    return Json::parse(content(compare(std::move(runs), Align::start)).json)["foot"];
  };
  EXPECT_EQ(foot(true), "/true/foot/position");
  EXPECT_EQ(foot(false), "/foot/position");
}

TEST(Comparison, IsTheSameForTheSameRuns) {
  const Content a = content(two(table(), table())), b = content(two(table(), table()));
  EXPECT_EQ(a.json, b.json);
  EXPECT_EQ(a.samples, b.samples);
}

TEST(Comparison, KeepsTheChosenTopics) {
  Comparison c = two(table(), table());
  keep(c, {"/joint/hip/angle"});
  ASSERT_EQ(c.channels.size(), 1u);
  const Json page = Json::parse(content(c).json);
  EXPECT_EQ(page["panels"].size(), 1u);
  EXPECT_EQ(Json::parse(to_json(c))["channels"][0]["topic"], "/joint/hip/angle");
}

// A measured pressure for which the simulated robot has no sensor is compared with the true one,
// and differs by the added 1000 Pa, in either order of the runs.
TEST(Comparison, WhatOnlyASimulationKnowsStandsForASensorWithoutError) {
  const std::string plain = "/muscle/hip_flexor/pressure", known = "/true" + plain;
  for (const bool measured_first : {true, false}) {
    signals::Table measured = table(), simulated = table();
    ASSERT_NE(simulated.find(known), nullptr);
    ASSERT_EQ(simulated.find(plain), nullptr);
    add(1000, values(measured, known));
    std::erase_if(measured.series, [&](const signals::Series& s) {
      return s.topic.name.starts_with("/true/") && s.topic.name != known;
    });
    for (signals::Series& s : measured.series)
      if (s.topic.name == known) s.topic.name = plain;
    const Comparison c = measured_first ? two(std::move(measured), std::move(simulated))
                                        : two(std::move(simulated), std::move(measured));
    const auto row = std::ranges::find_if(
        c.channels, [&](const ChannelRow& r) { return r.channel.topic == plain; });
    ASSERT_NE(row, c.channels.end());
    EXPECT_NEAR(row->differences[1]->rms, 1000, 1e-6);
  }
}

}  // namespace
}  // namespace sinew::report::comparison_test
