// The page of a run in progress: its pieces give the same samples as the whole run.
#include "sinew/report/page/live_page.h"

#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "sinew/config/compose.h"
#include "sinew/log/deflate.h"
#include "sinew/report/page/test_run.h"
#include "tests/places.h"

namespace sinew::report::growing_test {
namespace {

using Json = nlohmann::ordered_json;
using signals::Table;

const config::Node& resolved() {
  static const config::Node node =
      config::compose(sinew::test::source_dir() + "/experiments/walk-test-1.toml");
  return node;
}

Table table() { return test::walking(analysis::read_machine(resolved())); }

std::vector<signals::Topic> topics(const Table& table) {
  std::vector<signals::Topic> out;
  for (const signals::Series& s : table.series) out.push_back(s.topic);
  return out;
}

LivePage live_page(const Table& table, bool foot_path = true) {
  return {topics(table),
          {.resolved = resolved(), .name = "walk", .duration = 12.5, .foot_path = foot_path}};
}

// Returns the samples within [from, to).
Table part(const Table& all, std::int64_t from, std::int64_t to) {
  Table out;
  for (const signals::Series& s : all.series) {
    signals::Series cut{s.topic, {}, std::vector<signals::Column>(s.columns.size())};
    for (std::size_t i = 0; i < s.time_ns.size(); ++i) {
      if (s.time_ns[i] < from || s.time_ns[i] >= to) continue;
      cut.time_ns.push_back(s.time_ns[i]);
      for (std::size_t c = 0; c < s.columns.size(); ++c) cut.columns[c].push_back(s.columns[c][i]);
    }
    out.series.push_back(std::move(cut));
  }
  return out;
}

std::string from_base64(const std::string& text) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 4; ++k)
      three = three << 6 | (text[i + k] == '=' ? 0u : std::uint32_t(letters.find(text[i + k])));
    const std::size_t bytes = text[i + 2] == '=' ? 1 : text[i + 3] == '=' ? 2 : 3;
    for (std::size_t k = 0; k < bytes; ++k) out += static_cast<char>(three >> (16 - 8 * k));
  }
  return out;
}

// Ticks and bits of every column, as decoded by the page.
struct Column {
  std::vector<std::int32_t> ticks;
  std::vector<std::uint32_t> bits;
};
std::vector<Column> columns_of(const std::string& piece) {
  const Json json = Json::parse(piece);
  const std::string bytes = log::inflated(from_base64(json["data"]));
  std::size_t at = 0;
  const auto words = [&](std::size_t n) {
    std::vector<std::uint32_t> out(n);
    for (std::size_t rank = 0; rank < 4; ++rank)
      for (std::size_t i = 0; i < n; ++i)
        out[i] |= std::uint32_t(std::uint8_t(bytes[at + rank * n + i])) << (8 * rank);
    at += 4 * n;
    return out;
  };
  std::vector<std::vector<std::int32_t>> clocks;
  for (const std::size_t n : json["samples"]["clocks"]) {
    std::vector<std::int32_t> ticks;
    std::int32_t tick = 0;
    for (const std::uint32_t step : words(n)) ticks.push_back(tick += std::int32_t(step));
    clocks.push_back(std::move(ticks));
  }
  std::vector<Column> out;
  for (const std::size_t clock : json["samples"]["columns"])
    out.push_back({clocks[clock], words(clocks[clock].size())});
  EXPECT_EQ(at, bytes.size());
  return out;
}

TEST(LivePage, PiecesAreTheWhole) {
  const Table all = table();
  const LivePage page = live_page(all);
  const std::vector<Column> whole = columns_of(page.piece(all));
  ASSERT_GT(whole.size(), 40u);

  std::vector<Column> sum(whole.size());
  std::int64_t at = 0;
  for (const std::int64_t ms : {10, 30, 31, 500, 777, 1500, 1501, 100000}) {
    const std::vector<Column> more = columns_of(page.piece(part(all, at, ms * 1'000'000)));
    ASSERT_EQ(more.size(), sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i].ticks.insert(sum[i].ticks.end(), more[i].ticks.begin(), more[i].ticks.end());
      sum[i].bits.insert(sum[i].bits.end(), more[i].bits.begin(), more[i].bits.end());
    }
    at = ms * 1'000'000;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_EQ(sum[i].ticks, whole[i].ticks) << i;
    EXPECT_EQ(sum[i].bits, whole[i].bits) << i;
    EXPECT_FALSE(sum[i].ticks.empty()) << i;
  }
}

// The page is given the faults in advance, to mark them when they begin.
TEST(LivePage, ThePageKnowsTheFaults) {
  const Table all = table();
  EXPECT_FALSE(Json::parse(live_page(all).content("{}").json).contains("faults"));
  const config::Node broken =
      config::compose(sinew::test::source_dir() + "/experiments/faults/valve-stuck-open.toml");
  const LivePage page(topics(all), {.resolved = broken, .name = "broken", .duration = 12.5});
  const Json faults = Json::parse(page.content("{}").json)["faults"];
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0]["of"], "knee_extensor.inlet");
  EXPECT_EQ(faults[0]["from"], 5.0);
  EXPECT_NEAR(faults[0]["to"].get<double>(), 5.2, 1e-12);
}

TEST(LivePage, ThePageHasNoSamplesYetAndAPlaceForAll) {
  const Table all = table();
  const Content content = live_page(all).content(R"({"controls":[]})");
  const Json json = Json::parse(content.json);
  EXPECT_EQ(content.title, json["title"]);
  EXPECT_EQ(json["duration"], 12.5);
  EXPECT_TRUE(json["live"]["controls"].empty());
  EXPECT_TRUE(json["phases"]["stretches"].empty());
  EXPECT_EQ(json["phases"]["names"].size(), 3u);
  EXPECT_TRUE(json["verdicts"].empty());
  EXPECT_TRUE(json["summary"].empty());
  EXPECT_GT(json["parameters"].size(), 300u);
  for (const auto& n : json["samples"]["clocks"]) EXPECT_EQ(n, 0);
  EXPECT_EQ(log::inflated(from_base64(content.samples)), "");
  EXPECT_EQ(json["samples"]["columns"].size(), columns_of(live_page(all).piece(all)).size());

  bool has_oscillation = false;
  for (const auto& panel : json["panels"])
    for (const auto& line : panel["lines"]) {
      EXPECT_TRUE(line["column"].is_number()) << line["topic"];
      has_oscillation = has_oscillation || !is_pointwise(line["topic"].get<std::string>());
    }
  EXPECT_FALSE(has_oscillation) << "that needs samples that are still to come";
  EXPECT_GT(json["scene"]["muscles"][0]["longest"], 0.05);
}

TEST(LivePage, WithoutAFootPathNoneIsDesired) {
  const Table all = table();
  EXPECT_FALSE(
      Json::parse(live_page(all).content("{}").json)["scene"]["feet"][0]["desired"].is_null());
  EXPECT_TRUE(Json::parse(live_page(all, false).content("{}").json)["scene"]["feet"][0]["desired"]
                  .is_null());
}

TEST(LivePage, PhasesOfAPieceAreThoseOfItsRows) {
  const Table all = table();
  const Json whole = Json::parse(live_page(all).piece(all))["phases"]["stretches"];
  const Json late = Json::parse(live_page(all).piece(part(all, 1'000'000'000, 1'300'000'000)));
  ASSERT_FALSE(late["phases"]["stretches"].empty());
  const Json& first = late["phases"]["stretches"][0];
  EXPECT_NEAR(first["from"], 1.0, 0.011);
  bool found = false;
  for (const Json& s : whole)
    found = found || (s["from"] <= first["from"] && s["to"] > first["from"] &&
                      s["phase"] == first["phase"] && s["step"] == first["step"]);
  EXPECT_TRUE(found);
}

TEST(LivePage, APieceOfNothingHasEveryColumnEmpty) {
  const Table all = table();
  for (const Column& c : columns_of(live_page(all).piece(part(all, 0, 0))))
    EXPECT_TRUE(c.bits.empty());
}

}  // namespace
}  // namespace sinew::report::growing_test
