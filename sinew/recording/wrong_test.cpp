// A table that is ambiguous or wrong is refused with the line and advice; nothing is dropped
// silently.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/measured.h"
#include "sinew/recording/raw_table.h"

namespace sinew::recording::wrong_test {
namespace {

constexpr ColumnSpec specs[] = {
    {.name = "time", .unit = "s", .optional = true, .doc = "since the start"},
    {.name = "pressure", .unit = "Pa gauge", .least = 1e3, .most = 2e6, .doc = "inside"},
    {.name = "force", .unit = "N", .least = 1, .most = 1e5, .doc = "it pulls with"}};

struct Case {
  std::string text, part;
  Source source = {};
};

template <class Read>
void expect_refused(const std::vector<Case>& cases, Read read) {
  for (const Case& c : cases) {
    Source source = c.source;
    source.path = "lab.csv";
    source.text = c.text;
    std::string said = "read without a word";
    try {
      read(source);
    } catch (const config::Error& e) {
      said = e.what();
    }
    EXPECT_NE(said.find(c.part), std::string::npos) << c.text << "\n"
                                                    << said << "\nwants " << c.part;
  }
}

void expect_table_refused(const std::vector<Case>& cases) {
  expect_refused(cases, [](const Source& s) { read_table(s); });
}

using namespace std::string_literals;

TEST(Wrong, WhatIsNoTextIsNamed) {
  expect_table_refused({
      {"PK\x03\x04" + std::string(26, '\0') + "[Content_Types].xml",
       "lab.csv: found an Excel workbook (.xlsx); expected a table as text, such as CSV; try to "
       "save the sheet as CSV"},
      {"PK\x03\x04" + std::string(26, '\0') +
           "mimetypeapplication/vnd.oasis.opendocument.spreadsheet",
       "a workbook of LibreOffice (.ods)"},
      {"PK\x03\x04" + std::string(26, '\0') + "data.bin", "an archive (.zip)"},
      {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"s, "an Excel workbook (.xls)"},
      {"MATLAB 5.0 MAT-file, Platform: GLNXA64"s, "a file of MATLAB (.mat)"},
      {"\x89HDF\r\n\x1A\n"s, "an HDF5 file"},
      {"TDSm\x0E\0\0\0"s, "a TDMS file of LabVIEW"},
      {"\x1F\x8B\x08"s, "a file packed by gzip"},
      {"\x89MCAP0\r\n"s, "a log in MCAP"},
      {"%PDF-1.7\n"s, "a PDF"},
      {"<!DOCTYPE html>\n"s, "a web page"},
      {"time [s],F [N]\n0,1\n\0\0\0\n1,2\n"s, "lab.csv:3:1: found a zero byte"},
      {"Zeit [s];Fl\xE4"
       "che [mm2]\n0;1\n",
       "lab.csv:1:12: found a byte e4 that is no UTF-8; "
       "expected a table in UTF-8; try encoding=latin1"},
      {"\xFF\xFE\x00\xD8\x41\x00"s, "UTF-16 with half a letter"},
      {"", "rows: found none; expected a header and rows of numbers"},
      {"\n\n# nothing\n", "rows: found none"},
      {"time [s],F [N]\n", "rows: found none"},
  });
}

TEST(Wrong, MissingFilesAreReportedBeforeReading) {
  const auto said = [](const std::string& path) {
    try {
      read_table({.path = path});
    } catch (const config::Error& e) {
      return std::string(e.what());
    }
    return std::string("read");
  };
  EXPECT_EQ(said("nowhere.csv"),
            "nowhere.csv: found no readable file; expected measurements as CSV");
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(said(folder), folder +
                              ": found a folder; expected measurements as CSV, or a run's folder "
                              "with log.mcap; try one of the "
                              "files in it");
}

TEST(Wrong, NumbersThatCanBeTwoThingsAreNotGuessed) {
  const std::string header = "time [s];F [N]\n";
  expect_table_refused({
      {header + "1,000;1,234\n2,000;2,345\n",
       "lab.csv:2:1: found \"1,000\", and no number that shows what its comma is; expected decimal "
       "commas or grouped thousands, and which of them; try decimal=\",\" if the comma is the "
       "decimal "
       "mark, thousands=\",\" if it groups thousands"},
      {header + "0,5;1.234\n0,6;12,5\n",
       "lab.csv:2:5: F: found \"1.234\"; expected a number; try thousands=\".\" if the point parts "
       "thousands"},
      {header + "0,5;1.234,5\n",
       "found \"1.234,5\"; expected a number; try thousands=\".\", the mark"},
      {header + "0.5;1,234.5\n",
       "found \"1,234.5\"; expected a number; try thousands=\",\", the mark"},
      {header + "0.5;1 234.5\n",
       "found \"1 234.5\"; expected a number; try thousands=\" \", the mark"},
      {header + "0.5;1'234.5\n",
       "found \"1'234.5\"; expected a number; try thousands=\"'\", the mark"},
      {header + "0,5;12,5\n0,6;12.5\n", "a decimal comma, as in other rows: 12,5"},
      {header + "0.5;12.5\n0.6;13.5\n0.7;12,5\n",
       "lab.csv:4:5: F: found \"12,5\"; expected a "
       "number; try a decimal point: 12.5"},
      {header + "0.5;12.5 N\n0.6;13\n0.7;14\n", "the unit in the header alone, as in `force [N]`"},
      {"time [s],F [N]\n0,5,12,5\n0,6,13,5\n",
       "lab.csv:2:1: row: found 4 cells (2 such rows); expected 2 as in the header; try decimal "
       "points, or semicolons between cells"},
      {"date,t [s],F [N]\n2026-11-24,0,5,12\n2026-11-24,0,6,13\n",
       "found 4 cells (2 such rows); expected 3 as in the header; try decimal points, or "
       "semicolons between cells: with decimal commas every number is cut in two"},
      {"time [s],F [N]\n0,5,12,5\n0,6,13,5\n",
       "semicolons between cells: with decimal commas every number is cut in two",
       {.drop_incomplete = true}},
      {"time [s],F [N]\n0,5\n1,6\n2,7.5,left\n3,8\n",
       "drop_incomplete=true to leave such rows out"},
      {header + "0,5;1\n", "decimal: found \";\"; expected \".\" or \",\"", {.decimal = ";"}},
      {header + "0,5;1\n", "two different signs", {.decimal = ",", .thousands = ","}},
      {header + "0,5;1\n", "encoding: found \"utf8\"", {.encoding = "utf8"}},
  });
}

TEST(Wrong, ImpossibleClocksAreReported) {
  expect_table_refused({
      {"when,F [N]\n11/03/2026 10:00:00,1\n11/03/2026 10:00:01,2\n",
       "lab.csv:2:1: when: found \"11/03/2026 10:00:00\", and no date whose day is above 12; "
       "expected dates that show which number is the day; try dates=\"day first\" or "
       "dates=\"month first\""},
      {"when,F [N]\n11/24/2026,1\n24/11/2026,2\n11/25/2026,3\n",
       "lab.csv:3:1: time: found \"24/11/2026\"; expected a date or a time of day"},
      {"when,F [N]\n31.02.2026 10:00:00,1\n01.03.2026 10:00:00,2\n", "lab.csv:2:1: time: found"},
      {"time [s],F [N]\n0,1\n2,1\n1,1\n",
       "lab.csv:4:1: time: found 1 s after 2 s; expected times "
       "that do not run backwards"},
      {"time [s],F [N]\n0,1\n0,1\n1,1\n1,2\n",
       "lab.csv:3:1: time: found 2 rows with the time of the row above, as the clock is coarse; "
       "expected a time of its own for each row; try spread_times=true"},
      {"time,F [N]\n0,1\n1,1\n",
       "time: found times without a unit; expected s, ms, us, min or h; "
       "try units.time=\"s\", or rate=\"100 Hz\""},
      {"time [mm],F [N]\n0,1\n1,1\n", "time: found the unit \"mm\"; expected s, ms, us, min or h"},
      {"Date,F [N]\n46350.5,5\n46350.6,6\n", "dates=excel, if these are Excel's days"},
      {"time [s],F [N]\n0,1\n,1\n2,3\n",
       "lab.csv:3:1: time: found an empty cell; expected a number; "
       "try drop_incomplete=true"},
      {"time [s],F [N]\n0,1\n", "no column \"clock\"", {.names = {{"time", "clock"}}}},
      {"F [N]\n1\n",
       "rate: found \"100\"; expected how many rows there are in a second",
       {.rate = "100"}},
      {"when,F [N]\n11/03/2026,1\n",
       "dates: found \"day-first\"; expected \"day first\", \"month "
       "first\" or \"excel\"; try \"day first\"",
       {.dates = "day-first"}},
  });
}

TEST(Wrong, MeasurementsWhoseTimeRunsFarBackwardsAreRefused) {
  const std::string header = "time [s],pressure [barg],force [N]\n";
  expect_refused(
      {{header + "0,2,20\n2,2,21\n1,2,22\n3,2,23\n",
        "lab.csv:4:1: time: found 1 s after 2 s; expected times that do not run "
        "backwards; try to sort the rows by their time"},
       {header + "0,2,20\n1,2,21\n2,2,22\n2,2,23\n2,2,24\n2,2,25\n0.9,2,24\n", "0.9 s after"}},
      [](const Source& s) { read_measured(s, specs); });
}

TEST(Wrong, MeasurementsThatShareATimeAreSpreadAndReported) {
  const Measured m =
      parse_measured("time [s],pressure [barg],force [N]\n0,2,20\n1,2,21\n1,2,22\n2,2,23\n",
                     {.path = "lab.csv"}, specs);
  EXPECT_EQ(m["time"], (std::vector<double>{0, 1, 1.5, 2}));
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_EQ(m.notes[0], "1 rows shared the time of another: spread evenly");
}

// Two recorders whose rows were joined in small blocks: rows keep their own values.
TEST(Wrong, MeasurementsThatAreInterleavedAreSortedAndReported) {
  std::string text = "time [s],pressure [barg],force [N]\n";
  for (int block = 0; block < 100; ++block)
    for (const int i : {2 * block + 1, 2 * block}) text += fmt::format("{},2,{}\n", i, 20 + i);
  const Measured m = parse_measured(text, {.path = "lab.csv"}, specs);
  ASSERT_EQ(m.rows(), 200u);
  for (std::size_t i = 0; i < m.rows(); ++i) {
    EXPECT_EQ(m["time"][i], static_cast<double>(i));
    EXPECT_EQ(m["force"][i], 20.0 + static_cast<double>(i));
    EXPECT_EQ(m.lines[i], static_cast<int>(i % 2 == 0 ? i + 3 : i + 1));
  }
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_EQ(m.notes[0], "100 rows stood after later ones: sorted by their time");
}

// A maker's table gives several rows a line, which share a time.
TEST(Wrong, RowsOfOneLineMayShareATime) {
  const Measured m = parse_measured(
      "time [s],force [N] @ pressure = 1 bar gauge,force [N] @ pressure = 2 bar gauge\n"
      "0,10,20\n1,11,21\n",
      {.path = "lab.csv"}, specs);
  EXPECT_EQ(m["time"], (std::vector<double>{0, 0, 1, 1}));
}

// A logger writes a line for each of its channels.
TEST(Wrong, RowsOfOneTimeThatFillEachOthersCellsAreOneRow) {
  const std::string header = "time [s],pressure [bar gauge],force [N]\n";
  const Measured m =
      parse_measured(header + "0,1,\n0,,10\n1,2,\n1,,11\n2,3,12\n", {.path = "lab.csv"}, specs);
  EXPECT_EQ(m["time"], (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(m["pressure"], (std::vector<double>{1e5, 2e5, 3e5}));
  EXPECT_EQ(m["force"], (std::vector<double>{10, 11, 12}));
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_EQ(m.notes[0],
            "2 rows have the time of the row above and values of other columns: merged with it");
  // A column of a condition is equal in both rows, or missing in one; other rows are left out.
  const Measured some = parse_measured(
      "time [s],pressure [bar gauge],force [N],state\n"
      "0,1,,ok\n0,,10,ok\n1,2,,ok\n1,,11,\n2,3,,bad\n2,,12,bad\n",
      {.path = "lab.csv", .where = {{"state", "ok"}}}, specs);
  EXPECT_EQ(some["pressure"], (std::vector<double>{1e5, 2e5}));
  EXPECT_EQ(some["force"], (std::vector<double>{10, 11}));
  const Measured stamps = parse_measured(
      "date,time,pressure [bar gauge],force [N]\n2026-11-27,10:00:00,1,\n2026-11-27,10:00:00,,10\n"
      "2026-11-27,10:00:01,2,11\n",
      {.path = "lab.csv"}, specs);
  EXPECT_EQ(stamps["time"], (std::vector<double>{0, 1}));
  EXPECT_EQ(stamps["force"], (std::vector<double>{10, 11}));
  const auto measured = [](const Source& s) { read_measured(s, specs); };
  expect_refused({{header + "0,1,\n1,,10\n2,2,11\n", "force: found an empty cell"},
                  {header + "0,1,\n0,2,10\n2,2,11\n", "force: found an empty cell"}},
                 measured);
}

TEST(Wrong, AColumnOfASecondClockIsRefused) {
  const std::string rows = "\n0,20,0,2\n.01,21,.04,2\n.02,22,.08,2\n";
  const auto measured = [](const Source& s) { read_measured(s, specs); };
  const std::string said =
      "pressure: found the column \"pressure\" of another clock than \"time\"; "
      "expected columns of one clock; try the table resampled at the times of "
      "one clock; sinew import reads several";
  const std::string columns = ",force [N],time [s],pressure [bar gauge]";
  expect_refused({{"time [s]" + columns + rows, said},
                  {"time [s],force [N],time (2) [s],pressure [bar gauge]" + rows, said},
                  {"time (1) [s],force [N],time (2) [s],pressure [bar gauge]" + rows,
                   "force: found the column \"force\" of another clock than \"time (2)\"",
                   {.names = {{"time", "time (2)"}}}}},
                 measured);
}

TEST(Wrong, SeveralRecordingsInATableAreCountedAndOneCanBeRead) {
  const std::string header = "time [s],pressure [barg],force [N]\n";
  const std::string first = "0,2,20\n1,2,21\n2,2,22\n", second = "0,2,30\n1,2,31\n";
  const std::string said =
      "lab.csv:5:1: found 2 recordings one after the other, the second from this line; expected "
      "one recording; try part=1 to part=2";
  const std::string again = "lab.csv:6:1: found 2 recordings";
  expect_table_refused({{header + first + second, said},
                        {header + first + header + second, again},
                        {header + first + second, "part: found 3; expected 1 to 2", {.part = 3}},
                        {header + first, "expected 1: the file holds one", {.part = 2}}});
  const auto measured = [](const Source& s) { read_measured(s, specs); };
  expect_refused({{header + first + second, said}, {header + first + header + second, again}},
                 measured);
  for (const std::string& text : {header + first + second, header + first + header + second}) {
    const Source source{.path = "lab.csv", .text = text, .part = 2};
    const RawTable table = read_table(source);
    EXPECT_EQ(table.time, (std::vector<double>{0, 1}));
    EXPECT_EQ(table.columns.at(1).values, (std::vector<double>{30, 31}));
    EXPECT_EQ(read_measured(source, specs)["force"], (std::vector<double>{30, 31}));
  }
}

TEST(Wrong, AFileBeyondTheMemoryIsRefusedBeforeItIsRead) {
  const std::string path = ::testing::TempDir() + "sinew_large.csv";
  std::ofstream(path) << std::string(3'000'000, '#');
  std::string said;
  try {
    read_table({.path = path, .largest = 2e6});
  } catch (const config::Error& e) {
    said = e.what();
  }
  std::filesystem::remove(path);
  EXPECT_EQ(said, path +
                      ": found a file of 3.0 MB; expected at most 2.0 MB, which this computer's "
                      "memory can take; try every tenth row (awk 'NR == 1 || NR % 10 == 0'), or "
                      "the part that matters");
}

TEST(Wrong, RowsAndCellsAreReportedWithTheirPlace) {
  expect_table_refused({
      {"0,1\n1,2\n", "lab.csv:1:1: header: found numbers in the first line"},
      {"Messung 7\n0;1\n1;2\n", "lab.csv:2:1: header: found numbers without names above them"},
      {"time [s],F [N]\n0,1\n1\n2,3\n", "lab.csv:3:1: row: found 1 cells (1 such row); expected 2"},
      {"time [s],F [N]\n0,1\n1,2,3\n2,3\n", "lab.csv:3:1: row: found 3 cells"},
      {"time [s],F [N]\n0,1\n1,broken\n2,3\n3,4\n",
       "lab.csv:3:3: F: found \"broken\"; expected a "
       "number"},
      {"time [s],F [N]\n0,1\n",
       "units: found \"G\"; expected a column of the file: time, F",
       {.units = {{"G", "N"}}}},
  });
}

TEST(Wrong, UnitsAreReportedInTheWordsOfTheFile) {
  const auto measured = [](const Source& s) { read_measured(s, specs); };
  expect_refused(
      {{"pressure [bar],force [N]\n2,20\n",
        "pressure: found the unit \"bar\"; expected Pa gauge (pressure); try \"bar gauge\" or "
        "\"bar "
        "abs\""},
       {"pressure [mbar],force [N]\n2000,20\n", "try \"mbar gauge\" or \"mbar abs\""},
       {"pressure [barg],force [lbs]\n2,20\n", "\"lb\" for mass, \"lbf\" for force"},
       {"pressure [barg],force [kg]\n2,20\n",
        "try units.force=\"kgf\" for the weight of that mass"},
       {"pressure [furlong],force [N]\n2,20\n", "the unit \"furlong\""},
       {"pressure [mbarg],force [N]\n2,20\n",
        "pressure: found values up to 2 mbarg; expected between 10 mbarg and 2e+04 mbarg: a wrong "
        "unit, "
        "or another column; try units.pressure=\"kPa gauge\" or \"MPa gauge\" or \"bar gauge\" or "
        "\"psi gauge\""},
       {"pressure [psig],force [kN]\n20,2000\n",
        "found values up to 2000 kN; expected between "
        "0.001 kN and 100 kN"},
       {"pressure [barg],force [N]\n2,20\n3,OL\n",
        "lab.csv:3:3: force: found \"OL\"; expected a "
        "finite number; try drop_incomplete=true"}},
      measured);
}

TEST(Wrong, WhatIsLeftOutIsNoted) {
  const auto notes = [](std::string text, Source source = {}) {
    source.path = "lab.csv";
    source.text = std::move(text);
    std::string all;
    for (const std::string& note : read_table(source).notes) all += note + "\n";
    return all;
  };
  EXPECT_EQ(notes("time [s],F [N]\n0,1\n1,2\n2"),
            "line 4, the last one, with 1 of 2 cells: left out\n");
  EXPECT_EQ(notes("Rig 7\ntime [s],F [N]\n0,1\n1,2\n"), "line 1, above the table: left out\n");
  EXPECT_EQ(notes("phase,time [s],F [N]\nrest,0,1\nrest,1,2\n"),
            "columns without numbers left out: phase\n");
  EXPECT_EQ(notes("time [s],F [N]\n0,1\n1,2\n\0\0"s),
            "2 zero bytes at the end: left out, as a logger leaves them whose power went\n");
  EXPECT_EQ(notes("time [s],F [N]\n0,1\n,2\n2,3\n", {.drop_incomplete = true}),
            "1 rows without a time left out\n");
  std::string slow = "time [s],F [N]\n";
  for (int i = 0; i < 30; ++i) slow += std::to_string(10 * i) + ",1\n";
  EXPECT_EQ(notes(slow),
            "time: a row every 10 s, 0.0806 h in all; if it counts ms, give units.time=\"ms\"\n");
}

}  // namespace
}  // namespace sinew::recording::wrong_test
