// A topic that never changes is written once, and read as if it had been written each time.
#include "sinew/log/steady.h"

#include <algorithm>

#include "sinew/log/fixtures_test.h"
#include "sinew/log/mcap.h"
#include "sinew/log/reader.h"

namespace sinew::log::steady_test {
namespace {

using namespace testing;

// Returns two topics with equal times and edges at other times; `steady` topics never change.
signals::Table walk(std::uint64_t seed, int rows) {
  std::mt19937_64 random(seed);
  signals::Table table;
  const auto add = [&](const char* name, auto value, std::int64_t from, int count) {
    signals::Series& s = table.series.emplace_back();
    s.topic = {name, "of a test", {{"x", "m"}, {"y", "m"}}};
    s.columns.resize(2);
    for (int i = 0; i < count; ++i) {
      s.time_ns.push_back(from + i * 10'000'000LL);
      const auto [x, y] = value(i);
      s.columns[0].push_back(x);
      s.columns[1].push_back(y);
    }
  };
  const auto changes = [&](int) { return std::pair(any_double(random), 1.0); };
  const double held = any_double(random);
  const auto stays = [&](int) { return std::pair(held, -0.0); };
  add("/stays/before", stays, 0, rows);
  add("/changes", changes, 0, rows);
  add("/stays/behind", stays, 0, rows);
  add("/stays/at/other/times", stays, 5, rows);
  add("/stays/too/with/it", stays, 5, rows);
  add("/once", stays, 0, rows > 0 ? 1 : 0);
  add(
      "/signs/change", [](int i) { return std::pair(i % 2 ? 0.0 : -0.0, 0.0); }, 0, rows);
  return table;
}

TEST(Steady, IsReadAsItWasWritten) {
  const Folder folder;
  for (const int rows : {0, 1, 2, 3, 500}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const signals::Table table = walk(seed, rows);
      write_log(folder / "log.mcap", table, true);
      const signals::Table back = read(folder / "log.mcap");
      EXPECT_TRUE(back.complete);
      expect_same(back, table);
    }
  }
}

TEST(Steady, StandsOnceInAFinishedFile) {
  const Folder folder;
  write_log(folder / "log.mcap", walk(1, 500), true);
  const std::string bytes = bytes_of(folder / "log.mcap");
  std::map<std::uint16_t, Channel> channels;
  std::map<std::string, int> counts;
  const auto take = [&](const Record& record) {
    if (record.op == Op::channel) {
      const auto channel = parse_channel(record.content);
      channels.emplace(channel->id, *channel);
    } else if (record.op == Op::message) {
      ++counts[std::string(channels.at(parse_message(record.content)->channel).topic)];
    }
  };
  Records records(std::string_view(bytes).substr(kMagic.size()));
  while (const auto record = records.next()) {
    if (record->op == Op::data_end) break;
    take(*record);
    if (record->op != Op::chunk) continue;
    Records inner(parse_chunk(record->content)->records);
    while (const auto message = inner.next()) take(*message);
  }
  EXPECT_EQ(counts["/changes"], 500);
  EXPECT_EQ(counts["/signs/change"], 500) << "0 and -0 are two values";
  EXPECT_EQ(counts["/stays/before"] + counts["/stays/behind"], 2);
  // No changing topic has their times: the first is written in full for the other.
  EXPECT_EQ(counts["/stays/at/other/times"], 500);
  EXPECT_EQ(counts["/stays/too/with/it"], 1);
  const Pairs units = {{"unit.x", "m"}, {"unit.y", "m"}};
  Pairs steady = units;
  steady.emplace_back("sinew.steady", "/changes");
  EXPECT_EQ(channels.at(1).metadata, steady);
  EXPECT_EQ(channels.at(2).metadata, units);
}

// Each row has all of its values, wherever the log was cut.
TEST(Steady, ACutLogKeepsItsRows) {
  const Folder folder;
  write_log(folder / "log.mcap", walk(3, 40'000), true);
  const std::string bytes = bytes_of(folder / "log.mcap");
  for (const std::size_t share : {55, 75, 95}) {
    put_bytes(folder / "cut.mcap", std::string_view(bytes).substr(0, bytes.size() * share / 100));
    const signals::Table cut = read(folder / "cut.mcap");
    EXPECT_FALSE(cut.complete);
    EXPECT_GT(cut.series[1].time_ns.size(), 100U);
    EXPECT_EQ(cut.series[0].time_ns.size(), cut.series[1].time_ns.size());
    EXPECT_EQ(cut.series[2].time_ns.size(), cut.series[1].time_ns.size());
  }
}

TEST(Steady, OfATopicThatThereIsNotIsWhatItIs) {
  signals::Table table = walk(1, 3);
  signals::Series once = table.series[5];
  repeat(once, table.series[3]);  // begins at another time
  EXPECT_EQ(once.time_ns.size(), 1U);
  repeat(once, table.series[1]);
  EXPECT_EQ(once.time_ns.size(), 3U);
}

}  // namespace
}  // namespace sinew::log::steady_test
