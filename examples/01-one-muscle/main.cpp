// One braided muscle and one valve: tables of their laws.
//
//   one_muscle [SHARE]     SHARE is the folder that has robots/: the sources, or
//   <prefix>/share/sinew
#include <cstdio>
#include <exception>
#include <string>

#include "sinew/actuator/operating_point.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/valve_flow.h"

namespace {

using namespace sinew;

void show_muscle(const std::string& file) {
  const experiment::Experiment read = experiment::load_machine_file(file).experiment;
  const actuator::Actuator& muscle = read.actuators.front();
  const actuator::Surroundings around{read.air.atmosphere, read.air.polytropic_exponent};

  // Tension decreases as the muscle shortens, and trapped air makes it stiffer.
  const double pressure = config::quantity("60 psi gauge", "Pa gauge");
  std::printf("length [mm]  tension [N]  k at p [N/m]  k sealed [N/m]\n");
  for (int mm = 65; mm <= 95; mm += 5) {
    const auto at = actuator::operating_point(muscle, mm / 1e3, pressure, around);
    std::printf("%11d %12.2f %13.1f %15.1f\n", mm, at.tension, at.stiffness_at_constant_pressure,
                at.stiffness_sealed);
  }

  std::printf("\ngauge [kPa]  tension [N]  effectiveness\n");
  for (int kPa = 100; kPa <= 700; kPa += 200) {
    const auto at = actuator::operating_point(muscle, 0.085, 1e3 * kPa, around);
    std::printf("%11d %12.2f %14.4f\n", kPa, at.tension, at.effectiveness);
  }
}

// A pressure needs a reference, gauge or abs.
void refuse_half_a_unit() {
  try {
    config::quantity("60 psi", "Pa gauge");
  } catch (const config::Error& error) {
    std::printf("\n%s\n", error.what());
  }
}

void show_valve(const std::string& file) {
  const experiment::Experiment read = experiment::load_machine_file(file).experiment;
  const gas::Valve& valve = config::named(read.valves, "758", file, "valve");
  const double supply = config::quantity("100 psi gauge", "Pa abs");

  std::printf("\ninto [kPa abs]  flow [g/s]\n");
  for (int kPa = 100; kPa <= 700; kPa += 200) {
    const gas::ValveFlow flow = gas::flow_through(valve.flow, read.air, supply, 1e3 * kPa);
    std::printf("%14d %11.4f%s\n", kPa, 1e3 * flow.mass_flow, flow.choked() ? "  choked" : "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  try {
    show_muscle(share + "/robots/leg/actuator.toml");
    refuse_half_a_unit();
    show_valve(share + "/robots/leg/valves.toml");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
