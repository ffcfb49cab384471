// Static laws on public measurements. The force map of the DMSP-10-250 is in data/; the 20 mm
// muscles may not be shipped, and are read from SINEW_DATA_DIR if set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "sinew/identify/actuator/static.h"
#include "tests/places.h"

namespace sinew::identify::static_public_test {
namespace {

StaticData dmsp() {
  Source source{.path = sinew::test::source_dir() +
                        "/data/martens_boblan_2017/DMSP-10-250_force_map.csv"};
  source.names = {{"force", "F_N"}, {"pressure", "P_gauge_Pa"}, {"length", "L_m"}};
  source.units = {{"F_N", "N"}, {"P_gauge_Pa", "Pa gauge"}, {"L_m", "m"}};
  StaticData data;
  add_points(read_measured(source, static_columns()), {.rest_length = 0.25}, data);
  return data;
}

// Every second pressure is left out: 0.5 % of the largest force. All models are tried.
TEST(PublicData, DmspByPressure) {
  const StaticResult found = identify_static(dmsp(), {.hold_out = HoldOut::pressure});
  EXPECT_LE(found.report.best().held_out->rmse_percent, 0.5) << found.report.rule;
  EXPECT_LE(found.report.best().held_out->max_percent, 2.5);
}

// Each length in turn is left out, also the longest and the shortest. The model of the data's
// authors, fitted to all, has errors up to 4.4 %; lengths between the ends have at most this error.
// The rest length is predicted worse from the others, by 4.7 %: there the bladder's first pull is
// steepest. Required: 0.9 % rms.
TEST(PublicData, DmspByLength) {
  const StaticResult found = identify_static(dmsp(), {.hold_out = HoldOut::length});
  EXPECT_LT(found.report.best().held_out->rmse_percent, 0.9) << found.report.rule;
  EXPECT_LT(found.report.best().held_out->max_percent, 5.0);
  EXPECT_LT(found.report.best().cross_validated->max_percent, 4.4);
}

std::string shared(const std::string& name) {
  const char* folder = std::getenv("SINEW_DATA_DIR");
  if (!folder) return "";
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  return std::filesystem::exists(path) ? path.string() : "";
}

// One muscle of the 20 mm bins: its fill branch, fitted at 100, 200 ... 600 kPa.
StaticResult bins(const std::string& path, const std::string& muscles, bool all) {
  Source source{.path = path, .drop_incomplete = true};
  source.names = {{"force", "F_mean_N"},
                  {"pressure", "p_mean_kPa"},
                  {"length", "l_mounted_mm"},
                  {"rest_length", "l_rest_mm"},
                  {"branch", "phase"}};
  source.units = {
      {"F_mean_N", "N"}, {"p_mean_kPa", "kPa gauge"}, {"l_mounted_mm", "mm"}, {"l_rest_mm", "mm"}};
  source.where = {{"l_rest_mm", muscles}, {"phase", "fill"}};
  StaticData data;
  const Measured every = read_measured(source, static_columns());
  add_points(every, {}, data);
  source.where["p_bin_kPa"] = "100,200,300,400,500,600";
  const std::vector<int> lines = read_measured(source, static_columns()).lines;
  for (std::size_t i = 0; i < every.rows() && !all; ++i)
    data.points[i].fitted = std::find(lines.begin(), lines.end(), every.lines[i]) != lines.end();
  return identify_static(data, {.model = all ? "saturating" : ""});
}

TEST(PublicData, MusclesOf20MmByPressure) {
  const std::string path = shared("psu_20mm/isometric_bins.csv");
  if (path.empty()) GTEST_SKIP() << "SINEW_DATA_DIR has no psu_20mm";
  const auto held_out = [&](const char* muscle) {
    return bins(path, muscle, false).report.best().held_out->rmse_percent;
  };
  EXPECT_LE(held_out("98"), 1.0);  // required: 2.5, 3.0, 1.0
  EXPECT_LE(held_out("225"), 1.0);
  EXPECT_LE(held_out("398"), 1.0);
}

// The chosen law's error on held-out data is hardly larger than that of the best law.
TEST(PublicData, TheChoiceIsNearTheBestOfAllOnMusclesOf10And20Mm) {
  const std::string small = shared("psu_10mm/isometric_bins.csv");
  const std::string large = shared("psu_20mm/isometric_bins.csv");
  if (small.empty() || large.empty()) GTEST_SKIP() << "SINEW_DATA_DIR has no psu_10mm or psu_20mm";
  for (const auto& [path, muscle] :
       {std::pair{small, "182"}, {small, "281"}, {small, "382"}, {large, "98"}, {large, "398"}}) {
    const Report report = bins(path, muscle, false).report;
    double best = report.best().held_out->rmse_percent;
    for (const Fit& fit : report.fits)
      if (fit.refused.empty()) best = std::min(best, fit.held_out->rmse_percent);
    EXPECT_LE(report.best().held_out->rmse_percent, 1.3 * best) << muscle << report.rule;
    EXPECT_LE(report.best().held_out->rmse_percent, 2.6) << muscle;
  }
}

// Three rest lengths, one law: the ends take 3 cm from each.
TEST(PublicData, MusclesOf20MmAreOfOneMake) {
  const std::string path = shared("psu_20mm/isometric_bins.csv");
  if (path.empty()) GTEST_SKIP() << "SINEW_DATA_DIR has no psu_20mm";
  const StaticResult found = bins(path, "98,225,398", true);
  EXPECT_EQ(found.muscles.size(), 3u);
  EXPECT_LE(found.report.best().fit.rmse_percent, 2.6);
  EXPECT_NEAR(found.fit.setting.end_loss, 0.03, 0.01);
}

// Three mounts, recorded at 600 Hz: branches, zeros and bins are found automatically.
TEST(PublicData, RecordingsOf20MmNeedNoHand) {
  const std::string first = shared("psu_20mm/raw/20mm_23cm_Unkinked_Test10.csv");
  if (first.empty()) GTEST_SKIP() << "SINEW_DATA_DIR has no psu_20mm";
  StaticData data;
  const std::pair<const char*, double> mounts[] = {
      {"Unkinked", 0.225}, {"Kinked9mm", 0.219}, {"Kinked19mm", 0.209}};
  for (const auto& [mount, length] : mounts) {
    Source source{.path = shared(std::string("psu_20mm/raw/20mm_23cm_") + mount + "_Test10.csv"),
                  .columns = {"force [N]", "pressure [kPa gauge]", "time [s]"},
                  .values = {fmt::format("length={} m", length)}};
    const Zero zero =
        add_points(read_measured(source, static_columns()), {.rest_length = 0.225}, data);
    EXPECT_NEAR(zero.pressure, 8.9e3, 300) << mount;
  }
  for (const Branch branch : {Branch::fill, Branch::vent})
    EXPECT_GT(std::count_if(data.points.begin(), data.points.end(),
                            [&](const StaticPoint& p) { return p.branch == branch; }),
              40);
  const StaticResult found = identify_static(data, {.model = "saturating"});
  EXPECT_LE(found.report.best().fit.rmse_percent, 1.2);
}

// Twelve recordings of each muscle of 10 mm, settled samples: pressures between the ends that are
// left out are predicted within the requirement by the law that `sinew identify static` chooses
// there; trying the others takes a minute.
TEST(PublicData, RecordingsOf10MmBySettledSamples) {
  const std::string folder = shared("psu_10mm/raw");
  if (folder.empty()) GTEST_SKIP() << "SINEW_DATA_DIR has no psu_10mm";
  for (const auto& [size, muscle, kink, most, law] :
       {std::tuple{"20cm", 182.0, 7.5, 1.9, "saturating-series-toe"},
        {"30cm", 281.0, 12.25, 1.3, "saturating-effectiveness"},
        {"40cm", 382.0, 17.0, 1.2, "saturating-effectiveness"}}) {
    StaticData data;
    for (int mount = 0; mount < 4; ++mount)
      for (int test = 8; test <= 10; ++test) {
        const std::string name = mount ? "kinked" + std::to_string(25 * mount) : "Unkink";
        Source source{
            .path = folder + "/10mm_" + size + "_" + name + "_Test" + std::to_string(test) + ".csv",
            .columns = {"force [N]", "pressure [kPa gauge]", "time [s]", "valve"},
            .values = {fmt::format("length={} mm", muscle - kink * mount)}};
        add_points(read_measured(source, static_columns()), {.rest_length = 1e-3 * muscle}, data);
      }
    const StaticResult found = identify_static(data, {.model = law});
    const Fit& best = found.report.best();
    ASSERT_EQ(best.kinds.size(), 2u);
    EXPECT_LE(best.kinds[0], most) << muscle << best.model;
  }
}

}  // namespace
}  // namespace sinew::identify::static_public_test
