// `sinew view --live --place serial:…`: a page sees the machine, and its button stops it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include "tests/cli/program.h"
#include "tests/cli/wire.h"
#include "tests/places.h"
#include "tests/serial/board_on_pty.h"

namespace sinew::test {
namespace {

using control::BoardState;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

experiment::Experiment loaded() {
  return experiment::load(sinew::test::source_dir() + "/experiments/walk-test-1.toml", {});
}

Words view_at(const BoardOnPty& board) {
  return {"view",
          "--live",
          "experiments/walk-test-1.toml",
          "--place",
          "serial:" + board.device(),
          "--no-open",
          "-o",
          "ran",
          "--no-report"};
}

// A live view in progress: its address, and the program, which ends with this.
struct Viewed {
  explicit Viewed(BoardOnPty& board) : host(w.start(view_at(board))) {
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::running; }, 20));
    std::this_thread::sleep_for(seconds(1));
    url = read_text(w / "out");
    if (!url.empty()) url.pop_back();
  }
  ~Viewed() {
    if (host > 0) ::kill(host, SIGKILL);
    (void)wait();
  }
  int wait() {
    int status = 0;
    if (host > 0) ::waitpid(host, &status, 0);
    host = -1;
    return status;
  }

  Workspace w;
  pid_t host;
  std::string url;
};

class MachineInAPage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without its page";
  }
};

TEST_F(MachineInAPage, IsSeenAndStoppedByItsButton) {
  BoardOnPty board(loaded());
  Viewed view(board);
  ASSERT_THAT(view.url, HasSubstr("http://"));
  Wire page(port_of(view.url));
  page.send(upgrade_to(port_of(view.url), path_of(view.url) + "live"));
  const std::string told = page.hear("\"piece\"", seconds(5));
  EXPECT_THAT(told, HasSubstr("\"machine\":true"));
  EXPECT_THAT(told, HasSubstr("\"piece\"")) << "samples, though no truth is known";

  page.send(masked(R"({"do":"pause"})"));
  EXPECT_THAT(page.hear("expected stop", seconds(5)), HasSubstr("the machine keeps its own time"));
  EXPECT_EQ(board.state(), BoardState::running);
  page.send(masked(R"({"do":"stop"})"));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5));
}

// A simulation would run to its end at full speed.
TEST_F(MachineInAPage, IsVentedBySignals) {
  for (const int signal : {SIGINT, SIGHUP, SIGTSTP}) {
    BoardOnPty board(loaded());
    Viewed view(board);
    for (int i = 0; i < 3; ++i) {
      ::kill(view.host, signal);
      std::this_thread::sleep_for(milliseconds(10));
    }
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5)) << signal;
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5)) << signal;
    const int status = view.wait();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << "interrupted, and said so";
  }
}

TEST_F(MachineInAPage, KeepsItsOwnTime) {
  BoardOnPty board(loaded());
  const Workspace w;
  for (const char* word : {"--paused", "--pace=2"}) {
    Words words = view_at(board);
    words.push_back(word);
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_THAT(r.err, HasSubstr("the machine keeps its own time"));
  }
  EXPECT_FALSE(std::filesystem::exists(w / "ran"));
}

}  // namespace
}  // namespace sinew::test
