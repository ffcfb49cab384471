// Laws of the stand: statics, energy, sticking, schedules, convergence; and that previews change
// nothing.
#include "sinew/world/stand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/actuator/loss.h"
#include "sinew/world/test_stands.h"

namespace sinew::plant::stand_test {
namespace {

double weight(const StandSetup& s) { return s.load.mass.at(0) * s.load.gravity; }

TEST(Stand, HangsWhereTheMuscleCarriesTheLoad) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> gauge(30, 100), pounds(1, 15);
  for (int i = 0; i < 20; ++i) {
    StandSetup s = trapped(gauge(random), pounds(random));
    s.start.displacement = 0;
    Stand stand(s);
    const StandTruth at_start = stand.truth(0), later = stand.truth(0.5);
    EXPECT_NEAR(at_start.force, weight(s), 1e-9 * weight(s));
    EXPECT_TRUE(at_start.sticks);
    EXPECT_EQ(later.length, at_start.length);  // no creep
    EXPECT_EQ(later.velocity, 0);
  }
}

// d/dt (M v^2/2 - M g L + U) = 0 with the energy of a sealed polytrope and of the room's air,
// U = P V/(n - 1) + P_atm V_room, V_room = -V.
TEST(Stand, KeepsItsEnergyWithoutLosses) {
  StandSetup s = trapped(60, 6);
  s.muscle.actuator.loss = {};
  s.muscle.actuator.effectiveness = {};  // no share is lost, for the virtual work of [22]
  const double mass = s.load.mass.at(0);
  const auto energy = [&](const StandTruth& x) {
    const double volume =
        actuator::volume(s.muscle.actuator.braid, x.length) + s.muscle.external_volume;
    return 0.5 * mass * x.velocity * x.velocity - mass * s.load.gravity * x.length +
           x.pressure * volume / 0.4 + s.air.atmosphere * volume;
  };
  Stand stand(s);
  const double at_start = energy(stand.truth(0));
  double most = 0, swing = 0;
  for (double t = 0; t < 2; t += 0.0137) {
    const StandTruth x = stand.truth(t);
    most = std::max(most, std::fabs(energy(x) - at_start));
    swing = std::max(swing, 0.5 * mass * x.velocity * x.velocity);
  }
  EXPECT_GT(swing, 0.01);
  EXPECT_LT(most, 1e-7 * swing);
}

// Dry friction alone on a linear spring reduces the amplitude by 4 Q per period: a closed form.
TEST(Stand, DryFrictionTakesFourQPerPeriod) {
  StandSetup s = trapped(0, 5);
  s.muscle.actuator.loss = {.coulomb_length = 1.0,
                            .coulomb_scale = actuator::Loss::Scale::constant,
                            .coulomb_stiffness = 0.5};  // 0.5 N
  s.muscle.actuator.bladder = {.stiffness = 4000, .rest_length = 0.07};
  s.muscle.actuator.effectiveness.scale = 0;  // only the spring pulls
  s.start = {
      .pressure = s.air.atmosphere, .length = 0.07 + weight(s) / 4000, .displacement = 0.003};
  const double rest = s.start.length, q = 0.5 / 4000;
  const double period = 2 * std::numbers::pi * std::sqrt(s.load.mass.at(0) / 4000);
  Stand stand(s);
  for (int n = 0; n <= 5; ++n) {
    const StandTruth x = stand.truth(n * period);
    EXPECT_NEAR(x.length - rest, 0.003 - 4 * q * n, 1e-10) << n;
  }
  // Twelve half periods bring it to where 0.5 N hold it.
  const StandTruth at_rest = stand.truth(20 * period);
  EXPECT_TRUE(at_rest.sticks);
  EXPECT_NEAR(at_rest.length, rest, q + 1e-12);
  EXPECT_NEAR(at_rest.force, weight(s), 1e-12);
}

// The volume of hose and fittings does not affect the equilibrium at constant pressure, even if it
// is 0; it does affect the oscillation.
TEST(Stand, HangsTheSameWithoutHoseAndFittings) {
  StandSetup with = trapped(60, 6), without = with;
  without.muscle.external_volume = 0;
  ASSERT_GT(with.muscle.external_volume, 0);
  EXPECT_NEAR(hanging_length(without), hanging_length(with), 1e-12);
  Stand a(with), b(without);
  EXPECT_GT(std::fabs(a.truth(0.1).length - b.truth(0.1).length), 1e-5);
  for (int i = 0; i < 2000; ++i) {
    const StandTruth x = b.truth(i * 1e-3);
    ASSERT_TRUE(std::isfinite(x.length) && std::isfinite(x.pressure)) << i << " ms";
    // Trapped air: its mass is constant.
    ASSERT_NEAR(x.air, b.truth(0).air, 1e-15) << i << " ms";
  }
}

TEST(Stand, BreaksLooseWhereTheLoadExceedsTheBound) {
  StandSetup s = trapped(60, 6);
  s.start.displacement = 0;
  const double length = hanging_length(s);
  const double bound =
      actuator::coulomb_bound(s.muscle.actuator, length, 60 * psi, s.air.atmosphere, 0);
  for (const auto& [share, moves] : {std::pair{0.99, false}, {1.01, true}}) {
    for (const double way : {1.0, -1.0}) {
      s.load.force = Schedule({{0.0, 0.0}, {0.1, way * share * bound}});
      Stand stand(s);
      const double moved = stand.truth(0.3).length - length;
      EXPECT_EQ(std::fabs(moved) > 1e-9, moves) << share << " " << way << " " << moved;
      if (moves) {
        EXPECT_GT(moved * way, 0);
      }
    }
  }
}

// [33] as printed never sticks, but converges to the motion with a true stick as the step shrinks.
TEST(Stand, TheSignOfTheSpeedConvergesToStick) {
  StandSetup s = trapped(60, 6);
  const double stuck = Stand(s).truth(0.5).length;
  s.muscle.actuator.loss.stick = false;
  const auto error = [&](double step) {
    s.step = step;
    return std::fabs(Stand(s).truth(0.5).length - stuck);
  };
  const double coarse = error(1e-3), fine = error(1e-5);
  EXPECT_GT(coarse, 1e-8);
  EXPECT_LT(fine, 0.2 * coarse);
  EXPECT_LT(fine, 2e-6);
}

TEST(Stand, StepHalvingMovesNothing) {
  const auto worst = [](StandSetup s, double frequency, double open) {
    s.step = 1e-3;
    StandSetup half = s;
    half.step = 0.5 * s.step;
    Stand a(s), b(half);
    double most = 0;
    const auto period = static_cast<signals::Tick>(std::lround(1e4 / frequency));
    const auto shut = static_cast<signals::Tick>(std::lround(1e4 * open));
    for (signals::Tick t = 0; t < 20000; t += 5) {
      for (Stand* stand : {&a, &b}) {
        if (s.charge.mode != Charge::Mode::valves) break;
        if (t % period == 0) stand->drive({.at = t, .open = true});
        if (t % period == shut) stand->drive({.at = t, .open = false});
      }
      const double at = 1e-4 * static_cast<double>(t);
      most = std::max(most, std::fabs(a.truth(at).length - b.truth(at).length));
    }
    return most / inch;
  };
  EXPECT_LT(worst(trapped(60, 6), 1, 0), 1e-6);
  EXPECT_LT(worst(trapped(80, 11), 1, 0), 1e-6);
  for (const double pounds : {5.0, 15.0}) EXPECT_LT(worst(pulsed(pounds), 25, 0.017), 1e-5);
  for (const double pounds : {1.0, 5.0, 15.0}) EXPECT_LT(worst(pulsed(pounds), 50, 0.007), 1e-5);
}

// The pieces between two nodes are as long as the accuracy allows: 3 s of trapped air in nodes of
// 10 ms, against pieces a hundred times shorter than needed.
TEST(Stand, IsAsExactAsRequested) {
  const auto lengths = [](double accuracy) {
    StandSetup s = trapped(60, 6);
    s.step = 1e-2;
    s.accuracy = accuracy;
    Stand stand(s);
    std::vector<double> out;
    for (int i = 1; i <= 300; ++i) out.push_back(stand.truth(1e-2 * i).length);
    return out;
  };
  const std::vector<double> exact = lengths(1e-11);
  const auto error = [&](double accuracy) {
    const std::vector<double> found = lengths(accuracy);
    double most = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      most = std::max(most, std::fabs(found[i] - exact[i]));
    return most / (0.2 * inch);
  };
  const double coarse = error(1e-4), middle = error(1e-6), fine = error(1e-8);
  EXPECT_LT(coarse, 100 * 1e-4);  // of some hundred radians
  EXPECT_LT(middle, 100 * 1e-6);
  EXPECT_LT(fine, 100 * 1e-8);
  EXPECT_LT(fine, 0.1 * middle);
  EXPECT_LT(middle, 0.1 * coarse);
}

// Appendix A's flow jumps by .38 % where it chokes. With the step cut there, steps of the usual
// accuracy and steps a thousand times finer give one mass of air.
TEST(Stand, CutsItsStepsWhereAppendixAsFlowJumps) {
  const auto passed = [](double accuracy, double pounds) {
    StandSetup s = pulsed(pounds);
    s.muscle.inlet.flow.law = gas::Flow::Law::appendix_a;
    s.accuracy = accuracy;
    Stand stand(s);
    std::vector<double> out;
    for (signals::Tick t = 0; t < 10000; t += 200) {
      stand.drive({.at = t, .open = true});
      stand.drive({.at = t + 70, .open = false});
      const StandTruth x = stand.truth(1e-4 * static_cast<double>(t + 200));
      out.push_back(x.air_in), out.push_back(x.air_out);
    }
    return out;
  };
  for (const double pounds : {1.0, 5.0, 15.0}) {
    const std::vector<double> exact = passed(1e-11, pounds), usual = passed(3.4e-7, pounds);
    double most = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      most = std::max(most, std::fabs(usual[i] / exact[i] - 1));
    EXPECT_LT(most, 1e-7) << pounds << " lb";
  }
}

TEST(Stand, LooksAndStrayEdgesChangeNoBit) {
  Stand alone(pulsed(5)), watched(pulsed(5));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> later(0, 2e-3);
  double looked = 0;
  for (signals::Tick t = 0; t < 5000; ++t) {
    for (Stand* stand : {&alone, &watched})
      if (t % 400 == 0 || t % 400 == 170) stand->drive({.at = t, .open = t % 400 == 0});
    for (looked = std::max(looked, 1e-4 * static_cast<double>(t));
         looked < 1e-4 * static_cast<double>(t + 1); looked += later(random))
      (void)watched.truth(looked);
  }
  const StandTruth a = alone.truth(0.6), b = watched.truth(0.6);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.pressure, b.pressure);
  EXPECT_EQ(a.air_in, b.air_in);
}

TEST(Stand, AirIsNeitherMadeNorLost) {
  for (const bool hose : {false, true}) {
    StandSetup s = pulsed(5);
    s.muscle.leak.area = 1e-9;
    if (hose)
      s.muscle.hose = {
          .law = gas::Hose::Law::pipe, .length = 0.5, .inner_diameter = 4e-3, .volume = 6e-6};
    Stand stand(s);
    const double at_start = stand.truth(0).all_air;
    for (signals::Tick t = 0; t < 10000; t += 200)
      stand.drive({.at = t, .open = (t / 200) % 2 == 0});
    const StandTruth x = stand.truth(1.2);
    EXPECT_GT(x.air_in, 5 * at_start);
    EXPECT_GT(x.air_leaked, 0);
    EXPECT_NEAR(x.all_air, at_start + x.air_in - x.air_out - x.air_leaked, 1e-12 * x.air_in);
    EXPECT_EQ(x.all_air > x.air, hose);
  }
}

// --- driven and regulated -----------------------------------------------------------------------

TEST(Stand, ATensileMachineSeesTheLawAndItsFriction) {
  StandSetup s = trapped(60, 5);
  s.load = {.mode = Load::Mode::driven};
  s.load.length = Schedule({{0, 0.075}, {1, 0.085}, {2, 0.085}, {3, 0.075}});
  s.charge = {.mode = Charge::Mode::regulated, .pressure = s.start.pressure};
  s.start = {};
  Stand stand(s);
  const actuator::Actuator& a = s.muscle.actuator;
  for (double t : {0.5, 1.5, 2.5}) {
    const StandTruth x = stand.truth(t);
    const double rate = t < 1 ? 0.01 : t < 2 ? 0.0 : -0.01, side = t < 2 ? 1 : -1;
    EXPECT_DOUBLE_EQ(x.length, t < 1 ? 0.08 : t < 2 ? 0.085 : 0.08);
    EXPECT_NEAR(x.pressure, s.charge.pressure.at(0), 1e-6);
    const double bound = actuator::coulomb_bound(a, x.length, 60 * psi, s.air.atmosphere, 0);
    const double smooth = actuator::clamped_tension(a, x.length, rate, 60 * psi, s.air.atmosphere);
    EXPECT_NEAR(x.friction, side * bound, 1e-9);
    EXPECT_NEAR(x.force, smooth + side * bound, 1e-9);
  }
}

// The regulator's flow is the air for the change of volume.
TEST(Stand, ARegulatorKeepsTheBookOfItsAir) {
  StandSetup s = trapped(60, 5);
  s.load = {.mode = Load::Mode::driven, .length = 0.08};
  s.charge = {.mode = Charge::Mode::regulated,
              .pressure = Schedule({{0, 2e5}, {1, 6e5}, {1.5, 6e5}, {1.5, 3e5}})};
  s.start = {};
  Stand stand(s);
  const double volume = actuator::volume(s.muscle.actuator.braid, 0.08) + s.muscle.external_volume;
  const auto mass = [&](double p) { return gas::density(s.air, p) * volume; };
  const StandTruth up = stand.truth(1.2), down = stand.truth(2);
  EXPECT_NEAR(up.pressure, 6e5, 1e-6);
  EXPECT_NEAR(up.air_in, mass(6e5) - mass(2e5), 1e-9 * mass(6e5));
  EXPECT_NEAR(down.pressure, 3e5, 1e-6);
  EXPECT_NEAR(down.air_out, mass(6e5) - mass(3e5), 1e-9 * mass(6e5));
}

// A load that is added in steps comes to rest after each, and the forces are in balance.
TEST(Stand, WeightsMayBeAddedAndTakenAway) {
  StandSetup s = trapped(60, 1);
  s.load.mass = Schedule({{0, units::pound_mass},
                          {3, units::pound_mass},
                          {3, 2 * units::pound_mass},
                          {6, 2 * units::pound_mass},
                          {6, units::pound_mass}});
  s.muscle.actuator.loss.viscous *= 5;
  s.start.displacement = 0;
  Stand stand(s);
  const StandTruth one = stand.truth(2.9), two = stand.truth(5.9), again = stand.truth(8.9);
  for (const StandTruth& x : {one, two, again}) EXPECT_TRUE(x.sticks);
  EXPECT_NEAR(one.force, weight(s), 1e-9);
  EXPECT_NEAR(two.force, 2 * weight(s), 1e-9);
  EXPECT_GT(two.length, one.length + 1e-3);
  EXPECT_GT(again.length, one.length);  // hysteresis: friction keeps part of the extension
}

// --- the air cylinder ---------------------------------------------------------------------------

StandSetup with_cylinder() {
  StandSetup s;
  s.cylinder = {.mode = air::Cylinder::Mode::single_acting,
                .bore = 0.02,
                .rod_diameter = 0.006,
                .stroke = 0.05,
                .dead_volume = {2e-6, 0}};
  s.load = {.mode = Load::Mode::driven};
  s.load.length = Schedule({{0, 0.01}, {1, 0.04}});
  s.start.pressure = 3e5;
  return s;
}

// Sealed: P V^n, and the force is that of the pressure on the annulus, without ends or friction.
TEST(Stand, ASealedCylinderIsAPolytropicSpring) {
  const StandSetup s = with_cylinder();
  Stand stand(s);
  const double ring = air::area(*s.cylinder, air::up);
  const auto volume = [&](double out) { return 2e-6 + ring * (0.05 - out); };
  for (double t : {0.0, 0.3, 1.0, 1.7}) {
    const StandTruth x = stand.truth(t);
    const double p = 3e5 * std::pow(volume(0.01) / volume(x.length), 1.4);
    EXPECT_NEAR(x.pressure, p, 1e-9 * p);
    EXPECT_NEAR(x.force, (p - s.air.atmosphere) * ring, 1e-9 * p * ring);
  }
}

TEST(Stand, ACylinderOscillatesAsItsStiffnessPredicts) {
  StandSetup s = with_cylinder();
  s.load = {.mass = 5 * units::pound_mass};
  const double ring = air::area(*s.cylinder, air::up);
  s.start = {.pressure = s.air.atmosphere + weight(s) / ring, .length = 0.02, .displacement = 1e-5};
  const double stiffness = 1.4 * s.start.pressure * ring * ring / (2e-6 + ring * (0.05 - 0.02));
  const double period = 2 * std::numbers::pi * std::sqrt(5 * units::pound_mass / stiffness);
  Stand stand(s);
  EXPECT_NEAR(stand.truth(0.5 * period).length, 0.02 - 1e-5, 1e-8);
  EXPECT_NEAR(stand.truth(period).length, 0.02 + 1e-5, 1e-8);
}

// --- the port -----------------------------------------------------------------------------------

TEST(Stand, ReadsInCountsOfItsTransducers) {
  StandSetup s = trapped(60, 6);
  s.seed = 2;
  s.transducers = {
      {.name = "length", .of = Transducer::Of::length, .low = 0.05, .high = 0.11},
      {.name = "cell", .of = Transducer::Of::force, .low = 0, .high = 20},
      {.name = "gauge", .of = Transducer::Of::pressure, .low = 0, .high = 7e5},
      {.name = "noisy", .of = Transducer::Of::length, .low = 0.05, .high = 0.11, .noise = 1e-4}};
  Stand stand(s);
  const signals::Conversion all[] = {{{0}, 0, 1}, {{1}, 0, 2}, {{2}, 0, 3}, {{3}, 0, 4}};
  ASSERT_EQ(stand.start({.period = 100, .conversions = all}), signals::Status::ok);
  const StandTruth x = stand.truth(0.05);
  const auto read = [&](std::uint8_t i) { return stand.read({i}, 500 + i + 1); };
  EXPECT_NEAR(quantity(s.transducers[0], read(0).counts), x.length, 0.06 / 4095 / 2 + 1e-12);
  EXPECT_EQ(read(1).counts, 4095);  // 6 lb is more than 20 N
  EXPECT_NEAR(quantity(s.transducers[2], read(2).counts), x.pressure - s.air.atmosphere, 86);
  EXPECT_NE(read(3).counts, read(0).counts);
  EXPECT_EQ(read(3).counts, read(3).counts);
  EXPECT_EQ(stand.read({4}, 505).status, signals::Status::invalid);
  EXPECT_EQ(stand.drive({.at = 600, .open = true}), signals::Status::invalid);  // sealed
  EXPECT_EQ(stand.stop(600), signals::Status::ok);
  EXPECT_EQ(read(0).status, signals::Status::ended);
}

TEST(Stand, RefusesWhatIsNoStand) {
  const auto refusal = [](auto change) -> std::string {
    StandSetup s = trapped(60, 6);
    change(s);
    try {
      Stand stand(s);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "nothing";
  };
  EXPECT_EQ(refusal([](StandSetup&) {}), "nothing");
  EXPECT_EQ(refusal([](StandSetup& s) { s.load.mass = {}; }),
            "test stand: a hanging load has a mass");
  EXPECT_EQ(refusal([](StandSetup& s) { s.load.mode = Load::Mode::driven; }),
            "test stand: a driven load has a length over time");
  EXPECT_EQ(refusal([](StandSetup& s) { s.load.mass = -1.0; }),
            "test stand: the mass must be above 0");
  EXPECT_EQ(refusal([](StandSetup& s) {
              s.load.force = Schedule({{1, 0}, {0, 0}});
            }),
            "test stand: the force goes back in time");
  EXPECT_EQ(refusal([](StandSetup& s) { s.charge.mode = Charge::Mode::regulated; }),
            "test stand: a regulated stand has a pressure over time");
  EXPECT_EQ(refusal([](StandSetup& s) { s.cylinder = air::Cylinder{}; }),
            "test stand: its cylinder is single-acting");
  EXPECT_EQ(refusal([](StandSetup& s) {
              s.muscle.actuator.long_end.stiffness = 0;
              s.muscle.actuator.effectiveness.scale = 0;
            }),
            "test stand: its load hangs nowhere between half the shortest length and 1.5 threads");
  EXPECT_EQ(refusal([](StandSetup& s) {
              s.muscle.external_volume = 0;
              s.load = {.mode = Load::Mode::driven,
                        .length = 1.01 * s.muscle.actuator.braid.thread_length};
              s.start = {.pressure = s.start.pressure};
            }).substr(0, 28),
            "test stand: at a length of 0");
  for (const double mass : {0.45, 5.0})
    EXPECT_EQ(refusal([=](StandSetup& s) {
                s.muscle.actuator.toe.tension = 13;
                s.muscle.actuator.short_end.law = actuator::ShortEnd::Law::zero;
                s.load.mass = mass;
              }).substr(0, 37),
              mass < 1 ? "test stand: by short_end.law = \"zero\"" : "nothing");
  for (const double length : {2.0, 0.01})
    EXPECT_EQ(refusal([=](StandSetup& s) { s.start.length = length; }),
              "test stand: it starts beyond half the shortest length and 1.5 threads");
}

TEST(Schedule, RunsStraightBetweenPointsAndJumpsWhereTwoMeet) {
  const Schedule s({{1, 2}, {3, 6}, {3, 1}, {4, 1}});
  EXPECT_EQ(s.at(0), 2);
  EXPECT_EQ(s.at(2), 4);
  EXPECT_EQ(s.at(3), 1);
  EXPECT_EQ(s.at(9), 1);
  EXPECT_EQ(s.piece(1).slope, 2);
  EXPECT_EQ(s.corner(0), 1);
  EXPECT_EQ(s.corner(1), 3);
  EXPECT_EQ(s.corner(4), std::numeric_limits<double>::infinity());
  EXPECT_EQ(Schedule().at(3), 0);
  EXPECT_EQ(Schedule(5.0).at(-1), 5);
}

}  // namespace
}  // namespace sinew::plant::stand_test
