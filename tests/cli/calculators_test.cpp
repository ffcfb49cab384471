// `actuator` and `valve`: the laws' own numbers, and what is said where they end.
#include <gmock/gmock.h>

#include <cmath>

#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"
#include "sinew/units/literals.h"
#include "tests/cli/json.h"

namespace sinew::test::calculators_test {
namespace {

using namespace units::literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const std::string actuator_file = "robots/leg/actuator.toml";
const std::string valves = "robots/leg/valves.toml";
const std::string robot = "robots/leg/robot.toml";

// --- actuator ---

TEST(Actuator, GivesTheIdealTensionOfEquation22) {
  const Workspace w;
  const Json out =
      json(w, {"actuator", actuator_file, "--length", "3.4in", "--pressure", "60 psi gauge"});
  const Json& p = out["points"][0];
  const double ideal = actuator::ideal_tension({4.218_in, 2.3125}, 3.4_in, 60.0_psi);
  EXPECT_NEAR(p["tension_N"], ideal * p["effectiveness"].get<double>(), 1e-9 * ideal);
  EXPECT_NEAR(p["length_m"], 3.4_in, 1e-15);
  EXPECT_GT(p["stiffness_sealed_N_per_m"], p["stiffness_at_constant_pressure_N_per_m"]);
  EXPECT_EQ(p["beyond"], Json::array());
}

TEST(Actuator, TakesAbsolutePressureAndUnitsWithAndWithoutASpace) {
  const Workspace w;
  const Json gauge =
      json(w, {"actuator", robot, "--length", "3.4 in", "--pressure", "60 psi gauge"});
  const Json absolute =
      json(w, {"actuator", robot, "--length", "86.36mm", "--pressure", "74.7psi abs"});
  EXPECT_NEAR(gauge["points"][0]["tension_N"], absolute["points"][0]["tension_N"], 1e-9);
}

// [33]: what moves loses, and more the faster it moves.
TEST(Actuator, GivesTheTensionWhileItContracts) {
  const Workspace w;
  const Words words = {"actuator",   "robots/stand/equations.toml",
                       "--length",   "3.4 in",
                       "--pressure", "60 psi gauge",
                       "--velocity", "-2 in/s"};
  const Json p = json(w, words)["points"][0];
  const double at_rest = p["tension_N"].get<double>();
  EXPECT_LT(p["viscous_loss_N"], 0);
  EXPECT_NEAR(p["sliding_tension_N"],
              at_rest + p["viscous_loss_N"].get<double>() - p["coulomb_bound_N"].get<double>(),
              1e-9);
  EXPECT_THAT(w.sinew(words).out, AllOf(HasSubstr("tension, sliding"), HasSubstr("of it viscous")));
  Words table = words;
  table[3] = "3in:3.4in:0.2in";
  EXPECT_THAT(w.sinew(table).out, HasSubstr("sliding [N]"));
  table.resize(6);
  EXPECT_THAT(w.sinew(table).out, Not(HasSubstr("sliding")));
  Words fast = words;
  fast.back() = "-1000 m/s";
  EXPECT_THAT(w.sinew(fast).err, HasSubstr("--velocity: found \"-1000 m/s\"; expected -100 m/s"));
  EXPECT_FALSE(json(w, {"actuator", actuator_file, "--length", "3.4in", "--pressure",
                        "60 psi gauge"})["points"][0]
                   .contains("sliding_tension_N"));
}

TEST(Actuator, MakesTablesOverRanges) {
  const Workspace w;
  const Json out = json(w, {"actuator", actuator_file, "--length", "2.5in:3.9in:0.1in",
                            "--pressure", "20 psi gauge:110 psi gauge:10 psi"});
  ASSERT_EQ(out["points"].size(), 15u * 10u);
  EXPECT_NEAR(out["points"].back()["length_m"], 3.9_in, 1e-12);
  EXPECT_NEAR(out["points"].back()["gauge_pressure_Pa"], 110.0_psi, 1e-6);

  const Result text = w.sinew(
      {"actuator", actuator_file, "--length", "2.5in:3.9in:0.1in", "--pressure", "60 psi gauge"});
  EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), 16);
  EXPECT_THAT(text.out, HasSubstr("length [in]  pressure [psi gauge]"));
}

TEST(Actuator, SaysWhereTheModelEnds) {
  const Workspace w;
  const Result inside =
      w.sinew({"actuator", actuator_file, "--length", "3.4in", "--pressure", "60 psi gauge"});
  EXPECT_THAT(inside.err, IsEmpty());
  const Result beyond =
      w.sinew({"actuator", actuator_file, "--length", "4.3in", "--pressure", "120 psi gauge"});
  EXPECT_EQ(beyond.code, 0);
  EXPECT_THAT(beyond.err,
              AllOf(HasSubstr("longer than the thread"), HasSubstr("beyond the long end"),
                    HasSubstr("outside the fitted pressures")));
  EXPECT_THAT(beyond.out, ::testing::Not(HasSubstr("nan")));
}

TEST(Actuator, RefusesWhatIsNoQuantity) {
  const Workspace w;
  const auto said = [&](const std::string& length, const std::string& pressure) {
    const Result r =
        w.sinew({"actuator", actuator_file, "--length", length, "--pressure", pressure});
    EXPECT_EQ(r.code, 2) << length << " " << pressure;
    EXPECT_THAT(r.out, IsEmpty());
    return r.err;
  };
  EXPECT_THAT(said("3.4", "60 psi gauge"), HasSubstr("--length: found 3.4 without a unit"));
  EXPECT_THAT(said("3,4 in", "60 psi gauge"), HasSubstr("a decimal point: \"3.4 in\""));
  EXPECT_THAT(said("nan m", "60 psi gauge"), HasSubstr("a finite number"));
  EXPECT_THAT(said("3.4 lb", "60 psi gauge"), HasSubstr("expected m (length)"));
  EXPECT_THAT(said("3.4in", "60 psi"), HasSubstr("\"60 psi gauge\" or \"60 psi abs\""));
  EXPECT_THAT(said("3in:2in:0.1in", "60 psi gauge"), HasSubstr("a step that leads"));
  EXPECT_THAT(said("3in:4in", "60 psi gauge"), HasSubstr("from:to:step"));
  EXPECT_THAT(said("3in:4in:1um", "60 psi gauge"), HasSubstr("--length"));
}

// A quantity that cannot be is refused with its range and the reason, before anything is answered.
struct Impossible {
  Words words;
  const char* says;
};

void expect_refused(const std::vector<Impossible>& all) {
  const Workspace w;
  for (const Impossible& one : all) {
    const Result r = w.sinew(one.words);
    EXPECT_EQ(r.code, 2) << testing::PrintToString(one.words);
    EXPECT_THAT(r.out, IsEmpty()) << testing::PrintToString(one.words);
    EXPECT_THAT(r.err, HasSubstr(one.says));
    EXPECT_THAT(r.err, ::testing::AnyOf(HasSubstr("; expected more than "), HasSubstr(" to ")));
  }
}

TEST(Actuator, RefusesWhatNoActuatorIs) {
  const auto at = [](const char* length, const char* pressure, const char* external = "0 m3") {
    return Words{"actuator",   actuator_file, "--length",          length,
                 "--pressure", pressure,      "--external-volume", external};
  };
  expect_refused(
      {{at("-3 in", "60 psi gauge"), "--length: found \"-3 in\", which is -0.0762 m; expected"},
       {at("0 in", "60 psi gauge"), "from the caps alone to one and a half threads"},
       {at("300 in", "60 psi gauge"), "--length: found \"300 in\""},
       {at("1e300 in", "60 psi gauge"), "--length"},
       {at("-3in:3in:1in", "60 psi gauge"), "--length: found \"-3in\""},
       {at("3in:300in:1in", "60 psi gauge"), "--length: found \"300in\""},
       {at("3 in", "-500 psi gauge"), "--pressure: found \"-500 psi gauge\""},
       {at("3 in", "-1 psi abs"), "absolute pressures are positive"},
       {at("3 in", "0 psi abs"), "absolute pressures are positive"},
       {at("3 in", "1e300 psi gauge"), "above it air is no ideal gas"},
       {at("3 in", "60 psi gauge", "-1 in3"), "--external-volume: found \"-1 in3\""}});
}

// The hint of a range proposes a range that is taken.
TEST(Actuator, ProposesRangesThatItTakes) {
  const Workspace w;
  const Result wrong = w.sinew(
      {"actuator", actuator_file, "--length", "3in", "--pressure", "20 psi gauge:50 psi gauge"});
  const std::string hint = "1 psi gauge:2 psi gauge:0.1 psi";
  EXPECT_THAT(wrong.err, HasSubstr("try \"" + hint + "\""));
  EXPECT_EQ(w.sinew({"actuator", actuator_file, "--length", "3in", "--pressure", hint}).code, 0);
}

// --- force-beam and geometry ---

TEST(ForceBeam, RefusesWhatNoTransducerIs) {
  const auto with = [](const char* option, const char* value) {
    return Words{"force-beam", std::string("--") + option + "=" + value};
  };
  expect_refused({{with("poisson", "nan"), "--poisson: found nan"},
                  {with("poisson", "0.6"), "--poisson: found 0.6; expected 0 to 0.5"},
                  {with("concentration", "0.1"), "a mount adds to the stress"},
                  {with("concentration", "nan"), "--concentration: found nan"},
                  {with("gain", "-1"), "--gain: found -1"},
                  {with("gain", "1e300"), "--gain"},
                  {with("gage-factor", "1e300"), "semiconductors have 200"},
                  {with("length", "-1 in"), "--length: found \"-1 in\""},
                  {with("modulus", "1e300 psi"), "diamond"},
                  {with("load", "1e300 lbf"), "--load"},
                  {with("load", "0 lbf"), "--load"},
                  {with("sensitivity", "-1 V/lbf"), "--sensitivity"}});
}

TEST(Geometry, RefusesWhatNoBraidIs) {
  const auto with = [](const char* counts, const char* side, const char* thread = "0 mm") {
    return Words{"identify", "geometry", "--trapezoids",       counts,
                 "--side",   side,       "--thread-thickness", thread};
  };
  expect_refused({{with("37,16", "1e300 in"), "--side"},
                  {with("37,16", "-0.057 in"), "--side"},
                  {with("1e300,16", "0.057 in"), "--trapezoids: found \"1e300\""},
                  {with("37.5,0.1", "0.057 in"), "--trapezoids: found \"0.1\""},
                  {with("37,16", "0.057 in", "-1 mm"), "--thread-thickness"}});
}

// --- valve ---

TEST(Valve, RefusesWhatNoValveSees) {
  const auto with = [](const char* up, Words more) {
    Words words{"valve", valves, "inlet", "--upstream", up, "--downstream", "0 psi gauge"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const char* const line = "100 psi gauge";
  expect_refused({{with("1e300 psi gauge", {}), "--upstream"},
                  {with("-20 psi gauge", {}), "--upstream: found \"-20 psi gauge\""},
                  {with(line, {"--volume", "-1 in3"}), "--volume: found \"-1 in3\""},
                  {with(line, {"--volume", "0 in3"}), "--volume"},
                  {with(line, {"--duty", "2"}), "--duty: found \"2\"; expected 0 to 1"},
                  {with(line, {"--duty=-0.5"}), "a share of the period"},
                  {with(line, {"--duty", "0.5", "--frequency", "0 Hz"}), "--frequency"},
                  {with(line, {"--duty", "0.5", "--frequency=-100 Hz"}), "--frequency"}});
  const Workspace w;
  EXPECT_EQ(w.sinew(with(line, {"--frequency", "50 Hz"})).code, 2) << "of no pulses";
}

TEST(Valve, ChokesBelowTheCriticalRatio) {
  const Workspace w;
  const auto flow = [&](const std::string& downstream) {
    return json(
        w, {"valve", valves, "inlet", "--upstream", "100 psi gauge", "--downstream", downstream});
  };
  const Json choked = flow("0 psi gauge"), more = flow("40 psi gauge"), free = flow("80 psi gauge");
  EXPECT_EQ(choked["choked"], true);
  EXPECT_EQ(more["mass_flow_kg_per_s"], choked["mass_flow_kg_per_s"]);
  EXPECT_EQ(free["choked"], false);
  EXPECT_LT(free["mass_flow_kg_per_s"], choked["mass_flow_kg_per_s"]);
  EXPECT_NEAR(choked["critical_pressure_ratio"], 0.528282, 1e-6);
  EXPECT_NEAR(choked["normal_flow_m3_per_s"].get<double>() * 1.185, choked["mass_flow_kg_per_s"],
              1e-12);
}

TEST(Valve, RunsBackwardsWithTheOtherSign) {
  const Workspace w;
  const auto flow = [&](const std::string& up, const std::string& down) {
    return json(w, {"valve", valves, "exhaust", "--upstream", up, "--downstream",
                    down})["mass_flow_kg_per_s"]
        .get<double>();
  };
  EXPECT_EQ(flow("3 bar abs", "2 bar abs"), -flow("2 bar abs", "3 bar abs"));
}

TEST(Valve, TakesTwiceAsLongForTwiceTheVolume) {
  const Workspace w;
  const auto times = [&](const std::string& volume) {
    return json(w, {"valve", valves, "inlet", "--upstream", "100 psi gauge", "--downstream",
                    "0 psi gauge", "--volume", volume})["transfers"];
  };
  const Json one = times("1 in3"), two = times("2 in3");
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (const char* key : {"fill_time_s", "vent_time_s"})
      EXPECT_NEAR(two[i][key], 2 * one[i][key].get<double>(), 1e-9) << key;
}

// Section 3.4: 4 and 1 ms make 42.5 % of 50 % at 25 Hz, and 35 % at 50 Hz.
TEST(Valve, DeliversWhatItsDelaysLeaveOfADuty) {
  const Workspace w;
  const auto delivered = [&](const std::string& frequency) {
    return json(w, {"valve", valves, "758", "--upstream", "100 psi gauge", "--downstream",
                    "0 psi gauge", "--duty", "50 %", "--frequency",
                    frequency})["duties"][0]["delivered_duty"]
        .get<double>();
  };
  EXPECT_NEAR(delivered("25 Hz"), 0.425, 1e-12);
  EXPECT_NEAR(delivered("50 Hz"), 0.35, 1e-12);
}

TEST(Valve, NamesTheValvesThereAre) {
  const Workspace w;
  const Result result =
      w.sinew({"valve", valves, "inlett", "--upstream", "2 bar abs", "--downstream", "1 bar abs"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("found \"inlett\"; expected inlet, exhaust or 758"),
                                HasSubstr("try \"inlet\"")));
  const Result vacuum =
      w.sinew({"valve", valves, "inlet", "--upstream", "2 bar abs", "--downstream", "0 bar abs"});
  EXPECT_EQ(vacuum.code, 2);
  EXPECT_THAT(vacuum.err, HasSubstr("--downstream: "));
}

// Near equal pressures the straight line through zero is far below the law, which is told.
TEST(Valve, SaysThatItsFlowIsInTheLinearPart) {
  const Workspace w;
  const Words near = {"valve",          valves,         "inlet",      "--upstream",
                      "100.02 psi abs", "--downstream", "100 psi abs"};
  const Json out = json(w, near);
  EXPECT_EQ(out["linear_part"], true);
  const double share =
      out["mass_flow_kg_per_s"].get<double>() / out["law_mass_flow_kg_per_s"].get<double>();
  EXPECT_NEAR(share, std::sqrt(0.02 / 100.02 / 1e-3), 1e-3) << "55 % low";
  const Result text = w.sinew(near);
  EXPECT_THAT(text.out, AllOf(HasSubstr("by the law itself"), HasSubstr("free, linear")));
  EXPECT_THAT(text.err, AllOf(HasSubstr("warning: inlet: the pressures are 0.02 % apart"),
                              HasSubstr("2.24 times as much")));

  Words apart = near;
  apart[4] = "110 psi abs";
  EXPECT_EQ(json(w, apart)["linear_part"], false);
  EXPECT_THAT(w.sinew(apart).err, IsEmpty());
}

}  // namespace
}  // namespace sinew::test::calculators_test
