// Air integrated ahead of a step against steps that are short enough for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"

namespace sinew::air::quick_bodies_test {
namespace {

// A leg's motion: inches within a second, and 20 m/s^2 at its ends.
Motion swinging(double t) {
  Motion m{};
  for (int i = 0; i < 8; ++i) {
    m.length[i] = (3.2 + 0.35 * std::sin(12 * t + i)) * inch;
    m.rate[i] = 0.35 * 12 * std::cos(12 * t + i) * inch;
  }
  m.travel = (1.0 + 0.99 * std::sin(5 * t)) * inch;  // nearly from stop to stop
  m.travel_rate = 0.99 * 5 * std::cos(5 * t) * inch;
  return m;
}

struct Case {
  std::string name;
  std::function<void(std::vector<Muscle>&)> change;
  std::vector<AirFault> faults;
  std::optional<Cylinder> cylinder;
  double limit;  // of the difference of pressures over the pressure
};

std::vector<Case> cases() {
  const gas::Hose pipe{
      .law = gas::Hose::Law::pipe, .length = 0.6, .inner_diameter = 2.5e-3, .volume = 3e-6};
  const auto hose = [](const gas::Hose& h) {
    return [h](std::vector<Muscle>& m) {
      for (Muscle& one : m) one.hose = h;
    };
  };
  const auto leaking = [=](std::vector<Muscle>& m) {
    hose(pipe)(m);
    m[0].leak = {.area = 2e-8, .conductance = 1e-11};
  };
  const auto regulators = [](std::vector<Muscle>& m) {
    for (Muscle& one : m) {
      one.inlet.kind = gas::Valve::Kind::regulator;
      one.inlet.regulator = {.range = 6 * bar, .time_constant = 5e-3};
      one.inlet.flow.area = 3e-5;
    }
  };
  const auto wide = [](double area, gas::Valve::Kind kind, const gas::Hose& h = {}) {
    return [=](std::vector<Muscle>& m) {
      for (Muscle& one : m) {
        one.inlet.kind = kind;
        one.inlet.flow.area = one.exhaust.flow.area = area;
        one.hose = h;
      }
    };
  };
  const auto steep = [=](std::vector<Muscle>& m) {
    wide(2e-5, gas::Valve::Kind::two_way)(m);
    for (Muscle& one : m) one.inlet.flow.linear_below = one.exhaust.flow.linear_below = 0;
  };
  const gas::Hose short_pipe{.law = gas::Hose::Law::pipe, .length = 0.1, .inner_diameter = 8e-3};
  const gas::Hose short_hose = iso_hose(3e-7);
  using Kind = gas::Valve::Kind;
  const AirFault hole{.what = AirFault::What::hole, .begin = 0.05, .leak = {.area = 2e-5}};
  // Measured: 4.2e-4, 4.9e-4, 3.6e-4, 4.2e-4, 2.0e-4, 9.5e-5, 1.1e-4, 4.7e-5, 2.2e-4, 5.7e-5,
  // 4.4e-5, 2.0e-5, 1.7e-4. With twelve other drives at
  // most 5.6e-4, 7.2e-4, 4.1e-4, 5.6e-4, 2.4e-4,
  // 7.7e-4, 1.3e-4, 4.8e-5, 2.5e-4, 1.9e-4, 4.7e-5, 4.3e-4, and 1.2e-3 of the cylinder alone.
  return {{"pipes", hose(pipe), {}, {}, 1e-3},
          {"fittings", hose(iso_hose(3e-9, 1e-6)), {}, {}, 1e-3},
          {"tiny_hoses", hose(iso_hose(6e-9, 2e-8)), {}, {}, 1e-3},
          {"leaking_hoses", leaking, {}, {}, 1e-3},
          {"regulators", regulators, {}, {}, 1e-3},
          {"wide_valves", wide(2e-5, Kind::two_way), {}, {}, 1e-3},
          {"very_wide_valves", wide(1e-4, Kind::two_way), {}, {}, 1e-3},
          {"wide_3_way_valves", wide(5e-5, Kind::three_way), {}, {}, 1e-3},
          {"wide_valves_without_linear_part", steep, {}, {}, 1e-3},
          {"wide_valves_and_pipes", wide(5e-5, Kind::two_way, short_pipe), {}, {}, 1e-3},
          {"wide_valves_and_hoses", wide(5e-5, Kind::three_way, short_hose), {}, {}, 1e-3},
          {"rupture", [](std::vector<Muscle>&) {}, {hole}, {}, 1e-3},
          {"cylinder", [](std::vector<Muscle>&) {}, {}, thesis_cylinder(), 1e-3}};
}

class Quick : public ::testing::TestWithParam<Case> {
 protected:
  // Two muscles with ideal valves, driven at random for 0.3 s, the same for both.
  void drive(const std::function<void(double until)>& go,
             const std::function<void(int valve, bool open, double share)>& command) {
    std::mt19937 random(4);
    for (int k = 1; k <= 150; ++k) {
      // One after the other: compilers differ in the order of arguments.
      const int valve = static_cast<int>(random() % (GetParam().cylinder ? 8 : 4));
      const double share = 0.1 * static_cast<double>(random() % 10);
      const bool open = random() % 2 == 0;
      command(valve, open, share);
      go(2e-3 * k);
    }
  }
};

TEST_P(Quick, AgreesWithShortSteps) {
  const Case& c = GetParam();
  std::vector<Muscle> muscles{bundle(0), bundle(0.2)};
  c.change(muscles);
  const gas::Air air{.polytropic_exponent = 1.2};
  const Air network(muscles, air, {.pressure = 7 * bar}, c.cylinder, c.faults);
  TestIntegrator fine(network, swinging, 2 * bar), ahead(network, swinging, 2 * bar);
  const double before = network.total_mass(ahead.state, swinging(0).travel);
  double worst = 0;
  const auto compare = [&](double a, double b) { worst = std::max(worst, std::abs(a / b - 1)); };
  const auto go = [&](double until) {
    const double quickest = std::min(network.longest_step(swinging(fine.t), fine.valves), 5e-6);
    fine.run_until(until, quickest);
    ahead.run_until(until, 1e-3, true);
    for (int i = 0; i < 2; ++i) compare(ahead.now.pressure[i], fine.now.pressure[i]);
    for (std::size_t s = 0; s < 2 && c.cylinder; ++s)
      compare(ahead.now.cylinder_pressure[s], fine.now.cylinder_pressure[s]);
  };
  const auto command = [&](int valve, bool open, double share) {
    for (TestIntegrator* test : {&fine, &ahead})
      if (valve < 4 &&
          muscles[static_cast<std::size_t>(valve / 2)].inlet.kind == gas::Valve::Kind::regulator)
        test->level(valve / 2 * 2, test->t, share), test->node(test->t);
      else
        test->electrical(valve, open);
  };
  drive(go, command);
  EXPECT_LT(worst, c.limit);
  RecordProperty("worst", std::to_string(worst));
  const double after = network.total_mass(ahead.state, swinging(ahead.t).travel);
  EXPECT_NEAR((after + ahead.left()) / (before + ahead.entered()), 1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(AirNetwork, Quick, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace sinew::air::quick_bodies_test
