// The C++ lines of README.md: a muscle is filled for 20 ms, then both valves are closed, while its
// length is prescribed.
#include <cstdio>
#include "sinew/muscle.h"
int main() {
  sinew::air::Muscle tube;  // a braided tube between two valves; numbers are in SI
  tube.actuator.braid = {.thread_length = 0.1067, .turns = 2.3};
  tube.inlet.flow.area = tube.exhaust.flow.area = 1.42e-6;
  sinew::air::DrivenMuscle muscle(tube, sinew::gas::Air{}, sinew::gas::Supply{}, 0.085);
  for (int ms = 1; ms <= 60; ++ms) {
    muscle.inlet(ms <= 20);                      // current in the inlet's coil
    muscle.advance(0.001, 0.085 - 0.0001 * ms);  // your robot's next length
    if (ms % 20 == 0) std::printf("%2d ms: %4.1f N\n", ms, muscle.tension());
  }
}
