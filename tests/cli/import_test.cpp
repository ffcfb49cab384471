// A laboratory's recording as the folder of a run: what comes in, what takes it, what is refused.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/cli/program.h"

namespace sinew::test::import_test {
namespace {

using ::testing::HasSubstr;

const std::string bench = "experiments/one-joint.toml";

// A logger's table of the bench's lever: German marks, a clock that does not begin at 0.
std::string table() {
  std::string out = "Zeit [ms];Winkel;Druck [bar gauge];Kraft [N]\n";
  for (int i = 0; i < 600; ++i)
    out += std::to_string(5000 + 10 * i) + ";" +
           std::to_string(270 + static_cast<int>(20 * std::sin(0.02 * i))) + ",5;" +
           std::to_string(i % 3) + ",25;" + std::to_string(10 + i % 7) + "\n";
  return out;
}

const Words mapped = {
    "--map", "/joint/lever/angle=Winkel",     "--unit", "Winkel=deg",
    "--map", "/muscle/flexor/pressure=Druck", "--map",  "/muscle/flexor/tension=Kraft"};

Words import(Words words, const Words& more) {
  Words out = {"import"};
  out.insert(out.end(), words.begin(), words.end());
  out.insert(out.end(), {"--experiment", bench});
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Import, OneOfSeveralRecordingsIsNamedByItsNumber) {
  const Workspace w;
  write_text(w / "two.csv", "time [s],lever_angle [deg]\n0,270\n1,271\n2,272\n0,280\n1,281\n");
  const Result both = w.sinew(import({"two.csv"}, {"-o", "both"}));
  EXPECT_EQ(both.code, 1);
  EXPECT_THAT(both.err, HasSubstr("two.csv:5:1: found 2 recordings one after the other"));
  EXPECT_THAT(both.err, HasSubstr("try --part 1 to --part 2"));
  const Result second = w.sinew(import({"two.csv"}, {"--part", "2", "-o", "second"}));
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_THAT(second.err, HasSubstr("recording 2 of 2 in the file, from line 5"));
  EXPECT_THAT(read_text(w / "second/resolved.toml"), HasSubstr("rows = 2"));
  EXPECT_EQ(w.sinew(import({"two.csv"}, {"--part", "3", "-o", "third"})).code, 2);
}

TEST(Import, ATableBecomesARunThatEverythingTakes) {
  const Workspace w;
  write_text(w / "rig.csv", table());
  const Result r =
      w.sinew(import({"rig.csv"}, with(mapped, {"-o", "lab", "--save-mapping", "rig.toml"})));
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("time 0 of the log is 5 s of the recording's clock"));
  EXPECT_THAT(r.err, HasSubstr("counts by the robot's scales, which the recording lacks"));
  const std::string resolved = read_text(w / "lab/resolved.toml");
  EXPECT_THAT(resolved, HasSubstr("[[imported]]"));
  EXPECT_THAT(resolved, HasSubstr("file = \"rig.csv\""));
  EXPECT_THAT(resolved, HasSubstr("rows = 600"));

  EXPECT_EQ(w.sinew({"analyze", "lab", "--json"}).out, read_text(w / "lab/summary.json"));
  const Result csv = w.sinew({"export", "lab", "--csv"});
  EXPECT_THAT(csv.out, HasSubstr("/sensor/lever_angle/count [count]"));
  EXPECT_THAT(csv.out, HasSubstr("\n5.99,"));
  for (const Words& words : {Words{"report", "lab", "-o", "page.html"}, Words{"check", "lab"},
                             Words{"show", "lab/resolved.toml", "imported"},
                             Words{"check", "rig.toml"}, Words{"show", "rig.toml"}}) {
    const Result taken = w.sinew(words);
    EXPECT_EQ(taken.code, 0) << words[0] << " " << words[1] << "\n" << taken.err;
  }
  ASSERT_EQ(w.sinew({"run", bench, "-o", "ran"}).code, 0);
  const Result compared = w.sinew({"compare", "ran", "lab"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("/joint/lever/angle"));

  // The file that was saved gives the same run, and so does the one in the folder.
  for (const char* mapping : {"rig.toml", "lab/mapping.toml"}) {
    const Result again =
        w.sinew(import({"rig.csv"}, {"-o", "again", "--force", "--mapping", mapping, "--quiet"}));
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(w.sinew({"export", "again", "--csv"}).out, csv.out);
  }
}

TEST(Import, OurOwnExportComesBackBitForBit) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "ran"}).code, 0);
  ASSERT_EQ(w.sinew({"export", "ran", "--csv", "-o", "ran.csv"}).code, 0);
  const Result r = w.sinew(import({"ran.csv"}, {"-o", "back"}));
  ASSERT_EQ(r.code, 0) << r.err;
  ASSERT_EQ(w.sinew({"export", "back", "--csv", "-o", "back.csv"}).code, 0);
  EXPECT_TRUE(read_text(w / "ran.csv") == read_text(w / "back.csv"));
  // A log is taken whole, edges and all.
  ASSERT_EQ(w.sinew(import({"ran/log.mcap"}, {"-o", "log"})).code, 0);
  EXPECT_EQ(w.sinew({"export", "log", "--csv"}).out, read_text(w / "ran.csv"));
  EXPECT_EQ(w.sinew({"replay", "log"}).code, 0);
}

TEST(Import, WhatIsWrongIsToldAndLeavesNothing) {
  const Workspace w;
  write_text(w / "rig.csv", table());
  write_text(w / "other.toml", "format = \"sinew.mapping/7\"\n");
  write_text(w / "text.mat", table());
  const auto refused = [&](const Words& words, const Words& parts) {
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, r.err.starts_with("--") ? 2 : 1) << r.out << r.err;
    for (const std::string& part : parts) EXPECT_THAT(r.err, HasSubstr(part));
    EXPECT_FALSE(std::filesystem::exists(w / "lab")) << r.err;
  };
  const Words to = {"-o", "lab"};
  refused(import({"rig.csv"}, with({"--map", "/joint/lever/angel=Winkel"}, to)),
          {"\"/joint/lever/angel\"", "/joint/lever/angle"});
  refused(import({"rig.csv"}, with({"--map", "/joint/lever/angle=Winkl"}, to)), {"\"Winkel\""});
  refused(import({"rig.csv"}, with({"--map", "/joint/lever/angle=Winkel"}, to)),
          {"a column without a unit", "--unit Winkel="});
  refused(import({"rig.csv"}, with({"--map", "/joint/lever/angle=Kraft"}, to)), {"the unit \"N\""});
  refused(import({"rig.csv", "rig.csv"}, with(mapped, to)), {"a second time"});
  refused(import({"no.csv"}, with(mapped, to)), {"no.csv"});
  refused(import({"text.mat"}, with(mapped, to)), {"text.mat", "MAT file"});
  refused(import({"rig.csv"}, with({"--mapping", "other.toml"}, to)), {"sinew.mapping/7"});
  refused({"import", "rig.csv", "--experiment", "no.toml", "-o", "lab"}, {"no.toml"});
  EXPECT_EQ(w.sinew({"import", "rig.csv"}).code, 2);

  ASSERT_EQ(w.sinew(import({"rig.csv"}, with(mapped, to))).code, 0);
  const Result full = w.sinew(import({"rig.csv"}, with(mapped, to)));
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.err, HasSubstr("--force"));
}

}  // namespace
}  // namespace sinew::test::import_test
