// Actuators with more than a braid in a network: tension and volume follow actuator/body.h.
#include "sinew/actuator/body.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/actuator/tension.h"
#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"
#include "sinew/gas/air.h"

namespace sinew::air::body_test {
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

TEST(RealTube, IsNothingThatLanesHold) {
  EXPECT_TRUE(lanes_support(bundle(0)));
  EXPECT_FALSE(lanes_support(real_tube()));
}

TEST(RealTube, PullsAndHoldsAirByItsLaws) {
  const Muscle m = real_tube();
  const Air network(std::vector{m}, {}, {});
  const gas::Air air;
  for (const double inches : {2.8, 3.2, 3.8}) {
    const Motion at = still_at(inches * inch);
    const double p = 5e5, gauge = p - air.atmosphere;
    const Air::State state = network.initial(p, at.length, 0);
    Air::Evaluation out{};
    network.evaluate(0, at, state, network.valves_at_rest(), network.memory_at_rest(p, at.length),
                     out);
    const double pull =
        actuator::clamped_tension(m.actuator, at.length[0], 0, gauge, air.atmosphere);
    EXPECT_NEAR(out.tension[0], m.count * std::max(pull, 0.0), 1e-9);
    const double volume = m.count * actuator::volume(m.actuator, at.length[0]) + m.external_volume;
    EXPECT_NEAR(network.total_mass(state, 0), gas::density(air, p) * volume, 1e-12 * volume);
  }
}

}  // namespace
}  // namespace sinew::air::body_test
