// A line that the program does not understand: what it says, exit code 2, and nothing done. And the
// help, which says what would have been right.
#include <gmock/gmock.h>

#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test::usage_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

Words words_of(const std::string& text) {
  std::istringstream in(text);
  Words out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

TEST(Usage, SaysWhatWasFoundAndWhatIsMeant) {
  const Workspace w;
  struct Case {
    const char* line;
    std::vector<const char*> says;
  };
  const Case cases[] = {
      {"rnu x", {"rnu: found no such command of sinew", "try run", "sinew help tells"}},
      {"identify statc", {"statc: found no such command of sinew identify", "try static"}},
      {"identify", {"sinew identify: found no command; expected geometry"}},
      {"run --ouptut x", {"--ouptut: found no such option of sinew run", "try --output"}},
      {"run x --out=y", {"--out: found no such option", "try --output"}},
      {"run x -json", {"-json: found no such option of sinew run"}},
      {"compare a b --untis si", {"--untis: found", "try --units"}},
      {"compare a b --align-with x", {"--align-with: found", "try --align"}},
      {"run x --metric", {"--metric: found no such option of sinew run, it is one of sinew new"}},
      {"check a b=c", {}},
      {"show", {"FILE: missing; expected experiment, rig, robot"}},
      {"new", {"KIND: missing; expected robot, actuator", "NAME: missing; expected its name"}},
      {"new robto x", {"KIND: found \"robto\"; expected robot, actuator", "try \"robot\""}},
      {"list exmaples", {"KIND: found \"exmaples\"", "try \"examples\""}},
      {"keys --kind robt", {"--kind: found \"robt\"", "try \"robot\""}},
      {"keys --schema any", {"--schema: found \"any\"; expected robot"}},
      {"keys --schema rig --json", {"--json: found --schema beside it; expected one of the two"}},
      {"completion bash zsh", {"zsh: found a word too many", "expected sinew completion SHELL"}},
      {"list robots json", {"json: found a word too many", "try --json"}},
      {"sweep x --points zz", {"--points: found \"zz\"; expected a whole number, 1 to 1000000"}},
      {"sweep x --points 0", {"--points: found \"0\"; expected a whole number, 1 to"}},
      {"view --port 1.5", {"--port: found \"1.5\"; expected a whole number, 0 to 65535"}},
      {"compare a", {"RUN: found 1; expected 2 to 8"}},
      {"run x --set", {"--set: found nothing behind it"}},
      {"kinematics x", {"sinew kinematics: found none of them; expected just one of --foot or"}},
      {"kinematics x --foot a --angles b", {"found --foot with --angles; expected just one of"}},
      {"export x", {"expected just one of"}},
      {"help rnu", {"sinew help: found \"rnu\"; expected a command, or one of units", "try run"}},
      {"help identify statc", {"found \"statc\"; expected geometry", "try static"}},
  };
  for (const Case& c : cases) {
    if (c.says.empty()) continue;
    const Result r = w.sinew(words_of(c.line));
    EXPECT_EQ(r.code, 2) << c.line << "\n" << r.err;
    for (const char* words : c.says) EXPECT_THAT(r.err, HasSubstr(words)) << c.line;
    EXPECT_THAT(r.out, IsEmpty()) << c.line;
    for (const char* leak : {"not expected", "is required", "not in {", "TEXT", "Run with", "got "})
      EXPECT_THAT(r.err, Not(HasSubstr(leak))) << c.line;
  }
  EXPECT_THAT(names_in(w.path()), ::testing::ElementsAre("experiments", "robots"));
}

TEST(Usage, HelpIsFoundInEachWayOfAsking) {
  const Workspace w;
  const std::string asked = w.sinew({"help", "identify", "static"}).out;
  EXPECT_THAT(asked, AllOf(HasSubstr("Usage: sinew identify static DATA"), HasSubstr("--model"),
                           HasSubstr("Example:\n  sinew identify static")));
  EXPECT_EQ(w.sinew({"identify", "static", "--help"}).out, asked);
  EXPECT_EQ(w.sinew({"identify", "static", "-h"}).out, asked);
  EXPECT_EQ(w.sinew({"identify", "static", "help"}).out, asked);
  EXPECT_EQ(w.sinew({"help"}).out, w.sinew({"--help"}).out);
}

// Each command stands once among those of a task, each of its help's lines is short enough to be
// read, and each ends with an example of itself.
TEST(Usage, EveryCommandHasAHelpWithAnExample) {
  const Workspace w;
  const Result top = w.sinew({"help"});
  EXPECT_EQ(top.code, 0);
  EXPECT_THAT(top.out, Not(HasSubstr("Do more")));
  const std::vector<std::string> commands = lines_of(w.sinew({"help", "commands"}).out);
  EXPECT_GT(commands.size(), 35U);
  for (const std::string& command : commands) {
    const std::string text = [&] {
      Words words = words_of("help " + command);
      const Result r = w.sinew(words);
      EXPECT_EQ(r.code, 0) << command;
      return r.out;
    }();
    EXPECT_THAT(text, HasSubstr("Usage: sinew " + command)) << command;
    EXPECT_THAT(text, HasSubstr("Example:\n  ")) << command;
    for (const char* leak : {"TEXT", "REQUIRED", " INT", "FLOAT", "Excludes", "Needs"})
      EXPECT_THAT(text, Not(HasSubstr(leak))) << command;
    if (command.find(' ') == command.npos) {
      EXPECT_THAT(top.out, HasSubstr(command == "help" ? "help COMMAND" : "\n  " + command + " "));
    }
    for (const std::string& line : lines_of(text)) {
      if (line.find("sinew ") != line.npos) continue;  // an example may be as long as it is
      EXPECT_LE(line.size(), 110U) << command << ": " << line;
    }
  }
}

// A value is as much of the line as its option: scripts need no second code for it.
TEST(Usage, AWrongValueIsWrongUsageAsAWrongOptionIs) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", "experiments/one-joint.toml", "-o", "a", "--no-report"}).code, 0);
  for (const Words& words :
       {Words{"figures", "a", "--width", "9 cats", "-o", "figs"},
        Words{"figures", "a", "--widht", "9 cm", "-o", "figs"},
        Words{"compare", "a", "a", "--align", "foo"},
        Words{"run", "experiments/one-joint.toml", "--set", "joint.lever.damping=3 cats"},
        Words{"import", "a/log.mcap", "--experiment", "experiments/one-joint.toml", "--scale",
              "x=cats"}}) {
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, 2) << words[0] << " " << words.back() << r.err;
    EXPECT_THAT(r.err, HasSubstr("--")) << words[0];
  }
  EXPECT_EQ(w.sinew({"figures", "no-such-run", "-o", "figs"}).code, 1) << "a file's fault";
}

TEST(Usage, TopicsSayWhatAllCommandsShare) {
  const Workspace w;
  const auto page = [&](const char* word) {
    const Result r = w.sinew({"help", word});
    EXPECT_EQ(r.code, 0) << word << r.err;
    return r.out;
  };
  EXPECT_THAT(page("units"), AllOf(HasSubstr("kPa"), HasSubstr("bar gauge"), HasSubstr("lbf")));
  EXPECT_THAT(page("files"), AllOf(HasSubstr("experiment"), HasSubstr("sinew check")));
  EXPECT_THAT(page("channels"), HasSubstr("/joint/NAME/angle"));
  EXPECT_THAT(page("next"), HasSubstr("sinew identify static"));
  EXPECT_THAT(page("keys"), HasSubstr("joint.hip.damping"));
}

}  // namespace
}  // namespace sinew::test::usage_test
