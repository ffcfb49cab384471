// Overhead of an FMU's functions: the same steps by the library and through the C functions of the
// binary, measured alternately.
#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fmu/machine/machine.h"
#include "fmu/muscle/muscle.h"
#include "sinew/run/muscle/muscle_setup.h"
#include "sinew/run/setup/buildable.h"

namespace {

using namespace sinew;
namespace fs = std::filesystem;

// Model of a module, used through its C functions as by an importer.
class Slave {
 public:
  Slave(const char* module, const fmu::Description& description) {
    std::string folder = (fs::temp_directory_path() / "sinew-bench-XXXXXX").string();
    if (!mkdtemp(folder.data())) throw std::runtime_error("no folder for temporary files");
    std::ofstream(fs::path(folder) / "model.txt") << description.text();
    for (const auto& file : description.attached())
      std::ofstream(fs::path(folder) / file.name) << file.text;
    library_ = dlopen((std::string(SINEW_BENCH_MODULES) + "/" + module).c_str(), RTLD_NOW);
    if (!library_) throw std::runtime_error(dlerror());
    const void* none[5] = {};
    using Make = void* (*)(const char*, int, const char*, const char*, const void*, int, int);
    handle_ = function<Make>("fmi2Instantiate")("slave", 1, description.hash().c_str(),
                                                folder.c_str(), none, 0, 0);
    fs::remove_all(folder);
    using Phase = int (*)(void*);
    function<Phase>("fmi2EnterInitializationMode")(handle_);
    function<Phase>("fmi2ExitInitializationMode")(handle_);
    set_ = function<Values<const double>>("fmi2SetReal");
    get_ = function<Values<double>>("fmi2GetReal");
    step_ = function<int (*)(void*, double, double, int)>("fmi2DoStep");
  }
  ~Slave() { function<void (*)(void*)>("fmi2FreeInstance")(handle_); }
  Slave(const Slave&) = delete;
  Slave& operator=(const Slave&) = delete;

  void set(const std::vector<unsigned>& at, const double* values) {
    set_(handle_, at.data(), at.size(), values);
  }
  void get(const std::vector<unsigned>& at, double* values) {
    get_(handle_, at.data(), at.size(), values);
  }
  void step(double from, double length) { step_(handle_, from, length, 1); }

 private:
  template <class Number>
  using Values = int (*)(void*, const unsigned*, std::size_t, Number*);
  template <class Function>
  Function function(const char* name) {
    return reinterpret_cast<Function>(dlsym(library_, name));
  }

  void *library_ = nullptr, *handle_ = nullptr;
  Values<const double> set_;
  Values<double> get_;
  int (*step_)(void*, double, double, int);
};

template <class Work>
double time_of(const Work& work) {  // [s]
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Measures both alternately; each returns the time of its steps [s]. Reports the medians as
// microseconds per step, and the ratio of the FMU's to the library's.
template <class Library, class Through>
void by_turns(benchmark::State& state, int steps, const Library& library, const Through& through) {
  std::vector<double> ours, theirs, ratios;
  for (auto _ : state) {
    ours.push_back(library() / steps);
    theirs.push_back(through() / steps);
    ratios.push_back(theirs.back() / ours.back());
  }
  const auto median = [](std::vector<double>& of) {
    std::nth_element(of.begin(), of.begin() + static_cast<long>(of.size() / 2), of.end());
    return of[of.size() / 2];
  };
  state.counters["library_us"] = 1e6 * median(ours);
  state.counters["fmu_us"] = 1e6 * median(theirs);
  state.counters["times_longer"] = median(ratios);
}

// Muscle at 1 kHz with length and rate as inputs and tension as output.
void fmu_muscle(benchmark::State& state) {
  constexpr int steps = 2000;
  constexpr double h = 1e-3;
  const std::string root = SINEW_SOURCE_DIR;
  const run::MuscleSetup read = run::muscle_setup(root + "/robots/leg/robot.toml", "hip_flexor");
  const auto length_at = [&](int k) { return read.length * (1 - 0.002 * (k % 10)); };
  by_turns(
      state, steps,
      [&] {
        air::DrivenMuscle muscle(read.muscle, read.air, read.supply, read.length, 4e5);
        return time_of([&] {
          for (int k = 0; k < steps; ++k) {
            muscle.advance(h, length_at(k));
            benchmark::DoNotOptimize(muscle.tension());
          }
        });
      },
      [&] {
        Slave muscle("sinew_fmu_muscle.so",
                     fmu::Muscle::describe(read.muscle, read.air, read.supply, {read.length, 4e5}));
        double in[2] = {}, out = 0;
        const std::vector<unsigned> inputs{1, 2}, outputs{5};
        return time_of([&] {
          for (int k = 0; k < steps; ++k) {
            in[0] = length_at(k);
            muscle.set(inputs, in);
            muscle.step(k * h, h);
            muscle.get(outputs, &out);
            benchmark::DoNotOptimize(out);
          }
        });
      });
}

// Walk in steps of 10 ms with six output channels.
void fmu_machine(benchmark::State& state) {
  constexpr int steps = 1200;
  constexpr double h = 0.01;
  const auto walk = run::buildable(std::string(SINEW_SOURCE_DIR) + "/experiments/walk-test-1.toml");
  const std::vector<std::string> channels{
      "/joint/hip/angle",           "/joint/knee/angle",
      "/muscle/hip_flexor/tension", "/muscle/knee_flexor/tension",
      "/true/trolley/position",     "/true/trolley/velocity"};
  by_turns(
      state, steps,
      [&] {
        run::Simulation leg(walk);
        std::vector<std::size_t> at;
        for (const std::string& name : channels) at.push_back(leg.find(name));
        std::vector<double> values(at.size());
        return time_of([&] {
          for (int k = 0; k < steps; ++k) {
            leg.advance_by(h);
            leg.read(at, values);
            benchmark::DoNotOptimize(values.data());
          }
        });
      },
      [&] {
        Slave leg("sinew_fmu_machine.so", fmu::Machine::describe(walk, {.outputs = channels}));
        const std::vector<unsigned> outputs{1, 2, 3, 4, 5, 6};
        double values[6] = {};
        return time_of([&] {
          for (int k = 0; k < steps; ++k) {
            leg.step(k * h, h);
            leg.get(outputs, values);
            benchmark::DoNotOptimize(values);
          }
        });
      });
}

BENCHMARK(fmu_muscle)->Iterations(41);
BENCHMARK(fmu_machine)->Iterations(41);

}  // namespace
