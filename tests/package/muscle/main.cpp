// A muscle in a 1 kHz loop outside Sinew: filled for 40 ms at its rest length, then released to a
// shorter length. It pulls when it is full, and less when it is short; no air is lost in between.
#include "sinew/muscle.h"

#include <cmath>
#include <cstdio>

using namespace sinew;
using namespace sinew::units::literals;

namespace {

air::Muscle described() {
  air::Muscle m;
  m.actuator.braid = {.thread_length = 4.2_in, .turns = 2.3};
  m.actuator.effectiveness = {.c0 = 0.95};
  m.actuator.long_end = {.length = 3.9_in, .stiffness = 8.8e4, .damping = 120};
  m.actuator.short_end = {.stiffness = 8.8e4, .damping = 120};
  m.external_volume = 0.495_in3;
  m.inlet.flow.area = m.exhaust.flow.area = 3e-6_ft2;
  return m;
}

bool is(const char* what, bool true_here) {
  std::printf("%s: %s\n", what, true_here ? "yes" : "NO");
  return true_here;
}

}  // namespace

int main() {
  const gas::Air air;
  gas::Supply supply;
  supply.pressure = units::absolute(100.0_psi, air.atmosphere);
  const double length = 3.8_in, shorter = 3.4_in;

  air::DrivenMuscle muscle(described(), air, supply, length);
  const double slack = muscle.tension(), begun_with = muscle.air_mass();
  muscle.inlet(true);
  for (int ms = 0; ms < 40; ++ms) muscle.advance(1e-3, length);
  muscle.inlet(false);
  for (int ms = 0; ms < 20; ++ms) muscle.advance(1e-3, length);
  const double full = muscle.tension(), filled = muscle.air_mass();
  const air::DrivenMuscle::State held = muscle.state();
  for (int ms = 0; ms < 50; ++ms)
    muscle.advance(1e-3, length + (shorter - length) * (ms + 1) / 50.0);
  const double let_go = muscle.tension();

  bool good = is("without pressure it does not pull", std::abs(slack) < 0.5);
  good &= is("filled it pulls, by more than 10 N", full > 10);
  good &= is("shorter it pulls less", let_go < full && let_go >= 0);
  const double by_flow = begun_with + muscle.account().in - muscle.account().out;
  good &= is("what it holds is what has flowed in", std::abs(filled - by_flow) < 1e-9 * filled);
  muscle.restore(held);
  good &= is("restored it pulls as before, to the bit", muscle.tension() == full);
  return good ? 0 : 1;
}
