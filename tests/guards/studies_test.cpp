// The same study in one process, with two threads, as three shards merged, over three processes
// of mpirun, and killed at any moments and continued in any of these ways: the same table, to the
// byte.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/guards/writers.h"
#include "tests/places.h"

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int points = 120;

// The same number of runs as generations that depend on each other.
const char* const tuning =
    "format = \"sinew.tuning/1\"\n"
    "title = \"a lever\"\n"
    "experiment = \"experiments/one-joint.toml\"\n"
    "tune = [\"joint.lever.angle_gain=0.05:0.2 %/count log\", \"phase.up.duration=0.5:1.5 s\"]\n"
    "minimize = [\"joints.lever.tracking_rms_rad\"]\n"
    "where = [\"air_used_kg < 0.6 g\"]\n"
    "population = 10\n"
    "seeds = 2\n"
    "generations = 6\n";
const Words tune = {"tune", "t.toml"};

const Words sweep = {"sweep",    "experiments/one-joint.toml",
                     "--vary",   "joint.lever.angle_gain=0.08,0.12,0.2 %/count",
                     "--range",  "phase.up.duration=0.5:1.5 s",
                     "--points", "40",
                     "--report", "joints.lever.tracking_rms_rad,air_used_kg [g]"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

bool has_mpi() { return SINEW_HAS_MPI && std::system("command -v mpirun >/dev/null") == 0; }

// Three processes where there may be fewer processors, as root in a container.
[[noreturn]] void become_mpirun(const Words& words) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  // A process that dies while it starts may leave a lock of PMIx's shared memory taken, for which
  // mpirun then waits forever: once in 130 kills. Without that memory there is no such lock.
  setenv("PMIX_MCA_gds", "hash", 1);
  const std::string program = sinew::test::program();
  std::vector<const char*> arguments{"mpirun", "--oversubscribe", "-n", "3", program.c_str()};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  execvp("mpirun", const_cast<char**>(arguments.data()));
  _exit(126);
}

Started start_on(const Workspace& w, const Words& words, bool mpi) {
  return start(w, words, [&] {
    if (mpi) become_mpirun(words);
  });
}

std::vector<pid_t> children_of(pid_t pid) {
  const std::string id = std::to_string(pid);
  std::istringstream text(read_text("/proc/" + id + "/task/" + id + "/children"));
  std::vector<pid_t> out;
  for (pid_t child = 0; text >> child;) out.push_back(child);
  return out;
}

// Of sweeps and of tunings.
class Studies : public ::testing::TestWithParam<Words> {
 protected:
  Studies() {
    write_text(w / "t.toml", tuning);
    const auto begin = std::chrono::steady_clock::now();
    table = table_of({"--results", "alone.db", "--threads", "1"});
    lasts = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void SetUp() override {
    const int rows = GetParam() == tune ? points / 2 : points;  // two runs a candidate
    ASSERT_EQ(std::count(table.begin(), table.end(), '\n'), rows + 1);
  }

  // Of this study, run or continued with these arguments.
  std::string table_of(const Words& words) {
    const Result r = w.sinew(with(with(GetParam(), words), {"-o", "t.csv", "--force", "--quiet"}));
    EXPECT_EQ(r.code, 0) << r.err;
    return read_text(w / "t.csv");
  }

  // Kills the process, one of those that mpirun started, or stops mpirun itself.
  bool disturb(const Started& process, bool mpi) {
    const std::vector<pid_t> ranks = mpi ? children_of(process.pid) : std::vector<pid_t>{};
    const std::size_t which = random() % 4;
    const bool one = which < ranks.size();
    kill(one ? ranks[which] : process.pid, one || !mpi ? SIGKILL : SIGTERM);
    const Ended end = ended(process);
    EXPECT_THAT(end.code, AnyOf(-1, 0, 1, 128 + SIGKILL)) << end.output;
    return end.code != 0;
  }

  Workspace w;
  std::string table;
  double lasts = 0;  // duration of the serial run [s]
  std::mt19937 random{7};
};

TEST_P(Studies, AreOneTableHoweverTheyAreRun) {
  EXPECT_EQ(table_of({"--results", "two.db", "--threads", "2"}), table);
  if (GetParam() == sweep) {
    Words merge = {"merge", "-o", "all.db"};
    for (const std::string i : {"3", "1", "2"}) {
      EXPECT_EQ(w.sinew(with(sweep, {"--results", i + ".db", "--shard", i + "/3"})).code, 0);
      merge.push_back(i + ".db");
    }
    EXPECT_EQ(w.sinew(merge).code, 0);
    EXPECT_EQ(table_of({"--results", "all.db"}), table);
  }
  if (!has_mpi()) GTEST_SKIP() << "no mpirun, or a program without MPI: the others are the same";
  const Ended end =
      ended(start_on(w, with(GetParam(), {"-o", "mpi.csv", "--results", "m.db"}), true));
  EXPECT_EQ(end.code, 0) << end.output;
  EXPECT_EQ(read_text(w / "mpi.csv"), table);
}

TEST_P(Studies, KilledAndGoneOnWithAreTheSameTable) {
  const Words words = with(GetParam(), {"--results", "s.db", "--quiet", "--threads", "1"});
  const double begin_of_mpirun = 0.3;  // [s], or so
  int killed = 0, whole = 0, mpirun = 0, tried = 0;
  const auto finish = [&] {
    EXPECT_EQ(table_of({"--results", "s.db", "--threads", "1"}), table);
    fs::remove(w / "s.db");
    ++whole;
  };
  for (; killed < tries(6) && tried < 4 * tries(6); ++tried) {
    const bool mpi = has_mpi() && tried % 2 == 1;
    const Started process = start_on(w, words, mpi);
    const double longest = mpi ? begin_of_mpirun + 0.4 * lasts : 0.6 * lasts;
    const double after = std::uniform_real_distribution(0.0, longest)(random);
    std::this_thread::sleep_for(std::chrono::duration<double>(after));
    SCOPED_TRACE("killed after " + std::to_string(after) + " s" + (mpi ? " of mpirun" : ""));
    const bool in_time = disturb(process, mpi);
    killed += in_time;
    mpirun += in_time && mpi;
    if (!in_time) finish();
  }
  finish();
  EXPECT_EQ(killed, tries(6)) << "most were over before their signal came";
  std::printf(
      "guard: %d kills of a %s of %d runs, %d of them under mpirun; gone on with, the table was "
      "the "
      "same %d times\n",
      killed, GetParam() == tune ? "tuning" : "sweep", points, mpirun, whole);
}

INSTANTIATE_TEST_SUITE_P(All, Studies, ::testing::Values(sweep, tune),
                         [](const auto& kind) { return kind.param.front(); });

}  // namespace
}  // namespace sinew::test
