// The notes of a row: one wording per reason, checked with runs that have it.

#include <gtest/gtest.h>

#include "sinew/tune/sweep.h"
#include "tests/places.h"

namespace sinew::tune::notes_test {
namespace {

const std::string root = sinew::test::source_dir();
const std::string walk = root + "/experiments/walk-test-1.toml";
const std::string lever = root + "/experiments/one-joint.toml";

Row row_of(Sweep s) { return sweep(s, {}).front(); }

TEST(Notes, AreWordsInOneOrder) {
  EXPECT_EQ(to_text({}), "");
  EXPECT_EQ(status_with({}, "ok"), "ok");
  const Notes all{.lacks = {"a_m", "b_m"},
                  .differs = {"c_m"},
                  .stop_reached = true,
                  .no_air = true,
                  .out_of_reach = true};
  EXPECT_EQ(to_text(all),
            "without a_m, b_m; reaches the end of the track; uses no air; aims out of reach; "
            "differs in c_m");
  EXPECT_EQ(status_with({.no_air = true}, "holds to the last value"),
            "holds to the last value; uses no air");
}

TEST(Notes, AimsOutOfReach) {
  const Sweep s{.experiment = walk,
                .sets = {"link.femur.length=8 in"},
                .report = parse_figures("unreachable_share"),
                .allow_unreachable = true};
  const Row row = row_of(s);
  EXPECT_TRUE(row.ok);
  EXPECT_TRUE(row.notes.out_of_reach);
  EXPECT_GT(std::stod(row.cells[0]), 0);
  EXPECT_NE(row.cells.back().find("aims out of reach"), std::string::npos);
}

TEST(Notes, UsesNoAir) {
  const Sweep s{
      .experiment = lever,
      .sets = {"joint.lever.angle_gain=0 %/count", "joint.lever.stiffness_gain=0 %/(lbf in/rad)"},
      .report = parse_figures("air_used_kg")};
  const Row row = row_of(s);
  EXPECT_TRUE(row.notes.no_air);
  EXPECT_EQ(row.cells, (std::vector<std::string>{"0", "uses no air"}));
}

// Sources report values of the unchanged experiment, so a row that changes it is not compared.
TEST(Notes, AChangedExperimentIsNotJudgedByWhatIsReported) {
  const Sweep s{.experiment = walk,
                .sets = {"trolley.track_length=20 in"},
                .report = parse_figures("trolley.distance_m")};
  EXPECT_EQ(row_of(s).cells.back(), "reaches the end of the track");
}

TEST(Share, HasEachPointOnce) {
  for (const std::size_t n : {1u, 2u, 3u, 7u})
    for (const std::size_t points : {0u, 1u, 6u, 7u, 20u}) {
      std::vector<int> taken(points);
      for (std::size_t i = 1; i <= n; ++i) {
        const Share share{i, n};
        std::size_t size = 0;
        for (std::size_t p = 0; p < points; ++p)
          if (share.has(p)) ++size, ++taken[p];
        EXPECT_EQ(share.size(points), size) << i << "/" << n << " of " << points;
      }
      EXPECT_EQ(std::ranges::count(taken, 1), static_cast<std::ptrdiff_t>(points));
    }
}

}  // namespace
}  // namespace sinew::tune::notes_test
