// An experiment on a machine with an I/O card, by the program itself and the real libcomedi, whose
// calls are answered by stand_in.cpp.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sinew/experiment/experiment.h"
#include "sinew/log/reader.h"
#include "sinew/robot/wiring/wiring.h"
#include "tests/cli/program.h"
#include "tests/places.h"

namespace sinew::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// The leg at rest, as its sensors read (B.1's offsets).
const std::string at_rest = "24:404,25:1895,26:1175,27:0,28:0,29:0,30:0";

using Card = std::map<std::string, std::string>;  // the stand-in's variables

struct Write {
  std::int64_t time = 0;  // [ns]
  unsigned mask = 0, bits = 0;
};

class Cards : public ::testing::Test {
 protected:
  Result run(Card card, Words more = {}, const std::string& device = "/dev/comedi0",
             const std::string& experiment = "kick") {
    card.insert({{"CARD_COUNTS", at_rest}, {"CARD_LOG", (w_ / "writes").string()}});
    // A sanitizer's library would be loaded first; the list does not include it.
    card.insert({{"LD_PRELOAD", test::build_dir() + "/tests/sinew_cards_stand_in.so"},
                 {"ASAN_OPTIONS", "verify_asan_link_order=0"}});
    for (const auto& [name, value] : card) setenv(name.c_str(), value.c_str(), 1);
    Words words = {"run",        "experiments/" + experiment + ".toml",
                   "--port",     "comedi:" + device,
                   "-o",         "run",
                   "--no-report"};
    words.insert(words.end(), more.begin(), more.end());
    const Result out = w_.sinew(words);
    for (const auto& [name, value] : card) unsetenv(name.c_str());
    return out;
  }

  std::vector<Write> writes() const {
    std::vector<Write> out;
    std::istringstream in(read_text(w_ / "writes"));
    for (Write w; in >> w.time >> w.mask >> w.bits;) out.push_back(w);
    return out;
  }

  // The leg's valves, by the bits that the robot's file gives them.
  std::vector<robot::ValveBit> bits() const {
    const experiment::Experiment e =
        experiment::load(sinew::test::source_dir() + "/experiments/kick.toml", {});
    return robot::bits_of(e.robot, e.wiring);
  }
  unsigned mask_of(const std::string& which) const {
    unsigned out = 0;
    for (const robot::ValveBit& b : bits())
      if (b.which == which || which.empty()) out |= 1u << b.bit;
    return out;
  }

  // At the start no coil has current.
  void expect_rest() const {
    const std::vector<Write> all = writes();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back().bits, all.back().mask) << "a bit that is 0 gives its coil current";
    EXPECT_EQ(all.back().mask, mask_of(""));
  }

  Workspace w_;
};

TEST_F(Cards, ValvesInTheLogAreThoseThatTheCardReceived) {
  const Result result = run({});
  ASSERT_EQ(result.code, 0) << result.err;
  const signals::Table log = log::read(w_ / "run/log.mcap");
  const std::vector<robot::PortBytes> said =
      robot::port_bytes(log, bits(), robot::Wiring::Polarity::low_opens);
  ASSERT_GT(said.size(), 20u);

  // The last write of an instant counts; time is from the run's first tick.
  std::vector<Write> got;
  const unsigned mask = mask_of("");
  for (const Write& w : writes()) {
    EXPECT_EQ(w.mask, mask);
    if (!got.empty() && got.back().time == w.time) got.pop_back();
    if (got.empty() || got.back().bits != w.bits) got.push_back(w);
  }
  // The exhausts open at tick 0; before, when the card was opened, all valves were closed.
  ASSERT_EQ(got.size(), said.size() + 1);
  EXPECT_EQ(got[0].bits, mask);
  for (std::size_t i = 0; i < said.size(); ++i) {
    ASSERT_EQ(got[i + 1].time - got[1].time, said[i].time_ns) << i;
    ASSERT_EQ(got[i + 1].bits, (said[i].port[0] | said[i].port[1] << 8) & mask) << i;
  }
  expect_rest();
}

TEST_F(Cards, CountsOfTheRobotsConverterAreHandedOnAsTheyAre) {
  ASSERT_EQ(run({}).code, 0);
  const signals::Table log = log::read(w_ / "run/log.mcap");
  const signals::Series* hip = log.find("/sensor/hip_angle/count");
  ASSERT_TRUE(hip);
  ASSERT_GT(hip->columns[0].size(), 100u);
  // Before the first conversion there is none.
  for (std::size_t i = 1; i < hip->columns[0].size(); ++i) ASSERT_EQ(hip->columns[0][i], 1895) << i;
}

TEST_F(Cards, AFinerConverterOfAnotherRangeIsScaledAndItsEndsAreTheRobots) {
  // 16 bits over -10 .. 10 V: 1895/4095 of 5 V is (2.3138 + 10)/20 of 65535.
  const std::string hip = std::to_string(std::lround((5.0 * 1895 / 4095 + 10) / 20 * 65535));
  const std::string knee = std::to_string(std::lround((5.0 * 1175 / 4095 + 10) / 20 * 65535));
  const std::string cylinder = std::to_string(std::lround((5.0 * 404 / 4095 + 10) / 20 * 65535));
  // Tensions: -10 V and what is just below 0 V are count 0.
  ASSERT_EQ(run({{"CARD_TOP", "65535"},
                 {"CARD_LOW", "-10"},
                 {"CARD_HIGH", "10"},
                 {"CARD_COUNTS",
                  "24:" + cylinder + ",25:" + hip + ",26:" + knee + ",27:0,28:32767,29:0,30:0"}})
                .code,
            0);
  const signals::Table log = log::read(w_ / "run/log.mcap");
  const auto last = [&](const std::string& sensor) {
    return log.find("/sensor/" + sensor + "/count")->columns[0].back();
  };
  EXPECT_EQ(last("hip_angle"), 1895);
  EXPECT_EQ(last("knee_angle"), 1175);
  EXPECT_EQ(last("hip_flexor_tension"), 0);
  EXPECT_EQ(last("hip_extensor_tension"), 0);
}

// The stand-in detects allocations between two ticks.
TEST_F(Cards, NoMemoryIsTakenInTheLoop) {
  ASSERT_EQ(run({{"CARD_HEAP", (w_ / "heap").string()}}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(w_ / "heap"));
}

TEST_F(Cards, ReportsAtTheStartHowLateTheComputerIs) {
  const Result result = run({});
  EXPECT_THAT(result.err, HasSubstr("board: stand-in, at comedi:/dev/comedi0"));
  EXPECT_THAT(result.err, HasSubstr("timer real-time: 10000 wake-ups, worst 0 us"));
  const auto summary = nlohmann::json::parse(read_text(w_ / "run/summary.json"));
  EXPECT_EQ(summary["host"]["board"], "stand-in, at comedi:/dev/comedi0");
}

// The first 10000 sleeps are those of the measurement.
TEST_F(Cards, ALateWakeUpIsAMissedTickAndTheRunGoesOn) {
  const Result on_time = run({});
  ASSERT_EQ(on_time.code, 0) << on_time.err;
  EXPECT_THAT(on_time.err, Not(HasSubstr("came late by more than a tick")));
  const Result late = run({{"CARD_SLEEP", "10500:300000"}}, {"--force"});
  ASSERT_EQ(late.code, 0) << late.err;
  EXPECT_THAT(late.err, HasSubstr("came late by more than a tick"));
}

TEST_F(Cards, TenMillisecondsLateVentsTheMachine) {
  const Result result = run({{"CARD_SLEEP", "10500:20000000"}});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("this computer came 10 ms late or more"));
  expect_rest();
  // The exhausts of the muscles had current, and nothing else, for the robot's vent_time, 1 s: then
  // the rest state, and again when the card was closed.
  const std::vector<Write> all = writes();
  ASSERT_GT(all.size(), 3u);
  const Write &vent = all[all.size() - 3], &rest = all[all.size() - 2];
  unsigned exhausts = 0;
  for (const robot::ValveBit& b : bits())
    if (b.which == "exhaust" && !b.of.starts_with("cylinder")) exhausts |= 1u << b.bit;
  EXPECT_EQ(vent.bits, mask_of("") & ~exhausts);
  EXPECT_EQ(rest.time - vent.time, 1'000'000'000);
}

TEST_F(Cards, ConversionsThatFailEndTheRunAtRest) {
  const Result result = run({{"CARD_READ_ERROR", "500"}});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("/dev/comedi0: 3 conversions of "));
  expect_rest();
}

TEST_F(Cards, ConversionsThatAreLateAreCountedAndAreNoReadings) {
  const Result one = run({{"CARD_SLOW", "1"}});
  EXPECT_EQ(one.code, 0);
  EXPECT_THAT(one.err, HasSubstr("1 reading came late"));
  const Result many = run({{"CARD_SLOW", "1000000"}}, {"--force"});
  EXPECT_EQ(many.code, 1);
  EXPECT_THAT(many.err, HasSubstr("in a row failed or took longer than a tick"));
  expect_rest();
}

TEST_F(Cards, OutputsThatFailEndTheRunAndAreTriedToTheEnd) {
  const Result result = run({{"CARD_WRITE_ERROR", "40"}});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("does not take what is to be written to its outputs"));
  EXPECT_EQ(writes().size(), 39u);
}

// A run that is refused half way leaves the card as it was found: all valves closed.
TEST_F(Cards, AnOutputThatCannotBeOneNamesItsValve) {
  const Result result = run({{"CARD_STUCK", "8"}});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("exhaust on bit 8 cannot be made an output"));
  expect_rest();
}

TEST_F(Cards, ASensorThatSaturatesVents) {
  const Result result = run({{"CARD_COUNTS", "24:404,25:4095,26:1175,27:0,28:0,29:0,30:0"}});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("hip_angle"));
  expect_rest();
}

TEST_F(Cards, SignalsLeaveTheValvesAtRest) {
  for (const char* signal : {"2", "15", "1", "3", "20"}) {
    std::filesystem::remove(w_ / "writes");
    const Result result = run({{"CARD_SIGNAL", std::string("13000:") + signal}}, {"--force"});
    EXPECT_NE(result.code, 0) << signal;
    EXPECT_THAT(writes(), Not(IsEmpty()));
    expect_rest();
  }
}

TEST_F(Cards, ACardThatDoesNotFitIsRefusedBeforeAnOutputIsTouched) {
  const auto refused = [&](const Card& card, const std::string& words) {
    const Result result = run(card, {"--force"});
    EXPECT_EQ(result.code, 1) << words;
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(w_ / "writes")) << words;
  };
  refused({{"CARD_INPUTS", "0"}}, "stand-in: found no analog input; expected a converter");
  refused({{"CARD_INPUTS", "16"}},
          "found 16 analog inputs; expected 31, as a sensor is on channel 30");
  refused({{"CARD_OUTPUTS", "0"}}, "found no digital output");
  refused({{"CARD_OUTPUTS", "8"}}, "found 8 digital outputs in a subdevice; expected ");
  refused({{"CARD_HIGH", "2.5"}},
          "found 0 to 2.5 V for its widest range; expected one over 0 to 5 V");
  refused({{"CARD_LOW", "1"}}, "found 1 to 5 V for its widest range");
  refused({{"CARD_LOW", "-5"}}, "found steps of 2.44 mV; expected 1.22 mV or finer");
  refused({{"CARD_TOP", "255"}}, "found steps of 19.6 mV");
  refused({{"CARD_BUSY", "1"}}, "has another program the card?");
}

TEST_F(Cards, ACardThatIsNotThereIsNamedWithWhatToDo) {
  EXPECT_THAT(run({}, {}, "/dev/comedi7").err,
              HasSubstr("/dev/comedi7: No such file or directory; is the card's driver loaded?"));
  EXPECT_THAT(run({}, {}, "/dev/comedi1").err, HasSubstr("sudo usermod -aG iocard $USER"));
}

TEST_F(Cards, WhatOnlyASimulationCanDoIsRefused) {
  EXPECT_THAT(run({}, {}, "/dev/comedi0", "faults/valve-stuck-open").err,
              HasSubstr("only a simulated machine is broken by a word"));
  EXPECT_THAT(run({}, {}, "/dev/comedi0", "walk-with-regulators").err,
              HasSubstr("a digital output sets no pressure"));
  EXPECT_THAT(run({}, {"--pace", "2"}).err, HasSubstr("--pace: found 2"));
}

}  // namespace
}  // namespace sinew::test
