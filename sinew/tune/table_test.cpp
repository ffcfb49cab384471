// A table replaces an older one only when it is complete; until then its rows are in a separate
// file.
#include "sinew/tune/table.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"

namespace sinew::tune::table_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class TableFileTest : public ::testing::Test {
 protected:
  TableFileTest() { fs::create_directories(root_); }
  ~TableFileTest() override { fs::remove_all(root_); }

  const fs::path root_ = fs::temp_directory_path() / ("sinew-table-" + std::to_string(getpid()));
  const fs::path file_ = root_ / "t.csv";
  const std::vector<std::string> headings_{"a", "status"};
};

TEST_F(TableFileTest, NothingIsWrittenBeforeTheFirstRow) {
  { const TableFile table(file_, headings_, false); }
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(TableFileTest, RowsStandBesideUntilTheTableIsWhole) {
  std::ofstream(file_) << "mine";
  EXPECT_THROW(TableFile(file_, headings_, true), config::Error);
  std::ofstream(file_) << "old,status";
  EXPECT_THROW(TableFile(file_, headings_, false), config::Error);
  EXPECT_THROW(TableFile(file_, headings_, true, {file_}), config::Error);

  TableFile table(file_, headings_, true);
  EXPECT_TRUE(table.add({"1", "ok"}));
  EXPECT_TRUE(table.add({"2", "ok"}));
  EXPECT_EQ(text_of(file_), "old,status");
  EXPECT_EQ(text_of(table.part()), "a,status\n1,ok\n2,ok\n");
  EXPECT_NO_THROW(table.throw_failure());
  table.take_place();
  EXPECT_EQ(text_of(file_), "a,status\n1,ok\n2,ok\n");
}

TEST_F(TableFileTest, RowsOfATableThatDidNotBecomeWholeStay) {
  std::string part;
  {
    TableFile table(file_, headings_, false);
    table.add({"1", "ok"});
    part = table.part();
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_EQ(text_of(part), "a,status\n1,ok\n");
}

TEST_F(TableFileTest, AFailureIsKeptUntilItIsRequested) {
  TableFile table(headings_, [](std::string_view) { throw std::runtime_error("full"); });
  EXPECT_FALSE(table.add({"1", "ok"}));
  EXPECT_FALSE(table.add({"2", "ok"}));
  EXPECT_THROW(table.throw_failure(), std::runtime_error);
}

TEST(Table, JsonHasNumbersAndFlagsAsSuch) {
  const std::vector<Row> rows{{.cells = {"0.25", "true", "walks", ""}, .ok = true}};
  const auto json = Json::parse(json_of({"x", "flag", "word", "none"}, rows));
  EXPECT_EQ(json["format"], "sinew.sweep/1");
  EXPECT_EQ(json["rows"][0]["x"], 0.25);
  EXPECT_EQ(json["rows"][0]["flag"], true);
  EXPECT_EQ(json["rows"][0]["word"], "walks");
  EXPECT_TRUE(json["rows"][0]["none"].is_null());
}

TEST(Table, EachKindOfDoubtfulRowIsOneWarning) {
  std::vector<Row> rows{{.ok = true}, {.ok = true}};
  EXPECT_TRUE(warnings(rows).empty());
  rows[0].notes.lacks = {"x"};
  EXPECT_EQ(warnings(rows).size(), 1u);
  rows[1].notes.stop_reached = true;
  EXPECT_EQ(warnings(rows).size(), 2u);
  rows.push_back({.ok = false});
  EXPECT_EQ(warnings(rows).size(), 3u);
}

TEST(Table, AFigureThatNoRowHasIsRefusedAndOneThatSomeHaveIsNot) {
  const Sweep sweep{.report = parse_figures("x_m")};
  std::vector<Row> rows{{.ok = true, .notes = {.lacks = {"x_m"}}}, {.ok = true}};
  EXPECT_NO_THROW(refuse_empty_columns(rows, sweep));
  rows[1].notes.lacks = {"x_m"};
  EXPECT_THROW(refuse_empty_columns(rows, sweep), config::Error);
  EXPECT_THROW(refuse_empty_columns({{.cells = {"no"}, .ok = false}}, sweep), std::runtime_error);
}

}  // namespace
}  // namespace sinew::tune::table_test
