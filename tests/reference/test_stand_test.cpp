// Chapter 3 in numbers: every set-up of verification_summary, by the network's air and [37].
//
// Where the reference leaves something open, reference.json has its reading: trapped air is sealed
// at the hanging equilibrium and released 0.2 in below it; the valve is open from the start of each
// period; means are those of the last five periods of 3 s. Friction by sign(v) as printed: where
// the sign would change at every instant the mass stands still, as in a converged integration.
//
// Not checked: f_trans_Hz of the 1 lb loads, whose transient leaves the actuator's range; all of
// "E" except its name, see below.

#include "tests/reference/test_stand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>

#include "sinew/air/network.h"
#include "tests/places.h"

namespace sinew::reference::test_stand_test {
namespace {

using nlohmann::json;

const json& summary() {
  static const json data =
      json::parse(std::ifstream(sinew::test::source_dir() + "/data/reference.json"));
  return data["verification_summary"];
}

constexpr double in_per_s2 = 386.088;  // appendix A's g

Reading by_equations() { return {}; }

// Appendix A. Its density of 1.349e-6 slug/in^3 is 0.2 % below that of 528 degR: the same flow
// fills so much faster. Its rounded .0165 and .064 are -0.17 % and +0.21 % of [44], not expressed.
Reading by_code() {
  return {.absolute_effectiveness = true,
          .coulomb_length = 0.0045,
          .supply = 112.7,
          .flow = gas::density_at_atmosphere({}) / 1.2013851329494645};
}

void expect_share(double ours, const json& expected, double tolerance, const std::string& what) {
  const double value = expected.get<double>();
  EXPECT_NEAR(ours, value, tolerance * std::abs(value)) << what;
}

// --- trapped air --------------------------------------------------------------------------------

struct Trapped {
  const char* name;
  double gauge, load;  // [psi], [lbf]
};
constexpr Trapped trapped_set_ups[] = {
    {"A 60psi 6lb", 60, 6}, {"B 80psi 11lb", 80, 11}, {"C 60psi 11lb", 60, 11}};

struct Swing {
  std::vector<Sample> samples;
  std::vector<double> peak_times;
  std::vector<double> peaks;  // of the length, the start included [in]
};

Swing swing(const Trapped& set_up, bool code) {
  const double rest = summary()[set_up.name][code ? "Leq_code" : "Leq_eq"];
  TestStand stand({.reading = code ? by_code() : by_equations(),
                   .load = set_up.load,
                   .external_volume = 0.114});
  Swing s;
  s.samples = stand.run(rest + 0.2, set_up.gauge + 14.7, rest, 4.0);
  s.peak_times = {0};
  s.peaks = {rest + 0.2};
  for (std::size_t i = 1; i < stand.reversals().size(); i += 2) {  // every other is a trough
    const double t = stand.reversals()[i];
    s.peak_times.push_back(t);
    s.peaks.push_back(s.samples[static_cast<std::size_t>(t / TestStand::step)].length);
  }
  return s;
}

template <class Get>
std::pair<double, double> range(const std::vector<Sample>& samples, Get get) {
  const auto [low, high] =
      std::minmax_element(samples.begin(), samples.end(),
                          [&](const Sample& a, const Sample& b) { return get(a) < get(b); });
  return {get(*low), get(*high)};
}

template <class Is>
double last_time(const std::vector<Sample>& samples, Is is) {
  const auto it = std::find_if(samples.rbegin(), samples.rend(), is);
  return it == samples.rend() ? 0.0 : it->t;
}

// Lengths, forces and pressures to 2e-5, times to 1e-4, both far above the integration's error.
// Differences of lengths and what is identified from them lose digits: 0.1 %. `looser` is for
// thesis_1ms, whose steps miss the reversals by up to 1 ms.
void expect_swing(const Trapped& set_up, const Swing& s, const json& e, double looser) {
  SCOPED_TRACE(set_up.name);
  const double end = s.samples.back().length;
  ASSERT_GE(s.peaks.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(s.peaks[k], e["peaks_in"][k].get<double>(), 1e-5 * looser) << "peak " << k;

  expect_share(1e3 * s.peak_times[1], e["Td_first_ms"], 2e-5 * looser, "Td_first_ms");
  const double period = s.peak_times[4] / 4;
  expect_share(1e3 * period, e["Td_mean_ms"], 2e-5 * looser, "Td_mean_ms");
  expect_share(1 / period, e["f_Hz"], 2e-5 * looser, "f_Hz");
  EXPECT_NEAR(end, e["L_final"].get<double>(), 1e-5 * (looser > 1 ? 150 : 1));

  const auto [weakest, strongest] = range(s.samples, [](const Sample& x) { return x.force; });
  const auto [lowest, highest] = range(s.samples, [](const Sample& x) { return x.pressure; });
  expect_share(strongest, e["F_peak"], looser > 1 ? 0.02 : 2e-5, "F_peak");
  expect_share(weakest, e["F_min"], 2e-5 * looser, "F_min");
  expect_share(highest, e["P_peak"], 2e-6 * looser, "P_peak");
  expect_share(lowest, e["P_min"], 2e-6 * looser, "P_min");

  // [45]-[53]: amplitude and loss of the first and of the third swing.
  const double x1 = s.peaks[0] - end, dx1 = s.peaks[0] - s.peaks[1];
  const double x3 = s.peaks[2] - end, dx3 = s.peaks[2] - s.peaks[3];
  const double fine = looser > 1 ? 0.02 : 1e-3;
  expect_share(x1, e["X1"], fine, "X1");
  expect_share(dx1, e["dx1"], fine, "dx1");
  expect_share(x3, e["X3"], fine, "X3");
  expect_share(dx3, e["dx3"], fine, "dx3");
  const double decrement = std::log(x1 / (x1 - dx1));
  expect_share(decrement, e["logdec1"], fine, "logdec1");
  expect_share(decrement / (2 * std::numbers::pi), e["zeta_eq1"], fine, "zeta_eq1 [53]");
  expect_share(std::log(x3 / (x3 - dx3)) / (2 * std::numbers::pi), e["zeta_eq3"], fine,
               "zeta_eq3 [53]");
  const double b = 1 - (dx1 - dx3) / (x1 - x3);
  expect_share((dx1 - x1 * (1 - b)) / 4, e["ident_Q_in"], fine, "Q [45]");
  expect_share(2 * set_up.load / in_per_s2 / period * std::log(1 / b), e["ident_c"], fine,
               "c [52]");

  // Within 2 % of the first amplitude; slower than 0.05 in/s.
  const double settled =
      last_time(s.samples, [&](const Sample& x) { return std::abs(x.length - end) > 0.02 * x1; });
  const double stopped =
      last_time(s.samples, [](const Sample& x) { return std::abs(x.velocity) > 0.05; });
  EXPECT_NEAR(settled, e["settle_2pct_s"].get<double>(), looser > 1 ? 0.01 : 5e-4);
  EXPECT_NEAR(stopped, e["stop_s"].get<double>(), looser > 1 ? 0.01 : 5e-4);
}

TEST(TestStand, TrappedAir) {
  for (const Trapped& set_up : trapped_set_ups) {
    const json& row = summary()[set_up.name];
    const Swing text = swing(set_up, false), code = swing(set_up, true);
    expect_swing(set_up, text, row["equations"], 1);
    expect_swing(set_up, code, row["code_conv"], 1);
    expect_swing(set_up, code, row["thesis_1ms"], 5);

    double apart = 0;
    for (std::size_t i = 0; i < text.samples.size(); ++i)
      apart = std::max(apart, std::abs(text.samples[i].length - code.samples[i].length));
    expect_share(apart, row["eq_minus_code"]["maxdL"], 1e-3, "maxdL");
    expect_share(text.samples.back().length - code.samples.back().length,
                 row["eq_minus_code"]["dLend"], 1e-3, "dLend");
  }
}

// --- pulsed valve -------------------------------------------------------------------------------

struct Pulsed {
  const char* name;
  double frequency, load, open;  // [Hz], [lbf], [s]
  bool pushes;                   // "emp": the commented line below b/sqrt 3
};
// 42.5 % and 35 % of the period, in appendix A's ticks of 1 ms.
constexpr Pulsed pulsed_set_ups[] = {
    {"D 25Hz 5lb", 25, 5, 0.017, false},   {"Demp 25Hz 5lb", 25, 5, 0.017, true},
    {"Eemp 25Hz 1lb", 25, 1, 0.017, true}, {"F 25Hz 15lb", 25, 15, 0.017, false},
    {"G 50Hz 1lb", 50, 1, 0.007, false},   {"Gemp 50Hz 1lb", 50, 1, 0.007, true},
    {"H 50Hz 5lb*", 50, 5, 0.007, false},  {"I 50Hz 15lb*", 50, 15, 0.007, false}};

std::vector<Sample> pulse(const Pulsed& set_up, Reading reading) {
  reading.pushes = set_up.pushes;
  TestStand stand({.reading = reading,
                   .load = set_up.load,
                   .external_volume = 0.495,
                   .frequency = set_up.frequency,
                   .open = set_up.open});
  return stand.run(3.4, 14.7, 3.4, 3.0);
}

struct Steady {
  double length = 0, length_ripple = 0, pressure = 0, pressure_ripple = 0, force = 0,
         force_ripple = 0;
};

Steady steady(const Pulsed& set_up, const std::vector<Sample>& samples) {
  const auto count = std::lround(5 / set_up.frequency / TestStand::step);
  const std::vector<Sample> last(samples.end() - count, samples.end());
  Steady s;
  for (const Sample& x : last) {
    s.length += x.length / static_cast<double>(count);
    s.pressure += (x.pressure - 14.7) / static_cast<double>(count);
    s.force += x.force / static_cast<double>(count);
  }
  const auto ripple = [&](auto get) {
    const auto [low, high] = range(last, get);
    return high - low;
  };
  s.length_ripple = ripple([](const Sample& x) { return x.length; });
  s.pressure_ripple = ripple([](const Sample& x) { return x.pressure; });
  s.force_ripple = ripple([](const Sample& x) { return x.force; });
  return s;
}

// Mean over one period about each instant, from half a period on.
std::vector<Sample> smooth(const Pulsed& set_up, const std::vector<Sample>& samples) {
  const auto period = static_cast<std::size_t>(std::lround(1 / set_up.frequency / TestStand::step));
  std::vector<Sample> out;
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += samples[i].length;
    if (i < period) continue;
    sum -= samples[i - period].length;
    out.push_back({.t = samples[i - period / 2].t, .length = sum / static_cast<double>(period)});
  }
  return out;
}

// Returns the frequency of the swinging about the mean, by the median distance of its upward
// crossings.
double transient_frequency(const std::vector<Sample>& smoothed, double mean) {
  std::vector<double> crossings, distances;
  for (std::size_t i = 1; i < smoothed.size() && smoothed[i].t < 1.5; ++i)
    if (smoothed[i].t > 0.1 && smoothed[i - 1].length <= mean && smoothed[i].length > mean)
      crossings.push_back(smoothed[i].t);
  for (std::size_t i = 1; i < crossings.size(); ++i)
    distances.push_back(crossings[i] - crossings[i - 1]);
  if (distances.empty()) return 0;
  std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(distances.size() / 2),
                   distances.end());
  return 1 / distances[distances.size() / 2];
}

struct Tolerance {
  double length, ripple, pressure, force, peak;  // shares
  double settled;                                // [s]
};

void expect_pulsed(const Pulsed& set_up, const std::vector<Sample>& samples, const json& e,
                   const Tolerance& tolerance, const std::string& column) {
  SCOPED_TRACE(std::string(set_up.name) + ", " + column);
  const Steady s = steady(set_up, samples);
  expect_share(s.length, e["L_mean"], tolerance.length, "L_mean");
  expect_share(s.length_ripple, e["L_rip"], tolerance.ripple, "L_rip");
  expect_share(s.pressure, e["P_mean"], tolerance.pressure, "P_mean");
  expect_share(s.pressure_ripple, e["P_rip"], tolerance.pressure, "P_rip");
  // Below b/sqrt 3 at 1 lb the transient amplifies every difference: a force's peak and the
  // shortest length of "G" are bands of a tenth. Where the commented line pushes back, 0.2 %.
  const bool falls = set_up.load == 1 && !set_up.pushes;
  const auto [shortest, longest] = range(samples, [](const Sample& x) { return x.length; });
  const double strongest = range(samples, [](const Sample& x) { return x.force; }).second;
  expect_share(strongest, e["F_peak"], falls ? 0.1 : tolerance.peak, "F_peak");
  expect_share(longest, e["L_max"], tolerance.length, "L_max");
  if (e.contains("L_min"))
    expect_share(shortest, e["L_min"],
                 falls           ? 0.1
                 : set_up.pushes ? 2e-3
                                 : 2 * tolerance.length,
                 "L_min");
  if (!e.contains("F_mean")) return;
  expect_share(s.force, e["F_mean"], tolerance.force, "F_mean");
  expect_share(s.force_ripple, e["F_rip"], tolerance.ripple, "F_rip");

  const std::vector<Sample> smoothed = smooth(set_up, samples);
  const double mean = e["L_mean"];
  const double settled =
      last_time(smoothed, [&](const Sample& x) { return std::abs(x.length - mean) > 0.02; });
  EXPECT_NEAR(settled, e["settle_s"].get<double>(), falls ? 0.05 : tolerance.settled);
  // The reference's method of counting swings is not known: 4 %.
  if (set_up.load > 1)
    expect_share(transient_frequency(smoothed, mean), e["f_trans_Hz"], 0.04, "f_trans_Hz");
}

// The equations are ours except for rounding of the reference's grid: means to 1e-4, ripples, which
// are small differences, to 1 %.
TEST(TestStand, PulsedValveByTheEquations) {
  for (const Pulsed& set_up : pulsed_set_ups)
    expect_pulsed(set_up, pulse(set_up, by_equations()), summary()[set_up.name]["equations"],
                  {.length = 1e-4,
                   .ripple = 0.01,
                   .pressure = 1e-4,
                   .force = 5e-4,
                   .peak = 1e-4,
                   .settled = 0.002},
                  "equations");
}

// By the code: its .0165 and .064 are the remaining difference from the network's exact orifice;
// ripples and peaks depend on them and, at 1 ms, on the coarse steps.
TEST(TestStand, PulsedValveByTheCode) {
  for (const Pulsed& set_up : pulsed_set_ups) {
    const std::vector<Sample> samples = pulse(set_up, by_code());
    const json& row = summary()[set_up.name];
    const Tolerance tolerance{.length = 1e-3,
                              .ripple = 0.05,
                              .pressure = 5e-3,
                              .force = 1e-3,
                              .peak = 5e-3,
                              .settled = 0.03};
    expect_pulsed(set_up, samples, row["code_conv"], tolerance, "code_conv");
    Tolerance coarse = tolerance;
    coarse.ripple = 0.15;
    coarse.force = 3e-3;
    expect_pulsed(set_up, samples, row["thesis_1ms"], coarse, "thesis_1ms");
  }
}

// One constant of the code at a time.
TEST(TestStand, Sensitivities) {
  for (const Pulsed& set_up : pulsed_set_ups) {
    int columns = 0;
    for (const auto& [what, expected] : summary()[set_up.name]["sens"].items()) {
      Pulsed changed = set_up;
      Reading r = by_code();
      if (what == "eff gage") r.absolute_effectiveness = false;
      if (what == "Q .0044") r.coulomb_length = 0.0044;
      if (what == "supply 114.7") r.supply = 114.7;
      if (what == "mesh_c .07") r.braid_damping = 0.07;
      if (what == "valve_eff 1") r.efficiency = 1;
      if (what == "16 ticks") changed.open = 0.016;
      const Tolerance tolerance{
          .length = 1e-3, .ripple = 0.05, .pressure = 5e-3, .force = 0, .peak = 5e-3, .settled = 0};
      expect_pulsed(changed, pulse(changed, r), expected, tolerance, what);
      ++columns;
    }
    EXPECT_EQ(columns, set_up.frequency == 25 ? 8 : 7) << set_up.name;
  }
}

// A 1 lb load at 25 Hz falls through b/sqrt 3 again and again (to -3 in), where [31] has no force:
// chaotic, three ways of calculating it give three results. Checked: that it does leave the range.
TEST(TestStand, OnePoundAt25HzLeavesTheRange) {
  const json& row = summary()["E 25Hz 1lb"];
  for (const char* column : {"thesis_1ms", "code_conv", "equations"})
    EXPECT_LT(row[column]["L_min"].get<double>(), 0);
  const Pulsed e{"E", 25, 1, 0.017, false};
  const auto samples = pulse(e, by_equations());
  EXPECT_LT(range(samples, [](const Sample& x) { return x.length; }).first, 2.0);
}

// How far the reference's own coarser steps are from its converged run: below the limits above.
TEST(TestStand, ErrorsOfTheReferenceAreSmallerThanTheTolerances) {
  for (const auto& [name, row] : summary().items()) {
    ASSERT_TRUE(row.contains("err_1ms") && row.contains("err_10us")) << name;
    if (name[0] == 'E' && name[1] == ' ') continue;  // chaotic
    EXPECT_LT(row["err_10us"]["maxdL"].get<double>(), 1e-4) << name;
    EXPECT_LT(row["err_1ms"]["maxdL"].get<double>(), 5e-3) << name;
  }
}

// With stick = false a muscle's force has the sign of its speed, both ways.
TEST(TestStand, FrictionWithoutStickHasTheSignOfTheSpeed) {
  air::Muscle sticks = TestStand::muscle({}), slides = sticks;
  slides.actuator.loss.stick = false;
  using Air = air::AirNetwork<4>;
  const Air air(std::vector{sticks, slides}, {}, {});
  for (double speed : {0.1, -0.1}) {
    Air::Ends ends{};
    ends.length.of.fill(0.08);
    ends.rate.of.fill(speed);
    Air::Evaluation pull{};
    air.evaluate(0, ends, air.initial(5e5, ends.length, 0), air.valves_at_rest(),
                 air.memory_at_rest(5e5, ends.length), pull);
    EXPECT_DOUBLE_EQ(pull.tension[1], pull.tension[0] + (speed > 0 ? pull.friction_bound[0]
                                                                   : -pull.friction_bound[0]));
    EXPECT_GT(pull.friction_bound[0], 0);
  }
}

TEST(TestStand, EverySetUpHasATest) {
  std::set<std::string> held{"E 25Hz 1lb"}, all;
  for (const Trapped& s : trapped_set_ups) held.insert(s.name);
  for (const Pulsed& s : pulsed_set_ups) held.insert(s.name);
  for (const auto& [name, row] : summary().items()) all.insert(name);
  EXPECT_EQ(held, all);
}

}  // namespace
}  // namespace sinew::reference::test_stand_test
