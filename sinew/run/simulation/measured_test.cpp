// Static tests on the stand as an operator records them: loops, creep, trapped air.
#include "sinew/experiment/measured.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sinew/actuator/braid.h"
#include "sinew/run/simulation/run.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::run::measured_test {
namespace {

using units::inch, units::psi, units::pound_force;
using Of = robot::Transducer::Of;

const std::string folder = sinew::test::source_dir() + "/experiments/rig/";

struct Done {
  experiment::Experiment experiment;
  signals::Table table;
  experiment::Notes notes;

  const std::vector<double>& of(Of what) const {
    for (std::size_t s = 0; s < experiment.stand->sensors.size(); ++s)
      if (experiment.stand->sensors[s].of == what) return notes.values[s];
    throw std::logic_error("no such sensor");
  }
  // The true values at the same instants.
  double truth(const std::string& topic, double t) const {
    const signals::Series& s = *table.find(topic);
    const auto at = std::ranges::lower_bound(s.time_ns, std::llround(t * 1e9));
    return s.columns[0][static_cast<std::size_t>(at - s.time_ns.begin())];
  }
};

Done done(const std::string& name, const std::vector<std::string>& sets = {}) {
  Done t{experiment::load(folder + name + ".toml", sets), {}, {}};
  t.table = run(t.experiment).table;
  t.notes = experiment::notes(t.experiment, t.table);
  return t;
}

// Up to 15 lb and back: 30 readings form a loop, in which dry friction makes the muscle longer on
// the way back; without friction it closes to the potentiometer's noise.
TEST(Measured, WeightsMakeALoop) {
  const std::vector<std::string> quiet{"sensor.length.noise=0 in"};
  for (const bool friction : {true, false}) {
    std::vector<std::string> sets = quiet;
    if (!friction) sets.push_back("actuator.equations.loss.coulomb_length=0 in");
    const Done t = done("weights-60", sets);
    const std::vector<double>&length = t.of(Of::length), &force = t.of(Of::force);
    ASSERT_EQ(length.size(), 30u);
    EXPECT_NEAR(*std::ranges::max_element(force) / pound_force, 15.1, 0.05);
    const std::size_t top =
        static_cast<std::size_t>(std::ranges::max_element(force) - force.begin());
    double widest = 0;
    for (std::size_t up = 2; up < top - 1; ++up) {
      const std::size_t down = 2 * top - up;
      if (down >= force.size()) continue;
      EXPECT_NEAR(force[down], force[up], 0.06 * pound_force);
      widest = std::max(widest, length[down] - length[up]);
    }
    if (friction)
      EXPECT_GT(widest, 0.004 * inch);
    else
      EXPECT_LT(widest, 0.0012 * inch);
  }
}

// A converter has no reading before its first conversion; its count, 0, would be a length of
// 2.2 in.
TEST(Measured, HasNoRowBeforeTheFirstConversion) {
  const Done t = done("creep", {"duration=0.5 s", "measured.period=10 ms"});
  ASSERT_FALSE(t.notes.time.empty());
  EXPECT_NEAR(t.notes.time[0], t.experiment.stand->drive.period, 1e-9);
  for (const double length : t.of(Of::length)) EXPECT_NEAR(length / inch, 3.3, 0.02);
}

// Readings equal the true values, to the transducer's noise, counts and divisions.
TEST(Measured, ReadsTheTruth) {
  const Done t = done("sealed-bpa");
  const std::vector<double>&length = t.of(Of::length), &pressure = t.of(Of::pressure);
  ASSERT_GT(length.size(), 700u);
  double square = 0;
  for (std::size_t i = 1; i < length.size(); ++i) {
    // Read within the period of 40 ms before the instant.
    const double off = length[i] - t.truth("/true/stand/length", t.notes.time[i] - 0.02);
    square += off * off / static_cast<double>(length.size());
    EXPECT_NEAR(off, 0, 0.012 * inch);
    EXPECT_NEAR(pressure[i] + t.experiment.air.atmosphere,
                t.truth("/true/muscle/bpa/pressure", t.notes.time[i] - 0.02), 2.5 * psi);
  }
  EXPECT_NEAR(std::sqrt(square), 0.002 * inch, 0.0006 * inch);
}

// Trapped air at constant temperature: P V is constant, in the muscle and in the cylinder (6.3).
TEST(Measured, AirShutInObeysBoyle) {
  for (const char* name : {"sealed-bpa", "sealed-cylinder"}) {
    const Done t = done(name);
    const experiment::Stand::Element& e = t.experiment.stand->element;
    const auto volume = [&](double length) {
      if (e.cylinder.bore > 0)
        return e.cylinder.dead_volume + 0.25 * M_PI *
                                            (e.cylinder.bore * e.cylinder.bore -
                                             e.cylinder.rod_diameter * e.cylinder.rod_diameter) *
                                            (e.cylinder.stroke - length);
      return actuator::volume(t.experiment.actuators[0].braid, length) + e.external_volume;
    };
    const std::string p = "/true/muscle/" + e.name + "/pressure";
    const double start = t.truth(p, 0) * volume(t.truth("/true/stand/length", 0));
    for (double at = 1; at < 40; at += 1)
      EXPECT_NEAR(t.truth(p, at) * volume(t.truth("/true/stand/length", at)) / start, 1, 1e-9)
          << name;
  }
}

// At one length the muscle pulls less while it is filled than while it is vented; without friction
// the branches coincide.
TEST(Measured, FillAndVentPartAtOneLength) {
  for (const bool memory : {true, false}) {
    std::vector<std::string> sets{"actuator.with-memory.creep.share=[\"0 %\", \"0 %\"]",
                                  "actuator.with-memory.loss.coulomb_length=0 in"};
    if (!memory)
      for (const char* key : {"half_width", "width_per_contraction"})
        sets.push_back(std::string("actuator.with-memory.hysteresis.") + key + "=0 psi diff");
    const Done t = done("isometric", sets);
    // Force over pressure, filling and venting.
    std::vector<std::pair<double, double>> fill;
    double widest = 0, narrowest = 1e9;
    for (double at = 0.4; at < 24.9; at += 0.5) {
      const double p = t.truth("/true/muscle/bpa/pressure", at),
                   f = t.truth("/true/stand/force", at);
      if (at < 12.4) {
        if (fill.empty() || p > fill.back().first + 1) fill.emplace_back(p, f);
        continue;
      }
      if (p < 2e5 || p > 5.5e5) continue;
      const auto above = std::ranges::lower_bound(fill, p, {}, &std::pair<double, double>::first);
      const auto below = above - 1;
      const double share = (p - below->first) / (above->first - below->first);
      const double gap = f - (below->second + share * (above->second - below->second));
      widest = std::max(widest, gap);
      narrowest = std::min(narrowest, gap);
    }
    if (memory) {
      EXPECT_GT(narrowest, 1.0);  // [N]
      EXPECT_LT(widest, 8.0);
    } else {
      EXPECT_LT(std::max(widest, -narrowest), 0.5);
    }
  }
}

// After a step of pressure the tension grows by the delayed shares.
TEST(Measured, CreepGrows) {
  const Done t = done("creep");
  const double early = t.truth("/true/stand/force", 1.21),
               late = t.truth("/true/stand/force", 59.9);
  EXPECT_GT(late / early, 1.06);
  EXPECT_LT(late / early, 1.0855);
  EXPECT_EQ(t.truth("/true/muscle/bpa/pressure", 2), t.truth("/true/muscle/bpa/pressure", 59));
}

TEST(Measured, IsACsvWithUnits) {
  Done t = done("weights-60");
  std::istringstream in(experiment::measured_csv(t.experiment, t.table));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "time [s],length [m],force [N],pressure [Pa gauge]");
  std::getline(in, line);
  EXPECT_EQ(line.substr(0, 4), "0.4,");
  t.experiment.stand->sensors.clear();
  EXPECT_EQ(experiment::measured_csv(t.experiment, t.table), "");
}

}  // namespace
}  // namespace sinew::run::measured_test
