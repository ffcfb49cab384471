// The walk against the thesis, as bands that hold for every noise seed, not for one lucky run: one
// parameter file, robots/leg, for all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sinew/analysis/machine.h"
#include "sinew/analysis/reported.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/run.h"
#include "sinew/units/constants.h"

namespace sinew {
namespace {

constexpr double inch = units::inch, degree = 3.14159265358979312 / 180;
constexpr int seeds = 20;

analysis::Summary summary_of(const std::string& name, std::vector<std::string> sets = {}) {
  const std::string path = std::string(SINEW_SOURCE_DIR) + "/experiments/" + name + ".toml";
  const config::Node root = config::compose(path, sets);
  const experiment::Outcome out = experiment::run(experiment::load(root, path));
  EXPECT_EQ(out.status, signals::Status::ok) << name;
  return analysis::summarize(out.table, analysis::read_machine(root));
}

std::vector<analysis::Summary> over_seeds(const std::string& name) {
  std::vector<analysis::Summary> all;
  for (int seed = 1; seed <= seeds; ++seed)
    all.push_back(summary_of(name, {"seed=" + std::to_string(seed)}));
  return all;
}

// Every run's value lies in [low, high] of `unit`.
void expect_band(const std::vector<analysis::Summary>& runs, const char* key, double low,
                 double high, double unit) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double* value = runs[i].find(key);
    ASSERT_NE(value, nullptr) << key;
    EXPECT_GE(*value / unit, low) << key << " of seed " << i + 1;
    EXPECT_LE(*value / unit, high) << key << " of seed " << i + 1;
  }
}

TEST(Bands, Test1WalksAsReported) {
  const auto runs = over_seeds("walk-test-1");
  expect_band(runs, "trolley.distance_m", 53, 60, inch);
  expect_band(runs, "trolley.mean_speed_m_per_s", 4.2, 5.2, inch);
  expect_band(runs, "trolley.distance_from_torques_m", 53, 70, inch);
  expect_band(runs, "joints.hip.passiveness", 92, 96, 0.01);
  expect_band(runs, "joints.knee.passiveness", 62, 70, 0.01);
  expect_band(runs, "foot.stick_share_first_half_propulsion", 0.95, 1, 1);

  // The hip extensor alone reaches the converter's ceiling, 4095 / (819.2 x 0.17) = 29.4 lb.
  constexpr double ceiling = 4095 / (819.2 * 0.17);
  expect_band(runs, "muscles.hip_extensor.measured_peak_tension_N", 0.999 * ceiling,
              1.001 * ceiling, units::pound_force);
  for (const char* other : {"hip_flexor", "knee_flexor", "knee_extensor"}) {
    const std::string key = std::string("muscles.") + other + ".measured_peak_tension_N";
    expect_band(runs, key.c_str(), 0, 0.8 * ceiling, units::pound_force);
  }
}

TEST(Bands, Test2IsFasterPlannedAndWorse) {
  const auto slow = over_seeds("walk-test-1"), fast = over_seeds("walk-test-2");
  expect_band(fast, "trolley.distance_m", 15, 25, inch);
  for (std::size_t i = 0; i < fast.size(); ++i) {
    const auto less = [&](const char* key, double share) {
      EXPECT_LT(*fast[i].find(key), share * *slow[i].find(key)) << key << " of seed " << i + 1;
    };
    less("trolley.distance_m", 0.5);
    less("trolley.mean_speed_m_per_s", 1.0);
    EXPECT_GT(*fast[i].find("joints.hip.swing_oscillation_rms_rad"),
              1.2 * *slow[i].find("joints.hip.swing_oscillation_rms_rad"));
  }
}

TEST(Bands, WithoutDragItIsTwiceAsFast) {
  expect_band(over_seeds("no-drag"), "trolley.mean_speed_m_per_s", 8, 10, inch);
}

// Table 6-1, within 2 deg.
TEST(Bands, TheActuatorsLimitTheJoints) {
  const analysis::Summary s = summary_of("joint-limits");
  const auto expect = [&](const char* key, double degrees) {
    const double* value = s.find(key);
    ASSERT_NE(value, nullptr) << key;
    EXPECT_NEAR(*value / degree, degrees, 2.0) << key;
  };
  expect("phases.extended.joints.hip.end_angle_true_rad", 249);
  expect("phases.flexed.joints.hip.end_angle_true_rad", 307);
  expect("phases.extended.joints.knee.end_angle_true_rad", 343);
  expect("phases.flexed.joints.knee.end_angle_true_rad", 289);

  // Vented, a joint rests where dry friction lets it: the table's angle lies between the two.
  const auto between = [&](const char* joint, double degrees) {
    const auto end = [&](const char* side) {
      return *s.find(std::string("phases.relaxed_from_") + side + ".joints." + joint +
                     ".end_angle_true_rad") /
             degree;
    };
    EXPECT_LT(std::min(end("flexion"), end("extension")), degrees) << joint;
    EXPECT_GT(std::max(end("flexion"), end("extension")), degrees) << joint;
  };
  between("hip", 278);
  between("knee", 314);
}

// At 50 us between nodes the same walk, seed by seed: within an inch.
TEST(Bands, Test1IsConverged) {
  for (int seed = 1; seed <= 4; ++seed) {
    const std::string set = "seed=" + std::to_string(seed);
    const analysis::Summary coarse = summary_of("walk-test-1", {set});
    const analysis::Summary fine = summary_of("walk-test-1", {set, "plant_steps.body=50 us"});
    const char* key = "trolley.distance_m";
    EXPECT_NEAR(*coarse.find(key) / inch, *fine.find(key) / inch, 1.0) << set;
  }
}

// What an experiment says of itself holds: no verdict of a shipped experiment is `differs`.
TEST(Bands, NoShippedExperimentDiffers) {
  for (const char* name : {"walk-test-1", "walk-test-2", "no-drag", "joint-limits", "leg-in-air",
                           "blocked-joint", "one-joint", "touchdown"}) {
    const std::string path = std::string(SINEW_SOURCE_DIR) + "/experiments/" + name + ".toml";
    const analysis::Machine machine = analysis::read_machine(config::compose(path));
    for (const analysis::Verdict& v : analysis::compare(summary_of(name), machine.reported))
      EXPECT_NE(v.is, analysis::Verdict::Is::differs) << name << ": " << v.key << " " << v.ours;
  }
}

}  // namespace
}  // namespace sinew
