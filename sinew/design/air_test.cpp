// A store's duration: monotone in what it has, between its limits, and as a simulated tank has it.

#include "sinew/design/air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/design/joint.h"
#include "sinew/design/methods.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/host/temporary_folder.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/units/constants.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::design::air_test {
namespace {

using test::message;
using units::psi;

constexpr double litre = 1e-3, bar = 1e5;
const gas::Air room;

AirStore random_store(std::mt19937_64& random) {
  std::uniform_real_distribution<> volume(0.1, 5), pressure(2, 310), lowest(0.02, 0.98);
  const double high = pressure(random) * bar + room.atmosphere;
  return {volume(random) * litre, high,
          room.atmosphere + lowest(random) * (high - room.atmosphere)};
}

// --- laws ---

TEST(DesignAir, MoreVolumePressureOrRangeNeverLastsShorter) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> more(1, 1.5), rate(1e-5, 1e-2), share(0, 1.2);
  for (int i = 0; i < 2000; ++i) {
    const AirStore store = random_store(random);
    const AirUse use{.per_second = rate(random), .per_step = 1e-4, .per_metre = 1e-3};
    const double compressor = share(random) * use.per_second;
    AirStore larger = store, fuller = store, lower = store;
    larger.volume *= more(random);
    fuller.pressure = std::min(fuller.pressure * more(random), gas::highest_stored_pressure);
    lower.lowest /= more(random);
    for (const auto yield : {yield_at_room_temperature, yield_without_heat}) {
      const Lasting of_store = lasting(yield(store, room).air, use, compressor);
      for (const AirStore& other : {larger, fuller, lower}) {
        const Lasting one = lasting(yield(other, room).air, use, compressor);
        EXPECT_GE(one.time, of_store.time);
        EXPECT_GE(one.steps, of_store.steps);
        EXPECT_GE(one.distance, of_store.distance);
      }
      EXPECT_GE(lasting(yield(store, room).air, use, 1.1 * compressor).time, of_store.time);
    }
  }
}

TEST(DesignAir, WarmWallsNeverLastShorter) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const AirStore store = random_store(random);
    const Yield warm = yield_at_room_temperature(store, room),
                cold = yield_without_heat(store, room);
    EXPECT_GE(warm.air, cold.air);
    EXPECT_GE(cold.air, 0);
    // A line gets less exergy than the store loses.
    EXPECT_LE(warm.air * gas::stream_exergy(room, store.lowest),
              gas::stored_exergy(room, store.volume, store.pressure) -
                  gas::stored_exergy(room, store.volume, store.lowest));
  }
}

TEST(DesignAir, AStoreBelowTheLineYieldsNothing) {
  const AirStore store{litre, 5 * bar, 7 * bar};
  EXPECT_EQ(yield_at_room_temperature(store, room).air, 0);
  EXPECT_EQ(yield_without_heat(store, room).air, 0);
}

TEST(DesignAir, FillingComesFirst) {
  const AirUse use{1e-3, 1e-3, 1e-2, 0.01};
  EXPECT_NEAR(lasting(0.11, use, 0).time, 100, 1e-9);
  EXPECT_NEAR(lasting(0.11, use, 0).steps, 100, 1e-9);
  EXPECT_NEAR(lasting(0.11, use, 0).distance, 10, 1e-9);
  EXPECT_EQ(lasting(0.005, use, 0).time, 0);
  EXPECT_TRUE(std::isinf(lasting(0.11, use, 1e-3).time));
  EXPECT_NEAR(lasting(0.11, use, 0.5e-3).time, 200, 1e-9);
}

TEST(DesignAir, AFillingIsAStrokeOfAJoint) {
  const actuator::Actuator a =
      experiment::load_machine_file(test::source_dir() + "/robots/leg/actuator.toml")
          .experiment.actuators.at(0);
  const JointTask task{.angles = 0.6, .pressure = 6 * bar, .external_volume = 1e-6};
  const JointDesign joint{a, 1, 0.025, 0.08};
  const double stroke = air_of_stroke(joint, task, room);
  EXPECT_NEAR(air_of_filling(a, 1e-6, length_at(joint, Arm::cam, -0.3),
                             length_at(joint, Arm::cam, 0.3), 6 * bar, room) /
                  stroke,
              1, 1e-12);
}

TEST(DesignAir, QuantilesAreBetweenTheNumbers) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({1, NAN, 3}, 0.5), 2);
  EXPECT_NEAR(quantile({0, 10}, 0.05), 0.5, 1e-12);
  EXPECT_EQ(quantile({7}, 0.95), 7);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

// --- against the simulator ---

class DesignAirOfRuns : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }

  run::StoredRun walk(const std::string& name, const std::vector<std::string>& sets = {},
                      const std::string& experiment = "walk-test-1") const {
    return run::run_and_store(
        {.experiment = test::source_dir() + "/experiments/" + experiment + ".toml",
         .folder = path(name),
         .sets = sets,
         .report = false});
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

  AirSettings settings(const std::string& name) const {
    return {.use = path(name), .volume = "0.5 L", .pressure = "300 psi gauge"};
  }

  const std::string folder_ = host::make_temporary_folder("sinew-design-air");
};

TEST_F(DesignAirOfRuns, TheConsumptionIsTheFallOfASimulatedTank) {
  const run::StoredRun ran = walk("tank", {"air.supply.kind=tank", "air.supply.volume=2 L",
                                           "air.supply.initial_pressure=300 psi gauge"});
  const double first = 300 * psi + room.atmosphere,
               last = *ran.summary.find("supply.end_tank_pressure_Pa"),
               used = *ran.summary.find("air_used_kg");
  // The end of the sequence is before the end of the run, where the muscles are vented.
  const gas::Air air = experiment::load_machine_file(path("tank/resolved.toml")).experiment.air;
  const double fallen = (first - last) * 2 * litre / (air.gas_constant * air.temperature);
  EXPECT_NEAR(fallen / used, 1, 1e-6);
  // The mass follows from the compressibility of the design.
  const double designed =
      gas::stored_mass(air, 2 * litre, first) - gas::stored_mass(air, 2 * litre, last);
  EXPECT_NEAR(designed / used, 1, 0.01);
  const Result out = design(settings("tank"));
  EXPECT_NEAR(out.of("air_use_kg_per_s").number * *ran.summary.find("sequence_duration_s"),
              *ran.summary.find("air_used_per_step_kg") * *ran.summary.find("steps"), 1e-12);
}

TEST_F(DesignAirOfRuns, StepsAreThoseOfTheSimulatedEndurance) {
  walk("walk");
  const run::StoredRun simulated = walk("endurance", {}, "endurance");
  const Result out = design(settings("walk"));
  EXPECT_NEAR(out.of("steps").number, *simulated.summary.find("supply.full_steps"), 1);
  EXPECT_NEAR(out.of("time_s").number, *simulated.summary.find("supply.full_time_s"), 3);
  EXPECT_LT(out.of("time_s").low, out.of("time_s").number);
  EXPECT_TRUE(out.warnings.empty());
  // The run on that tank starves and has a lower consumption.
  EXPECT_NE(design(settings("endurance")).warnings.at(0).find("the run's own tank was too empty"),
            std::string::npos);
}

TEST_F(DesignAirOfRuns, OneMoreMuscleLastsItsShareShorter) {
  walk("walk");
  const Result out = design(settings("walk"));
  // All of four muscles, and of five.
  const double time = out.of("time_s").number, filled = out.of("usable_air_kg").number;
  const double rate = out.of("air_use_kg_per_s").number, walked = time * rate;
  EXPECT_NEAR(out.of("one_more_muscle_kg_per_s").number, rate / 4, 1e-15);
  const double filling = 1.25 * (filled - walked);
  EXPECT_NEAR(out.of("one_more_muscle_time_s").number, (filled - filling) / (1.25 * rate) - time,
              1e-9);
}

TEST_F(DesignAirOfRuns, ATableHasASpread) {
  AirSettings s = settings("");
  s.line = "100 psi gauge";
  s.use = write("sweep.csv",
                "seed,air_used_per_step [g],air_used [g/m],steps,sequence_duration [s],status\n"
                "1,0.4,1.1,4,12,ok\n2,0.5,1.2,4,12,ok\n3,0.6,1.3,4,12,ok\n4,,,,,refused\n");
  const Result out = design(s);
  EXPECT_NEAR(out.of("air_use_per_step_kg").number, 5e-4, 1e-15);
  EXPECT_NEAR(out.of("air_use_per_step_kg").low, 4.1e-4, 1e-15);
  EXPECT_NEAR(out.of("air_use_kg_per_s").number, 5e-4 / 3, 1e-15);
  EXPECT_NEAR(out.of("air_use_kg_per_m").number, 1.2e-3, 1e-15);
  const double usable = out.of("usable_air_kg").number;
  EXPECT_NEAR(out.of("steps").high, quantile({usable / 4e-4, usable / 5e-4, usable / 6e-4}, 0.95),
              1e-9);
  EXPECT_LT(out.of("steps").low, out.of("usable_air_kg").low / 5e-4);
  EXPECT_NE(out.notes.at(0).find("1 of 4 rows"), std::string::npos);
}

TEST_F(DesignAirOfRuns, MusclesHaveACycle) {
  AirSettings s = settings("");
  s.use = test::source_dir() + "/robots/leg/actuator.toml";
  s.muscles = 18;
  s.cycles = "1 Hz", s.contraction = "20 %", s.length = "80 mm", s.line = "6 bar gauge";
  const Result one = design(s);
  s.muscles = 36;
  EXPECT_NEAR(design(s).of("time_s").number * 2 / one.of("time_s").number, 1, 1e-12);
  s.cycles = "0.5 Hz";
  EXPECT_NEAR(design(s).of("time_s").number / one.of("time_s").number, 1, 1e-12);
}

TEST_F(DesignAirOfRuns, ACompressorKeepsUpOrDoesNot) {
  walk("walk");
  AirSettings s{.use = path("walk"), .compressor = {"100 psi gauge, 6.2 L/min, 120 W"}};
  EXPECT_NE(design(s).warnings.at(0).find("91.3 % of the mean consumption"), std::string::npos);
  s.compressor = {"100 psi gauge, 12.4 L/min, 120 W"};
  const Result out = design(s);
  EXPECT_TRUE(out.warnings.empty());
  EXPECT_NEAR(out.of("compressor_power_W").number, 120 / (2 * 0.913), 0.2);
  s.compressor = {"60 psi gauge, 12.4 L/min"};
  EXPECT_NE(design(s).warnings.at(0).find("table ends below"), std::string::npos);
  s.volume = "1 L", s.pressure = "200 bar gauge";
  s.compressor = {"100 psi gauge, 12.4 L/min"};
  EXPECT_TRUE(std::isinf(design(s).of("time_s").number));
}

TEST_F(DesignAirOfRuns, AFullBottleHasANumberUpToTheLastPressure) {
  AirSettings s = settings("");
  s.use = write("table.csv", "air_used_per_step [g],status\n0.4,ok\n");
  s.line = "7 bar gauge", s.pressure = "31898647 Pa gauge";
  EXPECT_GT(design(s).of("steps").number, 0);
  EXPECT_GT(design(s).of("exergy_J").number, 0);
  // A room of more pressure leaves less for the gauge.
  walk("low", {"air.atmosphere=1.05 bar abs"});
  s.use = path("low");
  EXPECT_TRUE(message([&] {
                (void)design(s);
              }).starts_with("pressure: found \"31898647 Pa gauge\"; expected at most 318.95 bar"));
  s.pressure = "318.95 bar gauge";
  EXPECT_GT(design(s).of("steps").number, 0);
}

TEST_F(DesignAirOfRuns, ALowestPressureThatIsGivenWarnsOfTheDroop) {
  walk("walk");
  AirSettings s = settings("walk");
  s.droop = "14.5 psi diff", s.droop_flow = "10 L/min";
  EXPECT_TRUE(design(s).warnings.empty());
  s.lowest = "80 psi gauge";
  EXPECT_TRUE(design(s).warnings.empty());
  s.lowest = "99 psi gauge";
  EXPECT_NE(design(s).warnings.at(0).find("below the lowest pressure in the line"),
            std::string::npos);
}

TEST_F(DesignAirOfRuns, ACompressorThatGivesMoreThanItTakesIsDoubted) {
  walk("walk");
  const AirSettings s{.use = path("walk"), .compressor = {"10 bar gauge, 10 L/min, 1 W"}};
  EXPECT_NE(design(s).warnings.at(0).find("an isothermal efficiency of 3"), std::string::npos);
}

// --- wrong inputs ---

TEST_F(DesignAirOfRuns, RefusesInWords) {
  walk("walk");
  const auto of = [&](const auto& change) {
    AirSettings s = settings("walk");
    change(s);
    return message([&] { (void)design(s); });
  };
  const auto starts = [](const std::string& text, const std::string& with) {
    EXPECT_TRUE(text.starts_with(with)) << text;
  };
  AirSettings low = settings("walk");
  low.pressure = "5 bar gauge";
  starts(design(low).refused, "no design: the store has 5 bar gauge, the line needs 6.89 bar");
  starts(of([](AirSettings& s) { s.volume = "1,5 L"; }), "volume: found \"1,5 L\"");
  starts(of([](AirSettings& s) { s.pressure = ""; }), "pressure: found nothing");
  starts(of([](AirSettings& s) { s.pressure = s.volume = ""; }),
         "volume: found nothing; expected a store or a compressor");
  starts(of([](AirSettings& s) { s.pressure = "330 bar gauge"; }), "pressure: found \"330 bar");
  starts(of([](AirSettings& s) { s.pressure = "319 bar gauge"; }), "pressure: found \"319 bar");
  starts(of([](AirSettings& s) { s.line = "319 bar gauge"; }), "line: found \"319 bar");
  starts(of([](AirSettings& s) { s.lowest = "50 bar gauge"; }),
         "lowest: found \"50 bar gauge\"; expected at most the set pressure of the line, 6.89 bar");
  starts(of([](AirSettings& s) { s.muscles = 5; }),
         "muscles: found a setting for the file of a muscle; expected none");
  starts(of([](AirSettings& s) { s.cycles = "3 Hz"; }), "cycles: found a setting");
  starts(of([](AirSettings& s) { s.contraction = "30 %"; }), "contraction: found a setting");
  const auto of_muscle = [&](const auto& change) {
    return of([&](AirSettings& s) {
      s.use = test::source_dir() + "/robots/leg/actuator.toml";
      s.muscles = 1, s.cycles = "1 Hz", s.contraction = "20 %", s.line = "6 bar gauge";
      s.length = "80 mm";
      change(s);
    });
  };
  starts(of_muscle([](AirSettings& s) { s.muscle_pressure = "8 bar gauge"; }),
         "muscle_pressure: found \"8 bar gauge\"; expected at most the pressure of the line");
  starts(of_muscle([](AirSettings& s) { s.length = "300mm"; }),
         "length: found \"300mm\", which is 300 mm; expected a length that the muscle can have");
  starts(of_muscle([](AirSettings& s) { s.contraction = "40 %"; }),
         "contraction: found \"40 %\", which is 48 mm; expected a length");
  starts(of([](AirSettings& s) { s.droop = "1 bar diff"; }), "droop_flow: found nothing");
  starts(of([](AirSettings& s) { s.compressor = {"7 bar gauge, 6,2 L/min"}; }),
         "compressor: found \"7 bar gauge, 6,2 L/min\"; expected pressure, free flow and power");
  starts(of([](AirSettings& s) { s.use = "nowhere"; }),
         "nowhere: found nothing; expected the folder of a run");
  starts(of([](AirSettings& s) { s.use = test::source_dir() + "/robots/leg/actuator.toml"; }),
         "cycles: found nothing");
  const std::string table = write("table.csv", "air_used_per_step [g],status\n0.4,ok\n");
  starts(of([&](AirSettings& s) { s.use = table; }), "line: found nothing");
  starts(of([&](AirSettings& s) {
           s.use = table, s.line = "7 bar gauge";
           s.compressor = {"8 bar gauge, 6 L/min"};
         }),
         "compressor: found a consumption without a duration");
  const std::string empty = write("empty.csv", "seed,status\n1,ok\n");
  starts(of([&](AirSettings& s) { s.use = empty; }), "use: found " + empty + " without a column");
  const std::string still =
      write("still.json", R"({"air_used_kg": 0, "duration_s": 3, "title": "nothing moves"})");
  starts(of([&](AirSettings& s) { s.use = still; }), "use: found a run that takes no air");
  const std::string bare = write("bare.json", R"({"title": "no air"})");
  starts(of([&](AirSettings& s) { s.use = bare; }), "use: found " + bare + " without figures");
}

}  // namespace
}  // namespace sinew::design::air_test
