// Times of a moving muscle against those of a rigid volume and against integration in time.

#include "sinew/gas/stroke.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace sinew::gas::stroke_test {
namespace {

constexpr double atmosphere = 101325, supply = 7e5;
const Air room{};

Flow valve(double c, double b) {
  return {.law = Flow::Law::iso6358, .sonic_conductance = c, .critical_pressure_ratio = b};
}

TEST(Stroke, WithoutMotionItIsARigidVolume) {
  std::mt19937 random(4403);
  std::uniform_real_distribution<double> pressure(1.2e5, 6.8e5), ratio(0.1, 0.528);
  for (int i = 0; i < 50; ++i) {
    const Flow flow = valve(2e-9, ratio(random));
    const double volume = 5e-5, to = pressure(random);
    const Stroke fill{atmosphere, to, volume, volume}, vent{to, 1.1e5, volume, volume};
    EXPECT_NEAR(stroke_time(flow, room, supply, fill, true) /
                    adiabatic_transfer_time(flow, room, volume, supply, atmosphere, to),
                1, 1e-12);
    EXPECT_NEAR(stroke_time(flow, room, supply, fill, false) /
                    isothermal_transfer_time(flow, room, volume, supply, atmosphere, to),
                1, 1e-12);
    EXPECT_NEAR(stroke_time(flow, room, atmosphere, vent, true) /
                    adiabatic_transfer_time(flow, room, volume, atmosphere, to, 1.1e5),
                1, 1e-12);
  }
}

// Integrates mass and energy in small steps of the path, with the flow of each step's middle. The
// air's temperature is a state here; no adiabat is assumed.
double stepped_time(const Flow& flow, double port, const Stroke& s, bool adiabatic,
                    Order order = Order::together) {
  constexpr int steps = 20'000;
  const auto pressure_share = [&](double x) {
    if (order == Order::together) return x;
    return std::clamp(order == Order::pressure_first ? 2 * x : 2 * x - 1, 0.0, 1.0);
  };
  const auto volume_share = [&](double x) {
    if (order == Order::together) return x;
    return std::clamp(order == Order::volume_first ? 2 * x : 2 * x - 1, 0.0, 1.0);
  };
  constexpr double k = heat_capacity_ratio;
  const double r = room.gas_constant;
  double temperature = room.temperature, time = 0;
  double p = s.from, v = s.volume_from, mass = p * v / (r * temperature);
  for (int i = 0; i < steps; ++i) {
    const double next_p = s.from + pressure_share((i + 1.0) / steps) * (s.to - s.from);
    const double next_v =
        s.volume_from + volume_share((i + 1.0) / steps) * (s.volume_to - s.volume_from);
    const double work = 0.5 * (p + next_p) * (next_v - v);
    const double energy = (next_p * next_v - p * v) / (k - 1.0);
    double in = mass_flow(flow, room, port, 0.5 * (p + next_p)), moved = 0;
    if (!adiabatic) {
      moved = next_p * next_v / (r * room.temperature) - mass;
    } else {
      const double passes = in > 0 ? room.temperature : temperature;
      if (in < 0) in *= std::sqrt(room.temperature / temperature);
      moved = (energy + work) / (k / (k - 1.0) * r * passes);
    }
    time += moved / in;
    mass += moved, p = next_p, v = next_v;
    temperature = p * v / (mass * r);
  }
  return time;
}

TEST(Stroke, AgreesWithABalanceInSmallSteps) {
  std::mt19937 random(4404);
  std::uniform_real_distribution<double> high(3e5, 6.5e5), low(1.3e5, 2.5e5), grow(1.0, 3.0),
      ratio(0.1, 0.528);
  for (int i = 0; i < 20; ++i) {
    const Flow flow = valve(2e-9, ratio(random));
    const double small = 4e-5, large = grow(random) * small, top = high(random), end = low(random);
    const Stroke fill{end, top, small, large}, vent{top, end, large, small};
    for (const bool adiabatic : {false, true})
      for (const Order order : {Order::volume_first, Order::together, Order::pressure_first}) {
        EXPECT_NEAR(stepped_time(flow, supply, fill, adiabatic, order) /
                        stroke_time(flow, room, supply, fill, adiabatic, order),
                    1, 1e-3);
        EXPECT_NEAR(stepped_time(flow, atmosphere, vent, adiabatic, order) /
                        stroke_time(flow, room, atmosphere, vent, adiabatic, order),
                    1, 1e-3);
      }
  }
}

TEST(Stroke, ALoadThatIsLiftedLastTakesLongest) {
  std::mt19937 random(4405);
  std::uniform_real_distribution<double> high(3e5, 6.5e5), low(1.3e5, 2.5e5), grow(1.0, 3.0);
  const Flow flow = valve(2e-9, 0.3);
  for (int i = 0; i < 50; ++i) {
    const double small = 4e-5, large = grow(random) * small, top = high(random), end = low(random);
    const Stroke fill{end, top, small, large}, vent{top, end, large, small};
    for (const bool adiabatic : {false, true})
      for (const auto& [port, s] : {std::pair{supply, fill}, std::pair{atmosphere, vent}}) {
        const double first = stroke_time(flow, room, port, s, adiabatic, Order::volume_first);
        const double both = stroke_time(flow, room, port, s, adiabatic);
        const double last = stroke_time(flow, room, port, s, adiabatic, Order::pressure_first);
        EXPECT_LE(first, both * (1 + 1e-9));
        EXPECT_LE(both, last * (1 + 1e-9));
      }
  }
}

TEST(Stroke, AtOnePressureTheFlowIsConstant) {
  const Flow flow = valve(2e-9, 0.3);
  const Stroke s{4e5, 4e5, 4e-5, 9e-5};
  const double exact =
      4e5 * 5e-5 / (room.gas_constant * room.temperature) / mass_flow(flow, room, supply, 4e5);
  for (const bool adiabatic : {false, true})
    EXPECT_NEAR(stroke_time(flow, room, supply, s, adiabatic) / exact, 1, 1e-14);
}

TEST(Stroke, APortThatCannotGetThereNeedsForever) {
  const Flow flow = valve(2e-9, 0.3);
  EXPECT_FALSE(std::isfinite(stroke_time(flow, room, 5e5, {2e5, 5e5, 1e-5, 2e-5}, false)));
  EXPECT_FALSE(std::isfinite(stroke_time(flow, room, atmosphere, {4e5, 4e5, 1e-5, 2e-5}, false)));
}

}  // namespace
}  // namespace sinew::gas::stroke_test
