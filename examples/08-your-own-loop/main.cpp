// A mass on a lever with one muscle, in a loop at 10 kHz outside of Sinew. The muscle, its valves,
// its hose and its supply are read from a file.
//
//   own_loop     run it in this lesson's folder, which has muscle.toml
#include <cmath>
#include <cstdio>
#include <exception>

#include "sinew/run/muscle/muscle_setup.h"
#include "sinew/world/driven/driven_muscle.h"

namespace {

using namespace sinew;

constexpr double step = 1e-4;                  // 10 kHz [s]
constexpr double arm = 0.02, inertia = 0.02;   // of the muscle [m]; of the lever [kg m^2]
constexpr double weight = 1.2, damping = 0.3;  // torque of the load [N m]; [N m s/rad]

void walk_through(const char* file) {
  const run::MuscleSetup read = run::muscle_setup(file);
  const double rest = 0.0864;  // length at angle 0 [m]
  air::DrivenMuscle pull(read.muscle, read.air, read.supply, rest);

  double angle = 0, rate = 0;
  std::printf("time [ms]  angle [deg]  gauge [kPa]  tension [N]  air [mg]\n");
  for (int k = 0; k <= 8000; ++k) {
    // Our controller: 40 pulses per second of 6 ms until 25 degrees, then none.
    const bool wanted = angle < 0.4363;
    pull.inlet(wanted && k % 250 < 60);
    if (k % 1000 == 0)
      std::printf("%8.0f %11.3f %12.2f %12.3f %9.3f\n", 1e3 * pull.time(), angle * 57.29577951,
                  (pull.pressure() - read.air.atmosphere) / 1e3, pull.tension(),
                  1e6 * pull.air_mass());

    // Our equation of motion, semi-implicit Euler.
    rate += step * (arm * pull.tension() - weight - damping * rate) / inertia;
    if (angle <= 0 && rate < 0) rate = 0;  // a stop
    angle += step * rate;
    pull.advance(step, rest - arm * angle);
  }
}

}  // namespace

int main() {
  try {
    walk_through("muscle.toml");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
