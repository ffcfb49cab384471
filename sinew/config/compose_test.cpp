// Several files to one namespace, in a folder of our own.
#include "sinew/config/compose.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sinew/config/node.h"
#include "tests/places.h"

namespace sinew::config::compose_test {
namespace {

namespace fs = std::filesystem;

class Compose : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "sinew-compose-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    write("leg/actuator.toml",
          "format = \"sinew.actuator/1\"\nname = \"bpa\"\n[braid]\nturns = 2\n");
    write("leg/valves.toml", "format = \"sinew.valves/1\"\n[valve.inlet]\nkind = \"2-way\"\n");
    write("leg/predict.dat", "0,0,101\n");
    write("leg/robot.toml",
          "format = \"sinew.robot/1\"\nname = \"leg\"\n"
          "files = { actuator = \"actuator.toml\", valves = \"valves.toml\", "
          "valve_timing = \"predict.dat\" }\n"
          "[joint.hip]\nsource = \"6.3\"\nrest_angle = \"278 deg\"\n"
          "damping = { value = \"1 N m s/rad\", source = \"fit\" }\n"
          "[muscle.hip_flexor]\nmount_length = \"3.25 in\"\n[low_level]\ntick = \"100 us\"\n");
    write("tests/walk.toml",
          "format = \"sinew.experiment/1\"\nrobot = \"../leg/robot.toml\"\nseed = 1\n"
          "[phase.swing]\nduration = \"1.5 s\"\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& content) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << content;
  }
  std::string message(const std::string& name, const std::vector<std::string>& sets = {}) const {
    try {
      compose(path(name), sets);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

// Returns the node "a.b.c" of a tree.
const Node* at(const Node& root, std::string_view dotted) {
  const std::size_t dot = dotted.find('.');
  const Node* child = root.find(dotted.substr(0, dot));
  return dot == dotted.npos || !child ? child : at(*child, dotted.substr(dot + 1));
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

// A robot based on another one changes a key of a valve and nothing else in the valves' file.
TEST_F(Compose, ARobotsOwnKeyOfAValveIsTheLastWord) {
  write("leg/slow.toml",
        "format = \"sinew.robot/1\"\nbase = \"robot.toml\"\n"
        "[valve.inlet]\nopening_delay = \"3 ms\"\n");
  const Node root = compose(path("leg/slow.toml"));
  EXPECT_EQ(at(root, "valve.inlet.opening_delay")->text, "3 ms");
  EXPECT_EQ(at(root, "valve.inlet.kind")->text, "2-way");
}

// --- a valve of a catalogue ---

constexpr std::string_view our_valves =
    "format = \"sinew.valves/1\"\n"
    "[valve.small]\nkind = \"2-way\"\nopening_delay = \"1 ms\"\nclosing_delay = \"2 ms\"\n"
    "flow = { law = \"iso6358\", sonic_conductance = \"0.1 L/(s bar)\" }\n"
    "[valve.large]\nkind = \"3-way\"\nclosing_delay = \"9 ms\"\n";

TEST_F(Compose, AValveOfTheShippedCatalogueHasItsValuesAndTheirPlaces) {
  write("v.toml",
        "format = \"sinew.valves/1\"\n[valve.in]\ncatalogue = \"festo-mhj10\"\n"
        "opening_delay = \"3 ms\"\n");
  const Node root = compose(path("v.toml"));
  EXPECT_EQ(at(root, "valve.in.opening_delay")->where.file, path("v.toml"));
  const Node* c = at(root, "valve.in.flow.sonic_conductance");
  ASSERT_NE(c, nullptr);
  EXPECT_TRUE(contains(c->where.file, "data/valves.toml"));
  EXPECT_EQ(at(root, "valve.in.catalogue"), nullptr);
}

TEST_F(Compose, ANameThatTheCatalogueLacksHasASuggestion) {
  write("v.toml", "format = \"sinew.valves/1\"\n[valve.in]\ncatalogue = \"festo-mhj1\"\n");
  EXPECT_TRUE(
      contains(message("v.toml"), "valve.in.catalogue: found \"festo-mhj1\"; expected a valve of"));
  EXPECT_TRUE(contains(message("v.toml"), "try \"festo-mhj10\""));
}

TEST_F(Compose, ACatalogueOfOnesOwnIsRelativeToTheFileThatNamesIt) {
  write("leg/ours.toml", std::string(our_valves));
  write("leg/v.toml",
        "format = \"sinew.valves/1\"\n[valve.in]\ncatalogue = \"large\"\n"
        "catalogue_file = \"ours.toml\"\n");
  EXPECT_EQ(at(compose(path("leg/v.toml")), "valve.in.kind")->text, "3-way");
  EXPECT_EQ(at(compose(path("leg/v.toml"), {"valve.in.catalogue=small"}), "valve.in.kind")->text,
            "2-way");
  write("leg/w.toml",
        "format = \"sinew.valves/1\"\n[valve.in]\ncatalogue = \"large\"\n"
        "catalogue_file = \"robot.toml\"\n");
  EXPECT_TRUE(contains(message("leg/w.toml"),
                       "catalogue_file: found \"robot.toml\", a file of kind robot"));
  write("leg/u.toml", "format = \"sinew.valves/1\"\n[valve.in]\ncatalogue_file = \"ours.toml\"\n");
  EXPECT_TRUE(contains(message("leg/u.toml"), "expected the name of one of its valves"));
}

// A robot that names a valve does not keep the delays of the one in its valves file; one based on
// it changes a single key; --set is the last word.
TEST_F(Compose, ANamedValveReplacesTheOneBelowAndIsChangedFromAbove) {
  write("leg/ours.toml", std::string(our_valves));
  write("leg/valves.toml",
        "format = \"sinew.valves/1\"\n[valve.inlet]\nkind = \"2-way\"\nopening_ramp = \"5 ms\"\n");
  write("leg/named.toml",
        "format = \"sinew.robot/1\"\nbase = \"robot.toml\"\n"
        "[valve.inlet]\ncatalogue = \"small\"\ncatalogue_file = \"ours.toml\"\n");
  write("tests/named.toml",
        "format = \"sinew.experiment/1\"\nrobot = \"../leg/named.toml\"\n"
        "[valve.inlet]\nclosing_delay = \"7 ms\"\n");
  const Node root = compose(path("tests/named.toml"));
  EXPECT_EQ(at(root, "valve.inlet.opening_ramp"), nullptr);
  EXPECT_EQ(at(root, "valve.inlet.opening_delay")->text, "1 ms");
  EXPECT_EQ(at(root, "valve.inlet.closing_delay")->text, "7 ms");

  const Node set = compose(path("tests/named.toml"),
                           {"valve.inlet.catalogue=large", "valve.inlet.opening_delay=4 ms",
                            "valve.inlet.flow.law=orifice"});
  EXPECT_EQ(at(set, "valve.inlet.kind")->text, "3-way");
  EXPECT_EQ(at(set, "valve.inlet.flow.law")->text, "orifice");
  EXPECT_EQ(at(set, "valve.inlet.opening_delay")->text, "4 ms");
  EXPECT_EQ(at(set, "valve.inlet.closing_delay")->text, "9 ms");
}

TEST_F(Compose, AnotherLawOfFlowTakesNoNumberOfTheCatalogues) {
  write("ours.toml", std::string(our_valves));
  write("v.toml",
        "format = \"sinew.valves/1\"\n[valve.in]\ncatalogue = \"small\"\n"
        "catalogue_file = \"ours.toml\"\nflow = { law = \"orifice\", area = \"1 mm2\" }\n");
  const Node root = compose(path("v.toml"));
  EXPECT_EQ(at(root, "valve.in.flow.sonic_conductance"), nullptr);
  EXPECT_EQ(at(root, "valve.in.closing_delay")->text, "2 ms");
}

TEST_F(Compose, AnExperimentHoldsItsRobotAndTheRobotsFiles) {
  const Node root = compose(path("tests/walk.toml"));
  EXPECT_EQ(format_kind(root), "experiment");
  EXPECT_TRUE(root.find("format")->used);
  EXPECT_EQ(at(root, "robot_name")->text, "leg");
  EXPECT_EQ(at(root, "phase.swing.duration")->text, "1.5 s");
  EXPECT_EQ(at(root, "muscle.hip_flexor.mount_length")->text, "3.25 in");
  EXPECT_EQ(at(root, "actuator.bpa.braid.turns")->integer, 2);
  EXPECT_EQ(at(root, "valve.inlet.kind")->text, "2-way");
  EXPECT_EQ(at(root, "low_level.tick")->text, "100 us");
  EXPECT_EQ(at(root, "low_level.valve_timing")->text, path("leg/predict.dat"));
  EXPECT_EQ(root.find("robot"), nullptr);
  EXPECT_EQ(root.find("files"), nullptr);
  EXPECT_EQ(at(root, "actuator.bpa.name"), nullptr);
  EXPECT_EQ(at(root, "actuator.bpa.braid.turns")->where.file, path("leg/actuator.toml"));
}

TEST_F(Compose, RobotActuatorAndValvesFilesComposeAlone) {
  EXPECT_EQ(at(compose(path("leg/robot.toml")), "actuator.bpa.braid.turns")->integer, 2);
  EXPECT_EQ(at(compose(path("leg/robot.toml")), "robot_name")->text, "leg");
  EXPECT_EQ(at(compose(path("leg/actuator.toml")), "actuator.bpa.braid.turns")->integer, 2);
  EXPECT_EQ(at(compose(path("leg/valves.toml")), "valve.inlet.kind")->text, "2-way");
}

TEST_F(Compose, SeveralActuatorsStandSideBySide) {
  write("leg/thin.toml", "format = \"sinew.actuator/1\"\n[braid]\nturns = 3\n");
  write("leg/two.toml",
        "format = \"sinew.robot/1\"\nfiles = { actuator = [\"actuator.toml\", \"thin.toml\"] }\n");
  const Node root = compose(path("leg/two.toml"));
  EXPECT_EQ(at(root, "actuator.thin.braid.turns")->integer, 3);  // named after the file
  write("leg/two.toml",
        "format = \"sinew.robot/1\"\nfiles = { actuator = [\"actuator.toml\", \"actuator.toml\"] "
        "}\n");
  EXPECT_TRUE(contains(message("leg/two.toml"), "found \"bpa\"; expected a name that"));
}

TEST_F(Compose, ABaseLiesUnderTheFile) {
  write("heavy/robot.toml",
        "format = \"sinew.robot/1\"\nname = \"heavy\"\nbase = \"../leg/robot.toml\"\n"
        "[joint.hip]\ndamping = \"2 N m s/rad\"\n");
  const Node root = compose(path("heavy/robot.toml"));
  EXPECT_EQ(at(root, "robot_name")->text, "heavy");
  EXPECT_EQ(at(root, "joint.hip.damping")->text, "2 N m s/rad");
  EXPECT_EQ(at(root, "joint.hip.rest_angle")->text, "278 deg");
  // `files` is written in leg/robot.toml, so its names are relative to leg/.
  EXPECT_EQ(at(root, "actuator.bpa.braid.turns")->integer, 2);
}

TEST_F(Compose, ABaseHasNoBase) {
  write("a.toml", "format = \"sinew.robot/1\"\n");
  write("b.toml", "format = \"sinew.robot/1\"\nbase = \"a.toml\"\n");
  write("c.toml", "format = \"sinew.robot/1\"\nbase = \"b.toml\"\n");
  EXPECT_TRUE(
      contains(message("c.toml"), "base: found \"a.toml\"; expected a base without a base"));
  write("d.toml", "format = \"sinew.experiment/1\"\nbase = \"a.toml\"\n");
  EXPECT_TRUE(contains(message("d.toml"), "expected a file of kind experiment"));
}

TEST_F(Compose, AnExperimentMayChangeItsRobot) {
  write("tests/derived.toml",
        "format = \"sinew.experiment/1\"\nbase = \"walk.toml\"\nseed = 2\n"
        "[muscle.hip_flexor]\nmount_length = \"3.1 in\"\n");
  const Node root = compose(path("tests/derived.toml"));
  EXPECT_EQ(root.find("seed")->integer, 2);
  EXPECT_EQ(at(root, "muscle.hip_flexor.mount_length")->text, "3.1 in");
  EXPECT_EQ(at(root, "phase.swing.duration")->text, "1.5 s");
}

TEST_F(Compose, AResolvedFileComposesAsItIs) {
  write("resolved.toml",
        "format = \"sinew.experiment/1\"\nrobot_name = \"leg\"\n[actuator.bpa.braid]\nturns = 2\n");
  EXPECT_EQ(at(compose(path("resolved.toml")), "actuator.bpa.braid.turns")->integer, 2);
}

TEST_F(Compose, SetHasTheLastWordAndItsOwnType) {
  const Node root =
      compose(path("tests/walk.toml"),
              {"muscle.hip_flexor.mount_length=3.2 in", "seed = 3", "log.enabled=false",
               "joint.hip.damping=0.5", "phase.swing.path=[\"1 m\", 2]", "title=nan"});
  EXPECT_EQ(at(root, "muscle.hip_flexor.mount_length")->text, "3.2 in");
  EXPECT_EQ(at(root, "muscle.hip_flexor.mount_length")->where.file, "--set");
  EXPECT_EQ(root.find("seed")->integer, 3);
  EXPECT_EQ(at(root, "log.enabled")->kind, Node::Kind::flag);
  EXPECT_EQ(at(root, "joint.hip.damping")->real, 0.5);
  EXPECT_EQ(at(root, "phase.swing.path")->children.size(), 2u);
  EXPECT_EQ(root.find("title")->kind, Node::Kind::text);
}

TEST_F(Compose, SetCanNameAnotherRobot) {
  write("other/robot.toml", "format = \"sinew.robot/1\"\nname = \"other\"\n[joint.hip]\nx = 1\n");
  const Node root =
      compose(path("tests/walk.toml"), {"joint.hip.x=2", "robot=" + path("other/robot.toml")});
  EXPECT_EQ(at(root, "robot_name")->text, "other");
  EXPECT_EQ(at(root, "joint.hip.x")->integer, 2);
}

// A study must not mix rows of two versions of a file that is edited while it runs.
TEST_F(Compose, AComposerReadsAFileOnce) {
  write("leg/other.toml", "format = \"sinew.robot/1\"\nname = \"other\"\n");
  const std::vector<std::string> damped = {"joint.hip.damping=2 N m s/rad"};
  const std::vector<std::string> other = {"robot=" + path("leg/other.toml"), "seed=2"};
  Composer composer;
  const Node plain = composer.compose(path("tests/walk.toml"));
  EXPECT_EQ(at(composer.compose(path("tests/walk.toml"), damped), "joint.hip.damping")->text,
            at(compose(path("tests/walk.toml"), damped), "joint.hip.damping")->text);
  EXPECT_EQ(at(composer.compose(path("tests/walk.toml"), other), "robot_name")->text, "other");
  EXPECT_EQ(at(composer.compose(path("tests/walk.toml"), other), "seed")->integer, 2);

  write("leg/actuator.toml", "format = \"sinew.actuator/1\"\nname = \"bpa\"\n");
  const Node again = composer.compose(path("tests/walk.toml"));
  EXPECT_EQ(at(again, "seed")->integer, 1);
  EXPECT_EQ(at(again, "actuator.bpa.braid.turns")->integer, 2);
  EXPECT_EQ(at(again, "joint.hip.damping.value")->text, at(plain, "joint.hip.damping.value")->text);
  EXPECT_EQ(at(compose(path("tests/walk.toml")), "actuator.bpa.braid.turns"), nullptr);
}

TEST_F(Compose, SetTakesAnElementOfAList) {
  write("tests/path.toml",
        "format = \"sinew.experiment/1\"\nrobot = \"../leg/robot.toml\"\n"
        "[phase.swing]\ny = [\"1 in\", \"-0.5\"]\n"
        "stiffness = { value = [\"20 N\", \"30 N\"], source = \"6.2\" }\n");
  const Node root =
      compose(path("tests/path.toml"), {"phase.swing.y[1]=-0.25", "phase.swing.stiffness[0]=25 N"});
  const Node* y = value_at(root, "phase.swing.y");
  EXPECT_EQ(y->children[0].text, "1 in") << "the others stay";
  EXPECT_EQ(y->children[1].real, -0.25);
  EXPECT_EQ(value_at(root, "phase.swing.stiffness.value[0]")->text, "25 N");
  const auto says = [&](const std::string& set) { return message("tests/path.toml", {set}); };
  EXPECT_NE(says("phase.swing.y[2]=1").find("found \"[2]\"; expected [0] to [1]"),
            std::string::npos)
      << says("phase.swing.y[2]=1");
  EXPECT_NE(says("phase.swing.y[a]=1").find("expected [0] to [1]"), std::string::npos);
  EXPECT_NE(says("phase.swing.x[0]=1").find("a list to set an element of"), std::string::npos);
}

TEST_F(Compose, SetReportsSlips) {
  EXPECT_EQ(message("tests/walk.toml", {"seed"}),
            "--set: found \"seed\"; expected key=value; try "
            "\"muscle.hip_flexor.mount_length=3.2 in\"");
  EXPECT_EQ(message("tests/walk.toml", {"muscle.hip_flexr.mount_length=1 m"}),
            "--set: muscle.hip_flexr.mount_length: found no table \"hip_flexr\"; expected a table "
            "that exists; try \"hip_flexor\"");
  EXPECT_EQ(message("tests/walk.toml", {"seed.x=1"}),
            "--set: seed.x: found seed is 1; expected a table to set a key in");
  EXPECT_NE(message("tests/walk.toml", {"a..b=1"}), "no error");
  EXPECT_NE(message("tests/walk.toml", {"a=[1"}), "no error");
}

TEST_F(Compose, TheFormatLineIsChecked) {
  write("x.toml", "seed = 1\n");
  EXPECT_TRUE(contains(message("x.toml"), "x.toml:1:1: format: missing; expected \"sinew."));
  write("x.toml", "format = \"sinew.robt/1\"\n");
  EXPECT_TRUE(contains(message("x.toml"), "try format = \"sinew.robot/1\""));
  write("x.toml", "format = \"sinew.robot/2\"\n");
  EXPECT_TRUE(contains(message("x.toml"),
                       "found \"sinew.robot/2\"; expected \"sinew.robot/1\" or older; try a newer "
                       "Sinew"));
  for (const char* bad :
       {"1", "\"\"", "\"sinew.robot\"", "\"sinew.robot/x\"", "\"sinew.robot/0\""}) {
    write("x.toml", std::string("format = ") + bad + "\n");
    EXPECT_TRUE(contains(message("x.toml"), "format: found ")) << bad;
  }
}

TEST_F(Compose, ANamedFileMustExistAndBeOfItsKind) {
  write("x.toml", "format = \"sinew.experiment/1\"\nrobot = \"nowhere.toml\"\n");
  EXPECT_EQ(message("x.toml"), path("x.toml") +
                                   ":2:1: robot: found \"nowhere.toml\"; expected a file that "
                                   "exists; try the path: looked for " +
                                   path("nowhere.toml"));
  write("x.toml", "format = \"sinew.experiment/1\"\nrobot = \"leg/valves.toml\"\n");
  EXPECT_TRUE(contains(message("x.toml"), "a file of kind valves; expected a file of kind robot"));
  write("x.toml", "format = \"sinew.robot/1\"\nfiles = { actuators = \"a.toml\" }\n");
  EXPECT_TRUE(contains(message("x.toml"), "files.actuators: found an unknown key"));
  write("x.toml", "format = \"sinew.robot/1\"\nfiles = 3\n");
  EXPECT_TRUE(contains(message("x.toml"), "files: found 3; expected a table"));
}

TEST(ComposeLeg, TheShippedFilesCompose) {
  const fs::path source = sinew::test::source_dir();
  int composed = 0;
  for (const char* folder : {"robots", "experiments"}) {
    if (!fs::exists(source / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      if (entry.path().extension() != ".toml") continue;
      EXPECT_NO_THROW(compose(entry.path().string())) << entry.path();
      ++composed;
    }
  }
  RecordProperty("composed", composed);
}

}  // namespace
}  // namespace sinew::config::compose_test
