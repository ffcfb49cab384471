// The places at which an experiment may run, and their errors.
#include "sinew/run/simulation/place.h"

#include <gtest/gtest.h>

#include "sinew/config/diagnostics.h"
#include "tests/places.h"

namespace sinew::run::place_test {
namespace {

std::string refusal(const std::string& name, std::vector<std::string> sets,
                    const std::string& place) {
  const experiment::Experiment e =
      experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
  try {
    const Place there(place, e);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Place, IsASimulationADeviceOrAFile) {
  for (const char* good : {"", "simulated", "serial:/dev/ttyACM0", "serial:/dev/ttyACM0@2000000",
                           "emulated:a.elf", "lock-step:lock-step.elf", "comedi:/dev/comedi0"})
    EXPECT_EQ(problem_of_place(good), "") << good;
  for (const char* bad : {"serial", "serial:", "emulated:", "comedi:", "Simulated", "/dev/ttyACM0"})
    EXPECT_NE(problem_of_place(bad).find("expected simulated, serial:DEVICE"), std::string::npos)
        << bad;
  for (const char* bad : {"serial:/dev/ttyACM0@", "serial:/dev/ttyACM0@fast", "serial:a@0",
                          "serial:a@-1", "serial:a@99999999999"})
    EXPECT_NE(problem_of_place(bad).find("whose rate is not a number"), std::string::npos) << bad;
  EXPECT_FALSE(is_outside_simulation(""));
  EXPECT_FALSE(is_outside_simulation("simulated"));
  EXPECT_TRUE(is_outside_simulation("serial:/dev/ttyACM0"));
}

TEST(Place, WhatNoBoardCanRunIsRefusedBeforeAnythingIsOpened) {
  const std::string device = "serial:/dev/no-such-board";
  EXPECT_NE(refusal("kick", {"log.period=1 ms"}, device)
                .find("log.period: found 0.001 s; expected a multiple of 0.01 s"),
            std::string::npos);
  EXPECT_NE(refusal("kick", {"log.period=15 ms"}, device).find("log.period"), std::string::npos);
  EXPECT_EQ(refusal("kick", {"log.period=20 ms"}, device).find("log.period"), std::string::npos);
  EXPECT_NE(refusal("cylinder-following", {"cylinder.board=2", "wiring.present=false"}, device)
                .find("board: found 2 boards; expected one"),
            std::string::npos);
  EXPECT_NE(refusal("faults/valve-stuck-open", {}, device).find("fault: found 1 of them"),
            std::string::npos);
}

TEST(Place, WhatNoBoardOfAStandCanDoIsRefusedByItsKey) {
  const std::string device = "serial:/dev/no-such-board";
  const auto expect = [&](const std::string& name, std::vector<std::string> sets,
                          const std::string& what) {
    const std::string said = refusal("rig/" + name, std::move(sets), device);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  const std::string at_once =
      R"(drive.pulses=[{at="1 s",open="9 ms"},{at="1.005 s",open="9 ms",exhaust=true}])";
  expect("feedback", {}, "log.period: found 0.001 s; expected a multiple of 0.4 s");
  expect("feedback", {"log.period=400 ms"}, "No such file");
  expect("feedback", {"drive.period=600 ms"}, "drive.period: found 0.6 s; expected at most 0.5 s");
  expect("pwm-25hz-5lb", {}, "sensor: found none; expected at least one");
  expect("duty-sweep", {}, "sweep: found many runs; expected none");
  expect("isometric", {at_once}, "drive.pulses[1]: found an inlet that is open meanwhile");
  const std::string one_after_another =
      R"(drive.pulses=[{at="0.1 s",open="200 ms"},{at="0.3 s",open="9 ms",exhaust=true}])";
  expect("isometric", {one_after_another, "log.period=40 ms"}, "No such file");
  EXPECT_NE(refusal("rig/feedback", {}, "comedi:/dev/no-such-card").find("on a test stand"),
            std::string::npos);
}

TEST(Place, WhatNoCardCanDriveIsRefusedBeforeItIsOpened) {
  const std::string device = "comedi:/dev/no-such-card";
  EXPECT_NE(refusal("faults/valve-stuck-open", {}, device).find("fault: found 1 of them"),
            std::string::npos);
  EXPECT_NE(refusal("walk-with-regulators", {}, device).find("a digital output sets no pressure"),
            std::string::npos);
  EXPECT_NE(refusal("cylinder-following", {"cylinder.board=2", "wiring.present=false"}, device)
                .find("driven by 2 boards; expected one"),
            std::string::npos);
}

// A card is configured by wiring.toml: with B.1's bits of the leg, or table C-1's.
TEST(Place, ACardHasTheRobotsChannelsAndBits) {
  const auto machine = [](std::vector<std::string> sets) {
    return card_machine(
        experiment::load(sinew::test::source_dir() + "/experiments/kick.toml", sets), "");
  };
  const plant::CardMachine leg = machine({});
  ASSERT_EQ(leg.inputs.size(), 7u);
  for (std::size_t i = 0; i < leg.inputs.size(); ++i)
    EXPECT_EQ(leg.inputs[i].channel, 24 + static_cast<int>(i)) << leg.inputs[i].sensor;
  EXPECT_EQ(leg.outputs[0].valve, "hip_flexor inlet");
  EXPECT_EQ(leg.outputs[0].bit + 8, leg.outputs[1].bit) << "exhausts have the second port";
  EXPECT_TRUE(leg.outputs[0].inlet && !leg.outputs[0].vents);
  EXPECT_TRUE(leg.outputs[1].vents && !leg.outputs[1].inlet);
  EXPECT_TRUE(leg.active_low);
  EXPECT_FALSE(machine({"wiring.polarity=high opens"}).active_low);
  EXPECT_EQ(leg.vent, 10'000);
  EXPECT_EQ(machine({"wiring.bits=table"}).outputs[0].bit, 2);
}

TEST(Place, ARateThatDoesNotCarryTheTelemetryIsRefusedWithOneThatDoes) {
  const std::string said = refusal("kick", {}, "serial:/dev/no-such-board@9600");
  EXPECT_NE(said.find("9600 bits/s do not carry this robot's telemetry; expected "),
            std::string::npos)
      << said;
}

TEST(Place, WithoutARateItIsTheFirmwaresOrNone) {
  EXPECT_NE(refusal("kick", {}, "serial:/dev/no-such-board").find("No such file"),
            std::string::npos)
      << "921,600 carries it, so that the line is opened";
  const std::string said = refusal("pwm-200", {}, "serial:/dev/no-such-board");
  EXPECT_NE(said.find("921600 bits/s do not carry this robot's telemetry; expected "
                      "/dev/no-such-board@1500000, if your board's firmware has that rate"),
            std::string::npos)
      << said;
}

TEST(Place, NothingIsOpenedForASimulation) {
  const experiment::Experiment e =
      experiment::load(sinew::test::source_dir() + "/experiments/kick.toml", {});
  const Place here("simulated", e);
  RunOptions options;
  here.apply(options);
  EXPECT_EQ(options.board, nullptr);
  EXPECT_FALSE(here.board_keeps_time()) << "a simulation takes a pace";
  EXPECT_EQ(here.who(), "");
}

}  // namespace
}  // namespace sinew::run::place_test
