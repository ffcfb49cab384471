// `sinew migrate` on files of users: what it changes, where it writes, what it refuses.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::migrate_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;

const std::string format_line = "format = \"sinew.valves/1\"\n";

// A valves file of somebody who forgot the line that says so.
std::string valves(const Workspace& w) {
  const std::string text = read_text(w / "robots/leg/valves.toml");
  const std::size_t at = text.find("format");
  return text.substr(0, at) + text.substr(text.find('\n', at) + 1);
}

TEST(Migrate, AFileThatDoesNotSayItsFormatBecomesOneThatReadsAsBefore) {
  const Workspace w;
  fs::create_directory(w / "mine");
  write_text(w / "mine/valves.toml", valves(w));
  const Result refused = w.sinew({"check", "mine/valves.toml"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.out, AllOf(HasSubstr("try format = \"sinew.valves/1\" as the first line"),
                                 HasSubstr("sinew migrate")));

  const Result done = w.sinew({"migrate", "mine/valves.toml"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("format = \"sinew.valves/1\" is added"));
  EXPECT_THAT(
      done.out,
      HasSubstr("mine/valves.toml: is sinew.valves/1 now; the old one is mine/valves.toml.bak"));
  EXPECT_EQ(w.sinew({"check", "mine/valves.toml"}).code, 0);

  // The same values as the file that it was made of; and the old one, to the byte.
  Json values[2];
  for (const int i : {0, 1}) {
    const char* file = i == 0 ? "robots/leg/valves.toml" : "mine/valves.toml";
    values[i] = Json::parse(w.sinew({"show", file, "--json"}).out);
    for (Json& one : values[i]) one.erase("file"), one.erase("line");
  }
  EXPECT_FALSE(values[0].empty());
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(read_text(w / "mine/valves.toml.bak"), valves(w));
  std::string again = read_text(w / "mine/valves.toml");
  again.erase(again.find(format_line), format_line.size());
  EXPECT_EQ(again, valves(w));
}

TEST(Migrate, IntoAnotherFolderTheOldFileStays) {
  const Workspace w;
  write_text(w / "valves.toml", valves(w));
  const Result done = w.sinew({"migrate", "valves.toml", "-o", "new/files"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("is sinew.valves/1 now in new/files/valves.toml"));
  EXPECT_EQ(read_text(w / "valves.toml"), valves(w));
  EXPECT_THAT(read_text(w / "new/files/valves.toml"), HasSubstr(format_line));
  EXPECT_FALSE(fs::exists(w / "valves.toml.bak"));
}

TEST(Migrate, DryItOnlyTells) {
  const Workspace w;
  write_text(w / "valves.toml", valves(w));
  const Result told = w.sinew({"migrate", "valves.toml", "--dry-run"});
  EXPECT_EQ(told.code, 0);
  EXPECT_THAT(told.err, HasSubstr("nothing was written"));
  EXPECT_EQ(read_text(w / "valves.toml"), valves(w));
  EXPECT_FALSE(fs::exists(w / "valves.toml.bak"));
  EXPECT_EQ(w.sinew({"migrate", "valves.toml"}).out, told.out);
}

TEST(Migrate, WhatIsOfTodayIsLeftAlone) {
  const Workspace w;
  const std::string text = read_text(w / "robots/leg/robot.toml");
  const Result done = w.sinew(
      {"migrate", "robots/leg/robot.toml", "robots/leg/gain.dat", "robots/leg/predict.dat"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("robot.toml: sinew.robot/1 is the newest; left alone"),
                              HasSubstr("gain.dat: gains as the thesis wrote them"),
                              HasSubstr("files.valve_timing")));
  EXPECT_EQ(read_text(w / "robots/leg/robot.toml"), text);
  EXPECT_FALSE(fs::exists(w / "robots/leg/robot.toml.bak"));
}

TEST(Migrate, TellsAsJson) {
  const Workspace w;
  write_text(w / "valves.toml", valves(w));
  write_text(w / "newer.toml", "format = \"sinew.valves/7\"\n");
  const Result done =
      w.sinew({"migrate", "valves.toml", "newer.toml", "robots/leg/robot.toml", "--json"});
  EXPECT_EQ(done.code, 1);
  const Json all = Json::parse(done.out);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0]["was"], "");
  EXPECT_EQ(all[0]["is"], "sinew.valves/1");
  EXPECT_EQ(all[0]["changes"].size(), 1U);
  EXPECT_EQ(all[0]["kept"], "valves.toml.bak");
  EXPECT_THAT(all[1]["problem"].get<std::string>(), HasSubstr("sinew.valves/7"));
  EXPECT_TRUE(all[2]["changes"].empty());
}

// Nothing is overwritten: not a file that is there, nor an old one that was kept before.
TEST(Migrate, ANameThatIsTakenIsRefused) {
  const Workspace w;
  write_text(w / "valves.toml", valves(w));
  write_text(w / "valves.toml.bak", "mine\n");
  fs::create_directory(w / "new");
  write_text(w / "new/valves.toml", "mine too\n");
  const Result kept = w.sinew({"migrate", "valves.toml"});
  EXPECT_EQ(kept.code, 1);
  EXPECT_THAT(kept.err, HasSubstr("valves.toml.bak: found a file that is there already"));
  const Result there = w.sinew({"migrate", "valves.toml", "-o", "new"});
  EXPECT_EQ(there.code, 1);
  EXPECT_THAT(there.err, HasSubstr("new/valves.toml: found a file that is there already"));
  fs::create_symlink("nowhere", w / "link.toml.bak");
  write_text(w / "link.toml", valves(w));
  EXPECT_EQ(w.sinew({"migrate", "link.toml"}).code, 1);
  EXPECT_EQ(read_text(w / "valves.toml"), valves(w));
  EXPECT_EQ(read_text(w / "valves.toml.bak"), "mine\n");
  EXPECT_EQ(read_text(w / "new/valves.toml"), "mine too\n");
}

TEST(Migrate, WrongInputsAreRefusedInWords) {
  const Workspace w;
  const auto file = [&](const std::string& name, const std::string& text) {
    write_text(w / name, text);
  };
  file("empty.toml", "");
  file("keys.toml", "x = 1\n");
  file("kind.toml", "format = \"sinew.robt/1\"\n");
  file("other.toml", "format = \"ros/1\"\n");
  file("number.toml", "format = \"sinew.robot/one\"\n");
  file("newer.toml", "format = \"sinew.robot/2\"\n");
  file("twice.toml", "format = \"sinew.robot/1\"\nname = \"a\"\nname = \"b\"\n");
  file("cut.toml", "format = \"sinew.robot/1\"\n[link\n");
  file("binary.toml", std::string("\0\1\2\3\xff", 5));
  file("utf16.toml", std::string("\xff\xfe"
                                 "f\0o\0",
                                 6));
  file("json.toml", "{\"format\": \"sinew.summary/1\"}\n");
  file("gain.dat", "a,b\n");
  file("table.dat", "1;2;3\n");
  file("base.toml", "base = \"none.toml\"\n");
  file("good.toml", valves(w));
  file("folder", "no folder\n");
  fs::create_directory(w / "dir.toml");
  for (const auto& [name, words] :
       {std::pair<const char*, const char*>{
            "none.toml", "none.toml: found no readable file; expected a TOML file"},
        {"dir.toml", "dir.toml: found a folder; expected a TOML file"},
        {"empty.toml", "empty.toml:1:1: format: missing; expected \"sinew.<kind>/1\""},
        {"keys.toml", "keys.toml:1:1: format: missing"},
        {"kind.toml", "found \"sinew.robt/1\"; expected \"sinew.<kind>/1\""},
        {"other.toml", "found \"ros/1\""},
        {"number.toml", "found \"sinew.robot/one\""},
        {"newer.toml", "expected \"sinew.robot/1\" or older; try a newer Sinew"},
        {"twice.toml", "twice.toml:3:"},
        {"cut.toml", "cut.toml:2:"},
        {"binary.toml", "binary.toml:1:"},
        {"utf16.toml", "utf16.toml:1:"},
        {"json.toml", "json.toml:1:"},
        {"gain.dat", "gain.dat:1:1:"},
        {"table.dat", "table.dat:1:1:"},
        {"base.toml", "format: missing"}}) {
    const std::string before = fs::is_regular_file(w / name) ? read_text(w / name) : "";
    const Result r = w.sinew({"migrate", name});
    EXPECT_EQ(r.code, 1) << name;
    EXPECT_THAT(r.err, HasSubstr(words)) << name;
    EXPECT_THAT(r.out, IsEmpty()) << name;
    EXPECT_EQ(fs::is_regular_file(w / name) ? read_text(w / name) : "", before);
  }
  const Result no_folder = w.sinew({"migrate", "good.toml", "-o", "folder"});
  EXPECT_EQ(no_folder.code, 1);
  EXPECT_THAT(no_folder.err, HasSubstr("folder: found a file; expected a folder"));
  EXPECT_EQ(w.sinew({"migrate"}).code, 2);
  EXPECT_EQ(w.sinew({"migrate", "good.toml", "--force"}).code, 2);
  EXPECT_EQ(read_text(w / "good.toml"), valves(w));
}

// A file that is refused does not keep the next from being migrated.
TEST(Migrate, TakesEachFileForItself) {
  const Workspace w;
  write_text(w / "good.toml", valves(w));
  const Result done = w.sinew({"migrate", "none.toml", "good.toml"});
  EXPECT_EQ(done.code, 1);
  EXPECT_THAT(read_text(w / "good.toml"), HasSubstr(format_line));
}

// Files as they once were are read by every later version: tests/old.
TEST(OldFiles, AreReadLeftAloneAndWalkedBy) {
  const Workspace w;
  fs::copy(fs::path(SINEW_SOURCE_DIR) / "tests/old/leg", w / "old", fs::copy_options::recursive);
  Words words{"migrate"}, check{"check"};
  for (const auto& entry : fs::recursive_directory_iterator(w / "old"))
    if (entry.is_regular_file()) words.push_back(entry.path()), check.push_back(entry.path());
  ASSERT_EQ(words.size(), 8U);
  const Result left = w.sinew(words);
  EXPECT_EQ(left.code, 0) << left.err;
  EXPECT_EQ(std::count(left.out.begin(), left.out.end(), '\n'), 7);
  EXPECT_THAT(left.out, ::testing::Not(HasSubstr("becomes")));
  EXPECT_EQ(w.sinew(check).code, 0);
  const Result walk =
      w.sinew({"run", "old/experiments/walk-test-1.toml", "-o", "walk", "--no-report", "--quiet"});
  EXPECT_EQ(walk.code, 0) << walk.err;
  const Json summary = Json::parse(read_text(w / "walk/summary.json"));
  EXPECT_NEAR(summary["trolley"]["distance_m"].get<double>(), 56.4 * 0.0254, 0.1 * 0.0254);
}

}  // namespace
}  // namespace sinew::test::migrate_test
