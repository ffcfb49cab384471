// `compare`: tables, JSON and the page. What the page shows is tested in a browser: web/test.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::compare_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::string walk = "experiments/walk-test-1.toml";
const std::string bench = "experiments/one-joint.toml";

void run(const Workspace& w, const std::string& experiment, const std::string& folder,
         const Words& more = {}) {
  Words words = {"run", experiment, "-o", folder, "--no-report", "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  ASSERT_EQ(w.sinew(words).code, 0) << folder;
}

Json compared(const Workspace& w, const Words& runs) {
  Words words = {"compare", "--json"};
  words.insert(words.end(), runs.begin(), runs.end());
  const Result result = w.sinew(words);
  EXPECT_EQ(result.code, 0) << result.err;
  return Json::parse(result.out);
}

TEST(Compare, OfARunWithItselfSaysSo) {
  const Workspace w;
  run(w, walk, "a");
  const Result result = w.sinew({"compare", "a", "a/log.mcap"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("Numbers: 0 of"), HasSubstr("Parameters: all equal")));
  const Json both = compared(w, {"a", "a"});
  for (const Json& channel : both["channels"])
    EXPECT_TRUE(channel["differences"][1]["same"].get<bool>()) << channel["topic"];
}

TEST(Compare, TellsAGainsRunsApart) {
  const Workspace w;
  run(w, walk, "a");
  run(w, walk, "b", {"--set", "control.gains.hip.velocity=0.0001 s/count"});
  const Json c = compared(w, {"a", "b"});
  ASSERT_EQ(c["parameters"].size(), 1u);
  EXPECT_EQ(c["parameters"][0]["key"], "control.gains.hip.velocity");
  const Json summary = Json::parse(read_text(w / "b/summary.json"));
  for (const Json& figure : c["figures"])
    if (figure["key"] == "trolley.distance_m") {
      EXPECT_EQ(figure["values"][1], summary["trolley"]["distance_m"]);
      const double a = figure["values"][0], b = figure["values"][1];
      EXPECT_EQ(figure["differences"][1], b - a);
      EXPECT_EQ(figure["relative"][1], (b - a) / a);
    }
  const Result text = w.sinew({"compare", "a", "b"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("control.gains.hip.velocity"), HasSubstr("B − A"),
                              HasSubstr("trolley.distance  "), HasSubstr(" in ")));
  EXPECT_THAT(w.sinew({"compare", "a", "b", "--units", "si"}).out, HasSubstr(" m "));
}

TEST(Compare, TakesALogOfHardwareAndALogAlone) {
  const Workspace w;
  run(w, walk, "a");
  ASSERT_EQ(w.sinew({"export", "a", "--format", "out.dat", "-o", "out.dat"}).code, 0);
  ASSERT_EQ(w.sinew({"import", "out.dat", "--experiment", walk, "-o", "imported"}).code, 0);
  const Json c = compared(w, {"a", "imported", "--align", "sequence"});
  for (const Json& channel : c["channels"])
    EXPECT_FALSE(channel["topic"].get<std::string>().starts_with("/true"));
  for (const Json& channel : c["channels"])
    if (channel["topic"] == "/sensor/hip_angle/count") {
      EXPECT_EQ(channel["differences"][1]["largest"], 0.0) << "as it was read";
    }

  fs::copy_file(w / "a/log.mcap", w / "alone.mcap");
  const Json alone = compared(w, {"a", "alone.mcap"});
  EXPECT_TRUE(alone["parameters"].empty()) << "the log says what was run";
}

TEST(Compare, JoinsOtherPeriodsAndAlignsSequences) {
  const Workspace w;
  run(w, walk, "a");
  run(w, walk, "dense", {"--set", "log.period=1 ms"});
  run(w, walk, "late", {"--set", "start.settle=0.9 s"});
  const auto hip = [](const Json& c) {
    for (const Json& channel : c["channels"])
      if (channel["topic"] == "/true/joint/hip/angle") return channel["differences"][1];
    return Json();
  };
  const Json dense = hip(compared(w, {"a", "dense"}));
  EXPECT_EQ(dense["meet"], "between");
  EXPECT_LT(dense["rms"], 1e-3);
  const Json start = hip(compared(w, {"a", "late"}));
  const Json sequence = hip(compared(w, {"a", "late", "--align", "sequence"}));
  EXPECT_LT(sequence["rms"], 0.5 * start["rms"].get<double>());
}

TEST(Compare, TakesTheTestStand) {
  const Workspace w;
  run(w, "experiments/rig/pwm-50hz-1lb.toml", "a");
  run(w, "experiments/rig/pwm-50hz-5lb-guess.toml", "b");
  const Result result = w.sinew({"compare", "a", "b"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("load.mass"), HasSubstr("/true/stand/length"),
                                HasSubstr("pulsed.length ")));
}

TEST(Compare, SaysWhatItCannotDo) {
  const Workspace w;
  run(w, bench, "a");
  const auto fails = [&](const Words& more, int code) {
    Words words = {"compare", "a"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, code) << result.err;
    return result.err;
  };
  EXPECT_THAT(fails({"nowhere"}, 1), StartsWith("nowhere: found nothing"));
  EXPECT_THAT(fails({"robots"}, 1), HasSubstr("found no log.mcap"));
  EXPECT_THAT(fails({}, 2), HasSubstr("RUN: found 1; expected 2 to 8"));
  EXPECT_THAT(fails({"a", "--channels", "/jonit/*"}, 2), HasSubstr("/joint/*"));
  EXPECT_THAT(fails({"a", "--align", "end"}, 2), HasSubstr("sequence"));
  run(w, "experiments/rig/pwm-50hz-1lb.toml", "stand");
  EXPECT_THAT(fails({"stand"}, 1), HasSubstr("no channel that a has too"));
  write_text(w / "kept.html", "mine");
  EXPECT_EQ(fails({"a", "-o", "kept.html"}, 1).empty(), false);
  EXPECT_EQ(read_text(w / "kept.html"), "mine");
}

#if SINEW_HAS_PAGE

TEST(Compare, WritesAPageOfWhatIsChosen) {
  const Workspace w;
  run(w, bench, "a");
  run(w, bench, "b", {"--set", "seed=2"});
  ASSERT_EQ(w.sinew({"compare", "a", "b", "-o", "all.html"}).code, 0);
  ASSERT_EQ(w.sinew({"compare", "a", "b", "-o", "again.html"}).code, 0);
  EXPECT_TRUE(read_text(w / "all.html") == read_text(w / "again.html"));
  ASSERT_EQ(w.sinew({"compare", "a", "b", "--channels", "/joint/*", "-o", "some.html"}).code, 0);
  EXPECT_THAT(read_text(w / "some.html"),
              AllOf(HasSubstr("/joint/lever/angle"), Not(HasSubstr("/true/joint"))));
}

#else

TEST(Compare, WithoutNpmHasNoPageAndSaysSo) {
  const Workspace w;
  run(w, bench, "a");
  const Result result = w.sinew({"compare", "a", "a", "-o", "page.html"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("npm ci in web/"));
}

#endif

// --- on one clock ---

TEST(Compare, ByCorrelationTheSameRunIsMovedByExactlyNothing) {
  const Workspace w;
  run(w, bench, "a");
  const Json c = compared(w, {"a", "a", "--align", "correlation", "--clock", "fit"});
  const Json& alignment = c["runs"][1]["alignment"];
  EXPECT_EQ(alignment["shift_s"], 0);
  EXPECT_EQ(alignment["rate"], 0);
  EXPECT_TRUE(alignment["same"].get<bool>());
  EXPECT_FALSE(c["runs"][0].contains("alignment"));
  EXPECT_THAT(w.sinew({"compare", "a", "a", "--align", "correlation"}).out,
              HasSubstr("the same samples: nothing is moved"));
}

TEST(Compare, AnEventAndWhatIsLeftAreTold) {
  const Workspace w;
  run(w, bench, "a");
  run(w, bench, "b", {"--set", "joint.lever.damping=1.6 lbf in s/rad"});
  const Result text = w.sinew({"compare", "a", "b", "--event", "/joint/lever/angle > 275 deg",
                               "--residuals", "left.csv", "--channels", "/joint/lever/angle"});
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(HasSubstr("B is laid on A by event: /joint/lever/angle > 275 deg"),
                              HasSubstr("bias"), HasSubstr("of range")));
  EXPECT_THAT(read_text(w / "left.csv"), StartsWith("time [s],B /joint/lever/angle [rad]\n"));
  EXPECT_EQ(w.sinew({"compare", "a", "b", "--residuals", "left.csv"}).code, 1) << "not over it";
}

TEST(Compare, WhatCannotBeLaidOnEachOtherIsRefusedWithAReason) {
  const Workspace w;
  run(w, bench, "a");
  run(w, bench, "b", {"--set", "joint.lever.damping=1.6 lbf in s/rad"});
  for (const auto& [words, found] :
       {std::pair{Words{"--event", "/joint/lever/angle > 900 deg"}, "never crosses 900 deg"},
        {Words{"--align", "correlation", "--within", "0"}, "a largest shift of 0 s"},
        {Words{"--align-by", "/joint/leverr/angle"}, "try \"/joint/lever/angle\""},
        {Words{"--align-by", "/desired/joint/lever/stiffness"}, "constant or nothing but noise"}}) {
    Words all = {"compare", "a", "b"};
    all.insert(all.end(), words.begin(), words.end());
    const Result result = w.sinew(all);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, HasSubstr(found));
    EXPECT_THAT(result.err, StartsWith("b: align"));
  }
  EXPECT_THAT(w.sinew({"compare", "a", "b", "--event", "/joint/lever/angle"}).err,
              StartsWith("--event: found \"/joint/lever/angle\", without > or <"));
  EXPECT_EQ(w.sinew({"compare", "a", "b", "--align", "middle"}).code, 2);
}

// --- replay ---

TEST(Replay, OfThePlantShowsWhereItPartsAndIsKept) {
  const Workspace w;
  run(w, bench, "a");
  const Result same = w.sinew({"replay", "a", "--of", "plant"});
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr(", 0 part by more than"));
  const Result other = w.sinew({"replay", "a", "--of", "plant", "-o", "c", "--set",
                                "joint.lever.damping=1.6 lbf in s/rad", "--json"});
  ASSERT_EQ(other.code, 0) << other.err;
  const Json json = Json::parse(other.out);
  EXPECT_FALSE(json["agrees"].get<bool>());
  EXPECT_TRUE(json["channels"][0]["parts_at_s"].is_number());
  EXPECT_EQ(w.sinew({"compare", "a", "c"}).code, 0);
  EXPECT_THAT(w.sinew({"replay", "a", "--of", "plant", "--band", "-3"}).err,
              HasSubstr("band: found -3 %"));
}

TEST(Replay, OfTheControllerTellsOfEachValve) {
  const Workspace w;
  run(w, bench, "a");
  const Result other =
      w.sinew({"replay", "a", "--set", "control.gains.lever.velocity=0.0004 s/count"});
  EXPECT_EQ(other.code, 1) << other.err;
  EXPECT_THAT(other.out, AllOf(HasSubstr("first difference at"), HasSubstr("only in the replay"),
                               HasSubstr("/valve/")));
}

}  // namespace
}  // namespace sinew::test::compare_test
