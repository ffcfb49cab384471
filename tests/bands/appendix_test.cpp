// The programs that appendix B.1 has as comments: required results of their experiments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sinew/gas/orifice.h"
#include "sinew/units/constants.h"
#include "tests/bands/shipped.h"

namespace sinew::appendix_test {
namespace {

using test::Sets;
using test::summary_of;

constexpr double inch = units::inch;

Sets operator+(Sets a, const Sets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Sets instant_valves = {"valve.inlet.opening_delay=0 s", "valve.inlet.closing_delay=0 s",
                             "valve.exhaust.opening_delay=0 s", "valve.exhaust.closing_delay=0 s"};

// --- knee-staircase -----------------------------------------------------------------------------

// How far the knee is from its aim at the end of each stair between 1000 and 1240 counts, where no
// stair is near a turn  [count].
std::vector<double> errors_on_the_stairs(const Sets& sets) {
  const auto e = experiment::load(test::file_of("knee-staircase"), sets);
  const run::Outcome out = run::run(e);
  const signals::Column &want = *out.table.column("/desired/joint/knee/angle"),
                        &is = *out.table.column("/sensor/knee_angle/count"),
                        &phase = *out.table.column("/plan/phase");
  const robot::Sensor& sensor =
      *std::ranges::find(e.robot.sensors, "knee_angle", &robot::Sensor::name);
  std::vector<double> errors;
  for (std::size_t i = 0; i + 1 < want.size(); ++i) {
    if (phase[i] < 0 || want[i] == want[i + 1]) continue;
    const double aim = std::trunc((want[i] - e.robot.joints[1].rest_angle) * sensor.assumed_scale +
                                  sensor.assumed_at_rest);
    if (aim >= 1000 && aim <= 1240) errors.push_back(aim - is[i]);
  }
  EXPECT_EQ(errors.size(), 4U * 25U);
  return errors;
}

// 0.12 %/count, truncated to whole percents: zero below 8.3 counts. Dry friction does not widen it,
// since the air integrates. The valves do: a pulse that is shorter than the opening delay lets no
// air through, so the first percents are lost too.
TEST(Appendix, TheKneesDeadBandIsTheTruncationAndMoreOfItTheValves) {
  constexpr double truncation = 1 / 0.12;
  const Sets no_friction = {"joint.knee.dry_friction=0 lbf in"};
  for (const Sets& sets : {instant_valves, instant_valves + no_friction})
    for (double error : errors_on_the_stairs(sets)) EXPECT_LT(std::abs(error), truncation + 1);

  for (const Sets& sets : {Sets{}, no_friction}) {
    double sum = 0;
    for (double error : errors_on_the_stairs(sets)) {
      sum += std::abs(error);
      EXPECT_LT(std::abs(error), 4 * truncation + 1);
    }
    EXPECT_GT(sum / 100, 2 * truncation);
    EXPECT_LT(sum / 100, 3 * truncation);
  }
}

// --- sensor-readout -----------------------------------------------------------------------------

// A reading's noise is the sensor's and that of its rounding, 1/12 count^2.
TEST(Appendix, ReadingsAtRestHaveTheNoiseThatWasSet) {
  const Sets longer = {"phase.readout.duration=20 s"};
  for (const double noise : {0.5, 1.5}) {
    const std::string set = "sensor.hip_angle.real.noise=" + std::to_string(noise) + " count";
    const analysis::Summary s = summary_of("sensor-readout", longer + Sets{set});
    const double expected = std::sqrt(noise * noise + 1.0 / 12);
    EXPECT_NEAR(*s.find("sensors.hip_angle.std_count"), expected, 0.06 * expected);
    EXPECT_NEAR(*s.find("sensors.knee_angle.mean_count"), 1175, 0.1);
    EXPECT_NEAR(*s.find("sensors.cylinder_position.mean_count"), 404, 1e-9);
  }
}

// --- the cylinder -------------------------------------------------------------------------------

struct Hold {
  double mean, swing;  // of the last 0.5 s [m]
  double air;          // [kg]
};

const Sets no_feedforward = {"cylinder.up_feedforward=0 %", "cylinder.down_feedforward=0 %"};

Sets cylinder(const std::string& gain, const std::string& damping) {
  return {"cylinder.position_gain=" + gain + " %/count",
          "cylinder.damping=" + damping + " lbf s/in"};
}

// The body controlled to 0.7 in, from its initial position.
Hold hold(const Sets& sets) {
  const Sets still = {"sequence.phases=[\"up\"]", "phase.up.duration=1.5 s",
                      "control.high_level_period=10 ms", "start.lift=0.7 in",
                      "phase.up.cylinder={ position = [\"0.7 in\"] }"};
  const auto e = experiment::load(test::file_of("cylinder-staircase"), still + sets);
  const run::Outcome out = run::run(e);
  const auto column = [&](const char* topic) { return out.table.column(topic)->in_memory(); };
  const std::vector<double> travel = column("/true/cylinder/position"),
                            phase = column("/plan/phase"), up = column("/true/cylinder/up/air_in"),
                            down = column("/true/cylinder/down/air_in");
  const auto after = std::find(phase.rbegin(), phase.rend(), 0.0);
  const auto end = travel.begin() + (phase.rend() - after), begin = end - 50;
  double sum = 0;
  for (auto i = begin; i != end; ++i) sum += *i;
  const auto [low, high] = std::minmax_element(begin, end);
  return {sum / 50, *high - *low, up.back() + down.back()};
}

// The pressure in a chamber with a steady flow: the air that enters through an inlet, open for a
// share of the time, leaves through the exhaust.
double standing_pressure(const experiment::Experiment& e, double in, double out) {
  const auto open = [&](const std::string& name, double duty) {
    const gas::Valve& v = *std::ranges::find(e.valves, name, &gas::Valve::name);
    const double period = e.robot.low_level.pwm_ticks * 1e-4;
    return std::pair{&v.flow, duty + (v.closing_delay - v.opening_delay) / period};
  };
  const auto [inlet, inlet_share] = open(e.robot.cylinder.up.inlet, in);
  const auto [exhaust, exhaust_share] = open(e.robot.cylinder.up.exhaust, out);
  double low = e.air.atmosphere, high = e.supply.pressure;
  for (int i = 0; i < 60; ++i) {
    const double p = 0.5 * (low + high);
    const bool rises = inlet_share * gas::mass_flow(*inlet, e.air, e.supply.pressure, p) >
                       exhaust_share * gas::mass_flow(*exhaust, e.air, p, e.air.atmosphere);
    (rises ? low : high) = p;
  }
  return low;
}

// The law's output at which steady flows carry the body: between the whole percents  [-].
double output_that_carries(const experiment::Experiment& e) {
  const robot::Cylinder& c = e.robot.cylinder;
  double mass = c.body_mass + e.robot.foot.mass;
  for (const robot::Link& link : e.robot.links) mass += link.mass;
  const double quarter_pi = 0.785398163397448;
  const double down = quarter_pi * c.bore * c.bore,
               up = down - quarter_pi * c.rod_diameter * c.rod_diameter;
  double low = 0, high = 0.4;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.5 * (low + high);
    const double p_up = standing_pressure(e, c.up_feedforward + u, c.up_feedforward - u),
                 p_down = standing_pressure(e, c.down_feedforward - u, c.down_feedforward + u);
    const double force = up * (p_up - e.air.atmosphere) - down * (p_down - e.air.atmosphere);
    (force < mass * 9.80665 ? low : high) = u;
  }
  return low;
}

// With a steady flow in both chambers the duty sets a pressure, as a 3-way valve's does: a
// proportional law then holds a weight with an error, which the balance of flows predicts.
TEST(Appendix, AStandingFlowCarriesTheBodyWithTheErrorThatItsBalanceForetells) {
  const auto e = experiment::load(test::file_of("cylinder-staircase"));
  const double carries = output_that_carries(e), counts_per_inch = 1437;
  for (const std::string gain : {"0.03", "0.05", "0.1"}) {
    const Hold body = hold(cylinder(gain, "3"));
    const double error = (0.7 - body.mean / inch) * counts_per_inch;
    EXPECT_LT(body.swing, 0.006 * inch) << gain;
    EXPECT_NEAR(0.01 * std::stod(gain) * error, carries, 0.01) << gain;  // whole percents
  }
}

// Valves that add air make an integrator of the air and two of the mass: only friction, or a steady
// flow that leaks, damps it.
TEST(Appendix, OnlyDampingOrAStandingFlowKeepTheCylinderFromSwinging) {
  const double stroke = 2 * inch;
  EXPECT_GT(hold({}).swing, stroke) << "B.1's gain, 4.2's minimal friction: from stop to stop";
  EXPECT_LT(hold(cylinder("0.9", "12")).swing, 0.01 * inch) << "damped a lot";

  EXPECT_LT(hold(cylinder("0.01", "0.02")).swing, 0.1 * inch) << "the flow alone";
  EXPECT_GT(hold(cylinder("0.01", "0.02") + no_feedforward).swing, 0.5 * inch);
  EXPECT_LT(hold(cylinder("0.1", "3")).swing, 0.01 * inch);
  EXPECT_GT(hold(cylinder("0.1", "3") + no_feedforward).swing, 0.1 * inch);
  EXPECT_LT(hold(cylinder("0.05", "3") + no_feedforward).swing, 0.01 * inch);
}

// Nearly all of the air that it uses passes straight through.
TEST(Appendix, TheStandingFlowTakesMoreAirThanTheWalk) {
  const analysis::Summary with = summary_of("cylinder-following"),
                          without = summary_of("cylinder-following", no_feedforward);
  const char *cylinder = "cylinder.air_used_kg", *all = "air_used_kg",
             *error = "cylinder.tracking_rms_m";
  EXPECT_GT(*with.find(cylinder), 30 * *without.find(cylinder));
  EXPECT_GT(*with.find(cylinder), 5 * (*with.find(all) - *with.find(cylinder)));
  EXPECT_LT(*without.find(cylinder), 0.3 * (*without.find(all) - *without.find(cylinder)));
  EXPECT_LT(*without.find(error), *with.find(error));
}

// --- pulses -------------------------------------------------------------------------------------

// 5.2: a higher rate would be smoother, except for the switching time of the valves.
TEST(Appendix, ValveDelaysLimitTheRateOfPulses) {
  const char *distance = "trolley.distance_m", *switchings = "valves.switchings_per_step";
  const analysis::Summary at_100 = summary_of("walk-test-1"), at_151 = summary_of("pwm-151"),
                          at_200 = summary_of("pwm-200");
  EXPECT_GT(*at_100.find(distance), *at_151.find(distance) + 10 * inch);
  EXPECT_GT(*at_151.find(distance), *at_200.find(distance) + 10 * inch);
  EXPECT_GT(*at_200.find(switchings), 1.8 * *at_100.find(switchings));
  EXPECT_GT(*summary_of("pwm-200", instant_valves).find(distance), 50 * inch);

  // Two laws in a period, each too long for a hundredth of it.
  const double periods = *at_151.find("sequence_duration_s") / 6.6e-3;
  EXPECT_NEAR(*at_151.find("low_level.overruns"), 2 * periods, 6);
  EXPECT_EQ(at_100.find("low_level.overruns"), nullptr);
}

TEST(Appendix, ADeadBandSavesAirAndSwitchingsAndThenTheWalk) {
  const auto with = [](const std::string& band) {
    return summary_of("walk-test-1", {"low_level.dead_band=" + band + " %"});
  };
  const analysis::Summary none = with("0"), small = with("2"), large = with("10");
  EXPECT_LT(*small.find("valves.switchings"), 0.95 * *none.find("valves.switchings"));
  EXPECT_GT(*small.find("trolley.distance_m"), 53 * inch);
  EXPECT_LT(*large.find("air_used_kg"), 0.7 * *none.find("air_used_kg"));
  EXPECT_LT(*large.find("trolley.distance_m"), 20 * inch);
}

}  // namespace
}  // namespace sinew::appendix_test
