// The program `sinew` as a process: its start, and a walk with log and report.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/peers/experiments.h"
#include "bench/peers/pair.h"

namespace sinew::bench {

namespace {

// Runs the program and discards its output. Throws std::runtime_error if it fails.
double run_program(const std::string& arguments) {
  const std::string command = "exec '" SINEW_PROGRAM "' " + arguments + " >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  return 1.0;
}

// Temporary folder for runs, removed by the destructor.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("sinew_bench_runs_" + std::to_string(getpid()))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  // Runs a walk from the shell with its files in this folder.
  double walk(const std::string& options) const {
    return run_program("run '" + experiment_file("walk-test-1.toml") + "' --force -o '" +
                       path_.string() + "' " + options);
  }

 private:
  std::filesystem::path path_;
};

void start(benchmark::State& state) {
  for (auto _ : state) run_program("--version");
}
BENCHMARK(start)->Name("program/start")->Unit(benchmark::kMillisecond)->UseRealTime();

void walk_from_shell(benchmark::State& state) {
  const Folder folder;
  for (auto _ : state) folder.walk("");
}
BENCHMARK(walk_from_shell)->Name("program/walk")->Unit(benchmark::kMillisecond)->UseRealTime();

const Registration rows([] {
  compare("program/log", [] {
    const auto folder = std::make_shared<Folder>();
    return Pair{.ours = [=] { return folder->walk(""); },
                .theirs = [=] { return folder->walk("--set log.enabled=false"); },
                .clock = Clock::wall,
                .label = "a walk from the shell with log and report, against without its log"};
  });
});

}  // namespace

}  // namespace sinew::bench
