// `sweep` that is interrupted. All else: sweep.txt.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "tests/cli/program.h"

namespace sinew::test::sweep_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

const std::string bench = "experiments/one-joint.toml";

// In a file next to the table that it would replace, which remains as it was.
TEST(Sweep, InterruptedKeepsWhatIsDone) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Workspace w;
    write_text(w / "t.csv", "an older table,status\n");
    const pid_t pid = w.start({"sweep", bench, "--seeds", "10000", "--report", "duration_s", "-o",
                               "t.csv", "--force", "--quiet"});
    for (int i = 0; i < 1000 && !fs::exists(w / "t.csv.part"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(pid, signal);
    int status = 0;
    waitpid(pid, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << "it should end by itself at signal " << signal;
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(read_text(w / "err"), HasSubstr("kept in t.csv.part"));
    EXPECT_EQ(read_text(w / "t.csv"), "an older table,status\n");
    const std::string text = read_text(w / "t.csv.part");
    EXPECT_THAT(text, AllOf(StartsWith("seed,duration [s],status\n1,13,ok\n"), EndsWith(",ok\n")));
  }
}

}  // namespace
}  // namespace sinew::test::sweep_test
