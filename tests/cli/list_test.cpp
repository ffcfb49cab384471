// `sinew list`: what comes with Sinew, what stands in a folder, and what is none of either.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::list_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

// Those of the folder, as "kind path: title".
std::vector<std::string> in_folder(const Workspace& w, const std::string& kind = "") {
  Words words{"list", "--json"};
  if (!kind.empty()) words.push_back(kind);
  const Result r = w.sinew(words);
  EXPECT_EQ(r.code, 0) << r.err;
  const Json all = Json::parse(r.out);
  std::vector<std::string> out;
  for (const Json& one : all["files"])
    if (!one["shipped"])
      out.push_back(one["kind"].get<std::string>() + " " + one["path"].get<std::string>() + ": " +
                    (one.contains("problem") ? one["problem"] : one["title"]).get<std::string>());
  return out;
}

void clear(const Workspace& w) {
  for (const char* folder : {"robots", "experiments"}) fs::remove_all(w / folder);
}

TEST(List, EveryShippedFileHasATitleAndCanBeChecked) {
  const Workspace w;
  const Result r = w.sinew({"list", "--json"});
  ASSERT_EQ(r.code, 0) << r.err;
  const Json all = Json::parse(r.out);
  EXPECT_EQ(all["format"], "sinew.list/1");
  EXPECT_EQ(all["cut"], false);
  std::map<std::string, int> count;
  Words check{"check"};
  for (const Json& one : all["files"]) {
    if (!one["shipped"]) continue;
    ++count[one["kind"]];
    EXPECT_FALSE(one["title"].get<std::string>().empty()) << one;
    EXPECT_FALSE(one.contains("problem")) << one;
    EXPECT_TRUE(fs::exists(one["path"].get<std::string>())) << one;
    if (one["kind"] == "robots") check.push_back(one["path"]);
  }
  EXPECT_GE(count["robots"], 10);
  EXPECT_GE(count["experiments"], 30);
  EXPECT_GE(count["rigs"], 15);
  EXPECT_GE(count["studies"], 1);
  EXPECT_EQ(w.sinew(check).code, 0);
}

TEST(List, TellsPathAndTitleOfOneKind) {
  const Workspace w;
  const Result r = w.sinew({"list", "robots"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out,
              AllOf(HasSubstr("robots, with Sinew:\n"), HasSubstr("robots, in this folder:\n"),
                    HasSubstr("  robots/one-joint/robot.toml"), HasSubstr("hanging lever"),
                    Not(HasSubstr("experiments"))));
  EXPECT_THAT(r.err, IsEmpty());
}

TEST(List, TitleIsTheFilesOwnThenItsCommentThenItsName) {
  const Workspace w;
  clear(w);
  write_text(w / "a.toml", "# a.toml – not this\nformat = \"sinew.experiment/1\"\ntitle = \"A\"\n");
  write_text(w / "b.toml",
             "# b.toml – an\n# arm. It moves.\nformat = \"sinew.robot/1\"\nname = \"b\"\n");
  write_text(w / "c.toml", "format = \"sinew.robot/1\"\nname = \"see\"\n");
  write_text(w / "d.toml", "format = \"sinew.rig/1\"\n");
  write_text(w / "e.toml", "  format=\"sinew.tuning/1\"\ntitle = \"E\"\n");
  write_text(w / "f.toml", "# crlf: a robot.\r\nformat = \"sinew.robot/1\"\r\n");
  EXPECT_THAT(in_folder(w),
              ::testing::ElementsAre("robots b.toml: an arm", "robots c.toml: see",
                                     "robots f.toml: crlf: a robot", "experiments a.toml: A",
                                     "rigs d.toml: ", "studies e.toml: E"));
  EXPECT_THAT(in_folder(w, "studies"), ::testing::ElementsAre("studies e.toml: E"));
}

TEST(List, RunsBuildsHiddenFoldersAndOtherFilesAreNot) {
  const Workspace w;
  clear(w);
  const std::string robot = "format = \"sinew.robot/1\"\nname = \"x\"\n";
  for (const char* folder : {"runs/x/1", ".hidden", "build", "node_modules/x", "a/b/c"})
    fs::create_directories(w / folder);
  write_text(w / "runs/x/1/resolved.toml", robot);
  write_text(w / ".hidden/r.toml", robot);
  write_text(w / "build/CMakeCache.txt", "");
  write_text(w / "build/r.toml", robot);
  write_text(w / "node_modules/x/r.toml", robot);
  write_text(w / "a/b/c/r.toml", robot);
  write_text(w / "r.txt", robot);
  write_text(w / "other.toml", "format = \"ros/1\"\n");
  write_text(w / "valves.toml", "format = \"sinew.valves/1\"\n");
  write_text(w / "late.toml", "[table]\nformat = \"sinew.robot/1\"\n");
  write_text(w / "empty.toml", "");
  write_text(w / "large.toml", robot + std::string(1'100'000, '\n'));
  fs::create_directory(w / "folder.toml");
  fs::create_symlink("nowhere", w / "link.toml");
  fs::create_directory_symlink(".", w / "loop");
  EXPECT_THAT(in_folder(w), ::testing::ElementsAre("robots a/b/c/r.toml: x"));
}

TEST(List, AFileThatCannotBeReadIsNamedWithoutATitle) {
  const Workspace w;
  clear(w);
  write_text(w / "cut.toml", "format = \"sinew.robot/1\"\n[link\n");
  write_text(w / "binary.toml", std::string("format = \"sinew.rig/1\"\n\0\xff", 25));
  for (const std::string& line : in_folder(w)) EXPECT_THAT(line, HasSubstr("sinew check says why"));
  EXPECT_EQ(in_folder(w).size(), 2U);
}

TEST(List, WrongWordsAreWrongUsage) {
  const Workspace w;
  for (const Words& words : {Words{"list", "robot"}, Words{"list", "Robots"}, Words{"list", ""},
                             Words{"list", "robots", "rigs"}, Words{"list", "--jso"}}) {
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, 2) << words.back();
    EXPECT_THAT(r.out, IsEmpty());
    EXPECT_THAT(r.err, Not(IsEmpty()));
  }
}

TEST(List, AWrongPlaceOfTheFilesOfSinewIsSaid) {
  const Workspace w;
  setenv("SINEW_SHARE", (w / "robots").c_str(), 1);
  const Result listed = w.sinew({"list", "robots"});
  const Result made = w.sinew({"new", "robot", "arm"});
  setenv("SINEW_SHARE", SINEW_SOURCE_DIR, 1);
  const Result good = w.sinew({"new", "robot", "arm"});
  unsetenv("SINEW_SHARE");
  EXPECT_EQ(listed.code, 0);
  EXPECT_THAT(listed.err, HasSubstr("SINEW_SHARE"));
  EXPECT_THAT(listed.out, HasSubstr("robots/one-joint/robot.toml"));  // in this folder
  EXPECT_EQ(made.code, 1);
  EXPECT_THAT(made.err, HasSubstr("SINEW_SHARE: found no robots/"));
  EXPECT_EQ(good.code, 0) << good.err;
}

}  // namespace
}  // namespace sinew::test::list_test
