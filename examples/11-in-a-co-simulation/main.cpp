// A braided muscle as an FMU in an external co-simulation master at 1 kHz. Class Slave does not
// depend on Sinew: it works with any FMU of FMI 2.0 with these variables.
#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "fmu/export/export.h"

namespace {

namespace fs = std::filesystem;

constexpr double step = 1e-3;                  // 1 kHz [s]
constexpr double arm = 0.02, inertia = 0.02;   // of the muscle [m]; of the lever [kg m^2]
constexpr double weight = 1.2, damping = 0.3;  // torque of the load [N m]; [N m s/rad]
constexpr double rest = 0.0864;                // length at angle 0 [m]

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Returns the text between the first `begin` after `from` and the following quote.
std::string quoted(const std::string& text, const std::string& begin, std::size_t from = 0) {
  const std::size_t at = text.find(begin, from);
  if (at == std::string::npos) throw std::runtime_error("modelDescription.xml has no " + begin);
  const std::size_t first = at + begin.size();
  return text.substr(first, text.find('"', first) - first);
}

// FMU of FMI 2.0: loads and instantiates it. Values are accessed by name; all are real except for
// the valves' currents.
class Slave {
 public:
  explicit Slave(const fs::path& folder) : description_(text_of(folder / "modelDescription.xml")) {
    const std::string name = quoted(description_, "modelIdentifier=\"");
    library_ = dlopen((folder / "binaries/linux64" / (name + ".so")).c_str(), RTLD_NOW);
    if (!library_) throw std::runtime_error(dlerror());
    using Make = void* (*)(const char*, int, const char*, const char*, const void*, int, int);
    const std::array<void*, 5> callbacks{};  // no logger and no allocation functions
    const auto make = reinterpret_cast<Make>(dlsym(library_, "fmi2Instantiate"));
    handle_ = make(name.c_str(), 1, quoted(description_, "guid=\"").c_str(),
                   (folder / "resources").c_str(), callbacks.data(), 0, 0);
  }

  // Calls a function of the FMU with its handle as first argument.
  template <class... Arguments>
  void call(const char* function, Arguments... arguments) {
    const auto entry = reinterpret_cast<int (*)(void*, Arguments...)>(dlsym(library_, function));
    if (!entry || entry(handle_, arguments...) != 0) throw std::runtime_error(function);
  }

  void initialize() {
    call("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0);
    call("fmi2EnterInitializationMode");
    call("fmi2ExitInitializationMode");
  }
  double get(const char* name) {
    const unsigned at = reference(name);
    double value = 0;
    call("fmi2GetReal", &at, std::size_t{1}, &value);
    return value;
  }
  void set(const char* name, double value) {
    const unsigned at = reference(name);
    call("fmi2SetReal", &at, std::size_t{1}, static_cast<const double*>(&value));
  }
  void turn(const char* name, bool on) {
    const unsigned at = reference(name);
    const int value = on;
    call("fmi2SetBoolean", &at, std::size_t{1}, &value);
  }
  void advance(double time) { call("fmi2DoStep", time, step, 0); }
  void* state() {
    void* out = nullptr;
    call("fmi2GetFMUstate", &out);
    return out;
  }
  void back_to(void* state) { call("fmi2SetFMUstate", state); }

 private:
  unsigned reference(const std::string& name) const {
    const std::size_t at = description_.find("ScalarVariable name=\"" + name + "\"");
    return static_cast<unsigned>(std::stoul(quoted(description_, "valueReference=\"", at)));
  }

  std::string description_;
  void *library_ = nullptr, *handle_ = nullptr;
};

struct Lever {
  double angle = 0, rate = 0;  // [rad], [rad/s]
};

// Returns the lever a step later, computed in ten small steps with constant tension.
Lever moved(Lever lever, double tension) {
  for (int k = 0; k < 10; ++k) {
    lever.rate += step / 10 * (arm * tension - weight - damping * lever.rate) / inertia;
    if (lever.angle <= 0 && lever.rate < 0) lever.rate = 0;  // a stop
    lever.angle += step / 10 * lever.rate;
  }
  return lever;
}

// Runs our controller, our body and the FMU's muscle from one millisecond to another.
Lever run(Slave& muscle, Lever lever, int begin, int end, bool pulses) {
  for (int k = begin; k < end; ++k) {
    muscle.turn("inlet", pulses && lever.angle < 0.4363 && k % 25 < 6);
    const Lever later = moved(lever, muscle.get("tension"));
    muscle.set("length", rest - arm * lever.angle);
    muscle.set("rate", -arm * (later.angle - lever.angle) / step);
    muscle.advance(k * step);
    lever = later;
  }
  return lever;
}

void row(int milliseconds, const Lever& lever, Slave& muscle) {
  std::printf("%8d %11.3f %12.2f %12.3f %9.3f\n", milliseconds, lever.angle * 57.29577951,
              muscle.get("gauge_pressure") / 1e3, muscle.get("tension"),
              1e6 * muscle.get("air_mass"));
}

// Makes the FMU and unpacks it as a master does.
fs::path unpacked(const fs::path& folder, const std::string& modules) {
  const sinew::fmu::Fmu made =
      sinew::fmu::make_fmu({.file = "../08-your-own-loop/muscle.toml", .modules = modules});
  std::printf("%s: ", made.kind.c_str());
  using Causality = sinew::fmu::Variable::Causality;
  const char* comma = "";
  for (const sinew::fmu::Variable& v : made.variables)
    if (v.causality == Causality::input || v.causality == Causality::output) {
      std::printf("%s%s", comma, v.name.c_str());
      comma = ", ";
    }
  std::printf("\n\n");
  std::ofstream(folder / "muscle.fmu", std::ios::binary) << made.bytes;
  const std::string unpack = "python3 -m zipfile -e '" + (folder / "muscle.fmu").string() + "' '" +
                             (folder / "muscle").string() + "'";
  if (std::system(unpack.c_str()) != 0) throw std::runtime_error(unpack);
  return folder / "muscle";
}

void simulate(const fs::path& folder, const std::string& modules) {
  Slave muscle(unpacked(folder, modules));
  muscle.set("length", rest);
  muscle.initialize();
  std::printf("time [ms]  angle [deg]  gauge [kPa]  tension [N]  air [mg]\n");
  Lever lever;
  row(0, lever, muscle);
  lever = run(muscle, lever, 0, 400, true);
  row(400, lever, muscle);
  const Lever kept = lever;
  void* state = muscle.state();
  lever = run(muscle, lever, 400, 800, true);
  row(800, lever, muscle);

  // Back to 400 ms; from there on both valves stay closed.
  muscle.back_to(state);
  lever = run(muscle, kept, 400, 800, false);
  std::printf("again from 400 ms, with the valves shut:\n");
  row(800, lever, muscle);
}

}  // namespace

// Argument: the folder share/sinew of an installation; not needed below /usr/local or /usr.
int main(int argc, char** argv) {
  const std::string modules = argc > 1 ? std::string(argv[1]) + "/../../lib/sinew" : "";
  std::string folder = (fs::temp_directory_path() / "lesson-11-XXXXXX").string();
  try {
    if (!mkdtemp(folder.data())) throw std::runtime_error("no folder for temporary files");
    simulate(folder, modules);
    fs::remove_all(folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
