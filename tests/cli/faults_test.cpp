// Sensors that break: how such a run ends, what it leaves, and what of a list is refused.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "sinew/log/reader.h"
#include "tests/cli/program.h"

namespace sinew::test::faults_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const std::string broken = "experiments/faults/sensor-open.toml";

TEST(Faults, ABrokenPotentiometerEndsTheRunAndIsNamed) {
  const Workspace w;
  const Result r = w.sinew({"run", broken, "-o", "run"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err,
              AllOf(HasSubstr("the run was ended: sensor hip_angle at 5.0203 s: 4095 "
                              "count three times in a row, outside its plausible "),
                    HasSubstr("all muscles were vented"), HasSubstr("hip_angle: "),
                    HasSubstr("3 readings were not believed"), Not(HasSubstr("plant_steps.body"))));

  // The log is kept and whole, the summary says only who was not believed.
  const signals::Table log = log::read(w / "run/log.mcap");
  EXPECT_TRUE(log.complete);
  EXPECT_EQ(log.column("/sensor/hip_angle/count")->back(), 4095);
  EXPECT_EQ(log.column("/low_level/tripped")->back(), 1);
  const Json summary = Json::parse(read_text(w / "run/summary.json"));
  EXPECT_GE(summary["sensors"]["hip_angle"]["rejected_readings"], 3);
  EXPECT_NEAR(summary["low_level"]["tripped_time_s"], 5.02, 0.011);
  EXPECT_FALSE(summary.contains("trolley"));
  EXPECT_FALSE(summary.contains("joints"));

  // A second run comes to the same end; and the log's lies give the same edges.
  const Result again = w.sinew({"run", "run/resolved.toml", "-o", "again", "--quiet"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("sensor hip_angle at 5.0203 s"));
  EXPECT_THAT(w.sinew({"replay", "run"}).out, HasSubstr("all equal"));
}

// Nothing of a run that was ended may look like a whole run's figures.
void expect_no_figures_of(const Workspace& w, const std::string& run, const std::string& cause) {
  for (const Words& words :
       {Words{"analyze", run}, Words{"analyze", run, "--json"}, Words{"analyze", run, "--verdicts"},
        Words{"compare", run, run}, Words{"compare", run, run, "--json"}}) {
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, 1) << words[0];
    EXPECT_EQ(r.out, "") << words[0];
    EXPECT_THAT(r.err, AllOf(HasSubstr(run + "/log.mcap: the run was ended: "), HasSubstr(cause),
                             HasSubstr("a run that was not finished has no numbers; sinew report "
                                       "shows what it did")));
  }
  const Result figures = w.sinew({"figures", run});
  EXPECT_EQ(figures.code, 0);
  EXPECT_THAT(figures.err, AllOf(HasSubstr("the run was ended: "), HasSubstr(cause)));
  if (!SINEW_HAS_PAGE) return;
  const Result page = w.sinew({"report", run});
  EXPECT_EQ(page.code, 0);
  EXPECT_THAT(page.err, AllOf(HasSubstr("the run was ended: "), HasSubstr(cause)));
  EXPECT_THAT(read_text(w / (run + "/report.html")),
              AllOf(HasSubstr("\"warnings\":[{\"text\":\"the run was ended: "),
                    HasSubstr("\"verdicts\":[]")));
}

TEST(Faults, ARunThatWasEndedReadsBackAsOne) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", broken, "-o", "run", "--quiet"}).code, 1);
  expect_no_figures_of(w, "run", "sensor hip_angle at 5.0203 s");

  const Result away = w.sinew({"run", "experiments/walk-test-1.toml", "-o", "away", "--quiet",
                               "--set", "actuator.bpa.loss.viscous=5000 N s/m"});
  ASSERT_EQ(away.code, 1);
  ASSERT_THAT(away.err, HasSubstr("was no number any more"));
  expect_no_figures_of(w, "away", "was no number any more");
}

TEST(Faults, AHealthyRunSaysNothingOfThem) {
  const Workspace w;
  const Result r = w.sinew({"run", "experiments/one-joint.toml", "-o", "run", "--json"});
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.out, AllOf(Not(HasSubstr("rejected")), Not(HasSubstr("tripped"))));
  EXPECT_THAT(r.err, Not(HasSubstr("believed")));
}

TEST(Faults, WhatCannotBeIsRefused) {
  const Workspace w;
  const auto refused = [&](const std::string& list) {
    write_text(w / "experiments/x.toml",
               "format = \"sinew.experiment/1\"\nbase = "
               "\"one-joint.toml\"\n[[fault]]\n" +
                   list);
    const Result r = w.sinew({"check", "experiments/x.toml"});
    EXPECT_EQ(r.code, 1) << list;
    return r.out + r.err;
  };
  EXPECT_THAT(refused("at = \"1 s\"\nof = \"lever_angel\"\nwhat = \"open\"\n"),
              AllOf(HasSubstr("lever_angel"), HasSubstr("lever_angle")));
  EXPECT_THAT(refused("at = \"1 s\"\nof = \"lever_angle\"\nwhat = \"opened\"\n"),
              HasSubstr("opened"));
  EXPECT_THAT(refused("at = \"1 s\"\nof = \"lever_angle\"\nwhat = \"offset\"\n"),
              HasSubstr("amount"));
  EXPECT_THAT(
      refused("at = \"1 s\"\nof = \"lever_angle\"\nwhat = \"open\"\namount = \"3 count\"\n"),
      HasSubstr("amount"));
  EXPECT_THAT(refused("at = \"1 s\"\nof = \"lever_angle\"\nwhat = \"slip\"\namount = \"3 count\"\n"
                      "for = \"1 s\"\n"),
              HasSubstr("a slip that ends"));
  EXPECT_THAT(refused("at = \"-1 s\"\nof = \"lever_angle\"\nwhat = \"open\"\n"), HasSubstr("at"));
}

// Returns what `check` says of one-joint with this list, which it refuses or not.
std::string check_list(const std::string& list, int code) {
  const Workspace w;
  write_text(w / "experiments/x.toml",
             "format = \"sinew.experiment/1\"\nbase = \"one-joint.toml\"\n" + list);
  const Result r = w.sinew({"check", "experiments/x.toml"});
  EXPECT_EQ(r.code, code) << list << r.out;
  return r.out + r.err;
}

std::string of_air(const std::string& of, const std::string& what, const std::string& more = "") {
  return "[[fault]]\nat = \"1 s\"\nof = \"" + of + "\"\nwhat = \"" + what + "\"\n" + more;
}

TEST(Faults, PartsOfTheAirAreNamedOrRefused) {
  const auto refused = [](const std::string& list) { return check_list(list, 1); };
  EXPECT_THAT(refused(of_air("flexr.inlet", "stuck open")),
              AllOf(HasSubstr("fault[0].of: found \"flexr.inlet\"; expected flexor.inlet"),
                    HasSubstr("try \"flexor.inlet\"")));
  EXPECT_THAT(refused(of_air("flexor", "stuck open")), HasSubstr("leaking, ruptured or blocked"));
  EXPECT_THAT(refused(of_air("flexor.inlet", "open")),
              HasSubstr("stuck open, stuck shut or leaking, as flexor.inlet is a valve"));
  EXPECT_THAT(refused(of_air("lever_angle", "leaking", "area = \"1 mm2\"\n")),
              HasSubstr("as lever_angle is a sensor"));
  EXPECT_THAT(refused(of_air("supply", "blocked")), HasSubstr("failed, as supply is the supply"));
}

TEST(Faults, AmountsOfTheAirAreChecked) {
  const auto refused = [](const std::string& list) { return check_list(list, 1); };
  EXPECT_THAT(refused(of_air("flexor", "leaking")),
              AllOf(HasSubstr("fault[0].area: found no leak"), HasSubstr("area = \"0.1 mm2\"")));
  EXPECT_THAT(refused(of_air("flexor", "leaking", "share = \"5 %\"\n")),
              HasSubstr("flexor is a muscle and has no seat"));
  EXPECT_THAT(refused(of_air("flexor", "leaking", "area = \"1 psi gauge\"\n")),
              HasSubstr("fault[0].area"));
  EXPECT_THAT(refused(of_air("flexor.inlet", "stuck open", "share = 0.5\n")), HasSubstr("share"));
  EXPECT_THAT(refused(of_air("supply", "failed", "pressure = \"3 bar\"\n")),
              HasSubstr("fault[0].pressure"));
  EXPECT_THAT(refused(of_air("flexor", "ruptured", "area = \"2 m2\"\n")),
              HasSubstr("no muscle is wider"));
  EXPECT_THAT(refused(of_air("flexor.inlet", "leaking", "area = \"1 cm2\"\n")),
              HasSubstr("found 100 mm2; expected at most 10 mm2"));
}

TEST(Faults, OnePartOfTheAirBreaksOnceAtATime) {
  const std::string jam = of_air("flexor.inlet", "stuck open", "for = \"0.5 s\"\n");
  EXPECT_THAT(check_list(jam + of_air("flexor.inlet", "stuck shut"), 1),
              AllOf(HasSubstr("fault[1].at: found 1 s; expected a time at which no other fault of "
                              "flexor.inlet acts: fault[0] is flexor.inlet stuck open from 1 s to "
                              "1.5 s"),
                    HasSubstr("try at = \"1.5 s\"")));
  // A muscle's hose is not its wall, and what ends at an instant leaves it to the next.
  EXPECT_THAT(
      check_list(jam + of_air("flexor", "ruptured") + of_air("flexor", "blocked") +
                     "[[fault]]\nat = \"1.5 s\"\nof = \"flexor.inlet\"\nwhat = \"stuck "
                     "shut\"\n",
                 0),
      HasSubstr("4 faults: flexor.inlet stuck open from 1 s to 1.5 s; flexor ruptured from "
                "1 s on; flexor blocked from 1 s on; flexor.inlet stuck shut from 1.5 s on"));
}

// Writes experiments/rig/<base>.toml with a list of faults.
void write_stand(const Workspace& w, const std::string& list,
                 const std::string& base = "pwm-25hz-5lb") {
  write_text(w / "experiments/rig/x.toml",
             "format = \"sinew.rig/1\"\nbase = \"" + base + ".toml\"\n" + list);
}

TEST(Faults, ATestStandsAirBreaks) {
  const Workspace w;
  write_stand(w, of_air("bpa.inlet", "stuck shut", "for = \"0.2 s\"\n") +
                     "[[fault]]\nat = \"1.5 s\"\nof = \"bpa\"\nwhat = \"leaking\"\n"
                     "area = \"0.05 mm2\"\n" +
                     "[[fault]]\nat = \"90 s\"\nof = \"supply\"\nwhat = \"failed\"\n");
  const Result checked = w.sinew({"check", "experiments/rig/x.toml"});
  EXPECT_EQ(checked.code, 0);
  EXPECT_THAT(checked.out + checked.err,
              AllOf(HasSubstr("3 faults: bpa.inlet stuck shut from 1 s to 1.2 s; bpa leaking (0.05 "
                              "mm2) from 1.5 s on"),
                    HasSubstr("fault[2] never acts: it begins at 90 s")));

  const Result r = w.sinew({"run", "experiments/rig/x.toml", "-o", "run"});
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err, HasSubstr("warning: fault[2] never acted: it begins at 90 s"));
  const Json summary = Json::parse(read_text(w / "run/summary.json"));
  EXPECT_EQ(summary["faults"],
            Json::parse("[{\"of\": \"bpa.inlet\", \"what\": \"stuck shut\", \"begin_s\": 1, "
                        "\"end_s\": 1.2}, {\"of\": \"bpa\", \"what\": \"leaking\", "
                        "\"begin_s\": 1.5}]"));
  const signals::Table log = log::read(w / "run/log.mcap");
  const signals::Column& leaked = *log.column("/true/muscle/bpa/air_leaked");
  const signals::Column& acts = *log.column("/true/muscle/bpa/fault");
  const signals::Column& inlet = *log.column("/true/valve/bpa/inlet");
  const signals::Times& time = log.find("/true/muscle/bpa/fault")->time_ns;
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_EQ(acts[i], time[i] >= 1'500'000'000 ? 1.0 : 0.0) << time[i];
    if (time[i] < 1'500'000'000) {
      EXPECT_EQ(leaked[i], 0.0) << time[i];
    }
    if (time[i] > 1'000'000'000 && time[i] < 1'200'000'000) {
      EXPECT_EQ(inlet[i], 0.0) << time[i];
    }
  }
  EXPECT_GT(leaked.back(), 1e-6);
  EXPECT_THAT(read_text(w / "run/report.html"),
              HasSubstr("\"faults\":[{\"of\":\"bpa.inlet\",\"what\":\"stuck shut\""));
}

TEST(Faults, WhatATestStandHasNotCannotBreak) {
  const auto refused = [](const std::string& list, const std::string& base = "pwm-25hz-5lb") {
    const Workspace w;
    write_stand(w, list, base);
    const Result r = w.sinew({"check", "experiments/rig/x.toml"});
    EXPECT_EQ(r.code, 1) << list;
    return r.out + r.err;
  };
  EXPECT_THAT(refused(of_air("inlet", "stuck open")),
              AllOf(HasSubstr("x.toml:5:"), HasSubstr("fault[0].of: found \"inlet\""),
                    HasSubstr("bpa.inlet")));
  EXPECT_THAT(refused(of_air("bpa.inlet", "open"), "feedback"), HasSubstr("a base of its own"));
  EXPECT_THAT(refused("[sensor.dial]\nof = \"length\"\nlow = \"2 in\"\nhigh = \"4 in\"\n" +
                      of_air("dial", "stuck")),
              AllOf(HasSubstr("\"dial\", a transducer of the test stand"),
                    HasSubstr("sensor.dial.offset")));
  EXPECT_THAT(refused(of_air("bpa", "ruptured"), "length-sweep"),
              HasSubstr("the pressure is prescribed"));
  EXPECT_THAT(refused(of_air("bpa", "ruptured") + of_air("bpa", "leaking", "area = \"1 mm2\"\n")),
              HasSubstr("a time at which no other fault of bpa acts"));
  std::string many;
  for (int i = 0; i < 65; ++i)
    many += "[[fault]]\nat = \"" + std::to_string(i + 1) +
            " s\"\nfor = \"0.5 s\"\nof = \"bpa\"\nwhat = \"blocked\"\n";
  EXPECT_THAT(refused(many), HasSubstr("65 faults of the air; expected at most 64"));
}

TEST(Faults, AValveThatStandsOpenIsListedAndDrawn) {
  const Workspace w;
  const Result r = w.sinew({"run", "experiments/faults/valve-stuck-open.toml", "-o", "run"});
  EXPECT_EQ(r.code, 0);
  const Json summary = Json::parse(read_text(w / "run/summary.json"));
  EXPECT_EQ(summary["faults"],
            Json::parse("[{\"of\": \"knee_extensor.inlet\", \"what\": \"stuck open\", "
                        "\"begin_s\": 5, \"end_s\": 5.2}]"));
  const auto& air = summary["air_balance"];
  EXPECT_GT(air["entered_kg"], 1e-3);
  EXPECT_EQ(air["leaked_kg"], 0);
  EXPECT_NEAR(air["error_kg"], 0, 1e-12 * air["entered_kg"].get<double>());

  const signals::Table log = log::read(w / "run/log.mcap");
  const signals::Column& acts = *log.column("/true/valve/knee_extensor/inlet/fault");
  EXPECT_NEAR(static_cast<double>(std::ranges::count(acts, 1.0)), 21, 1);
  EXPECT_THAT(w.sinew({"replay", "run"}).out, HasSubstr("all equal"));
  if (SINEW_HAS_PAGE) {
    EXPECT_THAT(read_text(w / "run/report.html"),
                HasSubstr("\"faults\":[{\"of\":\"knee_extensor.inlet\",\"what\":\"stuck open\","
                          "\"from\":5.0,\"to\":5.2}]"));
  }
}

TEST(Faults, ARangeWithoutTheCountAtRestIsRefused) {
  const Workspace w;
  w.edit("robots/one-joint/robot.toml", "[sensor.lever_angle]\n",
         "[sensor.lever_angle]\nplausible = [\"2100 count\", \"3000 count\"]\n");
  const Result r = w.sinew({"check", "experiments/one-joint.toml"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.out + r.err, AllOf(HasSubstr("sensor.lever_angle.plausible"),
                                   HasSubstr("a range with its count at rest in it, 2048")));
}

TEST(Faults, TheLastRecordsAreThoseOfTheTrip) {
  const Workspace w;
  const Result r = w.sinew({"run", broken, "-o", "run"});
  const std::size_t records = r.err.find("the last records before:");
  ASSERT_NE(records, std::string::npos);
  std::istringstream lines(r.err.substr(records));
  std::string line;
  std::getline(lines, line);
  int told = 0;
  while (std::getline(lines, line) && line.starts_with("  ")) {
    EXPECT_LE(std::stod(line), 5.0203) << line;
    ++told;
  }
  EXPECT_GT(told, 10);
  EXPECT_THAT(r.err, HasSubstr("\n  5.0113 s  /sensor/hip_angle/count  4095 count"));
}

TEST(Faults, OneReadingIsOne) {
  const Workspace w;
  write_text(w / "experiments/x.toml",
             "format = \"sinew.experiment/1\"\nbase = \"one-joint.toml\"\n[[fault]]\n"
             "at = \"1 s\"\nfor = \"10 ms\"\nof = \"lever_angle\"\nwhat = \"open\"\n");
  const Result r = w.sinew({"run", "experiments/x.toml", "-o", "run"});
  EXPECT_THAT(r.err, HasSubstr("lever_angle: 1 reading was not believed"));
}

TEST(Faults, OneThatNeverActsIsTold) {
  const Workspace w;
  write_text(w / "experiments/x.toml",
             "format = \"sinew.experiment/1\"\nbase = \"one-joint.toml\"\n[[fault]]\n"
             "at = \"100 s\"\nof = \"lever_angle\"\nwhat = \"open\"\n[[fault]]\n"
             "at = \"1 s\"\nof = \"lever_angle\"\nwhat = \"offset\"\namount = \"0 count\"\n"
             "[[fault]]\nat = \"1 s\"\nof = \"lever_angle\"\nwhat = \"offset\"\n"
             "amount = \"1 count\"\n[[fault]]\nat = \"1.003 s\"\nfor = \"2 ms\"\n"
             "of = \"lever_angle\"\nwhat = \"open\"\n");
  EXPECT_THAT(w.sinew({"check", "experiments/x.toml"}).out,
              HasSubstr("fault[0] never acts: it begins at 100 s"));
  const Result r = w.sinew({"run", "experiments/x.toml", "-o", "run"});
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err, AllOf(HasSubstr("warning: fault[0] never acted: it begins at 100 s"),
                           HasSubstr("warning: fault[1] never acted: its amount is 0"),
                           HasSubstr("warning: fault[3] never acted: it falls between two "
                                     "readings of lever_angle, the later one at 1.0101 s"),
                           Not(HasSubstr("fault[2]"))));
}

// Returns what `check` says of the lever's sensor with this line more.
std::string check_with(const std::string& line) {
  const Workspace w;
  w.edit("robots/one-joint/robot.toml", "[sensor.lever_angle]\n",
         "[sensor.lever_angle]\n" + line + "\n");
  const Result r = w.sinew({"check", "experiments/one-joint.toml"});
  EXPECT_EQ(r.code, 1) << line;
  return r.out + r.err;
}

TEST(Faults, AFrozenLimitThatNoiseReachesIsRefused) {
  EXPECT_THAT(check_with("frozen_limit = \"10 ms\""),
              AllOf(HasSubstr("sensor.lever_angle.frozen_limit"),
                    HasSubstr("a converter's noise repeats itself by chance")));
}

TEST(Faults, AReversedRangeIsNamedOnce) {
  const std::string reversed = check_with("plausible = [\"2800 count\", \"1000 count\"]");
  EXPECT_THAT(reversed, AllOf(HasSubstr("2800 to 1000 count"),
                              HasSubstr("the lowest count first, then the highest"),
                              HasSubstr("[\"1000 count\", \"2800 count\"]")));
  EXPECT_THAT(check_with("plausible = [\"2048 count\", \"2048 count\"]"),
              HasSubstr("two that differ"));
  const std::string aside = check_with("plausible = [\"2100 count\", \"3000 count\"]");
  const std::string told = "a range with its count at rest in it, 2048";
  ASSERT_THAT(aside, HasSubstr(told));
  EXPECT_EQ(aside.find(told), aside.rfind(told)) << aside;
}

}  // namespace
}  // namespace sinew::test::faults_test
