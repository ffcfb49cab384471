// Experiments that cannot run are refused with their key; one that diverges nevertheless ends its
// run, in every world, with the muscle, the time and the cause.

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::run::failure_test {
namespace {

const std::string folder = sinew::test::source_dir() + "/experiments/";

std::string refusal(const std::string& name, const std::vector<std::string>& sets) {
  try {
    (void)buildable(folder + name + ".toml", sets);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "none";
}

void expect_says(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << text << "\nlacks " << words;
}

// Formerly, this gave 524 of 524 rows with a pressure of NaN, and exit status 0.
TEST(Refusal, NamesTheMuscleThatHasNoVolumeAtTheStart) {
  const std::string text = refusal("cricket", {"joint.knee.moment_arm=0.0335756 m"});
  expect_says(text, "muscle.knee_");
  expect_says(text, ".mount_length: found a chamber without volume: with joint knee at ");
  expect_says(text, "try a smaller joint.knee.moment_arm");
  EXPECT_EQ(refusal("cricket", {}), "none");
}

TEST(Refusal, NamesTheMuscleWhoseThreadIsStraightWithoutAVolumeBesides) {
  const std::vector<std::string> sets = {"joint.knee.moment_arm=4 in",
                                         "muscle.knee_extensor.external_volume=0 m3"};
  const std::string text = refusal("walk-test-1", sets);
  expect_says(text, "muscle.knee_");
  expect_says(text, "found a chamber without volume: with joint knee at ");
  // Each of these alone leaves air in every muscle within the plan's range.
  EXPECT_EQ(refusal("walk-test-1", {sets[1]}), "none");
}

TEST(Refusal, NamesTheRestAngleThatNoMuscleReaches) {
  const std::string text = refusal("walk-test-1", {"joint.hip.rest_angle=0 deg"});
  expect_says(text, "found a chamber without volume: with joint hip at ");
  expect_says(text, "or another rest_angle");
}

// Values that the controller's numbers cannot represent. `check` accepted each, and run refused it
// without a key or used what remained in 32 bits.
TEST(Refusal, NamesWhatTheControllerCannotHold) {
  const auto says = [](const std::string& set, const std::string& words) {
    expect_says(refusal("walk-test-1", {set}), words);
  };
  says("low_level.assumed_mount_length=315 in",
       "low_level.assumed_mount_length: found 241605 count");
  says("low_level.assumed_thread_length=300 in",
       "low_level.assumed_thread_length: found 230100 count");
  says("sensor.hip_extensor_tension.assumed.scale=1e-6 V/lbf",
       "sensor.hip_extensor_tension.assumed.scale: found a count 170000 times as strong");
  says("sensor.hip_angle.assumed.scale=1e5 count/rad", "count of sensor.hip_angle");
  says("low_level.output_delay=101", "low_level.output_delay: found 101");
}

// --- failures detected in the loop ---

// Beyond the limits of buildable().
experiment::Experiment without_volume(const std::string& name) {
  experiment::Experiment e = experiment::load(folder + name + ".toml", {"sequence.repeat=1"});
  for (robot::Muscle& m : e.robot.muscles) m.external_volume = 0;
  for (robot::Joint& j : e.robot.joints)
    if (j.name == "knee") j.moment_arm *= 8;
  return e;
}

TEST(Failure, OfAirEndsTheRunInEveryWorld) {
  for (const char* name : {"walk-test-1", "walk-with-ankle", "walk-with-hoses"}) {
    const experiment::Experiment e = without_volume(name);
    const Outcome out = run(e);
    EXPECT_TRUE(out.ended_early()) << name;
    EXPECT_EQ(out.failure.of, air::Failure::Of::air) << name;
    const std::string cause = cause_of(e, out);
    expect_says(cause, "the air of muscle knee_");
    expect_says(cause, " was not finite at 0.0000 s: it was ");
    // The run does not continue after it.
    for (const signals::Series& s : out.table.series) EXPECT_EQ(s.time_ns.size(), 0u) << name;
  }
}

// A muscle whose bladder is too stiff for the step, which is limited by the joints, the ground, and
// the losses of muscles, but not by their stiffness.
const std::vector<std::string> runs_away{"muscle.knee_extensor.bladder_stiffness=1e8 N/m",
                                         "log.period=0.5 ms"};

TEST(Failure, OfTheMotionIsDistinguishedFromThatOfAir) {
  const experiment::Experiment e = experiment::load(folder + "walk-test-1.toml", runs_away);
  const Outcome out = run(e);
  ASSERT_TRUE(out.failure);
  EXPECT_GT(out.failure.time, 1e-3);  // after a few steps
  const std::string cause = cause_of(e, out);
  expect_says(cause, "the motion ran away");
  expect_says(cause, "plant_steps.body");
}

// The log ends at the failure, and all its values are finite.
TEST(Failure, LeavesNoNumberThatIsNone) {
  const Outcome out = run(experiment::load(folder + "walk-test-1.toml", runs_away));
  ASSERT_TRUE(out.failure);
  for (const signals::Series& s : out.table.series) {
    if (s.time_ns.empty()) continue;
    EXPECT_LE(1e-9 * static_cast<double>(s.time_ns.back()), out.failure.time) << s.topic.name;
    if (!s.topic.name.starts_with("/true/")) continue;
    for (const auto& column : s.columns)
      for (const double x : column) ASSERT_TRUE(std::isfinite(x)) << s.topic.name;
  }
  EXPECT_NEAR(1e-9 * static_cast<double>(out.table.series.front().time_ns.back()), out.failure.time,
              0.03);
}

}  // namespace
}  // namespace sinew::run::failure_test
