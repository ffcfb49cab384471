// Evaluation of runs: weights, limits that must hold for a share of them, fronts.
#include "sinew/tune/optimizer/tuning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace sinew::tune::goals_test {
namespace {

using Is = Condition::Is;

Goals speed_and_air() {
  Goals out;
  out.goals = {{{"trolley.mean_speed_m_per_s", "in/s"}, true}, {{"air_used_kg", "g"}, false}};
  out.limits = {{{"passiveness", "%"}, Is::at_least, 90, "passiveness >= 90 %"}};
  return out;
}

Figures run(double speed, double air, double passiveness, double weight = 1) {
  return {.weight = weight, .ok = true, .goals = {speed, air}, .limits = {passiveness}};
}

CandidateEvaluation evaluation(std::vector<double> goals, double violation = 0) {
  return {.goals = std::move(goals), .limits = {}, .violation = violation};
}

TEST(Judge, MeansAreOfTheRunsWeights) {
  const CandidateEvaluation j =
      evaluate(speed_and_air(), std::vector{run(4, 1, 95), run(10, 4, 91, 2)});
  EXPECT_DOUBLE_EQ(j.goals[0], 8);
  EXPECT_DOUBLE_EQ(j.goals[1], 3);
  EXPECT_EQ(j.limits[0], 91) << "the worst of the runs";
  EXPECT_TRUE(j.feasible());
  EXPECT_EQ(j.holds, 1);
}

TEST(Judge, TheWorstIsLeastOfWhatIsMaximizedAndMostOfWhatIsMinimized) {
  Goals goals = speed_and_air();
  goals.over = Goals::Over::worst;
  const CandidateEvaluation j = evaluate(goals, std::vector{run(4, 1, 95), run(10, 4, 91, 2)});
  EXPECT_EQ(j.goals, (std::vector<double>{4, 4}));
}

TEST(Judge, ViolationsAreSharesOfTheirLimit) {
  const CandidateEvaluation j = evaluate(speed_and_air(), std::vector{run(4, 1, 81)});
  EXPECT_DOUBLE_EQ(j.violation, 0.1);
  EXPECT_FALSE(j.feasible());
  EXPECT_EQ(j.holds, 0);
}

TEST(Judge, EachLimitHoldsAsItIsWritten) {
  const auto feasible = [](Is is, double value) {
    Goals goals = speed_and_air();
    goals.limits[0].is = is;
    return evaluate(goals, std::vector{run(4, 1, value)}).feasible();
  };
  EXPECT_TRUE(feasible(Is::at_least, 90) && feasible(Is::at_most, 90));
  EXPECT_FALSE(feasible(Is::above, 90) || feasible(Is::below, 90));
  EXPECT_TRUE(feasible(Is::above, 91) && feasible(Is::below, 89));
  EXPECT_FALSE(feasible(Is::at_least, 89) || feasible(Is::at_most, 91));
}

TEST(Judge, NineteenOfTwentyAreEnoughWhereThatShareMustHold) {
  Goals goals = speed_and_air();
  goals.hold = 0.95;
  std::vector<Figures> runs(19, run(4, 1, 95));
  runs.push_back(run(1, 1, 10));
  EXPECT_TRUE(evaluate(goals, runs).feasible());
  EXPECT_DOUBLE_EQ(evaluate(goals, runs).holds, 0.95);
  runs[0] = run(1, 1, 45);  // two are one too many; the smaller violation counts, one of nineteen
  EXPECT_NEAR(evaluate(goals, runs).violation, 0.5 / 19, 1e-12);
}

TEST(Judge, ARunWithoutFiguresIsFartherAwayThanAnyFigure) {
  const CandidateEvaluation none = evaluate(speed_and_air(), std::vector{Figures{}});
  EXPECT_TRUE(std::isnan(none.goals[0]));
  EXPECT_GT(none.violation, evaluate(speed_and_air(), std::vector{run(0, 1e9, -1e9)}).violation);
  const CandidateEvaluation some = evaluate(speed_and_air(), std::vector{Figures{}, run(4, 1, 95)});
  EXPECT_EQ(some.goals[0], 4) << "the mean is of those that have one";
  EXPECT_FALSE(some.feasible());
}

TEST(Costs, WhatIsFeasibleCostsLess) {
  const Goals goals = speed_and_air();
  const std::vector<double> good = costs(goals, evaluation({-1e9, 1e9})),
                            near = costs(goals, evaluation({9, 1}, 1e-9)),
                            far = costs(goals, evaluation({9, 1}, 2e-9));
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT(good[i], near[i]);
    EXPECT_LT(near[i], far[i]);
  }
  EXPECT_LT(costs(goals, evaluation({5, 1}))[0], costs(goals, evaluation({4, 1}))[0])
      << "more is better";
  EXPECT_LT(costs(goals, evaluation({5, 1}))[1], costs(goals, evaluation({5, 2}))[1]) << "less is";
}

// Checks the definition: no member of the front is dominated, and every other candidate is, or
// equals a member.
TEST(Front, IsWhatNothingDominates) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> number(0, 12);
  const Goals goals = speed_and_air();
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<CandidateEvaluation> all;
    for (int i = 0; i < 60; ++i)
      all.push_back(evaluation({double(number(random)), double(number(random))},
                               number(random) == 0 ? 0.1 : 0));
    const std::vector<std::size_t> best = front(goals, all);
    const std::set<std::size_t> chosen(best.begin(), best.end());
    ASSERT_FALSE(best.empty());
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool beaten = !all[i].feasible();
      for (std::size_t j = 0; j < all.size(); ++j)
        beaten = beaten || dominates(goals, all[j], all[i]) ||
                 (j < i && all[j].feasible() && all[j].goals == all[i].goals);
      EXPECT_EQ(chosen.count(i), beaten ? 0U : 1U) << trial << " " << i;
    }
    for (std::size_t k = 1; k < best.size(); ++k)
      EXPECT_LT(all[best[k]].goals[0], all[best[k - 1]].goals[0]) << "best speed first";
  }
}

TEST(Front, IsEmptyWhereNothingIsFeasible) {
  EXPECT_TRUE(
      front(speed_and_air(), std::vector{evaluation({9, 1}, 1), evaluation({8, 1}, 2)}).empty());
}

}  // namespace
}  // namespace sinew::tune::goals_test
