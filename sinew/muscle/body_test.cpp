// Tubes that are more than a braid, in a plumbing: they pull and hold air by actuator/body.h.
#include "sinew/actuator/body.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/actuator/tension.h"
#include "sinew/gas/air.h"
#include "sinew/muscle/plumbing.h"
#include "sinew/muscle/test_machines.h"

namespace sinew::muscle {
namespace {

Muscle real_tube() {
  Muscle m = bundle(0);
  m.actuator.effectiveness.threshold = 2e4;
  m.actuator.caps.length = 0.003;
  m.actuator.taper = {.gain = 1.1, .rest_length = 3.9 * inch};
  m.actuator.wall.thickness = 5e-4;
  m.actuator.bladder.saturating_tension = 10;
  m.actuator.bladder.saturation_length = 0.002;
  return m;
}

TEST(RealTube, IsAReasonForAPlumbing) {
  EXPECT_FALSE(needs_plumbing(std::vector{bundle(0)}, {}, {}, {}));
  EXPECT_TRUE(needs_plumbing(std::vector{real_tube()}, {}, {}, {}));
}

TEST(RealTube, PullsAndHoldsAirByItsLaws) {
  const Muscle m = real_tube();
  const Plumbing plumbing(std::vector{m}, {}, {});
  const gas::Air air;
  for (const double inches : {2.8, 3.2, 3.8}) {
    Lanes length{}, rate{};
    for (int i = 0; i < capacity; ++i) length[i] = inches * inch;
    const double p = 5e5, gauge = p - air.atmosphere;
    const AirState state = plumbing.initial(p, length, 0);
    AirPull out{};
    AirState derivative{};
    plumbing.evaluate(0, length, rate, 0, 0, state, plumbing.valves_at_rest(), out, derivative);
    const double pull = actuator::tension(m.actuator, length[0], 0, gauge, air.atmosphere);
    EXPECT_NEAR(out.tension[0], m.count * std::max(pull, 0.0), 1e-9);
    const double volume = m.count * actuator::volume(m.actuator, length[0]) + m.external_volume;
    EXPECT_NEAR(plumbing.total_mass(state, 0), gas::density(air, p) * volume, 1e-12 * volume);
  }
}

}  // namespace
}  // namespace sinew::muscle
