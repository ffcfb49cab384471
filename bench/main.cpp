// sinew_bench - all rows of bench/README.md, with the options of google-benchmark.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "sinew/run/simulation/lanes.h"

int main(int argc, char** argv) {
  // The speed of a computer varies within minutes, so the repetitions of all rows are mixed.
  // Options on the command line come later and take precedence.
  std::vector<std::string> words{
      argv[0], "--benchmark_repetitions=21", "--benchmark_report_aggregates_only=true",
      "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.02"};
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());

  benchmark::AddCustomContext("version", SINEW_VERSION);
  benchmark::AddCustomContext("compiler", SINEW_BENCH_COMPILER);
  benchmark::AddCustomContext("flags", SINEW_BENCH_FLAGS);
  benchmark::AddCustomContext("lanes", std::to_string(sinew::run::widest_lanes()));
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  return benchmark::RunSpecifiedBenchmarks() == 0;
}
