#include "sinew/log/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "sinew/log/fixtures_test.h"

namespace sinew::log::csv_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;

signals::Table small_table() {
  const double nan = std::nan("");
  return {{
              {{"/joint/hip/angle", "", {{"value", "rad"}}},
               {0, 10 * kMs, 20 * kMs},
               {{4.71, 0.1, -0.0}}},
              {{"/true/foot/force", "", {{"x", "N"}, {"y", "N"}}},
               {0, 20 * kMs},
               {{1e-320, nan}, {-2, 3.5}}},
              {{"/valve/hip_flexor/inlet/open", "", {{"value", "1"}}},
               {3 * kMs, 10 * kMs, 12 * kMs, 13 * kMs},
               {{1, 0, 1, 0}}},
              {{"/sensor/a, \"b\"/count", "", {{"value", ""}}}, {15 * kMs}, {{4095}}},
          },
          true};
}

TEST(Csv, SmallTable) {
  std::ostringstream out;
  write_csv(small_table(), out);
  EXPECT_EQ(out.str(),
            "time [s],/joint/hip/angle [rad],/true/foot/force.x [N],/true/foot/force.y [N],"
            "/valve/hip_flexor/inlet/open [1],\"/sensor/a, \"\"b\"\"/count\"\n"
            "0,4.71,1e-320,-2,0,\n"
            "0.01,0.1,,,0,\n"
            "0.015,,,,0,4095\n"
            "0.02,-0,,3.5,0,\n");
}

TEST(Csv, HeldEdgesAtTheRows) {
  signals::Table table = small_table();
  table.series[2].time_ns = {3 * kMs, 15 * kMs, 20 * kMs, 30 * kMs};
  std::ostringstream out;
  write_csv(table, out, {"/valve", "/joint/hip/angle"});
  EXPECT_EQ(out.str(),
            "time [s],/joint/hip/angle [rad],/valve/hip_flexor/inlet/open [1]\n"
            "0,4.71,0\n0.01,0.1,1\n0.02,-0,1\n");
}

TEST(Csv, EdgesAlone) {
  std::ostringstream out;
  write_csv(small_table(), out, {"/valve/hip_flexor/"});
  EXPECT_EQ(out.str(),
            "time [s],/valve/hip_flexor/inlet/open [1]\n0.003,1\n0.01,0\n0.012,1\n0.013,0\n");
}

TEST(Csv, ChoiceIsByWholeNames) {
  std::ostringstream out;
  write_csv(small_table(), out, {"/joint/hip/ang"});
  EXPECT_EQ(out.str(), "time [s]\n");
}

TEST(Csv, EmptyTable) {
  std::ostringstream out;
  write_csv({}, out);
  EXPECT_EQ(out.str(), "time [s]\n");
}

TEST(Csv, ToAFile) {
  const Folder folder;
  std::ostringstream out;
  write_csv(small_table(), out);
  write_csv(small_table(), folder / "log.csv");
  EXPECT_EQ(bytes_of(folder / "log.csv"), out.str());
  EXPECT_THAT(error_of([&] { write_csv(small_table(), folder / "no" / "log.csv"); }),
              HasSubstr("log.csv: cannot be written: No such file or directory"));
}

}  // namespace
}  // namespace sinew::log::csv_test
