// Tests of loading: files read alone, and checks that load() leaves to other functions.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/units/quantity.h"
#include "tests/places.h"

namespace sinew::experiment::load_test {
namespace {

const std::string source = sinew::test::source_dir() + "/";
const std::string walk = source + "experiments/walk-test-1.toml";
const std::string robot = source + "robots/leg/robot.toml";

template <class Act>
std::string refusal(Act act) {
  try {
    act();
  } catch (const config::Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(MachineFile, IsThePartOfAnExperimentOfItsKind) {
  const MachineFile whole = load_machine_file(walk), machine = load_machine_file(robot);
  EXPECT_EQ(whole.kind, "experiment");
  EXPECT_FALSE(whole.experiment.plan.phases.empty());
  EXPECT_EQ(machine.kind, "robot");
  EXPECT_EQ(machine.experiment.robot.joints.size(), whole.experiment.robot.joints.size());
  EXPECT_TRUE(machine.experiment.plan.phases.empty());

  const MachineFile actuators = load_machine_file(source + "robots/leg/actuator.toml");
  EXPECT_EQ(actuators.experiment.actuators.size(), machine.experiment.actuators.size());
  EXPECT_TRUE(actuators.experiment.robot.joints.empty());
  const MachineFile valves = load_machine_file(source + "robots/leg/valves.toml");
  EXPECT_EQ(valves.experiment.valves.size(), machine.experiment.valves.size());
}

TEST(MachineFile, ValuesComeInSiUnderTheKeysOfTheirOrigins) {
  const config::Node values = values_in_si(load_machine_file(robot, {"trolley.drag=1 lbf"}));
  const config::Node* trolley = values.find("trolley");
  ASSERT_NE(trolley, nullptr);
  ASSERT_NE(trolley->find("drag"), nullptr);
  EXPECT_EQ(config::written(*trolley->find("drag")), "4.4482216152605 N");
  EXPECT_EQ(values.find("phase"), nullptr);
}

// A number without its unit: the hint proposes exactly the value of the file, for every quantity of
// a walk and of its robot.
TEST(Load, TheHintOfAMissingUnitIsThatOfTheFile) {
  int tried = 0;
  for (const config::Origin& origin : load(walk).origins) {
    if (origin.unit.empty() || origin.unit == "1") continue;  // these need no unit
    const units::Parsed meant = units::parse_quantity(origin.text, origin.unit);
    const std::size_t space = origin.text.find(' ');
    const bool in_list = origin.path.find('[') != origin.path.npos;
    if (meant.mistake || origin.is_default || in_list || space == origin.text.npos) continue;
    const std::string said =
        refusal([&] { (void)load(walk, {origin.path + "=" + origin.text.substr(0, space)}); });
    if (said.find("expected a list") != said.npos || said == "nothing") continue;
    ASSERT_NE(said.find("without a unit; expected"), std::string::npos)
        << origin.path << ": " << said;
    const std::size_t quote = said.find("try \"") + 5;
    const std::string hint = said.substr(quote, said.find('"', quote) - quote);
    const units::Parsed proposed = units::parse_quantity(hint, origin.unit);
    EXPECT_FALSE(proposed.mistake) << origin.path << ": " << said;
    EXPECT_EQ(proposed.si, meant.si) << origin.path << ": " << said;
    ++tried;
  }
  EXPECT_GT(tried, 100);
}

TEST(MachineFile, ARobotAloneIsHeldToItsNames) {
  const auto load_with = [](const std::string& set) {
    return refusal([&] { load_machine_file(robot, {set}); });
  };
  EXPECT_EQ(load_with("muscle.hip_flexor.actuator=bqa"),
            "--set: muscle.hip_flexor.actuator: found \"bqa\"; expected bpa; try \"bpa\"");
  EXPECT_NE(load_with("muscle.hip_flexor.role=extensor").find("robot.toml:"), std::string::npos);
}

// The level's unit follows from the measure, so one mistake gives one message.
TEST(Load, AMisspeltMeasureIsOneProblem) {
  for (const char* name : {"foot.normal_forc", "foot.normalforce", "joint.hip.angel"}) {
    const std::string told = refusal([&] {
      load(source + "experiments/touchdown.toml",
           {std::string("phase.foot_plant.until.measure=") + name});
    });
    EXPECT_EQ(told, std::string("--set: phase.foot_plant.until.measure: found \"") + name +
                        "\"; expected a measured quantity; try foot.normal_force, "
                        "foot.friction_force, joint.<name>.angle, joint.<name>.stiffness or "
                        "muscle.<name>.tension");
  }
  const std::string nobody = refusal([&] {
    load(source + "experiments/touchdown.toml", {"phase.foot_plant.until.measure=joint.ankle.angle",
                                                 "phase.foot_plant.until.level=1 rad"});
  });
  EXPECT_NE(nobody.find("\"joint.ankle.angle\"; expected a measured quantity"), std::string::npos)
      << nobody;
}

TEST(Load, ReportsNumbersWithoutASourceOutsideRobots) {
  const Experiment e = load(walk);
  for (const config::Problem& p : e.unsourced)
    EXPECT_EQ(p.where.file.find("/robots/"), std::string::npos) << config::to_text(p);
  EXPECT_TRUE(load_machine_file(robot).experiment.unsourced.empty());
}

TEST(Load, LeavesWhatIsOutOfReachToWhoWantsToRefuseIt) {
  EXPECT_EQ(refusal([] { refuse_unreachable(load(walk)); }), "nothing");
  const Experiment far = load(walk, {"phase.propulsion.y.polynomial=[\"-16 in\"]"});
  const std::string words = refusal([&] { refuse_unreachable(far); });
  EXPECT_EQ(words.find(walk + ":"), 0u) << words;
  EXPECT_NE(words.find("phase.propulsion: found a path out of reach"), std::string::npos) << words;
}

// A figure that is judged needs a class, and its own band needs a reason.
TEST(Load, AJudgedFigureNeedsItsClassAndItsBandAReason) {
  const auto with = [](const std::string& more) {
    return refusal([&] {
      load(walk,
           {"reported=[{ key = \"trolley.distance_m\", value = \"55 to 60 in\", source = \"6.3\"" +
            more + " }]"});
    });
  };
  EXPECT_EQ(with(""), "nothing") << "it is not judged";
  EXPECT_EQ(with(R"(, class = "predicted", wording = "range")"), "nothing");
  const std::string none = with(R"(, wording = "range")");
  for (const char* word : {"predicted", "fitted", "put in", "by construction", "code against code"})
    EXPECT_NE(none.find(std::string("\"") + word + "\""), std::string::npos) << none;
  EXPECT_NE(with(R"(, class = "proven", wording = "range")").find("found \"proven\""),
            std::string::npos);
  const std::string band = R"(, class = "fitted", accept = ["53 in", "60 in"])";
  EXPECT_NE(with(band).find("band_reason: missing; expected why the band of"), std::string::npos)
      << with(band);
  EXPECT_EQ(with(band + R"(, band_reason = "read from a plot")"), "nothing");
  EXPECT_NE(with(band + R"(, wording = "range", band_reason = "x")").find("one of the two"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::experiment::load_test
