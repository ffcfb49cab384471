// A study in a file, `sweep --results`, that is killed, and with MPI. All else: study.txt.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/cli/program.h"
#include "tests/places.h"

namespace sinew::test::study_test {
namespace {

using ::testing::HasSubstr;

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class Study : public ::testing::Test {
 protected:
  Workspace w;
};

// Killed at any moment it keeps the completed runs; the next one only runs the others.
TEST_F(Study, GoesOnWhereItWasKilled) {
  const Words many = {"sweep",     "experiments/one-joint.toml",
                      "--seeds",   "300",
                      "--report",  "duration_s",
                      "--results", "s.db",
                      "--quiet"};
  const std::string whole =
      w.sinew({"sweep", "experiments/one-joint.toml", "--seeds", "300", "--report", "duration_s"})
          .out;
  for (int i = 0; i < 3; ++i) {
    const pid_t pid = w.start(many);
    std::this_thread::sleep_for(std::chrono::milliseconds(150 + 70 * i));
    kill(pid, i == 1 ? SIGTERM : SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  const Result last = w.sinew(with(many, {"-o", "t.csv"}));
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(read_text(w / "t.csv"), whole);
}

// --- mpirun ---

class StudyOverMpi : public Study {
 protected:
  // A line for a shell; its output to stderr.
  int shell(const std::string& line) {
    const std::string all = "cd " + w.path().string() +
                            " && export OMPI_ALLOW_RUN_AS_ROOT=1 "
                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 && " +
                            line + " >out 2>err";
    const int status = std::system(("bash -c '" + all + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string err() { return read_text(w / "err"); }

  const std::string sinew =
      sinew::test::program() + " sweep experiments/one-joint.toml --report duration_s --seeds ";
};

TEST_F(StudyOverMpi, IsTheSameTableAndAnErrorIsReportedOnce) {
  if (!SINEW_HAS_MPI || std::system("command -v mpirun >/dev/null") != 0)
    GTEST_SKIP() << "no mpirun, or a program without MPI";
  const std::string mpirun = "mpirun --oversubscribe -n 3 ";
  EXPECT_EQ(shell(mpirun + sinew + "7 --results s.db"), 0) << err();
  EXPECT_EQ(read_text(w / "out"), w.sinew({"sweep", "experiments/one-joint.toml", "--seeds", "7",
                                           "--report", "duration_s"})
                                      .out);
  EXPECT_EQ(shell(mpirun + sinew + "8 --results s.db"), 1);
  const std::string said = err(), what = "s.db: found another study";
  EXPECT_NE(said.find(what), said.npos) << said;
  EXPECT_EQ(said.find(what), said.rfind(what)) << said;
  // Other files on another machine.
  EXPECT_EQ(shell("mpirun --oversubscribe -n 1 " + sinew + "7 : -n 1 " + sinew + "9"), 1);
  EXPECT_THAT(err(), HasSubstr("rank 1 has another study, with \"vary = seed: 1, 2, 3, 4, 5, 6, 7, "
                               "8, 9\"; expected \"vary = seed: 1, 2, 3, 4, 5, 6, 7\""));
  EXPECT_EQ(shell("mpirun --oversubscribe -n 1 " + sinew + "7 : -n 1 " + sinew::test::program() +
                  " sweep experiments/none.toml"),
            1);
  EXPECT_THAT(err(), HasSubstr("rank 1: experiments/none.toml: found no readable file"));
}

}  // namespace
}  // namespace sinew::test::study_test
