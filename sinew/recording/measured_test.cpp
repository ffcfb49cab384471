// Measurements are returned in SI for every unit of the file; faults are reported with their line.
#include "sinew/recording/measured.h"

#include <gtest/gtest.h>

#include "sinew/config/diagnostics.h"

namespace sinew::recording::measured_test {
namespace {

constexpr ColumnSpec specs[] = {
    {.name = "time", .unit = "s", .optional = true, .doc = "since the start"},
    {.name = "length", .unit = "m", .least = 5e-3, .most = 5, .optional = true, .doc = "of it"},
    {.name = "pressure", .unit = "Pa gauge", .least = 1e3, .most = 2e6, .doc = "inside"},
    {.name = "force", .unit = "N", .least = 1, .most = 1e5, .doc = "it pulls with"}};

Measured read(std::string_view text, Source source = {}) {
  source.path = "rig.csv";
  return parse_measured(text, source, specs);
}

std::string problem(std::string_view text, Source source = {}) {
  try {
    read(text, std::move(source));
  } catch (const config::Error& e) {
    return e.what();
  }
  return "none";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(Measured, UnitsChangeNothing) {
  const Measured a = read("pressure [kPa gauge],force [N]\n100,44.4822161526\n200,88.9644323052\n");
  const Measured b = read("force [lbf],pressure [bar gauge]\n10,1\n20,2\n");
  const Measured c =
      read("force [lbf],pressure [bar abs]\n10,2.013529322095749\n20,3.013529322095749\n");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a["pressure"][i], b["pressure"][i], 1e-6);
    EXPECT_NEAR(a["pressure"][i], c["pressure"][i], 1e-6);
    EXPECT_NEAR(a["force"][i], b["force"][i], 1e-9);
  }
}

TEST(Measured, AForeignFileIsReadBySayingWhatItsColumnsAre) {
  Source source{.names = {{"pressure", "p_raw"}, {"force", "F"}},
                .units = {{"p_raw", "kPa gauge"}, {"F", "N"}}};
  const Measured m = read("n;F;p_raw\n# comment\n1;12.5;300\n\n2;+13;310\n", source);
  ASSERT_EQ(m.rows(), 2u);
  EXPECT_EQ(m["force"][1], 13);
  EXPECT_NEAR(m["pressure"][0], 3e5, 1e-9);
  EXPECT_EQ(m.lines, (std::vector<int>{3, 5}));
}

TEST(Measured, AReferenceInTheNameBelongsToTheUnit) {
  const Source source{.names = {{"pressure", "Druck abs"}}, .atmosphere = 1e5};
  const Measured m = read("Druck abs [mbar],force [N]\n2000,12.5\n3000,20\n", source);
  EXPECT_NEAR(m["pressure"][0], 1e5, 1e-6);
}

TEST(Measured, AFileWithoutAHeaderIsReadByItsColumns) {
  Source source{.columns = {"force [N]", "pressure [kPa gauge]", "time [s]"}};
  const Measured m = read("14.5,8.9,0\n14.6,9.0,0.001\n", source);
  ASSERT_EQ(m.rows(), 2u);
  EXPECT_EQ(m["time"][1], 0.001);
}

TEST(Measured, AValueOfTheWholeFileAndAnOffsetTakeTheirPlace) {
  static constexpr ColumnSpec of[] = {{.name = "length", .unit = "m", .doc = "of the muscle"},
                                      {.name = "pressure", .unit = "Pa gauge", .doc = "inside"},
                                      {.name = "force", .unit = "N", .doc = "it pulls with"}};
  Source source{.path = "runs/bar2.csv"};
  source.names["length"] = "extension";
  source.offsets["length"] = "200 mm";
  source.values = {"bar3:pressure=3 bar gauge", "bar2:pressure=2 bar gauge"};
  const std::string text = "extension [mm],force [N]\n0,10\n5,20\n";
  const Measured m = parse_measured(text, source, of);
  EXPECT_DOUBLE_EQ(m["length"][1], 0.205);
  EXPECT_EQ(m["pressure"], (std::vector<double>{2e5, 2e5}));
  EXPECT_EQ(m["force"][1], 20);
}

TEST(Measured, AMakersTableBecomesRows) {
  const Measured m = read(
      "length [mm],force [N] @ pressure = 1 bar gauge,force [N] @ pressure = 2 bar gauge\n"
      "250,100,210\n240,,150\n");
  ASSERT_EQ(m.rows(), 3u);  // an empty cell was not measured
  EXPECT_EQ(m["force"], (std::vector<double>{100, 210, 150}));
  EXPECT_EQ(m["pressure"], (std::vector<double>{1e5, 2e5, 2e5}));
  EXPECT_EQ(m["length"], (std::vector<double>{0.25, 0.25, 0.24}));
}

TEST(Measured, RowsCannotBeSelectedByACondition) {
  const std::string said = problem("length [mm],force [N] @ pressure = 1 bar gauge\n250,100\n",
                                   {.where = {{"pressure", "1"}}});
  EXPECT_TRUE(says(said, "where: found \"pressure\"; expected a column of the file")) << said;
}

TEST(Measured, RowsThatAreNotCompleteAreLeftOutOnRequestOnly) {
  const std::string text = "pressure [kPa gauge],force [N]\n100,10\n,20\n300,nan\n400,40\n";
  const std::string said = problem(text);
  EXPECT_TRUE(says(said, "rig.csv:3:1: pressure: found an empty cell")) << said;
  EXPECT_TRUE(says(said, "rig.csv:4:5: force: found \"nan\"")) << said;
  EXPECT_TRUE(says(said, "drop_incomplete=true")) << said;

  const Measured m = read(text, {.drop_incomplete = true});
  EXPECT_EQ(m["force"], (std::vector<double>{10, 40}));
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_TRUE(says(m.notes[0], "2 of 4 rows")) << m.notes[0];
}

TEST(Measured, WhatIsWrongIsReported) {
  struct Case {
    const char* text;
    const char* part;
  };
  const Case cases[] = {
      {"1,2\n3,4\n", "rig.csv:1:1: header: found numbers in the first line"},
      {"pressure [kPa gauge],Force [N]\n1,2\n", "no column \"force\""},
      {"pressure [kPa],force [N]\n1,2\n", "try \"kPa gauge\" or \"kPa abs\""},
      {"pressure [kPa gauge],force\n1,2\n", "without a unit"},
      {"pressure [kPa gauge],force [lb]\n100,2\n", "lb is mass, lbf is force"},
      {"pressure [Pa gauge],force [N]\n100,20\n", "units.pressure=\"kPa gauge\""},
      {"pressure [kPa gauge],force [N]\n100.5,20.5\n101,\"20,5\"\n", "a decimal point: 20.5"},
      {"pressure [kPa gauge],force [N]\n100,5,20,1\n", "found 4 cells (1 such row)"},
      {"time [s],pressure [kPa gauge],force [N]\n0,100,10\n2,110,12\n1,120,13\n",
       "rig.csv:4:1: time: found 1 s after 2 s"},
      {"pressure [kPa gauge],force [N]\n", "rows: found none"},
      {"pressure [kPa gauge],force [N],L\xE4nge [mm]\n100,20,1\n",
       "rig.csv:1:33: found a byte e4 that is no UTF-8"},
      {"pressure [kPa gauge],force [N],muscle\n100,20,\xFFx\n", "rig.csv:2:8: found a byte ff"},
      {"pressure [kPa gauge],force [N],L\xC3\n100,20,1\n", "found a byte c3"},
  };
  for (const Case& c : cases) {
    const std::string said = problem(c.text);
    EXPECT_TRUE(says(said, c.part)) << c.text << said;
  }
  EXPECT_TRUE(says(problem("pressure [kPa gauge],force [N]\n100,20\n", {.names = {{"froce", "x"}}}),
                   "names: found \"froce\""));
  EXPECT_TRUE(says(problem("pressure [kPa gauge],force [N]\n100,20\n", {.units = {{"x", "N"}}}),
                   "units: found \"x\""));
}

TEST(Measured, TwoColumnsOfOneNameAreRefusedUnlessAnAtDistinguishesThem) {
  const std::string said = problem("pressure [kPa gauge],force [N],force [lbf]\n100,20,30\n");
  EXPECT_TRUE(says(said, "rig.csv:1:32: force: found a second column of this name")) << said;
  const std::string unread = "n [mm],n [s],pressure [kPa gauge],force [N]\n1,2,100,20\n";
  EXPECT_EQ(problem(unread), "none");  // the column is not requested
}

}  // namespace
}  // namespace sinew::recording::measured_test
