#include "sinew/identify/machine/run_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sinew/config/write/writer.h"
#include "sinew/experiment/numbers.h"
#include "sinew/identify/machine/run_search.h"
#include "sinew/identify/machine/test_runs.h"
#include "sinew/json/json.h"

namespace sinew::identify::run_fit_test {
namespace {

const Estimate& estimate(const RunFitResult& found, const std::string& key) {
  for (const Estimate& e : found.report.best().parameters)
    if (e.name == key) return e;
  throw std::out_of_range(key);
}

// Changed parameters are found in noisy counts of three sensors, and are within intervals that are
// no wider than necessary.
TEST(RunFit, FindsFrictionAndADeadTimeOfOneJoint) {
  const experiment::Experiment start = shipped("one-joint");
  const std::map<std::string, double> truth = {{"joint.lever.dry_friction", 0.07},
                                               {"valve.inlet.closing_delay", 0.37e-3}};
  experiment::Experiment machine = start;
  for (const auto& [key, value] : truth) set_number(machine, key, value);
  machine.seed = 3;
  const DrivenRun driven(start, recorded(machine), false);
  const RunFitResult found =
      fit_run(start, driven, {.fit = {"joint.lever.dry_friction", "valve.inlet.closing_delay"}});
  for (const auto& [key, value] : truth) {
    const Estimate& e = estimate(found, key);
    EXPECT_LE(e.low, value) << key;
    EXPECT_GE(e.high, value) << key;
    EXPECT_LT(e.high - e.low, 0.01 * value) << key;
    EXPECT_TRUE(e.identifiable) << key;
  }
  EXPECT_NEAR(found.report.best().fit.rmse, 1, 0.05);
  EXPECT_NEAR(found.report.best().held_out->rmse, 1, 0.1);
  EXPECT_GT(found.at_start, 10);
  EXPECT_TRUE(found.undetermined.empty());
}

// A dead time several ticks from the start is found, also one of whole ticks, whose pulses of just
// its length are lost.
TEST(RunFit, FindsADeadTimeSeveralTicksFromTheStart) {
  const std::string key = "valve.inlet.opening_delay";
  const experiment::Experiment start = shipped("one-joint");
  for (const double truth : {0.45e-3, 0.3e-3}) {
    experiment::Experiment machine = start;
    set_number(machine, key, truth);
    const DrivenRun driven(start, recorded(machine), false);
    const RunFitResult found = fit_run(start, driven, {.fit = {"dead-time"}});
    EXPECT_GT(found.at_start, 100);
    EXPECT_NEAR(found.report.best().fit.rmse, 1, 0.05);
    EXPECT_NEAR(estimate(found, key).value, truth, 1e-4);
  }
}

// If the numbers that are fitted cannot explain the run, the result is still no worse than the
// start, and residuals far above the noise give no interval.
TEST(RunFit, IsNeverWorseThanItsStartAndGivesNoIntervalFarAboveTheNoise) {
  const std::vector<std::string> fit = {"valve.inlet.opening_delay", "valve.exhaust.closing_delay"};
  experiment::Experiment start = shipped("one-joint");
  const DrivenRun driven(start, recorded(start), false);
  for (const double times : {1.0, 1.02, 1.5}) {
    experiment::Experiment other = start;
    const std::string volume = "muscle.flexor.external_volume";
    set_number(other, volume, times * number_at(start, volume));
    const RunFitResult found = fit_run(other, driven, {.fit = fit, .rounds = 1});
    const double left = found.report.best().fit.rmse;
    EXPECT_LE(left, found.at_start * (1 + 1e-9)) << times;
    EXPECT_EQ(left > 5, !found.no_intervals.empty()) << times << ": " << left;
    for (const Estimate& e : found.report.best().parameters)
      EXPECT_EQ(std::isfinite(e.high - e.low), found.no_intervals.empty()) << times;
    if (left > 5) {
      EXPECT_NE(found.no_intervals.find("times the sensors' noise"), std::string::npos);
      EXPECT_EQ(run_file(found, "a run", config::make_table("robot")).find("uncertainty"),
                std::string::npos);
    }
  }
}

// A leg that hangs in the air does not move its trolley measurably.
TEST(RunFit, ReportsWhatNoReadingDependsOn) {
  const experiment::Experiment e = shipped("leg-in-air");
  const DrivenRun driven(e, recorded(e), false);
  const RunFitResult found =
      fit_run(e, driven, {.fit = {"trolley.drag", "joint.hip.damping"}, .rounds = 0});
  EXPECT_EQ(found.undetermined, std::vector<std::string>{"trolley.drag: no reading depends on it"});
  EXPECT_EQ(found.report.best().parameters.size(), 1u);
}

// A valve that loses every pulse has a closing delay without effect. Here it does so at the
// start of the search, by a tick, but not in the recorded run.
TEST(RunFit, FindsADelayThatOnlyAnotherDelayMakesFelt) {
  experiment::Experiment start = shipped("one-joint");
  const std::string opens = "valve.exhaust.opening_delay", closes = "valve.exhaust.closing_delay";
  const double opening = number_at(start, opens), closing = number_at(start, closes);
  const DrivenRun driven(start, recorded(start), false);
  const auto has_effect = [&] {
    std::vector<double> at(driven.samples()), there(driven.samples());
    set_number(start, closes, closing);
    EXPECT_TRUE(driven.predict(start, at, driven.duration()));
    set_number(start, closes, closing + 3e-4);
    EXPECT_TRUE(driven.predict(start, there, driven.duration()));
    set_number(start, closes, closing);
    return at != there;
  };
  double lost = opening;
  while (has_effect() && lost < 0.01) set_number(start, opens, lost += 1e-4);
  ASSERT_LT(lost, 0.01);
  const RunFitResult found = fit_run(start, driven, {.fit = {opens, closes}});
  EXPECT_TRUE(found.undetermined.empty());
  EXPECT_NEAR(found.report.best().fit.rmse, 1, 0.1);
  for (const auto& [key, value] : {std::pair{opens, opening}, {closes, closing}}) {
    const Estimate& e = estimate(found, key);
    EXPECT_LE(e.low, value) << key;
    EXPECT_GE(e.high, value) << key;
  }
}

// A walk's readings jump with its parameters, so an interval would be wrong: none is given, with
// the reason, and the robot's file has no uncertainty. The value itself is nearer than at the
// start.
TEST(RunFit, GivesNoIntervalsOfAWalk) {
  experiment::Experiment start = shipped("walk-test-1", {"sequence.repeat=1"});
  const DrivenRun driven(start, recorded(start), false);
  const double truth = number_at(start, "joint.knee.damping");
  set_number(start, "joint.knee.damping", 1.1 * truth);
  const RunFitResult found = fit_run(start, driven, {.fit = {"joint.knee.damping"}});
  EXPECT_GT(found.landings, 0);
  EXPECT_NE(found.no_intervals.find("a foot comes down on the ground"), std::string::npos);
  const Estimate& e = estimate(found, "joint.knee.damping");
  EXPECT_NEAR(e.value, truth, 0.05 * truth);
  EXPECT_EQ(e.low, -unbounded);
  EXPECT_EQ(e.high, unbounded);
  EXPECT_TRUE(e.identifiable);
  const std::string file = run_file(found, "a walk", config::make_table("robot"));
  EXPECT_NE(file.find("how far off is not known"), std::string::npos) << file;
  EXPECT_EQ(file.find("uncertainty"), std::string::npos) << file;
  EXPECT_EQ(describe(found)["intervals"], false);
  EXPECT_EQ(describe(found)["landings"], found.landings);
}

TEST(RunFit, GivesIntervalsInTheAirAndReportsThem) {
  const experiment::Experiment e = shipped("one-joint", {"sequence.repeat=1"});
  const DrivenRun driven(e, recorded(e), false);
  const RunFitResult found = fit_run(e, driven, {.fit = {"damping"}});
  EXPECT_LT(found.roughness, 0.005);
  EXPECT_EQ(found.landings, 0);
  const Json out = describe(found);
  EXPECT_EQ(out["rough"], false);
  EXPECT_EQ(out["intervals"], true);
  EXPECT_FALSE(out.contains("no_intervals_because"));
}

// Frozen parameters are not changed.
TEST(RunFit, DoesNotSearchWhatIsFrozen) {
  const experiment::Experiment e = shipped("one-joint", {"sequence.repeat=1"});
  const DrivenRun driven(e, recorded(e), false);
  const RunFitResult found =
      fit_run(e, driven, {.fit = {"friction", "damping"}, .frozen = {"joint.lever.dry_friction"}});
  ASSERT_EQ(found.report.best().parameters.size(), 1u);
  EXPECT_EQ(found.report.best().parameters[0].name, "joint.lever.damping");
}

TEST(RunFit, IsTheSameWithAnyNumberOfThreads) {
  experiment::Experiment start = shipped("one-joint");
  const DrivenRun driven(start, recorded(start), false);
  set_number(start, "joint.lever.damping", 0.06);
  RunFitOptions options{.fit = {"friction", "damping"}, .threads = 1};
  const RunFitResult one = fit_run(start, driven, options);
  options.threads = 3;
  const RunFitResult three = fit_run(start, driven, options);
  for (std::size_t i = 0; i < one.report.best().parameters.size(); ++i) {
    const Estimate &a = one.report.best().parameters[i], &b = three.report.best().parameters[i];
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
  }
  EXPECT_EQ(one.simulations, three.simulations);
}

// A prior acts as one more reading: it attracts the estimate, and narrows the interval.
TEST(RunFit, APriorNarrowsWhatTheRunLeavesWide) {
  const experiment::Experiment e = shipped("one-joint");
  const DrivenRun driven(e, recorded(e), false);
  RunFitOptions options{.fit = {"valve.inlet.opening_delay", "valve.inlet.closing_delay"}};
  const Estimate wide = estimate(fit_run(e, driven, options), "valve.inlet.opening_delay");
  options.priors = {{"valve.inlet.opening_delay", 0.169e-3, 2e-6}};
  const Estimate narrow = estimate(fit_run(e, driven, options), "valve.inlet.opening_delay");
  EXPECT_GT(wide.high - wide.low, 30e-6);
  EXPECT_NEAR(narrow.high - narrow.low, 2 * 1.96 * 2e-6, 0.5e-6);
}

// A number that determines others does so in a fit, too: the plan takes a joint's gains from the
// robot if its file does not give them.
TEST(RunFit, SetsWhatFollowsFromANumber) {
  const experiment::Experiment e = shipped("one-joint");
  const DrivenRun driven(e, recorded(e), false);
  const std::vector<Parameter> parameters = {{.name = "joint.lever.angle_gain"}};
  const RunFitOptions options;
  const RunResiduals residuals(e, driven, parameters, options, driven.duration());
  experiment::Experiment read = shipped("one-joint", {"joint.lever.angle_gain=0.1 %/count"});
  const std::vector<double> gain = {number_at(read, "joint.lever.angle_gain")};
  EXPECT_TRUE(experiment::same_values(residuals.machine(gain), read));

  experiment::Experiment machine = e;
  set_number(machine, "joint.lever.angle_gain", gain[0]);
  EXPECT_TRUE(experiment::same_values(machine, read));
}

TEST(RunFit, RefusesWhatItCannotFit) {
  const experiment::Experiment e = shipped("one-joint");
  const DrivenRun driven(e, recorded(e), false);
  EXPECT_EQ(refusal([&] { fit_run(e, driven, {.fit = {"damping"}, .hold_out = 0.95}); }),
            "hold_out: found 95 %; expected a share of the run, from 0 to below 90 %; try 20 %");
  EXPECT_EQ(refusal([&] {
              fit_run(e, driven, {.fit = {"damping"}, .priors = {{"trolley.drag", 1, 1}}});
            }),
            "prior: found \"trolley.drag\", which is not fitted; expected one of "
            "joint.lever.damping; try to fit it too");
  EXPECT_EQ(
      refusal([&] { fit_run(e, driven, {.fit = {"damping"}, .frozen = {"joint.lever.damping"}}); }),
      "freeze: found all numbers that were to be fitted; expected one to fit at least");
}

}  // namespace
}  // namespace sinew::identify::run_fit_test
