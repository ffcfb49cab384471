// The valve is recovered from charts, pulses and coil currents.
#include "sinew/identify/valve/valve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/gas/coil_current.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/pulse.h"
#include "sinew/identify/valve/edges.h"
#include "sinew/identify/valve/fixtures_test.h"
#include "sinew/identify/valve/timing.h"

namespace sinew::identify::valve_test {
namespace {

// --- chart ---

Measured chart(const gas::Flow& flow, const gas::Air& air, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  Values up, down, mass;
  for (const double p : {7.5e5, 5e5})
    for (int i = 0; i < 12; ++i) {
      up.push_back(p);
      down.push_back(air.atmosphere + (p - air.atmosphere) * i / 12.0);
      mass.push_back(gas::mass_flow(flow, air, p, down.back()) + normal(random));
    }
  return table(
      {{"upstream", "Pa abs", up}, {"downstream", "Pa abs", down}, {"mass_flow", "kg/s", mass}});
}

const gas::Flow iso{
    .law = gas::Flow::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = 0.3};
const gas::Flow orifice{.area = 1.67e-6};

TEST(ValveChart, IntervalsCoverTheTruth) {
  const ValveOptions options;
  int conductance = 0, ratio = 0, area = 0;
  double bias = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const ValveResult a = identify_chart(chart(iso, options.air, 3e-5, seed), options);
    ASSERT_EQ(a.report.best().model, "iso6358");
    const Estimate &c = parameter(a, "sonic_conductance"),
                   &b = parameter(a, "critical_pressure_ratio");
    conductance += c.low <= 3e-9 && 3e-9 <= c.high;
    ratio += b.low <= 0.3 && 0.3 <= b.high;
    bias += (b.value / 0.3 - 1) / 200;
    const ValveResult o = identify_chart(chart(orifice, options.air, 3e-5, seed), options);
    const Estimate& e = o.report.fits[0].parameters[0];
    area += e.low <= 1.67e-6 && 1.67e-6 <= e.high;
  }
  for (const int covered : {conductance, ratio, area}) {
    EXPECT_GE(covered, 180);
    EXPECT_LE(covered, 198);
  }
  EXPECT_LT(std::abs(bias), 0.01);
}

TEST(ValveChart, OrderOfRowsAndKindOfFlowChangeNothing) {
  const ValveOptions options;
  Measured a = chart(iso, options.air, 3e-5, 1), b = a;
  for (Column& c : b.columns) std::reverse(c.values.begin(), c.values.end());
  b.columns[2].name = "flow";
  b.columns[2].unit = "m3/s";
  for (double& f : b.columns[2].values) f /= gas::iso_density;
  const ValveResult ra = identify_chart(a, options), rb = identify_chart(b, options);
  EXPECT_NEAR(ra.valve.flow.sonic_conductance / rb.valve.flow.sonic_conductance, 1, 1e-6);
}

TEST(ValveChart, ChokedPointsAloneGiveAnAreaAndNoB) {
  const ValveOptions options;
  Values up, flow;
  for (int i = 0; i < 8; ++i) {
    up.push_back(3e5 + 5e4 * i);
    flow.push_back(gas::mass_flow(iso, options.air, up.back(), options.air.atmosphere) *
                   (1 + 0.002 * (i % 3 - 1)));
  }
  Values down(8, 0.2 * 3e5);
  const ValveResult r = identify_chart(table({{"upstream", "Pa abs", up},
                                              {"downstream", "Pa abs", down},
                                              {"mass_flow", "kg/s", flow}}),
                                       options);
  EXPECT_EQ(r.report.best().model, "orifice");
  expect_says(r.report.fits[1].refused, "b ");
}

TEST(ValveChart, SwappedPortsAndAConstantFlowAreRefused) {
  const ValveOptions options;
  Measured swapped = chart(iso, options.air, 0, 1);
  std::swap(swapped.columns[0].values, swapped.columns[1].values);
  expect_says(refusal_of([&] { identify_chart(swapped, options); }), "they may be swapped");
  Measured constant = chart(iso, options.air, 0, 1);
  for (double& f : constant.columns[2].values) f = 1e-3;
  expect_says(refusal_of([&] { identify_chart(constant, options); }), "the same flow throughout");
}

// --- pulses ---

struct Train {
  Values time, pressure, command;
};

// Ten pulses of 60 ms every 100 ms into a chamber, sampled every millisecond.
Train train(double opening, double closing, double vent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> phase(0, 1e-3);
  std::normal_distribution<double> normal(0, 500);
  std::vector<Opening> edges;
  for (int k = 0; k < 10; ++k) {
    edges.push_back({0.02 + 0.1 * k + phase(random), true});
    edges.push_back({0.08 + 0.1 * k + phase(random), false});
  }
  Train t;
  for (int i = 0; i < 1000; ++i) {
    t.time.push_back(1e-3 * i);
    bool on = false;
    for (const Opening& e : edges)
      if (e.time <= t.time.back()) on = e.open;
    t.command.push_back(on ? 1 : 0);
  }
  const Chamber c{
      .conductance = 6e-6, .critical_ratio = 0.3, .port = 7e5, .start = 1.1e5, .vent = vent};
  t.pressure.resize(t.time.size());
  EXPECT_TRUE(simulate(c, gas::Air(), delayed(edges, opening, closing), t.time, t.pressure));
  for (double& p : t.pressure) p += normal(random);
  return t;
}

Measured table_of(const Train& t) {
  return table(
      {{"time", "s", t.time}, {"pressure", "Pa abs", t.pressure}, {"command", "1", t.command}});
}

TEST(ValvePulses, DelaysComeBackFromASealedAndFromAVentingChamber) {
  for (const double vent : {0.0, 1.5}) {
    ValveOptions options;
    options.port = 7e5;
    options.volume = 1e-3;
    const ValveResult r = identify_pulses(table_of(train(4e-3, 1e-3, vent, 7)), options);
    EXPECT_EQ(r.report.best().model.starts_with("venting"), vent > 0);
    EXPECT_NEAR(r.valve.opening_delay, 4e-3, 0.5e-3);
    EXPECT_NEAR(r.valve.closing_delay, 1e-3, 0.5e-3);
    for (const auto& [name, value] : {std::pair{"opening_delay", 4e-3}, {"closing_delay", 1e-3}}) {
      EXPECT_LE(parameter(r, name).low, value);
      EXPECT_GE(parameter(r, name).high, value);
    }
    EXPECT_NEAR(r.valve.flow.sonic_conductance, 6e-9, 0.05 * 6e-9);
  }
}

TEST(ValvePulses, ACommandThatIsNeverSwitchedIsRefused) {
  Train t = train(4e-3, 1e-3, 0, 1);
  std::fill(t.command.begin(), t.command.end(), 0.0);
  expect_says(refusal_of([&] { identify_pulses(table_of(t), ValveOptions()); }),
              "a coil that is switched");
}

TEST(ValvePulses, DelayedEdgesAreTheShutters) {
  const std::vector<Opening> edges{{0.1, true}, {0.102, false}, {0.2, true}, {0.26, false}};
  const std::vector<Opening> out = delayed(edges, 4e-3, 1e-3);
  ASSERT_EQ(out.size(), 2u);  // 2 ms do not open a valve of 4 ms
  EXPECT_NEAR(out[0].time, 0.204, 1e-12);
  EXPECT_NEAR(out[1].time, 0.261, 1e-12);
  EXPECT_TRUE(out[0].open && !out[1].open);
}

// --- coil ---

gas::Valve coil_valve(bool boosted, double delay) {
  gas::Valve v{.opening_delay = delay};
  v.drive = boosted ? gas::Valve::Drive::speed_up : gas::Valve::Drive::standard;
  v.speed_up = {delay, 0.5e-3};
  v.coil.boost_time = 1e-3;
  v.circuit = {.resistance = 12,
               .inductance = 6e-3,
               .hold_voltage = boosted ? 5.0 : 24.0,
               .boost_voltage = 24,
               .release_voltage = 2.9,
               .motion_voltage = 22,
               .motion_time = 0.12e-3};
  return v;
}

// Two periods of 125 Hz at 50 % as from an oscilloscope.
Measured trace(const gas::Valve& valve, double noise, unsigned seed, bool commanded) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  const auto pieces = gas::coil_current(valve, 0, 8e-3, 0.5, 2);
  Values time, current, command;
  for (int i = 0; i < 850; ++i) {
    const double t = -1e-3 + 2e-5 * i + 0.7e-5;
    time.push_back(t);
    current.push_back((t < 0 ? 0.0 : gas::current(pieces, t)) + normal(random));
    command.push_back(t >= 0 && std::fmod(t, 8e-3) < 4e-3 ? 1 : 0);
  }
  std::vector<Column> columns{{"time", "s", time}, {"current", "A", current}};
  if (commanded) columns.push_back({"command", "1", command});
  return table(columns);
}

TEST(ValveCoil, TheDipGivesTheOpeningDelayAndTheClosingOneIsNotClaimed) {
  for (const bool boosted : {false, true})
    for (const bool commanded : {true, false}) {
      const ValveResult r =
          identify_coil(trace(coil_valve(boosted, 0.5e-3), 5e-3, 3, commanded), ValveOptions());
      EXPECT_NEAR(r.valve.opening_delay, 0.5e-3, 0.02e-3) << boosted << commanded;
      EXPECT_TRUE(r.opening_known);
      EXPECT_FALSE(r.closing_known);
      expect_says(r.report.notes.back(), "closing_delay is not in the current");
    }
}

// The second pulse begins 0.1 ms before the file ends.
TEST(ValveCoil, APulseThatTheFileCutsOffIsLeftOut) {
  Measured m = trace(coil_valve(true, 0.5e-3), 5e-3, 3, true);
  const std::size_t rows = 455;
  for (Column& c : m.columns) c.values.resize(rows);
  m.lines.resize(rows);
  ASSERT_EQ(m["command"].back(), 1);
  const ValveResult r = identify_coil(m, ValveOptions());
  EXPECT_NEAR(r.valve.opening_delay, 0.5e-3, 0.02e-3);
  expect_says(r.report.subject, "the current of 1 pulse");
  expect_says(r.report.notes.front(), "the last pulse is left out");
}

TEST(ValveCoil, IntervalsCoverTheTruth) {
  int covered = 0;
  double bias = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const ValveResult r =
        identify_coil(trace(coil_valve(false, 0.6e-3), 5e-3, seed, true), ValveOptions());
    const Estimate& e = parameter(r, "opening_delay");
    covered += e.low <= 0.6e-3 && 0.6e-3 <= e.high;
    bias += (e.value / 0.6e-3 - 1) / 40;
  }
  EXPECT_GE(covered, 36);
  EXPECT_LT(std::abs(bias), 0.01);
}

TEST(ValveCoil, AStuckShutterAndAClippedTraceAreRefused) {
  gas::Valve stuck = coil_valve(false, 0.5e-3);
  stuck.circuit.motion_voltage = 0;
  expect_says(refusal_of([&] { identify_coil(trace(stuck, 5e-3, 1, true), ValveOptions()); }),
              "a coil without a moving shutter");
  Measured clipped = trace(coil_valve(false, 0.5e-3), 5e-3, 1, true);
  for (double& i : clipped.columns[1].values) i = std::min(i, 1.2);
  expect_says(refusal_of([&] { identify_coil(clipped, ValveOptions()); }),
              "its converter is at its end");
}

// --- the file's kind ---

TEST(Valve, ColumnsDecideWhatWasMeasured) {
  const auto with = [](std::initializer_list<const char*> names,
                       std::optional<ValveData> wanted = {}) {
    std::vector<Column> columns;
    for (const char* name : names) columns.push_back({name, "1", {1}});
    return valve_data(table(columns), wanted);
  };
  EXPECT_EQ(with({"time", "pressure", "command"}, ValveData::fill), ValveData::fill);
  expect_says(refusal_of([&] {
                with({"time", "pressure"}, ValveData::coil);
              }),
              "the columns time, pressure alone; expected");
  EXPECT_EQ(with({"upstream", "flow"}), ValveData::chart);
  EXPECT_EQ(with({"time", "pressure"}), ValveData::fill);
  EXPECT_EQ(with({"time", "pressure", "command"}), ValveData::pulses);
  EXPECT_EQ(with({"time", "current"}), ValveData::coil);
  EXPECT_EQ(with({"duty", "delivered"}), ValveData::duty);
  EXPECT_EQ(with({"duty", "flow", "upstream"}), ValveData::duty);
  expect_says(refusal_of([&] { with({"time", "duty"}); }), "the columns time, duty alone");
}

}  // namespace
}  // namespace sinew::identify::valve_test
