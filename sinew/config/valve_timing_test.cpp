// predict.dat, whole and damaged.
#include "sinew/config/valve_timing.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config::valve_timing_test {
namespace {

std::vector<std::string> good_rows() {
  std::vector<std::string> rows;
  for (int duty = 0; duty <= 100; ++duty) {
    rows.push_back(std::to_string(duty) + "," + std::to_string(duty) + "," + (duty ? "3" : "101"));
  }
  return rows;
}

std::string joined(const std::vector<std::string>& rows) {
  std::string text;
  for (const auto& row : rows) text += row + "\r\n";
  return text;
}

std::string message(const std::vector<std::string>& rows) {
  try {
    parse_valve_timing(joined(rows), "predict.dat");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string message_with_row(std::size_t index, std::string row) {
  auto rows = good_rows();
  rows[index] = std::move(row);
  return message(rows);
}

TEST(ValveTiming, ReadsAWholeFile) {
  const ValveTiming timing = parse_valve_timing(joined(good_rows()), "predict.dat");
  EXPECT_EQ(timing.opening[0], ValveTiming::never);
  EXPECT_EQ(timing.opening[1], 3);
  EXPECT_EQ(timing.closing[100], 100);
}

TEST(ValveTiming, ReportsHowMuchOfACutFileExists) {
  auto rows = good_rows();
  rows.resize(40);
  EXPECT_EQ(message(rows),
            "predict.dat:40:1: found 40 rows of 101; expected 101 rows, duty 0 to 100; "
            "try a fresh copy: this one is cut short");
  EXPECT_NE(message({}).find("0 rows of 101"), std::string::npos);
}

TEST(ValveTiming, RefusesWhatIsNotATableOfTicks) {
  EXPECT_EQ(
      message_with_row(5, "6,5,3"),
      "predict.dat:6:1: duty: found 6; expected 5; try one row per percent, 0 to 100 in order");
  EXPECT_EQ(message_with_row(5, "5,2,3"),
            "predict.dat:6:1: close: found 2 after 4; expected a closing tick that does not fall "
            "as the duty rises");
  EXPECT_EQ(message_with_row(5, "5,5,4"),
            "predict.dat:6:1: open: found 4 after 3; expected an opening tick that does not rise "
            "as the duty rises");
  EXPECT_EQ(message_with_row(5, "5,5,3.5"),
            "predict.dat:6:5: open: found \"3.5\"; expected a whole number of ticks");
  EXPECT_EQ(message_with_row(5, "5,5,102"),
            "predict.dat:6:1: open: found 102; expected 0 to 101 ticks; try 101 for never");
  EXPECT_NE(message_with_row(5, "5,-1,3").find("close: found -1"), std::string::npos);
  EXPECT_NE(message_with_row(5, "5;5;3").find("found 1 columns"), std::string::npos);
  EXPECT_NE(message_with_row(5, "5,5,3,0").find("found 4 columns"), std::string::npos);
  auto rows = good_rows();
  rows.push_back("101,101,3");
  EXPECT_NE(message(rows).find("found a row more"), std::string::npos);
}

TEST(ValveTiming, ReportsSeveralRowsAtOnce) {
  auto rows = good_rows();
  rows[3] = "3,x,0";
  rows[9] = "9,9,900";
  const std::string text = message(rows);
  EXPECT_NE(text.find("predict.dat:4:3"), std::string::npos);
  EXPECT_NE(text.find("predict.dat:10:1"), std::string::npos);
}

TEST(ValveTiming, AMissingFileIsAnError) {
  EXPECT_THROW(read_valve_timing("no/such/predict.dat"), Error);
}

}  // namespace
}  // namespace sinew::config::valve_timing_test
