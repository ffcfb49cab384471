// A walk that the program controls: it advances the walk by periods, reads and changes it, saves it
// and restores it.
//
//   hold_a_run [SHARE]     SHARE is the folder that has experiments/: the sources, or
//                          <prefix>/share/sinew
#include <cstdio>
#include <exception>
#include <string>

#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/simulation.h"

using sinew::run::Simulation;

namespace {

void print(Simulation& leg, const char* what) {
  std::printf("%6.2f s  %-26s hip %6.2f deg  trolley %6.1f mm  air used %5.0f mg\n", leg.time(),
              what, leg.read("/true/joint/hip/angle") * 57.29577951308232,
              1e3 * leg.read("/true/trolley/position"),
              1e6 * leg.read("/true/muscle/hip_extensor/air_in"));
}

void hold(const std::string& file) {
  Simulation leg(sinew::run::buildable(file));
  print(leg, "at its start");
  leg.advance_by(2.2);
  print(leg, "in the first stance");

  // Two continuations from the same time: as planned, and with a stiffer hip.
  const std::vector<std::byte> saved = leg.save();
  leg.advance_by(0.8);
  print(leg, "as planned");

  leg.restore(saved);
  leg.change("control.stiffness.hip", 6.0);  // N m/rad
  leg.advance_by(0.8);
  print(leg, "with a stiffer hip");

  // Restored once more, it gives the same bits as the first time.
  leg.restore(saved);
  leg.advance_by(0.8);
  print(leg, "as planned, once more");

  // Our own controller: a setpoint every 10 ms, from a measurement.
  for (int period = 0; period < 100 && !leg.ended(); ++period) {
    leg.change("control.stiffness.knee", leg.read("/joint/knee/angle") < 5.0 ? 1.5 : 3.0);
    leg.advance_by(0.01);
  }
  print(leg, "a second of our own words");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string share = argc > 1 ? argv[1] : "../..";
  try {
    hold(share + "/experiments/walk-test-1.toml");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
