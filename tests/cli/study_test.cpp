// A study in a file: `sweep --results`, its resumption, its shards and `merge`.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/cli/program.h"

namespace sinew::test::study_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const Words sweep = {"sweep",    "experiments/one-joint.toml",
                     "--vary",   "phase.up.duration=0.5,1,1.5 s",
                     "--seeds",  "4",
                     "--report", "joints.lever.tracking_rms_rad,air_used_kg [g]"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class Study : public ::testing::Test {
 protected:
  Study() : table(w.sinew(sweep).out) {}

  // A table that is written from a file whose points are all there.
  std::string table_of(const std::string& file) {
    const Result r = w.sinew(with(sweep, {"--results", file, "-o", "t.csv", "--force"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr(file + ": 12 of 12 points are there"));
    return read_text(w / "t.csv");
  }

  Workspace w;
  const std::string table;
};

TEST_F(Study, IsTheSameTableAndIsThereAfterwards) {
  const Result first = w.sinew(with(sweep, {"--results", "s.db", "-o", "first.csv"}));
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "first.csv\n");
  EXPECT_EQ(read_text(w / "first.csv"), table);
  EXPECT_EQ(table_of("s.db"), table);
  const Result print = w.sinew(with(sweep, {"--results", "s.db"}));
  EXPECT_EQ(print.out, table);
  EXPECT_FALSE(fs::exists(w / "s.db-wal")) << "whole in one file";
}

// Killed at any moment it leaves what is done; the next one runs the others alone.
TEST_F(Study, GoesOnWhereItWasKilled) {
  const Words many = {"sweep",  "experiments/one-joint.toml", "--seeds", "300", "--results", "s.db",
                      "--quiet"};
  const std::string whole = w.sinew({"sweep", "experiments/one-joint.toml", "--seeds", "300"}).out;
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

TEST_F(Study, SaysHowFarItIs) {
  const Words half = with(sweep, {"--results", "s.db"});
  EXPECT_EQ(w.sinew(with(half, {"--shard", "2/2"})).code, 0);
  const Result r = w.sinew(half);
  EXPECT_EQ(r.err, "s.db: 6 of 12 points are there\n");
  EXPECT_EQ(r.out, table);
}

TEST_F(Study, OfShardsIsMergedToTheSameTable) {
  for (const std::string i : {"1", "2", "3"}) {
    const Result r = w.sinew(with(sweep, {"--results", i + ".db", "--shard", i + "/3", "--quiet"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 1 + 4);
  }
  const Result some = w.sinew({"merge", "1.db", "3.db", "-o", "all.db"});
  EXPECT_EQ(some.out, "all.db: 8 of 12 points are there, 8 of them new\n") << some.err;
  const Result rest = w.sinew({"merge", "2.db", "1.db", "-o", "all.db"});
  EXPECT_EQ(rest.out, "all.db: 12 of 12 points are there, 4 of them new\n") << rest.err;
  EXPECT_EQ(table_of("all.db"), table);
}

TEST_F(Study, IsNotMergedWithAnotherOrWithItself) {
  const auto make = [&](const std::string& file, const Words& more) {
    const Result r = w.sinew(with(with(sweep, {"--results", file}), more));
    EXPECT_EQ(r.code, 0) << r.err;
  };
  const auto refused = [&](const Words& words) {
    const Result r = w.sinew(with({"merge"}, words));
    EXPECT_EQ(r.code, 1);
    return r.err;
  };
  make("a.db", {"--shard", "1/2"});
  make("b.db", {"--set", "joint.lever.damping=1 lbf in s/rad"});
  EXPECT_THAT(refused({"a.db", "b.db", "-o", "all.db"}),
              AllOf(HasSubstr("b.db: found another study, with \"[joint.lever] damping"),
                    HasSubstr("as it is asked for now")));
  EXPECT_FALSE(fs::exists(w / "all.db"));
  EXPECT_THAT(refused({"a.db", "-o", "a.db"}), HasSubstr("a.db: found a file that is merged"));
  EXPECT_THAT(refused({"none.db", "-o", "all.db"}), HasSubstr("none.db: found nothing"));
  EXPECT_EQ(w.sinew({"merge", "a.db"}).code, 2);
}

// The same point with another number is no rounding: a machine or a program was another.
TEST_F(Study, WhoseShardsDisagreeNamesThePoint) {
  for (const std::string file : {"a.db", "b.db"})
    EXPECT_EQ(w.sinew(with(sweep, {"--results", file, "--shard", "1/3"})).code, 0);
  const std::string change =
      "sqlite3 b.db \"UPDATE result SET cells = replace(cells, 'ok', 'refused') WHERE point = 6\"";
  if (std::system(("cd " + w.path().string() + " && " + change).c_str()) != 0)
    GTEST_SKIP() << "no sqlite3 to change a row with";
  const Result r = w.sinew({"merge", "a.db", "b.db", "-o", "all.db"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err, HasSubstr("b.db: found point 6 with status = refused; expected ok, as a.db "
                               "has it"));
  EXPECT_FALSE(fs::exists(w / "all.db")) << "all or none";
}

TEST_F(Study, RefusesWhatItCannotTake) {
  const auto refused = [&](const Words& more, int code = 1) {
    const Result r = w.sinew(with(sweep, more));
    EXPECT_EQ(r.code, code) << r.err;
    EXPECT_THAT(r.out, IsEmpty());
    return r.err;
  };
  write_text(w / "notes.txt", "not a database, and not to be lost\n");
  EXPECT_THAT(refused({"--results", "notes.txt"}), HasSubstr("notes.txt: is no database"));
  EXPECT_EQ(read_text(w / "notes.txt"), "not a database, and not to be lost\n");
  EXPECT_THAT(refused({"--results", "none/s.db"}), HasSubstr("mkdir -p none"));
  EXPECT_THAT(refused({"--results", "/sys/s.db"}), HasSubstr("/sys/s.db: cannot be written: "));
  EXPECT_THAT(refused({"--shard", "1/2"}, 2), HasSubstr("--results"));
  EXPECT_THAT(refused({"--shard", "3/2", "--results", "s.db"}, 2),
              HasSubstr("--shard: found \"3/2\"; expected i/n, i from 1 to n"));
  // A mistake that the first run shows leaves no file.
  EXPECT_THAT(refused({"--results", "s.db", "--report", "durations_s"}), HasSubstr("duration_s"));
  EXPECT_FALSE(fs::exists(w / "s.db"));
}

// With no room for more rows: those that are there stay, and the same command goes on.
TEST_F(Study, ThatHasNoRoomGoesOnLater) {
  const std::string command = "cd " + w.path().string() +
                              " && ulimit -f 100 && " SINEW_PROGRAM
                              " sweep experiments/one-joint.toml --seeds 300 --results s.db "
                              ">/dev/null 2>err";
  EXPECT_NE(std::system(("bash -c '" + command + "'").c_str()), 0);
  EXPECT_THAT(read_text(w / "err"),
              AllOf(HasSubstr("s.db: cannot be"), HasSubstr("what stands in it stays")));
  const Words words = {"sweep", "experiments/one-joint.toml", "--seeds", "300"};
  const Result r = w.sinew(with(words, {"--results", "s.db"}));
  EXPECT_THAT(r.err, HasSubstr("of 300 points are there"));
  EXPECT_EQ(r.out, w.sinew(words).out);
}

TEST_F(Study, OfASensitivityGoesOnToo) {
  const Words words = {"sensitivity", "experiments/one-joint.toml",
                       "--range",     "phase.up.duration=1:2 s",
                       "--range",     "seed=1:9 whole",
                       "--report",    "sequence_duration_s",
                       "--points",    "8"};
  const std::string alone = w.sinew(words).out;
  EXPECT_EQ(w.sinew(with(words, {"--results", "s.db"})).out, alone);
  const Result again = w.sinew(with(words, {"--results", "s.db", "--runs", "runs.csv"}));
  EXPECT_EQ(again.out, alone);
  EXPECT_THAT(again.err, HasSubstr("s.db: 32 of 32 points are there"));
  const std::string runs = read_text(w / "runs.csv");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 33);
  const Result other = w.sinew(with(words, {"--results", "s.db", "--sample-seed", "2"}));
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, HasSubstr("s.db: found another study, with \"sample = 32 points, given"));
}

// --- mpirun ---

class StudyOverMpi : public Study {
 protected:
  // A line of a shell; its words on stderr.
  int shell(const std::string& line) {
    const std::string all = "cd " + w.path().string() +
                            " && export OMPI_ALLOW_RUN_AS_ROOT=1 "
                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 && " +
                            line + " >out 2>err";
    const int status = std::system(("bash -c '" + all + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string err() { return read_text(w / "err"); }

  const std::string sinew = SINEW_PROGRAM " sweep experiments/one-joint.toml --seeds ";
};

TEST_F(StudyOverMpi, IsTheSameTableAndAnErrorIsSaidOnce) {
  if (!SINEW_HAS_MPI || std::system("command -v mpirun >/dev/null") != 0)
    GTEST_SKIP() << "no mpirun, or a program without MPI";
  const std::string mpirun = "mpirun --oversubscribe -n 3 ";
  EXPECT_EQ(shell(mpirun + sinew + "7 --results s.db"), 0) << err();
  EXPECT_EQ(read_text(w / "out"),
            w.sinew({"sweep", "experiments/one-joint.toml", "--seeds", "7"}).out);
  EXPECT_EQ(shell(mpirun + sinew + "8 --results s.db"), 1);
  const std::string said = err(), what = "s.db: found another study";
  EXPECT_NE(said.find(what), said.npos) << said;
  EXPECT_EQ(said.find(what), said.rfind(what)) << said;
  // Other files on another machine.
  EXPECT_EQ(shell("mpirun --oversubscribe -n 1 " + sinew + "7 : -n 1 " + sinew + "9"), 1);
  EXPECT_THAT(err(), HasSubstr("rank 1 has another study, with \"vary = seed: 1, 2, 3, 4, 5, 6, 7, "
                               "8, 9\"; expected \"vary = seed: 1, 2, 3, 4, 5, 6, 7\""));
  EXPECT_EQ(shell("mpirun --oversubscribe -n 1 " + sinew +
                  "7 : -n 1 " SINEW_PROGRAM " sweep experiments/none.toml"),
            1);
  EXPECT_THAT(err(), HasSubstr("rank 1: experiments/none.toml: found no readable file"));
}

TEST_F(StudyOverMpi, IsRefusedWithoutTheModule) {
  fs::create_directory(w / "bin");
  fs::copy_file(SINEW_PROGRAM, w / "bin/sinew");
  const std::string alone = "bin/sinew sweep experiments/one-joint.toml --seeds 2";
  EXPECT_EQ(shell("env OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0 " + alone), 1);
  EXPECT_THAT(err(), AllOf(HasSubstr("started by mpirun, and this program was built without MPI"),
                           HasSubstr("libopenmpi-dev")));
  EXPECT_EQ(shell("env PMI_SIZE=2 " + alone), 1);
  EXPECT_THAT(err(), HasSubstr("the mpirun of another MPI"));
  EXPECT_EQ(shell("env OMPI_COMM_WORLD_SIZE=1 " + alone), 0) << "one process needs none";
}

}  // namespace
}  // namespace sinew::test::study_test
