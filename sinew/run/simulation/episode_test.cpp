// A run in steps of actions and observations: it equals the plan without actions, and has the
// settings that actions set.
#include "sinew/run/simulation/episode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sinew/run/setup/buildable.h"
#include "tests/places.h"

namespace sinew::run::episode_test {
namespace {

const std::string source = sinew::test::source_dir();

experiment::Experiment walk() {
  return buildable(source + "/experiments/walk-test-1.toml", {"sequence.repeat=1"});
}

Task task() {
  return {.actions = {{.setting = "control.angle.hip", .offset = 0.2},
                      {.setting = "control.stiffness.knee", .factor = 2}},
          .observations = {{.channel = "/true/joint/hip/angle", .middle = 4.9, .scale = 0.5}},
          .measures = {"/true/joint/hip/angle", "plan:control.stiffness.knee"}};
}

class CourseTest : public testing::Test {
 protected:
  const experiment::Experiment walk_ = walk();
  Simulation example_{walk_}, leg_{walk_};
};

TEST_F(CourseTest, NoActionIsThePlanToTheLastBit) {
  const Episode episode(task(), example_);
  episode.begin(leg_);
  EXPECT_EQ(leg_.time(), 0.6);
  while (!leg_.ended()) episode.step(leg_, std::vector<double>{0, 0});

  Simulation plain(walk_);
  plain.advance_to(leg_.tick());
  for (const Simulation::Channel& c : plain.channels())
    EXPECT_EQ(std::isnan(plain.read(c.name)) ? 0 : plain.read(c.name),
              std::isnan(leg_.read(c.name)) ? 0 : leg_.read(c.name))
        << c.name;
}

TEST_F(CourseTest, AnActionMovesThePlansSettings) {
  const Episode episode(task(), example_);
  episode.begin(leg_);
  Simulation plain(walk_);
  plain.advance_by(0.641);  // in the last of the five periods of a step
  episode.step(leg_, std::vector<double>{0.5, -1});
  const auto at = [](const Simulation& s, const char* key) {
    return s.value_of(s.find_setting(key));
  };
  EXPECT_DOUBLE_EQ(at(leg_, "control.angle.hip"), at(plain, "control.angle.hip") + 0.1);
  EXPECT_DOUBLE_EQ(at(leg_, "control.stiffness.knee"), at(plain, "control.stiffness.knee") / 2);
}

TEST_F(CourseTest, AnActionBeyondOneIsCut) {
  const Episode episode(task(), example_);
  Simulation other(walk_);
  for (Simulation* s : {&leg_, &other}) episode.begin(*s);
  episode.step(leg_, std::vector<double>{1, -1});
  episode.step(other, std::vector<double>{7, -1e9});
  EXPECT_EQ(leg_.read("/true/joint/hip/angle"), other.read("/true/joint/hip/angle"));
}

TEST_F(CourseTest, ALookIsScaledAndAMeasureIsNot) {
  const Episode episode(task(), example_);
  episode.begin(leg_);
  episode.step(leg_, std::vector<double>{0, 1});
  double observed[1], measured[2];
  episode.observe(leg_, observed, measured);
  EXPECT_EQ(measured[0], leg_.read("/true/joint/hip/angle"));
  EXPECT_EQ(observed[0], (measured[0] - 4.9) / 0.5);
  // An action has doubled the stiffness; the planned value stays.
  EXPECT_DOUBLE_EQ(2 * measured[1], leg_.value_of(leg_.find_setting("control.stiffness.knee")));
}

TEST_F(CourseTest, RefusesWhatThereIsNot) {
  const auto refused = [&](const char* words, auto change) {
    Task wrong = task();
    change(wrong);
    Simulation example(walk_);
    try {
      const Episode episode(wrong, example);
      FAIL() << words;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused("control.angel", [](Task& t) { t.actions[0].setting = "control.angel.hip"; });
  refused("/joint/hop", [](Task& t) { t.observations[0].channel = "/joint/hop/angle"; });
  refused("expected the setting of one", [](Task& t) { t.measures = {"plan:control.angle.knee"}; });
  refused("knee: factor: found 0", [](Task& t) { t.actions[1].factor = 0; });
  refused("angle: scale: found -1", [](Task& t) { t.observations[0].scale = -1; });
  refused("period: found 0.015 s", [](Task& t) { t.period = 0.015; });
  refused("period: found 0 s", [](Task& t) { t.period = 0; });
  refused("begin: found 0.605 s", [](Task& t) { t.begin = 0.605; });
  refused("less than the plan's", [](Task& t) { t.begin = 1000; });
  refused("expected a time", [](Task& t) { t.begin = NAN; });
}

}  // namespace
}  // namespace sinew::run::episode_test
