// One muscle of a file equals that of the whole file, and continues from its saved state.
#include "sinew/run/muscle/muscle_setup.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/setup/machine_setup.h"
#include "tests/places.h"

namespace sinew::run::muscle_setup_test {
namespace {

const std::string root = sinew::test::source_dir();
const std::string rig_file = root + "/examples/08-your-own-loop/muscle.toml";
const std::string robot_file = root + "/robots/leg-with-hoses/robot.toml";
const std::string walk = root + "/experiments/walk-test-1.toml";

air::DrivenMuscle made(const MuscleSetup& s) {
  return {s.muscle, s.air, s.supply, s.length, s.pressure};
}

// Drives the muscle with pulses at a varying length; returns the final tension.
double driven(air::DrivenMuscle& m, double length, int from, int to) {
  for (int k = from; k < to; ++k) {
    m.inlet(k % 50 < 20);
    m.advance(1e-3, length * (1 - 1e-4 * (k % 300)));
  }
  return m.tension();
}

std::string refusal(const std::string& path, const std::string& name = "",
                    const std::vector<std::string>& sets = {}) {
  try {
    muscle_setup(path, name, sets);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(MuscleSetup, IsTheRigsElement) {
  const plant::StandSetup stand = run::stand_setup(experiment::load(rig_file));
  const MuscleSetup read = muscle_setup(rig_file);
  EXPECT_EQ(read.length, stand.load.length.at(0));
  EXPECT_EQ(read.pressure, stand.air.atmosphere);
  air::DrivenMuscle one = made(read);
  air::DrivenMuscle other(stand.muscle, stand.air, stand.supply, read.length);
  EXPECT_EQ(driven(one, read.length, 0, 400), driven(other, read.length, 0, 400));
  EXPECT_GT(one.tension(), 10);
}

TEST(MuscleSetup, IsTheRobotsMuscle) {
  const plant::Setup planar = planar_setup(buildable(walk));
  for (std::size_t i = 0; i < planar.muscles.size(); ++i) {
    const MuscleSetup read = muscle_setup(walk, planar.muscles[i].name);
    EXPECT_EQ(read.length, planar.robot.muscles[i].mount_length);
    air::DrivenMuscle one = made(read);
    air::DrivenMuscle other(planar.muscles[i], planar.air, planar.supply, read.length,
                            planar.start.pressure);
    EXPECT_EQ(driven(one, read.length, 0, 200), driven(other, read.length, 0, 200));
  }
}

// The text needs no other file, and preserves every bit.
TEST(MuscleSetup, IsMadeAgainFromItsText) {
  for (const auto& [path, name] :
       {std::pair{rig_file, ""}, {robot_file, "knee_flexor"}, {walk, "hip_extensor"}}) {
    const MuscleSetup read = muscle_setup(path, name);
    const MuscleSetup again = muscle_setup_of(read.text, path, name);
    EXPECT_EQ(again.model, read.model);
    EXPECT_EQ(again.text, read.text);
    air::DrivenMuscle one = made(read), other = made(again);
    EXPECT_EQ(driven(one, read.length, 0, 200), driven(other, read.length, 0, 200));
  }
}

TEST(MuscleSetup, TakesSettings) {
  const MuscleSetup plain = muscle_setup(robot_file, "hip_flexor");
  const MuscleSetup more = muscle_setup(robot_file, "hip_flexor", {"muscle.hip_flexor.count=3"});
  EXPECT_EQ(plain.muscle.count, 2);
  EXPECT_EQ(more.muscle.count, 3);
  EXPECT_NE(plain.model, more.model);
}

TEST(MuscleSetup, ReportsWhatIsWrong) {
  EXPECT_NE(refusal(robot_file).find("hip_flexor"), std::string::npos);  // which of four
  EXPECT_NE(refusal(robot_file, "hip_flexer").find("try \"hip_flexor\""), std::string::npos);
  EXPECT_NE(refusal(rig_file, "hip").find("\"hip\""), std::string::npos);
  EXPECT_NE(refusal(root + "/robots/leg/valves.toml").find("a rig, robot or experiment file"),
            std::string::npos);
  EXPECT_NE(refusal("nowhere.toml").find("nowhere.toml"), std::string::npos);
  EXPECT_NE(refusal(rig_file, "", {"element.cont=2"}).find("count"), std::string::npos);
}

TEST(MuscleSave, GoesOnFromIt) {
  const MuscleSetup read = muscle_setup(rig_file);
  air::DrivenMuscle one = made(read), other = made(read);
  driven(one, read.length, 0, 111);
  const std::vector<std::byte> saved = save(one, read);
  const double end = driven(one, read.length, 111, 400);
  restore(other, read, saved);
  EXPECT_EQ(driven(other, read.length, 111, 400), end);
}

TEST(MuscleSave, RefusesWhatIsNone) {
  const MuscleSetup read = muscle_setup(rig_file);
  const MuscleSetup another = muscle_setup(rig_file, "", {"element.count=2"});
  air::DrivenMuscle m = made(read);
  const double before = m.tension();
  std::vector<std::byte> saved = save(m, read);
  driven(m, read.length, 0, 30);
  const std::vector<std::byte> now = save(m, read);
  EXPECT_THROW(restore(m, another, saved), std::invalid_argument);
  EXPECT_THROW(restore(m, read, {}), std::invalid_argument);
  EXPECT_THROW(restore(m, read, std::span(saved).first(saved.size() - 1)), std::invalid_argument);
  saved[saved.size() / 2] ^= std::byte{1};
  EXPECT_THROW(restore(m, read, saved), std::invalid_argument);
  saved[saved.size() / 2] ^= std::byte{1};
  EXPECT_EQ(save(m, read), now);
  restore(m, read, saved);
  EXPECT_EQ(m.tension(), before);
}

}  // namespace
}  // namespace sinew::run::muscle_setup_test
