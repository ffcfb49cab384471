#include "sinew/identify/machine/run_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/identify/machine/run_fit.h"
#include "sinew/identify/machine/test_runs.h"

namespace sinew::identify::run_score_test {
namespace {

using experiment::Experiment;

// Scores `machine` on the recording; returns the rms of each channel in units of its sensor's
// noise.
std::vector<double> rms_per_noise(const Experiment& machine, const Experiment& recording,
                                  const DrivenRun& driven) {
  std::vector<std::string> differing;
  const Experiment scored = scored_machine(machine, recording, {}, "other", differing);
  std::vector<double> out;
  for (const Report& part : score_run(scored, driven, 0, "other"))
    for (const PartError& one : part.errors[0].parts) {
      const RunChannel& c = driven.channels()[out.size()];
      EXPECT_EQ(one.score.points, c.value.size());
      out.push_back(one.score.rmse * std::abs(c.per_unit) / c.noise);
    }
  EXPECT_EQ(out.size(), driven.channels().size());
  return out;
}

// A machine with changed parameters is identified from one run and scored on another with other
// movements: the true parameters leave the sensors' noise, the identified ones hardly more, and the
// start values far more.
TEST(RunScore, OfWhatWasIdentifiedIsNearlyTheNoise) {
  const std::vector<std::string> other_way = {
      "sequence.repeat=1", R"(phase.up.joint_angles.lever=["270 deg", "300 deg"])",
      R"(phase.hold_up.joint_angles.lever=["300 deg"])"};
  const Experiment start = shipped("one-joint"), there = shipped("one-joint", other_way);
  const auto injected = [](Experiment e, int seed) {
    set_number(e, "joint.lever.dry_friction", 0.07);
    set_number(e, "joint.lever.damping", 0.06);
    set_number(e, "valve.inlet.closing_delay", 0.37e-3);
    e.seed = seed;
    return e;
  };
  const Experiment machine = injected(start, 3), recording = injected(there, 7);
  const RunFitResult found = fit_run(start, DrivenRun(start, recorded(machine), false),
                                     {.fit = {"friction", "damping", "valve.inlet.closing_delay"}});
  const DrivenRun driven(recording, recorded(recording), false);
  const std::vector<double> truth = rms_per_noise(machine, recording, driven);
  const std::vector<double> identified = rms_per_noise(found.machine, recording, driven);
  const std::vector<double> before = rms_per_noise(start, recording, driven);
  for (std::size_t c = 0; c < truth.size(); ++c) {
    const auto n = static_cast<double>(driven.channels()[c].value.size());
    EXPECT_LT(truth[c], 1 + 4 / std::sqrt(2 * n)) << driven.channels()[c].name;
    EXPECT_LT(identified[c], 1.1 * truth[c]) << driven.channels()[c].name;
    EXPECT_GT(before[c], 5 * truth[c]) << driven.channels()[c].name;
  }
}

// The description of the recording has other parameters than the machine: the recording's start and
// the machine's body are used, and differing parameters that were not fitted are named.
TEST(RunScore, TakesTheBodyOfTheMachineAndTheStartOfTheRecording) {
  Experiment machine = shipped("one-joint"), recording = shipped("one-joint");
  set_number(machine, "joint.lever.damping", 0.06);
  set_number(machine, "joint.lever.dry_friction", 0.07);
  recording.start.joint_angles["lever"] = 4.5;
  std::vector<std::string> differing;
  Experiment scored =
      scored_machine(machine, recording, {"joint.lever.damping"}, "other", differing);
  EXPECT_EQ(number_at(scored, "joint.lever.damping"), 0.06);
  EXPECT_EQ(scored.start.joint_angles["lever"], 4.5);
  EXPECT_EQ(differing, std::vector<std::string>{"joint.lever.dry_friction"});
  EXPECT_EQ(refusal([&] {
              (void)scored_machine(machine, shipped("leg-in-air"), {}, "other", differing);
            }),
            "other: found a machine without link.lever.length; expected a recording of the machine "
            "that was identified; try one of the same joints, muscles, actuators and valves");
}

// Nothing is fitted if the whole run is held out.
TEST(RunScore, AllOfARunMayBeHeldOut) {
  const Experiment e = shipped("one-joint", {"sequence.repeat=1"});
  const DrivenRun driven(e, recorded(e), false);
  const RunFitResult found = fit_run(e, driven, {.hold_out = 1});
  EXPECT_TRUE(found.report.best().parameters.empty());
  EXPECT_EQ(found.report.best().fit.points, 0u);
  EXPECT_NEAR(found.report.best().held_out->rmse, 1, 0.1);
  EXPECT_EQ(refusal([&] { fit_run(e, driven, {.fit = {"damping"}, .hold_out = 1}); }),
            "hold_out: found 100 %, and numbers to fit; expected one or the other; try less, or no "
            "fit and prior");
}

}  // namespace
}  // namespace sinew::identify::run_score_test
