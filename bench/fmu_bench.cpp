// Overhead of an FMU's functions: the same steps by the library and through the C functions of the
// binary.
#include <benchmark/benchmark.h>
#include <dlfcn.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/peers/experiments.h"
#include "bench/peers/pair.h"
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

// Muscle at 1 kHz with length and rate as inputs and tension as output.
bench::Pair fmu_muscle() {
  constexpr int steps = 2000;
  constexpr double h = 1e-3;
  const run::MuscleSetup read =
      run::muscle_setup(std::string(SINEW_SOURCE_DIR) + "/robots/leg/robot.toml", "hip_flexor");
  const auto length_at = [=](int k) { return read.length * (1 - 0.002 * (k % 10)); };
  struct Sides {
    std::optional<air::DrivenMuscle> library;
    std::optional<Slave> slave;
  };
  const auto sides = std::make_shared<Sides>();
  return {.ours =
              [=] {
                const std::vector<unsigned> inputs{1, 2}, outputs{5};
                double in[2] = {}, out = 0;
                for (int k = 0; k < steps; ++k) {
                  in[0] = length_at(k);
                  sides->slave->set(inputs, in);
                  sides->slave->step(k * h, h);
                  sides->slave->get(outputs, &out);
                  benchmark::DoNotOptimize(out);
                }
                return 1.0 * steps;
              },
          .theirs =
              [=] {
                for (int k = 0; k < steps; ++k) {
                  sides->library->advance(h, length_at(k));
                  benchmark::DoNotOptimize(sides->library->tension());
                }
                return 1.0 * steps;
              },
          .label = "a step of 1 ms through the FMU, against the library",
          .before =
              [=] {
                sides->library.emplace(read.muscle, read.air, read.supply, read.length, 4e5);
                sides->slave.emplace(
                    "sinew_fmu_muscle.so",
                    fmu::Muscle::describe(read.muscle, read.air, read.supply, {read.length, 4e5}));
              }};
}

// Walk in steps of 10 ms with six output channels.
bench::Pair fmu_machine() {
  constexpr int steps = 1200;
  constexpr double h = 0.01;
  const auto walk = run::buildable(bench::experiment_file("walk-test-1.toml"));
  const std::vector<std::string> channels{
      "/joint/hip/angle",           "/joint/knee/angle",
      "/muscle/hip_flexor/tension", "/muscle/knee_flexor/tension",
      "/true/trolley/position",     "/true/trolley/velocity"};
  struct Sides {
    std::optional<run::Simulation> library;
    std::vector<std::size_t> at;
    std::optional<Slave> slave;
  };
  const auto sides = std::make_shared<Sides>();
  return {.ours =
              [=] {
                const std::vector<unsigned> outputs{1, 2, 3, 4, 5, 6};
                double values[6] = {};
                for (int k = 0; k < steps; ++k) {
                  sides->slave->step(k * h, h);
                  sides->slave->get(outputs, values);
                  benchmark::DoNotOptimize(values);
                }
                return 1.0 * steps;
              },
          .theirs =
              [=] {
                std::vector<double> values(sides->at.size());
                for (int k = 0; k < steps; ++k) {
                  sides->library->advance_by(h);
                  sides->library->read(sides->at, values);
                  benchmark::DoNotOptimize(values.data());
                }
                return 1.0 * steps;
              },
          .label = "a step of 10 ms of a walk through the FMU, against the library",
          .before =
              [=] {
                sides->library.emplace(walk);
                sides->at.clear();
                for (const std::string& name : channels)
                  sides->at.push_back(sides->library->find(name));
                sides->slave.emplace("sinew_fmu_machine.so",
                                     fmu::Machine::describe(walk, {.outputs = channels}));
              }};
}

const bench::Registration rows([] {
  bench::compare("fmu/muscle", fmu_muscle);
  bench::compare("fmu/machine", fmu_machine);
});

}  // namespace
