// A run of many pages per column, most of which are in a file, gives the same results as a run in
// memory: summary, page, CSV table and log.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/summary.h"
#include "sinew/analysis/verdict/compare.h"
#include "sinew/config/node.h"
#include "sinew/log/csv.h"
#include "sinew/log/reader.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_storage.h"
#include "tests/places.h"

namespace sinew::run::long_run_test {
namespace {

namespace fs = std::filesystem;

template <class Samples>
Samples in_memory(const Samples& samples) {
  return Samples(samples.in_memory());
}

signals::Table in_memory(const signals::Table& table) {
  signals::Table out{{}, table.complete};
  for (const signals::Series& s : table.series) {
    out.series.push_back({s.topic, in_memory(s.time_ns), {}});
    for (const signals::Column& column : s.columns)
      out.series.back().columns.push_back(in_memory(column));
  }
  return out;
}

std::string csv_of(const signals::Table& table) {
  std::ostringstream out;
  log::write_csv(table, out, {"/joint", "/valve", "/true/trolley"});
  return out.str();
}

class LongRun : public ::testing::Test {
 protected:
  LongRun() { fs::remove_all(folder_); }
  ~LongRun() override { fs::remove_all(folder_); }

  RunRequest request(const std::string& name) const {
    return {.experiment = sinew::test::source_dir() + "/experiments/" + name + ".toml",
            .folder = folder_.string(),
            .sets = {"sequence.repeat=30", "log.period=1 ms"},
            .report = false};
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("sinew-long-run-" + std::to_string(getpid()));
};

TEST_F(LongRun, IsReadAsOneInMemory) {
  for (const char* name : {"walk-test-1", "walk-two-legs"}) {
    fs::remove_all(folder_);
    const auto kept = run_and_store(request(name));
    const signals::Table paged = log::read(folder_ / log_name), whole = in_memory(paged);
    ASSERT_GT(paged.series.front().time_ns.size(), 3 * signals::Times::page_size) << name;
    ASSERT_TRUE(paged.series.front().time_ns.file());
    ASSERT_FALSE(whole.series.front().time_ns.file());

    const std::string of_whole = to_json(analysis::summarize(whole, kept.machine));
    EXPECT_EQ(to_json(analysis::summarize(paged, kept.machine)), of_whole) << name;
    EXPECT_EQ(to_json(kept.summary), of_whole) << name;
    EXPECT_EQ(csv_of(paged), csv_of(whole)) << name;

    const config::Node values = config::parse_file((folder_ / resolved_name).string());
    const auto content = [&](const signals::Table& table) {
      const analysis::Analysis analysis(table, kept.machine);
      return report::content({.analysis = analysis, .resolved = values, .name = name});
    };
    const report::Content a = content(paged), b = content(whole);
    EXPECT_EQ(a.json, b.json) << name;
    EXPECT_EQ(a.samples, b.samples) << name;
    EXPECT_NE(a.json.find("longer than a page can show"), std::string::npos) << name;
    EXPECT_LT(a.samples.size(), 100e6) << name;

    for (const analysis::ChannelDifference& d : analysis::differences(paged, whole))
      EXPECT_TRUE(d.difference.same) << name << " " << d.topic;
    signals::Table moved = paged;
    analysis::shift(moved, 5);
    EXPECT_NE(moved.series.front().time_ns, paged.series.front().time_ns) << name;
    analysis::shift(moved, -5);
    EXPECT_EQ(csv_of(moved), csv_of(paged)) << name;
  }
}

}  // namespace
}  // namespace sinew::run::long_run_test
