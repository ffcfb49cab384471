// A walk that the program holds: advanced by periods, looked at, changed, saved and restored.
#include <cstdio>

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

}  // namespace

int main(int, char** words) {
  Simulation leg(sinew::run::buildable(words[1]));
  print(leg, "at its start");
  leg.advance_by(2.2);
  print(leg, "in the first stance");

  // Two futures of one instant: as planned, and with a stiffer hip.
  const std::vector<std::byte> saved = leg.save();
  leg.advance_by(0.8);
  print(leg, "as planned");

  leg.restore(saved);
  leg.change("control.stiffness.hip", 6.0);  // N m/rad
  leg.advance_by(0.8);
  print(leg, "with a stiffer hip");

  // Back once more: the same bits as the first time.
  leg.restore(saved);
  leg.advance_by(0.8);
  print(leg, "as planned, once more");

  // A controller of one's own: a word each 10 ms, from what was measured.
  for (int period = 0; period < 100 && !leg.ended(); ++period) {
    leg.change("control.stiffness.knee", leg.read("/joint/knee/angle") < 5.0 ? 1.5 : 3.0);
    leg.advance_by(0.01);
  }
  print(leg, "a second of our own words");
}
