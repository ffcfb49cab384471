// A log of chosen channels contains those channels and no others: for any log.channels in any
// order, each channel that is logged has the times and the numbers that it has in the log of
// everything, to the last bit. For every shipped experiment: each channel alone, and seeded pairs,
// small sets and orders, all written from one recorded table.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "sinew/config/compose.h"
#include "sinew/log/reader.h"
#include "sinew/log/writer.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/folder/run_log.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;
using Patterns = std::vector<std::string>;

std::vector<std::string> shipped() {
  std::vector<std::string> out;
  const fs::path all = fs::path(sinew::test::source_dir()) / "experiments";
  for (const fs::path& folder : {all, all / "rig"})
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".toml") out.push_back(entry.path().string());
  std::ranges::sort(out);
  return out;
}

int choices() {
  const char* more = std::getenv("SINEW_GUARD_COUNT");
  return more ? std::atoi(more) : 200;
}

// The table that an experiment records, and the topics that its log.channels may name.
struct Recorded {
  signals::Table table;
  std::vector<signals::Topic> topics;
};

// Called from the loop.
void push(void* writer, std::uint16_t topic, std::int64_t time_ns,
          std::span<const double> values) noexcept {
  static_cast<log::Writer*>(writer)->push(topic, time_ns, values);
}

run::LoggedTopics logged(const Recorded& recorded, const Patterns& patterns) {
  return run::logged_topics(recorded.topics, patterns, {}, "a.toml");
}

std::vector<std::string> names_of(const std::vector<signals::Topic>& topics) {
  std::vector<std::string> out;
  for (const signals::Topic& topic : topics) out.push_back(topic.name);
  return out;
}

bool same_bits(const signals::Column& a, const signals::Column& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) ||
           (x != x && y != y);  // a log has one kind of NaN
  });
}

// Compares every channel of `log`, and each that the patterns match, with its series in `full`.
void expect_part(const signals::Table& log, const signals::Table& full, const Patterns& patterns) {
  std::size_t meant = 0;
  for (const signals::Series& whole : full.series) {
    const bool wanted = std::ranges::any_of(patterns, [&](const std::string& pattern) {
      return whole.topic.name == pattern || whole.topic.name.starts_with(pattern + "/");
    });
    const signals::Series* part = log.find(whole.topic.name);
    ASSERT_EQ(part != nullptr, wanted) << whole.topic.name;
    if (!part) continue;
    ++meant;
    ASSERT_EQ(part->time_ns, whole.time_ns) << whole.topic.name;
    ASSERT_EQ(part->columns.size(), whole.columns.size()) << whole.topic.name;
    for (std::size_t c = 0; c < whole.columns.size(); ++c)
      ASSERT_TRUE(same_bits(part->columns[c], whole.columns[c]))
          << whole.topic.name << " holds other numbers";
  }
  ASSERT_EQ(log.series.size(), meant);
}

// Some fifty samples of each series, from the whole run: enough to distinguish channels.
void thin(signals::Table& table) {
  for (signals::Series& s : table.series) {
    const std::size_t step = s.time_ns.size() / 50 + 1;
    const auto thinned = [step](const auto& samples) {
      std::decay_t<decltype(samples)> out;
      for (std::size_t i = 0; i < samples.size(); i += step) out.push_back(samples[i]);
      return out;
    };
    s.time_ns = thinned(s.time_ns);
    for (signals::Column& column : s.columns) column = thinned(column);
  }
}

class Channels : public testing::TestWithParam<std::string> {
 protected:
  Channels()
      : name_(fs::path(GetParam()).stem().string()),
        file_(fs::temp_directory_path() /
              ("sinew-channels-" + std::to_string(::getpid()) + ".mcap")),
        random_(std::hash<std::string>{}(name_)) {}
  ~Channels() override { fs::remove(file_); }

  // A run writes its log while it proceeds, here one of a random choice, which is compared with the
  // recording of the same run.
  Recorded record() {
    const experiment::Experiment e = experiment::load(GetParam());
    Recorded out{{}, run::topics(e)};
    const Patterns patterns = some(names_of(out.topics), out.topics.size() / 2);
    const run::LoggedTopics chosen = logged(out, patterns);
    log::Writer writer(file_, chosen.topics);
    out.table = run::run(e, {.tap = {&writer, push}, .tapped = chosen.of_series}).table;
    writer.finish();
    expect_part(log::read(file_), out.table, patterns);
    return out;
  }

  // `count` different ones, in any order.
  Patterns some(Patterns names, std::size_t count) {
    std::ranges::shuffle(names, random_);
    names.resize(std::min(count, names.size()));
    return names;
  }

  signals::Table written(const Recorded& recorded, const Patterns& patterns) const {
    const run::LoggedTopics chosen = logged(recorded, patterns);
    log::Writer writer(file_, chosen.topics, {}, {.period = std::chrono::milliseconds(1)});
    run::write(writer, recorded.table, chosen);
    writer.finish();
    return log::read(file_);
  }

  // Each channel alone, whole.
  void try_each(const Recorded& recorded) {
    const signals::Table full = written(recorded, {"*"});
    expect_part(full, recorded.table, names_of(recorded.topics));
    for (const signals::Topic& topic : recorded.topics) {
      if (HasFatalFailure()) return;
      expect_part(written(recorded, {topic.name}), full, {topic.name});
    }
  }

  // Pairs and small sets in any order.
  void try_many(const Recorded& recorded) {
    const signals::Table full = written(recorded, {"*"});
    for (int i = 0; i < choices() && !HasFatalFailure(); ++i) {
      const std::size_t count = i % 2 == 0 ? 2 : 2 + random_() % 6;
      const Patterns patterns = some(names_of(recorded.topics), count);
      SCOPED_TRACE("choice " + std::to_string(i) + ": " + testing::PrintToString(patterns));
      expect_part(written(recorded, patterns), full, patterns);
    }
  }

  std::string name_;
  fs::path file_;
  std::mt19937 random_;
};

TEST_P(Channels, OfAnyChoiceAreThoseOfTheWholeLog) {
  Recorded recorded = record();
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_FALSE(recorded.table.series.empty());
  try_each(recorded);
  thin(recorded.table);
  try_many(recorded);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Channels, testing::ValuesIn(shipped()), [](const auto& one) {
  std::string name = fs::path(one.param).stem().string();
  if (fs::path(one.param).parent_path().filename() == "rig") name = "rig-" + name;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace sinew
