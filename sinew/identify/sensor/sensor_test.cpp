// A calibration recovers the sensor with its uncertainty, and refuses unusable data.
#include "sinew/identify/sensor/sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/units/literals.h"

namespace sinew::identify::sensor_test {
namespace {

using namespace units::literals;

constexpr CountScale converter{};

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

std::string message(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "none";
}

SensorData parse(const std::string& text, Source source = {}) {
  source.path = "weights.csv";
  return parse_sensor_data(text, source, converter);
}

Calibration calibrate(const std::string& text) { return identify_sensors(parse(text), converter); }

// Weights up to 16 lb and back, as in 4.4; `law` gives volts.
SensorData weights(unsigned seed, double noise, const std::function<double(double)>& law) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  SensorData data{.file = "synthetic", .display = "lbf", .sensors = {{.name = "gage"}}};
  for (int i = 0; i <= 32; ++i) {
    const double load = (i <= 16 ? i : 32 - i) * 1.0_lbf;
    data.known.push_back(load);
    data.lines.push_back(i + 2);
    data.sensors[0].volts.push_back(law(load) + noise * normal(random));
  }
  return data;
}

// --- table 4-1; its data are lost, so these are synthetic ---

TEST(Sensor, Table41ComesBackWithItsErrorsFromTheAverage) {
  std::string text = "load [lb],one [V],two [V],three [V],four [V]\n";
  for (int load = 0; load <= 16; ++load)
    text += std::to_string(load) + "," + std::to_string(0.1689 * load) + "," +
            std::to_string(0.1610 * load) + "," + std::to_string(0.1694 * load) + "," +
            std::to_string(0.1809 * load) + "\n";
  const Calibration c = calibrate(text);
  const double scales[] = {0.1689, 0.1610, 0.1694, 0.1809};
  const double errors[] = {0.7, 5.6, 0.4, -6.0};
  ASSERT_EQ(c.sensors.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(c.sensors[i].report.best().model, "proportional");
    EXPECT_NEAR(c.sensors[i].sensitivity * 1.0_lbf, scales[i], 1e-6);
    EXPECT_NEAR(100 * c.sensors[i].deviation, errors[i], 0.06);  // printed to 0.1, from 0.1700
  }
  EXPECT_NEAR(c.average * 1.0_lbf, 0.1700, 0.0001);
}

TEST(Sensor, TwoPointsGiveTheAngleSensorsScaleAndNoInterval) {
  // 4.5: the joint is turned by 90 degrees.
  const double turned = 1.0 + 90.0_deg / 1.147;
  const Calibration c = calibrate("angle [deg],hip [V]\n0,1\n90," + std::to_string(turned) + "\n");
  EXPECT_NEAR(1 / c.sensors[0].sensitivity, 1.147, 1e-5);
  EXPECT_NEAR(c.sensors[0].at_rest, 1.0, 1e-9);
  EXPECT_TRUE(std::isinf(c.sensors[0].sensitivity_uncertainty));
  EXPECT_FALSE(c.sensors[0].report.best().held_out);
}

// --- laws ---

TEST(Sensor, IntervalsCoverTheTruth) {
  const double truth = 0.17 / 1.0_lbf;
  int covered = 0;
  double bias = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const SensorData data = weights(seed, 0.01, [&](double load) { return 0.05 + truth * load; });
    const SensorResult r = identify_sensors(data, converter).sensors[0];
    covered += std::abs(r.sensitivity - truth) <= r.sensitivity_uncertainty;
    bias += (r.sensitivity / truth - 1) / 200;
  }
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 198);
  EXPECT_LT(std::abs(bias), 0.001);
}

TEST(Sensor, TheSimplestLawThatPredictsIsChosen) {
  const struct {
    const char* name;
    std::function<double(double)> law;
  } cases[] = {{"proportional", [](double x) { return 0.04 * x; }},
               {"line", [](double x) { return 0.2 + 0.04 * x; }},
               {"quadratic", [](double x) { return 0.2 + 0.04 * x + 2e-4 * x * x; }}};
  for (const auto& c : cases)
    for (const double noise : {0.0, 0.003})
      EXPECT_EQ(
          identify_sensors(weights(3, noise, c.law), converter).sensors[0].report.best().model,
          c.name)
          << noise;
}

TEST(Sensor, RestMovesTheOffsetAndNotTheScale) {
  const SensorData data = weights(1, 0.01, [](double x) { return 0.3 + 0.04 * x; });
  const SensorResult a = identify_sensors(data, converter).sensors[0];
  const SensorResult b = identify_sensors(data, converter, 20).sensors[0];
  EXPECT_NEAR(a.sensitivity, b.sensitivity, 1e-9);
  EXPECT_NEAR(b.at_rest, a.at_rest + 20 * a.sensitivity, 1e-6);
}

TEST(Sensor, CountsAndVoltsAreTheSameSensor) {
  std::string volts = "load [N],gage [V]\n", counts = "load [N],gage [count]\n";
  for (int i = 0; i < 20; ++i) {
    const int count = 100 + 190 * i + i % 3;
    volts += std::to_string(i) + "," + std::to_string(count * 5.0 / 4096) + "\n";
    counts += std::to_string(i) + "," + std::to_string(count) + "\n";
  }
  const SensorResult a = calibrate(volts).sensors[0], b = calibrate(counts).sensors[0];
  EXPECT_NEAR(a.sensitivity, b.sensitivity, 1e-6 * b.sensitivity);
  EXPECT_EQ(b.step, 5.0 / 4096);
}

TEST(Sensor, MassesHangWithTheirWeight) {
  const SensorData kg = parse("load [kg],gage [V]\n0,0\n2,1\n");
  EXPECT_NEAR(kg.known[1], 2 * 9.80665, 1e-12);
  const SensorData lb = parse("load [lb],gage [V]\n0,0\n2,1\n");
  EXPECT_NEAR(lb.known[1], 2.0_lbf, 1e-12);
  EXPECT_EQ(lb.display, "lbf");
}

// A sensor that clips is calibrated with the rest of its range.
TEST(Sensor, ReadingsAtTheEndAreLeftOut) {
  const auto law = [](double x) { return 0.1 + 0.05 * x; };
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SensorData data = weights(seed, 0.01, law);
    for (double& v : data.sensors[0].volts) v = std::min(v, converter.top());
    for (double& v : data.sensors[0].volts) v = std::min(v, 3.0);  // 13.04 lbf
    const SensorResult r = identify_sensors(data, converter).sensors[0];
    EXPECT_NEAR(r.sensitivity, 0.05, 0.02 * 0.05);
    ASSERT_EQ(r.report.notes.size(), 1u);
    EXPECT_TRUE(says(r.report.notes[0], "at 3 V, the end")) << r.report.notes[0];
  }
}

TEST(Sensor, ASecondCalibrationScoresTheFirst) {
  const auto law = [](double x) { return 0.1 + 0.05 * x; };
  const SensorData first = weights(1, 0.01, law), second = weights(2, 0.01, law);
  const Fit line = identify_sensors(first, converter, 0, &second).sensors[0].report.fits[1];
  EXPECT_NEAR(line.held_out->rmse, 0.01, 0.004);
  const SensorData drifted = weights(2, 0.01, [&](double x) { return law(x) + 0.1; });
  const Fit off = identify_sensors(first, converter, 0, &drifted).sensors[0].report.fits[1];
  EXPECT_NEAR(off.held_out->rmse, 0.1, 0.01);
}

TEST(Sensor, ATypingErrorIsReportedWithItsLine) {
  SensorData data = weights(1, 0.005, [](double x) { return 0.05 * x; });
  data.sensors[0].volts[7] += 0.9;
  const Calibration c = identify_sensors(data, converter);
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_TRUE(says(c.warnings[0], "synthetic:9: gage")) << c.warnings[0];
  EXPECT_TRUE(identify_sensors(weights(1, 0.005, [](double x) { return 0.05 * x; }), converter)
                  .warnings.empty());
}

// --- refusals ---

TEST(Sensor, WhatCannotBeCalibratedIsRefused) {
  const struct {
    const char* text;
    const char* part;
  } cases[] = {
      {"load [N],gage [V]\n10,1\n", "weights.csv: gage: found one reading"},
      {"load [N],gage [V]\n10,1\n10,1.1\n10,1.2\n", "found one known value throughout, 10 N"},
      {"load [N],gage [V]\n1,2\n2,2\n3,2\n4,2\n", "2 V throughout"},
      {"load [N],gage [V]\n1,1\n2,3\n3,0\n4,1.5\n5,2\n6,0.1\n", "does not follow"},
      {"load [N],gage [count]\n1,4095\n2,4095\n3,4095\n", "3 of 3 readings at an end"},
      {"load [N],gage [count]\n1,500\n2,4095\n3,4095\n", "full_scale=VOLTS"},
  };
  for (const auto& c : cases) {
    const std::string said = message([&] { calibrate(c.text); });
    EXPECT_TRUE(says(said, c.part)) << c.text << said;
  }
}

TEST(Sensor, WhatIsWrongWithAFileIsReported) {
  const struct {
    const char* text;
    const char* part;
  } cases[] = {
      {"weight [N],gage [V]\n1,2\n2,3\n", "weights.csv:1:1: known quantity: found none among"},
      {"load [N],gage\n1,2\n2,3\n", "no column in volts or counts"},
      {"load [N],force [N],gage [V]\n1,1,2\n2,2,3\n", "both load and force"},
      {"load [N],gage [V],gage [V]\n1,1,2\n2,2,3\n", "gage: found a second column of this name"},
      {"load [N],gage [V]\n1,2\n2,50\n", "weights.csv:3:1: gage: found 50 V"},
      {"load [N],gage [count]\n1,2\n2,5000\n", "0 to 4095, the counts of 12 bits"},
      {"load [psi],gage [V]\n1,2\n2,3\n", "load: found the unit \"psi\""},
      {"time [s],load [N],gage [V]\n0,1,2\n2,2,3\n1,3,4\n", "weights.csv:4:1: time"},
      {"load [N],gage [V]\n1,2\n2,nan\n", "drop_incomplete=true"},
  };
  for (const auto& c : cases) {
    const std::string said = message([&] { parse(c.text); });
    EXPECT_TRUE(says(said, c.part)) << c.text << said;
  }
  EXPECT_EQ(parse("w,g\n1,2\n2,3\n", {.names = {{"load", "w"}}, .units = {{"w", "N"}, {"g", "V"}}})
                .sensors[0]
                .name,
            "g");
}

}  // namespace
}  // namespace sinew::identify::sensor_test
