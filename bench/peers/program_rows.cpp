// The program `sinew` as a process: its start, and a walk with log and report.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/peers/experiments.h"
#include "bench/peers/row.h"

namespace sinew::bench {

namespace {

// Runs the program and discards its output. Throws std::runtime_error if it fails.
double run_program(const std::string& program, std::vector<std::string> arguments) {
  std::vector<char*> words;
  std::string name = program;
  words.push_back(name.data());
  for (std::string& a : arguments) words.push_back(a.data());
  words.push_back(nullptr);

  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int out : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silent, out, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &silent, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&silent);
  int status = 0;
  if (failed != 0 || waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error(program + " did not end well");
  return 1.0;
}

// Temporary folder, removed by the destructor.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("sinew_peers_runs_" + std::to_string(getpid()))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Returns a row with a time of Sinew only.
Row timed(Row row, const Work& work, int rounds) {
  std::vector<double> seconds;
  work();
  for (int i = 0; i < rounds; ++i) seconds.push_back(seconds_of([&] { work(); }, Clock::wall));
  row.better = Row::Better::less;
  row.unit = "ms";
  row.ours = seconds;
  for (const double s : seconds) row.figures.push_back(1e3 * s);
  return row;
}

}  // namespace

std::vector<Row> program_rows(const Effort& effort) {
  Row start{.name = "program/start",
            .what = "the program from its start to its end, printing its version",
            .goal = 10.0,
            .per = "start"};
  Row run{.name = "program/walk",
          .what = "a walk from the shell with log, summary and report on disk",
          .goal = 100.0,
          .per = "run"};
  Row log{.name = "program/log",
          .what = "a walk from the shell with log and report against one without its log",
          .per = "run"};
  if (!std::filesystem::exists(effort.program)) {
    const std::string why = "the program `sinew` is not built";
    return {not_measured(start, why), not_measured(run, why), not_measured(log, why)};
  }
  const Folder folder;
  const std::string file = experiment_file("walk-test-1.toml");
  const Work with = [&] {
    return run_program(effort.program, {"run", file, "--force", "-o", folder.path()});
  };
  const Work without = [&] {
    return run_program(effort.program,
                       {"run", file, "--set", "log.enabled=false", "--force", "-o", folder.path()});
  };
  return {timed(
              start, [&] { return run_program(effort.program, {"--version"}); }, effort.rounds),
          timed(run, with, effort.rounds),
          times_slower(log, by_turns(with, without, effort.rounds, Clock::wall))};
}

}  // namespace sinew::bench
