// A table gives the same numbers in every format that programs write.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/columns.h"
#include "sinew/recording/raw_table.h"

namespace sinew::recording::dialects_test {
namespace {

RawTable read(std::string text, Source source = {}) {
  source.path = "lab.csv";
  source.text = std::move(text);
  return read_table(source);
}

std::string in_utf16(const std::string& ascii, bool little_end_first, bool mark) {
  std::string out;
  if (mark) out = little_end_first ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : ascii) {
    if (little_end_first)
      out += {c, '\0'};
    else
      out += {'\0', c};
  }
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

struct Case {
  std::string name, text;
  Source source = {};
};

// time 0, 10, 20 ms; force 12.5, 1300.25, -2 N; pressure 1.5, 2.5, 3.5 bar gauge
const std::string plain =
    "time [s],force [N],pressure [bar gauge]\n"
    "0,12.5,1.5\n0.01,1300.25,2.5\n0.02,-2,3.5\n";
const std::string german =
    "time [s];force [N];pressure [bar gauge]\n"
    "0,00;12,5;1,5\n0,01;1300,25;2,5\n0,02;-2,0;3,5\n";

std::vector<Case> encodings_and_lines() {
  return {{"plain", plain},
          {"a byte order mark", "\xEF\xBB\xBF" + plain},
          {"UTF-16 of Windows", in_utf16(plain, true, true)},
          {"UTF-16, the other end first", in_utf16(plain, false, true)},
          {"UTF-16 without a mark", in_utf16(plain, true, false)},
          {"lines of Windows", replaced(plain, "\n", "\r\n")},
          {"lines of an old Macintosh", replaced(plain, "\n", "\r")},
          {"no end of the last line", plain.substr(0, plain.size() - 1)},
          {"empty lines and comments", "# a rig\n\n" + replaced(plain, "\n", "\n\n# more\n")},
          {"zeros of a logger", plain + std::string(512, '\0')},
          {"quotes", replaced("\"" + replaced(plain, ",", "\",\""), "\n", "\"\n\"") + "\""},
          {"NumPy's header", "# " + plain}};
}

std::vector<Case> separators() {
  return {{"semicolons", replaced(plain, ",", ";")},
          {"tabs", replaced(plain, ",", "\t")},
          {"tabs and blanks", replaced(plain, ",", " \t ")},
          {"aligned by blanks",
           "time [s]   force [N]   pressure [bar_g]\n"
           "0.00       12.5        1.5\n0.01       1300.25     2.5\n0.02       -2          3.5\n"},
          {"decimal commas", german},
          {"decimal commas and tabs", replaced(german, ";", "\t")},
          {"sep=;", "sep=;\r\n" + german},
          {"\"sep=;\"", "\"sep=;\"\r\n" + german},
          {"separators behind the rows", replaced(german, "\n", ";\n")},
          {"thousands of points", replaced(german, "1300,25", "1.300,25"), {.thousands = "."}},
          {"thousands of blanks", replaced(german, "1300,25", "1 300,25"), {.thousands = " "}},
          {"thousands of narrow blanks",
           replaced(german, "1300,25", "1\u202F300,25"),
           {.thousands = " "}},
          {"thousands of commas",
           replaced(replaced(plain, ",", ";"), "1300.25", "1,300.25"),
           {.thousands = ","}},
          {"thousands of commas in quotes",
           replaced(plain, "1300.25", "\"1,300.25\""),
           {.thousands = ","}},
          {"a typographer's minus", replaced(plain, "-2", "\u22122")},
          {"plus signs and exponents", replaced(plain, "1300.25", "+1.30025E+3")}};
}

std::vector<Case> headers() {
  const std::string rows = plain.substr(plain.find('\n'));
  return {
      {"round brackets", "time (s),force (N),pressure (barg)" + rows},
      {"a stroke", "time / s,force/N,pressure / bar(g)" + rows},
      {"in", "time in s,force in N,pressure in barg" + rows},
      {"a line of units", "time,force,pressure\ns,N,barg" + rows},
      {"a line of units in brackets", "time,force,pressure\n[s],[N],[bar rel.]" + rows},
      {"lines above", "Messung vom 24.11.2026\nBediener: Hans, Labor 2\n\n" + plain},
      {"LabVIEW",
       "LabVIEW Measurement\nSeparator,Comma\n***End_of_Header***,\nSamples,3,3\n"
       "***End_of_Header***,,\nX_Value,force (N),pressure (barg),Comment" +
           rows},
      {"a header that is said",
       rows.substr(1),
       {.columns = {"time [s]", "force [N]", "pressure [barg]"}}},
      {"units that are said",
       "time,force,pressure" + rows,
       {.units = {{"time", "sec"}, {"force", "N"}, {"pressure", "barg"}}}},
      {"a column of words", "phase,time [s],force [N],pressure [barg]" +
                                replaced(rows.substr(0, rows.size() - 1), "\n", "\nrest,") + "\n"}};
}

std::vector<Case> clocks() {
  const std::string names = "time,force [N],pressure [barg]\n";
  const auto rows = [&](const char* a, const char* b, const char* c) {
    return names + a + ",12.5,1.5\n" + b + ",1300.25,2.5\n" + c + ",-2,3.5\n";
  };
  return {
      {"milliseconds", replaced(rows("0", "10", "20"), "time", "time [ms]")},
      {"microseconds", replaced(rows("5000", "15000", "25000"), "time", "micros")},
      {"ISO", rows("2026-11-24T10:15:30.12", "2026-11-24T10:15:30.13", "2026-11-24T10:15:30.14")},
      {"ISO with a zone", rows("2026-11-24 10:15:30.12+01:00", "2026-11-24 10:15:30.13+01:00",
                               "2026-11-24 10:15:30.14+01:00")},
      {"across midnight", rows("23:59:59.99", "00:00:00.00", "00:00:00.01")},
      {"a German date",
       "Zeit;force [N];pressure [barg]\n24.11.2026 10:15:30,12;12,5;1,5\n"
       "24.11.2026 10:15:30,13;1300,25;2,5\n24.11.2026 10:15:30,14;-2,0;3,5\n"},
      {"a date and a time",
       "Datum;Uhrzeit;force [N];pressure [barg]\n24.11.26;10:15:30,12;12,5;1,5\n"
       "24.11.26;10:15:30,13;1300,25;2,5\n24.11.26;10:15:30,14;-2,0;3,5\n"},
      {"a date of the USA",
       rows("11/24/2026 1:15:30.12 PM", "11/24/2026 1:15:30.13 PM", "11/24/2026 1:15:30.14 PM")},
      {"a date that is said",
       rows("11/03/2026 1:15:30.12 PM", "11/03/2026 1:15:30.13 PM", "11/03/2026 1:15:30.14 PM"),
       {.dates = "month first"}},
      {"a rate", "force [N],pressure [barg]\n12.5,1.5\n1300.25,2.5\n-2,3.5\n", {.rate = "100 Hz"}},
      {"a period", "force [N],pressure [barg]\n12.5,1.5\n1300.25,2.5\n-2,3.5\n", {.rate = "10ms"}},
      {"times that are spread",
       replaced(rows("0", "0", "0.02"), "time", "time [s]").append("0.02,0,0\n"),
       {.spread_times = true}},
      {"milliseconds since 1970",
       replaced(rows("1764000000000", "1764000000010", "1764000000020"), "time", "timestamp")},
      {"Excel's days",
       rows("46350.5", "46350.500000115741", "46350.500000231481"),
       {.dates = "excel"}}};
}

void expect_the_same(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name + ":\n" + c.text);
    try {
      const RawTable t = read(c.text, c.source);
      ASSERT_GE(t.rows(), 3u);
      ASSERT_EQ(t.time.size(), t.rows());
      EXPECT_NEAR(t.time[1] - t.time[0], 0.01, 1e-6);
      EXPECT_NEAR(t.time[2] - t.time[0], 0.02, 1e-6);
      ASSERT_EQ(t.columns.size(), 2u);
      EXPECT_EQ(t.columns[0].name, "force");
      EXPECT_EQ(own_unit(t.columns[0].unit).shown, "N");
      EXPECT_EQ(t.columns[0].values[0], 12.5);
      EXPECT_EQ(t.columns[0].values[1], 1300.25);
      EXPECT_EQ(t.columns[0].values[2], -2);
      EXPECT_EQ(t.columns[1].name, "pressure");
      EXPECT_EQ(own_unit(t.columns[1].unit).shown, "bar gauge");
      EXPECT_EQ(t.columns[1].values[2], 3.5);
    } catch (const config::Error& e) {
      ADD_FAILURE() << e.what();
    }
  }
}

TEST(Dialects, EncodingsAndLinesChangeNothing) { expect_the_same(encodings_and_lines()); }
TEST(Dialects, SeparatorsAndMarksChangeNothing) { expect_the_same(separators()); }
TEST(Dialects, HeadersChangeNothing) { expect_the_same(headers()); }
TEST(Dialects, ClocksChangeNothing) { expect_the_same(clocks()); }

TEST(Dialects, LettersOfLatin1AreReadIfTheEncodingIsGiven) {
  const RawTable t = read(
      "Zeit [s];Temp [\xB0"
      "C];Fl\xE4"
      "che [mm\xB2]\n0,5;20,5;3,1\n",
      {.encoding = "latin1"});
  ASSERT_EQ(t.columns.size(), 2u);
  EXPECT_EQ(own_unit(t.columns[0].unit).shown, "degC");
  EXPECT_EQ(t.columns[1].name, "Fläche");
  EXPECT_EQ(own_unit(t.columns[1].unit).shown, "mm2");
}

TEST(Dialects, AUnitThatSinewLacksIsConverted) {
  const RawTable t = read("time [s],p [mbar(g)],F [kp]\n0,500,2\n1,600,3\n");
  const FileUnit pressure = own_unit(t.columns[0].unit), force = own_unit(t.columns[1].unit);
  EXPECT_EQ(pressure.shown, "bar gauge");
  EXPECT_DOUBLE_EQ(pressure.conversion(t.columns[0].values[0]), 0.5);
  EXPECT_EQ(force.shown, "N");
  EXPECT_DOUBLE_EQ(force.conversion(t.columns[1].values[1]), 3 * 9.80665);
}

TEST(Dialects, MissingValuesAreCountedAndKeepTheirRows) {
  std::string text = "time [s],F [N],x [mm]\n";
  const char* missing[] = {"", "-", "--", "NaN", "nan", "NA", "n/a", "#NV", "#N/A", "OL", "Inf"};
  int row = 0;
  for (const char* word : missing) text += std::to_string(row++) + "," + word + ",1\n";
  text += std::to_string(row) + ",5,2\n";
  const RawTable t = read(text);
  ASSERT_EQ(t.rows(), std::size(missing) + 1);
  EXPECT_EQ(t.columns[0].missing, std::size(missing));
  EXPECT_EQ(t.columns[0].values.back(), 5);
  ASSERT_EQ(t.notes.size(), 1u);
  EXPECT_EQ(t.notes[0], "F: 11 of 12 values are missing");
}

TEST(Dialects, OnlyRowsThatMeetTheConditionsAreRead) {
  const std::string text = "time [s],F [N],test,phase\n0,1,1,fill\n1,2,2,fill\n2,3,1,vent\n";
  EXPECT_EQ(read(text, {.where = {{"test", "1"}}}).time, (std::vector<double>{0, 2}));
  EXPECT_EQ(read(text, {.where = {{"test", "1, 2"}, {"phase", "fill"}}}).columns[0].values,
            (std::vector<double>{1, 2}));
}

TEST(Dialects, WhenTheFirstRowWasIsKept) {
  EXPECT_EQ(read("t,x [m]\n2026-11-24T10:15:30.125,1\n2026-11-24T10:15:31,1\n").start,
            "2026-11-24T10:15:30.125");
  EXPECT_EQ(read("t,x [m]\n10:15:30,1\n10:15:31,1\n").start, "10:15:30");
  EXPECT_EQ(read("t [s],x [m]\n5,1\n6,1\n").start, "");
}

TEST(Dialects, OfColumnsWithOneNameBothAreKept) {
  const RawTable t = read("time [s],F [N],F [N]\n0,1,2\n1,3,4\n");
  ASSERT_EQ(t.columns.size(), 2u);
  EXPECT_EQ(t.columns[1].name, "F (2)");
  EXPECT_EQ(t.columns[1].values[1], 4);
  EXPECT_EQ(t.notes.size(), 1u);
}

}  // namespace
}  // namespace sinew::recording::dialects_test
