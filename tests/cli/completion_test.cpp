// `sinew completion`, asked by bash itself: what a line may go on with.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/cli/program.h"

namespace sinew::test::completion_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// What bash offers for the last of the words.
std::vector<std::string> offered(const Workspace& w, const Words& words) {
  std::string line;
  for (const std::string& word : words) line += " '" + word + "'";
  write_text(w / "ask.sh",
             "source <(\"$1\" completion bash)\nCOMP_WORDS=(\"$1\"" + line +
                 ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_sinew \"$1\"\n"
                 "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"\nexit 0\n");
  const std::string command = "cd '" + w.path().string() + "' && bash --norc --noprofile ask.sh '" +
                              SINEW_PROGRAM + "' >asked 2>errors";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(read_text(w / "errors"), IsEmpty());
  std::istringstream in(read_text(w / "asked"));
  std::vector<std::string> out;
  for (std::string text; std::getline(in, text);) out.push_back(text);
  return out;
}

TEST(Completion, OffersCommandsAndThoseBelowThem) {
  const Workspace w;
  EXPECT_THAT(offered(w, {"ru"}), ElementsAre("run"));
  const auto all = offered(w, {""});
  for (const char* name : {"run", "check", "list", "new", "identify", "completion"})
    EXPECT_THAT(all, Contains(name));
  EXPECT_THAT(offered(w, {"identify", "stat"}), ElementsAre("static"));
  EXPECT_THAT(offered(w, {"fmu", ""}), Contains("export"));
  EXPECT_THAT(offered(w, {"nothing-like-it"}), IsEmpty());
}

// Every option that a command's help names is offered there.
TEST(Completion, OffersTheOptionsOfTheHelp) {
  const Workspace w;
  for (const Words& command : {Words{"run"}, Words{"sweep"}, Words{"identify", "static"}}) {
    Words line = command, help = command;
    line.emplace_back("--");
    help.emplace_back("--help");
    const auto options = offered(w, line);
    std::istringstream in(w.sinew(help).out);
    int count = 0;
    for (std::string text; std::getline(in, text);) {
      if (!text.starts_with("  -")) continue;
      const std::size_t at = text.find("--");
      if (at == text.npos) continue;
      EXPECT_THAT(options, Contains(text.substr(at, text.find_first_of(" {", at) - at)));
      ++count;
    }
    EXPECT_GT(count, 5);
  }
}

TEST(Completion, OffersTheWordsThatAnOptionTakes) {
  const Workspace w;
  EXPECT_THAT(offered(w, {"doctor", "--for", "s"}), ElementsAre("simulated", "serial"));
  EXPECT_THAT(offered(w, {"list", "r"}), ElementsAre("robots", "rigs"));
  EXPECT_THAT(offered(w, {"completion", ""}), ElementsAre("bash", "zsh", "fish"));
  EXPECT_THAT(offered(w, {"run", "--output", ""}), IsEmpty());  // bash's own: files
}

TEST(Completion, OffersKeysOfTheFileInTheLine) {
  const Workspace w;
  const std::string file = "experiments/one-joint.toml";
  EXPECT_THAT(offered(w, {"run", file, "--set", "joint.lever.damp"}),
              ElementsAre("joint.lever.damping=", "joint.lever.damper="));
  EXPECT_THAT(offered(w, {"sweep", file, "--set", "seed=3", "--vary", "sequence.r"}),
              ElementsAre("sequence.repeat="));
  EXPECT_GT(offered(w, {"run", file, "--set", ""}).size(), 100U);
  EXPECT_THAT(offered(w, {"run", file, "--set", "joint.hip"}), IsEmpty());
  EXPECT_THAT(offered(w, {"show", file, "joint.lever.damp"}),
              ElementsAre("joint.lever.damping", "joint.lever.damper"));
  EXPECT_THAT(offered(w, {"show", "robots"}), IsEmpty());  // bash's own: files
}

TEST(Completion, OffersTheWordsOfAKeyBehindIt) {
  const Workspace w;
  const std::string file = "experiments/one-joint.toml";
  EXPECT_THAT(offered(w, {"run", file, "--set", "air.supply.kind", "=", "t"}), ElementsAre("tank"));
  EXPECT_THAT(offered(w, {"run", file, "--set", "air.supply.kind", "="}), Contains("tank"));
  EXPECT_THAT(offered(w, {"run", file, "--set", "joint.lever.damping", "=", ""}), IsEmpty());
  EXPECT_THAT(offered(w, {"run", file, "--output", "x", "=", ""}), IsEmpty());
}

// Sets of units may be followed by more, which no shell can list.
TEST(Completion, OffersTheSetsOfUnits) {
  const Workspace w;
  EXPECT_THAT(offered(w, {"run", "--units", ""}), ElementsAre("si", "thesis", "metric"));
  EXPECT_THAT(offered(w, {"identify", "static", "--units", "t"}), ElementsAre("thesis"));
}

TEST(Completion, FishOffersTheSame) {
  if (std::system("command -v fish >/dev/null") != 0) GTEST_SKIP() << "fish is not installed";
  const Workspace w;
  write_text(w / "script", w.sinew({"completion", "fish"}).out);
  const auto offered_by_fish = [&](const std::string& line) {
    write_text(w / "ask", "set -x PATH " + fs::path(SINEW_PROGRAM).parent_path().string() +
                              " $PATH; source script; complete -C '" + line + "'\n");
    const std::string where = "cd '" + w.path().string() + "' && fish ask >out 2>&1";
    EXPECT_EQ(std::system(where.c_str()), 0);
    return read_text(w / "out");
  };
  EXPECT_THAT(offered_by_fish("sinew run --units t"), StartsWith("thesis"));
  EXPECT_THAT(offered_by_fish("sinew run experiments/one-joint.toml --set air.supply.kind=t"),
              StartsWith("air.supply.kind=tank"));
  EXPECT_THAT(offered_by_fish("sinew run experiments/one-joint.toml --set joint.lever.dampi"),
              StartsWith("joint.lever.damping="));
}

// Nothing of a file is run, whatever its keys are; a file that is wrong has none.
TEST(Completion, WrongFilesOfferNothingAndDoNothing) {
  const Workspace w;
  const std::string text = read_text(w / "robots/one-joint/robot.toml");
  write_text(w / "robots/one-joint/bad.toml",
             text + "\n[sensor.\"$(touch done)\"]\nkind = \"angle\"\n");
  write_text(w / "cut.toml", "format = \"sinew.robot/1\"\n[link\n");
  write_text(w / "empty.toml", "");
  for (const char* file : {"cut.toml", "empty.toml", "none.toml", "robots", "robots/leg/gain.dat"})
    EXPECT_THAT(offered(w, {"run", file, "--set", "j"}), IsEmpty()) << file;
  for (const std::string& key : offered(w, {"run", "robots/one-joint/bad.toml", "--set", ""}))
    EXPECT_THAT(key, Not(HasSubstr("$")));
  EXPECT_FALSE(fs::exists(w / "done"));
}

TEST(Completion, OtherShellsReadTheirScripts) {
  const Workspace w;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Result r = w.sinew({"completion", shell});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("identify static"));
    for (const char* mark : {"@rows@", "@chosen@", "@functions@", "@keyed@", "@all@"})
      EXPECT_THAT(r.out, Not(HasSubstr(mark)));
    write_text(w / "script", r.out);
    const std::string installed = "command -v " + std::string(shell) + " >/dev/null";
    if (std::system(installed.c_str()) != 0) continue;
    const std::string command = std::string(shell) + " -n '" + (w / "script").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << shell;
  }
}

TEST(Completion, AShellThatThereIsNotIsWrongUsage) {
  const Workspace w;
  for (const Words& words :
       {Words{"completion"}, Words{"completion", "csh"}, Words{"completion", "bash", "zsh"}}) {
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, 2);
    EXPECT_THAT(r.out, IsEmpty());
  }
}

}  // namespace
}  // namespace sinew::test::completion_test
