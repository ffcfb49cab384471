// Tests that the tests named in docs/reference/supervision.md exist and that its bounds are the
// defaults.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sinew/control/supervise/safety.h"
#include "tests/places.h"

namespace sinew::control::supervision_docs_test {
namespace {

using Row = std::vector<std::string>;

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(' '), to = text.find_last_not_of(' ');
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

// Returns the rows of the table of faults.
std::vector<Row> faults() {
  std::ifstream file(sinew::test::source_dir() + "/docs/reference/supervision.md");
  std::vector<Row> rows;
  bool here = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) here = line == "## Faults";
    if (!here || !line.starts_with("| ") || line.starts_with("| ---")) continue;
    Row row;
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(trimmed(cell));
    if (row[0] != "fault") rows.push_back(row);
  }
  return rows;
}

std::set<std::string> tests() {
  std::set<std::string> names;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t)
      names.insert(std::string(suite.name()) + "." + suite.GetTestInfo(t)->name());
  }
  return names;
}

std::string cell(const std::string& fault, std::size_t column) {
  for (const Row& row : faults())
    if (row[0] == fault) return row[column];
  ADD_FAILURE() << "no row: " << fault;
  return "";
}

// Returns the ticks without a round of run() after which the watchdog is not fed.
std::uint32_t patience_of_the_application() {
  std::ifstream file(sinew::test::source_dir() + "/firmware/application.cpp");
  const std::string before = "std::uint32_t patience = ";
  for (std::string line; std::getline(file, line);)
    if (const std::size_t at = line.find(before); at != std::string::npos)
      return static_cast<std::uint32_t>(std::stoul(line.substr(at + before.size())));
  return 0;
}

TEST(SupervisionDocs, EachFaultHasATestThatIsThere) {
  const std::set<std::string> there = tests();
  const std::vector<Row> rows = faults();
  ASSERT_GE(rows.size(), 20u);
  for (const Row& row : rows) {
    ASSERT_EQ(row.size(), 6u) << row[0];
    for (const std::string& one : row) EXPECT_NE(one, "") << row[0];
    ASSERT_GT(row[5].size(), 2u);
    EXPECT_TRUE(there.contains(row[5].substr(1, row[5].size() - 2))) << row[5];
  }
}

TEST(SupervisionDocs, BoundsAreTheDefaults) {
  const SafetyConfig safety;
  const SuperviseConfig supervise;
  const auto milliseconds = [](std::uint32_t ticks) { return std::to_string(ticks / 10) + " ms"; };
  const auto seconds = [](std::uint32_t ticks) { return std::to_string(ticks / 10'000) + " s"; };
  constexpr std::size_t bound = 2;
  EXPECT_EQ(cell("host silent", bound), milliseconds(safety.host_hold));
  EXPECT_EQ(cell("host silent for long", bound), seconds(safety.host_vent));
  EXPECT_EQ(cell("hold without end", bound), seconds(safety.hold_limit));
  EXPECT_EQ(cell("a constant in memory changes", bound), milliseconds(2 * safety.check_every));
  const std::string three_scans = milliseconds(100 * supervise.bad_readings);
  EXPECT_EQ(cell("a sensor open, short or saturated", bound), three_scans);
  EXPECT_EQ(cell("a sensor out of rate", bound), three_scans);
  EXPECT_EQ(cell("bad commands", bound), milliseconds(100 * (supervise.hold_commands - 1)) + "; " +
                                             milliseconds(100 * (supervise.vent_commands - 1)));
  EXPECT_EQ(cell("what works between ticks hangs, so that no host is heard", bound)
                .find(milliseconds(patience_of_the_application()) + " and "),
            0u);
  EXPECT_EQ(supervise.gap_shut, 2u);
  EXPECT_EQ(supervise.gap_vent, 100u) << "10 ms missed";
}

}  // namespace
}  // namespace sinew::control::supervision_docs_test
