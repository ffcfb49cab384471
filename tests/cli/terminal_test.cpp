// A terminal gets color and lines of its width, a file neither.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/places.h"

namespace sinew::test::terminal_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Returns the output of `sinew WORDS` on a terminal of so many columns.
std::string on_terminal(const Workspace& w, const Words& words, unsigned short columns,
                        const char* no_color, const char* term = "xterm") {
  winsize size{.ws_row = 50, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    std::vector<char*> arguments{const_cast<char*>("sinew")};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    setenv("TERM", term, 1);
    setenv("NO_COLOR", no_color, 1);
    if (chdir(w.path().c_str()) == 0) execv(sinew::test::program().c_str(), arguments.data());
    _exit(126);
  }
  std::string out;
  char buffer[4096];
  for (ssize_t n; (n = read(terminal, buffer, sizeof buffer)) > 0;)
    out.append(buffer, static_cast<std::size_t>(n));
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0) << out;
  return out;
}

const Words stand = {"run", "experiments/rig/trapped-60-6.toml", "-o", "ran", "--force", "--quiet"};

TEST(Terminal, VerdictsAreColored) {
  const Workspace w;
  EXPECT_THAT(on_terminal(w, stand, 200, ""), HasSubstr("\033[32magrees\033[0m"));
  EXPECT_THAT(on_terminal(w, stand, 200, "1"), Not(HasSubstr("\033")));
  EXPECT_THAT(on_terminal(w, stand, 200, "", "dumb"), Not(HasSubstr("\033")));
  EXPECT_THAT(w.sinew(stand).out, Not(HasSubstr("\033")));
}

// Every word that is written to a file is also shown on the terminal, in lines that fit.
TEST(Terminal, TablesKeepWithinTheWindow) {
  const Workspace w;
  const auto words = [](const std::string& text) {
    std::istringstream in(text);
    std::multiset<std::string> out;
    for (std::string word; in >> word;) {
      if (word.ends_with(';')) word.pop_back();  // of a class that is printed before its source
      out.insert(word);
    }
    return out;
  };
  const std::string whole = w.sinew(stand).out;
  for (const unsigned short columns : {220, 140, 110}) {
    const std::string seen = on_terminal(w, stand, columns, "1");
    EXPECT_EQ(words(seen), words(whole)) << columns;
    std::istringstream lines(seen);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), columns + std::size_t{1}) << line;  // \r
  }
}

// An example that is folded for the terminal is the same command as in a file.
TEST(Terminal, ExamplesKeepWithinTheWindow) {
  const Workspace w;
  const auto example = [](std::string text) {
    std::erase(text, '\r');
    for (std::size_t at; (at = text.find(" \\\n   ")) != text.npos;) text.erase(at, 6);
    return text.substr(text.find("Example:"));
  };
  for (const Words& words : {Words{"sweep", "--help"}, Words{"identify", "static", "--help"},
                             Words{"kinematics", "--help"}, Words{"figures", "--help"}}) {
    const std::string seen = on_terminal(w, words, 80, "1");
    EXPECT_EQ(example(seen), example(w.sinew(words).out));
    std::istringstream lines(seen.substr(seen.find("Example:")));
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), std::size_t{81}) << line;  // \r
  }
}

TEST(Terminal, TheBarIsGoneAtTheEnd) {
  const Workspace w;
  const std::string seen =
      on_terminal(w, {"run", "experiments/one-joint.toml", "--pace", "20", "-o", "ran"}, 100, "1");
  EXPECT_THAT(seen, HasSubstr("###"));
  EXPECT_THAT(seen.substr(seen.rfind('#')), HasSubstr("\033[K"));
}

}  // namespace
}  // namespace sinew::test::terminal_test
