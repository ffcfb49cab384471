// `sinew run --port serial:…` with a board at the other end, and the state of the board after its
// host is asked to stop, dies, or loses its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "sinew/run/bring_up/bring_up.h"
#include "tests/cli/program.h"
#include "tests/places.h"
#include "tests/serial/board_on_pty.h"

namespace sinew::test {
namespace {

using control::BoardFault;
using control::BoardState;
using ::testing::HasSubstr;

constexpr std::uint32_t inlets = 0x55555555;

experiment::Experiment loaded(const std::string& name) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", {});
}

Words run_at(const BoardOnPty& board, const std::string& name) {
  return {"run",        "experiments/" + name + ".toml",
          "--port",     "serial:" + board.device(),
          "-o",         "ran",
          "--no-report"};
}

// Hold is none: on a busy computer a host may be late.
bool has_ended(const BoardOnPty& board) {
  const BoardState state = board.state();
  return state != BoardState::running && state != BoardState::hold;
}

// Standard input of the programs started during its life: these answers, then no end of file.
class AnswersThatCome {
 public:
  explicit AnswersThatCome(const std::string& answers) : before_(::dup(0)) {
    if (::pipe(ends_) != 0) throw std::runtime_error("no pipe");
    EXPECT_EQ(::write(ends_[1], answers.data(), answers.size()), ssize_t(answers.size()));
    ::dup2(ends_[0], 0);
  }
  ~AnswersThatCome() {
    ::dup2(before_, 0);
    for (const int end : {ends_[0], ends_[1], before_}) ::close(end);
  }
  AnswersThatCome(const AnswersThatCome&) = delete;
  AnswersThatCome& operator=(const AnswersThatCome&) = delete;

 private:
  int before_, ends_[2];
};

// A run in progress, a second after its start.
struct Running {
  explicit Running(BoardOnPty& b, const std::string& name = "walk-test-1")
      : board(b), host(w.start(run_at(b, name))) {
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::running; }, 20));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::running; }, 1));
  }
  ~Running() {
    if (host > 0) ::kill(host, SIGKILL);
    wait();
  }
  // The program's exit code.
  int wait() {
    int status = 0;
    if (host > 0) ::waitpid(host, &status, 0);
    host = -1;
    return status;
  }

  Workspace w;
  BoardOnPty& board;
  pid_t host;
};

TEST(Serial, AnExperimentRunsToItsEndAndTheBoardRests) {
  const Workspace w;
  BoardOnPty board(loaded("kick"));
  const Result r = w.sinew(run_at(board, "kick"));
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("board: pty"));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 3));
  EXPECT_EQ(board.open(), 0u);
  EXPECT_THAT(read_text(w / "ran/summary.json"), HasSubstr("\"board\": \"pty"));
  EXPECT_EQ(read_text(w / "ran/summary.json").find("_true_"), std::string::npos)
      << "what only a simulation knows is absent";
}

TEST(Serial, ATestStandRunsAsARobotDoes) {
  const std::vector<std::string> sets = {"log.period=400 ms", "duration=2 s"};
  const Workspace w;
  BoardOnPty board(
      experiment::load(sinew::test::source_dir() + "/experiments/rig/feedback.toml", sets));
  Words words = run_at(board, "rig/feedback");
  for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
  const Result r = w.sinew(words);
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 3));
  EXPECT_EQ(board.open(), 0u);
  EXPECT_THAT(read_text(w / "ran/measured.csv"), HasSubstr("\n1.6,")) << "what the board measured";
}

TEST(Serial, ABoardWhoseWatchdogHasTrippedRunsOnlyAfterConfirmation) {
  const Workspace w;
  BoardOnPty board(loaded("kick"),
                   {.board = {'p', 't', 'y'}, .reset_by_watchdog = true, .active_low = true});
  const Result refused = w.sinew(run_at(board, "kick"));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("the board is in dump: its watchdog has reset it"));
  EXPECT_EQ(board.state(), BoardState::dump);
  Words again = run_at(board, "kick");
  again.push_back("--clear-fault");
  const Result ran = w.sinew(again);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("the board was in dump: its watchdog has reset it"));
}

TEST(Serial, ABoardWithTheOtherLevelIsRefusedBeforeItIsArmed) {
  const Workspace w;
  BoardOnPty board(loaded("kick"), {.board = {'p', 't', 'y'}});
  const Result refused = w.sinew(run_at(board, "kick"));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err,
              HasSubstr("wiring.polarity: found \"low opens\"; expected \"high opens\""));
  EXPECT_EQ(board.state(), BoardState::fault);
  Words other = run_at(board, "kick");
  other.insert(other.end(), {"--set", "wiring.polarity=high opens"});
  EXPECT_EQ(w.sinew(other).code, 0);
}

TEST(Serial, ARequestedStopVents) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    BoardOnPty board(loaded("walk-test-1"));
    Running run(board);
    ::kill(run.host, signal);
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5)) << signal;
    EXPECT_EQ(board.open() & inlets, 0u);
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5)) << signal;
    EXPECT_EQ(board.fault(), BoardFault::requested);
    const int status = run.wait();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << "interrupted, and said so";
  }
}

// A window that closes sends several signals, and a user may press Ctrl-C twice; Ctrl-Z would leave
// the machine as it is.
TEST(Serial, SeveralSignalsVentAsOneDoes) {
  for (const int signal : {SIGINT, SIGHUP, SIGQUIT, SIGTSTP}) {
    BoardOnPty board(loaded("walk-test-1"));
    Running run(board);
    for (int i = 0; i < 3; ++i) {
      ::kill(run.host, signal);
      std::this_thread::sleep_for(std::chrono::milliseconds(20 * i));
    }
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5)) << signal;
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5)) << signal;
    EXPECT_EQ(board.fault(), BoardFault::requested) << "the host was there to ask";
    const int status = run.wait();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << signal;
  }
}

// A device that is not a board and sends all the time: a GPS receiver, a logger.
TEST(Serial, ASignalEndsTheStartUpAtALineThatIsNeverSilent) {
  const Workspace w;
  const int far = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_TRUE(far >= 0 && ::grantpt(far) == 0 && ::unlockpt(far) == 0);
  const std::string device = ::ptsname(far);
  const int keeper = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios raw{};
  ::tcgetattr(keeper, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(keeper, TCSANOW, &raw);
  ::fcntl(far, F_SETFL, O_NONBLOCK);
  std::atomic<bool> ends = false;
  std::thread noise([&] {
    for (std::mt19937 random(39); !ends;
         std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
      std::array<char, 10> bytes;
      for (char& byte : bytes) byte = static_cast<char>(random());
      (void)!::write(far, bytes.data(), bytes.size());
      (void)!::read(far, bytes.data(), bytes.size());
    }
  });
  const Words words{"run", "experiments/kick.toml", "--port", "serial:" + device, "-o", "ran"};
  const Result left_alone = w.sinew(words);
  EXPECT_EQ(left_alone.code, 1);
  EXPECT_THAT(left_alone.err, HasSubstr("are no frames of ours"));
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t host = w.start(words);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    const auto asked = std::chrono::steady_clock::now();
    ::kill(host, signal);
    int status = 0;
    ::waitpid(host, &status, 0);
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::milliseconds(500));
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << signal;
  }
  ends = true;
  noise.join();
  ::close(keeper);
  ::close(far);
}

TEST(Serial, AStopInABringUpVents) {
  const Workspace w;
  BoardOnPty board(run::bench_of((w / "robots/leg/robot.toml").string(), w / "bench", {}));
  const AnswersThatCome yes("y\ny\ny\n");
  const pid_t host = w.start(
      {"bring-up", "robots/leg/robot.toml", "--port", "serial:" + board.device(), "-o", "day"});
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::running; }, 20));
  ::kill(host, SIGINT);
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5));
  int status = 0;
  ::waitpid(host, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  EXPECT_THAT(read_text(w / "out"), HasSubstr("Stopped: the muscles were vented"));
}

TEST(Serial, AnInteractiveBringUpEndsWithCtrlC) {
  BoardOnPty board(loaded("walk-test-1"));
  const Workspace w;
  const AnswersThatCome none("");
  const pid_t host = w.start(
      {"bring-up", "robots/leg/robot.toml", "--port", "serial:" + board.device(), "-o", "day"});
  for (int i = 0; i < 500 && read_text(w / "out").find("[y/n]") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ::kill(host, SIGINT);
  int status = 0;
  ::waitpid(host, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  EXPECT_THAT(read_text(w / "out"), HasSubstr("Stopped. The same command continues from here."));
}

TEST(Serial, AHostThatDiesIsHeldThenVented) {
  BoardOnPty board(loaded("walk-test-1"));
  Running run(board);
  ::kill(run.host, SIGKILL);
  run.wait();
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::hold; }, 0.5));
  EXPECT_EQ(board.open(), 0u);
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 2));
  EXPECT_EQ(board.open() & inlets, 0u);
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::fault; }, 5));
  EXPECT_EQ(board.fault(), BoardFault::host_silent);
  EXPECT_EQ(board.open(), 0u);
}

TEST(Serial, ACableThatIsPulledEndsTheRunAndVentsTheBoard) {
  BoardOnPty board(loaded("walk-test-1"));
  Running run(board);
  board.unplug();
  const auto pulled = std::chrono::steady_clock::now();
  const int status = run.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - pulled, std::chrono::seconds(2));
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::fault; }, 6));
  EXPECT_EQ(board.fault(), BoardFault::host_silent);
}

TEST(Serial, ASecondHostIsRefusedAndTheFirstGoesOn) {
  BoardOnPty board(loaded("walk-test-1"));
  Running run(board);
  const Workspace other;
  const Result second = other.sinew(run_at(board, "walk-test-1"));
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("another program has it"));
  EXPECT_FALSE(std::filesystem::exists(other / "ran"));
  EXPECT_FALSE(has_ended(board));
}

// Its log cannot grow: the run reports it, and the machine is not left under pressure.
TEST(Serial, AFullDiskLeavesTheBoardAtRest) {
  BoardOnPty board(loaded("kick"));
  const Workspace w;
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{200'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const Result r = w.sinew(run_at(board, "kick"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(r.code, 1) << r.err;
  EXPECT_THAT(r.err, HasSubstr("log.mcap"));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5));
  EXPECT_EQ(board.open(), 0u);
}

// --- at a terminal ------------------------------------------------------------------------------

struct AtTerminal {
  AtTerminal(BoardOnPty& b, const Workspace& w) : board(b) {
    const Words words = run_at(b, "walk-test-1");
    host = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    if (host == 0) {
      std::vector<char*> arguments{const_cast<char*>("sinew")};
      for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
      arguments.push_back(nullptr);
      if (::chdir(w.path().c_str()) == 0) ::execv(sinew::test::program().c_str(), arguments.data());
      ::_exit(126);
    }
    EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::running; }, 20));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  ~AtTerminal() {
    if (terminal >= 0) ::close(terminal);
    ::kill(host, SIGKILL);
    ::waitpid(host, nullptr, 0);
  }

  BoardOnPty& board;
  int terminal = -1;
  pid_t host = -1;
};

TEST(Serial, TheSpaceBarVents) {
  const Workspace w;
  BoardOnPty board(loaded("walk-test-1"));
  AtTerminal run(board, w);
  ASSERT_EQ(::write(run.terminal, "x ", 2), 2);
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5));
}

TEST(Serial, AnyOtherKeyIsNoStop) {
  const Workspace w;
  BoardOnPty board(loaded("walk-test-1"));
  AtTerminal run(board, w);
  ASSERT_EQ(::write(run.terminal, "xyz\n", 4), 4);
  EXPECT_FALSE(board.wait([&] { return has_ended(board); }, 0.5));
}

TEST(Serial, ATerminalThatClosesVents) {
  const Workspace w;
  BoardOnPty board(loaded("walk-test-1"));
  AtTerminal run(board, w);
  ::close(std::exchange(run.terminal, -1));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::vent; }, 0.5));
  EXPECT_TRUE(board.wait([&] { return board.state() == BoardState::idle; }, 5));
}

}  // namespace
}  // namespace sinew::test
