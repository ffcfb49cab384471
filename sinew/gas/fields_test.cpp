// Field tables of [air] and valves.toml: keys, units, and keys that exclude each other.

#include <gtest/gtest.h>

#include <set>

#include "sinew/gas/air.fields.h"
#include "sinew/gas/valve.fields.h"
#include "tests/field_visitor.h"

namespace sinew::gas::fields_test {
namespace {

using tests::FieldVisitor;
using Strings = std::vector<std::string>;

FieldVisitor orifice_valve() {
  FieldVisitor v;
  v.words_given = {
      {"valve.x.kind", "3-way"}, {"valve.x.flow.law", "orifice"}, {"valve.x.profile", "ramp"}};
  v.numbers_given = {{"valve.x.flow.area", {5e-7}},     {"valve.x.flow.efficiency", {0.85}},
                     {"valve.x.linear_below", {2e-3}},  {"valve.x.opening_delay", {3e-4}},
                     {"valve.x.closing_delay", {4e-4}}, {"valve.x.opening_ramp", {5e-4}},
                     {"valve.x.closing_ramp", {6e-4}}};
  return v;
}

FieldVisitor iso_valve() {
  FieldVisitor v;
  v.words_given = {{"valve.x.flow.law", "iso6358"}, {"valve.x.profile", "dead time"}};
  v.numbers_given = {{"valve.x.flow.sonic_conductance", {3e-9}},
                     {"valve.x.flow.critical_pressure_ratio", {0.3}}};
  return v;
}

Valve read(FieldVisitor& v) {
  std::vector<Valve> valves{{.name = "x"}};
  fields(v, valves);
  return valves[0];
}

void expect_each_key_once_with_a_line(const FieldVisitor& v) {
  std::set<std::string> asked;
  for (const auto& field : v.asked) {
    EXPECT_TRUE(asked.insert(field.key).second) << field.key << " twice";
    EXPECT_FALSE(field.doc.empty()) << field.key;
  }
  for (const auto& [key, value] : v.numbers_given) EXPECT_TRUE(asked.count(key)) << key;
  for (const auto& [key, value] : v.words_given) EXPECT_TRUE(asked.count(key)) << key;
}

TEST(ValveFields, FillEveryMember) {
  FieldVisitor v = orifice_valve();
  const Valve valve = read(v);
  EXPECT_TRUE(v.complaints.empty());
  expect_each_key_once_with_a_line(v);

  EXPECT_EQ(valve.kind, Valve::Kind::three_way);
  EXPECT_EQ(valve.flow.law, Flow::Law::orifice);
  EXPECT_EQ(valve.flow.area, 5e-7);
  EXPECT_EQ(valve.flow.efficiency, 0.85);
  EXPECT_EQ(valve.flow.linear_below, 2e-3);
  EXPECT_EQ(valve.profile, Valve::Profile::ramp);
  EXPECT_EQ(valve.opening_delay, 3e-4);
  EXPECT_EQ(valve.closing_delay, 4e-4);
  EXPECT_EQ(valve.opening_ramp, 5e-4);
  EXPECT_EQ(valve.closing_ramp, 6e-4);
}

TEST(ValveFields, LawDecidesWhichKeysAreNeeded) {
  FieldVisitor v = iso_valve();
  const Valve valve = read(v);
  EXPECT_TRUE(v.complaints.empty());
  expect_each_key_once_with_a_line(v);
  EXPECT_EQ(valve.flow.sonic_conductance, 3e-9);
  EXPECT_EQ(valve.flow.critical_pressure_ratio, 0.3);

  EXPECT_TRUE(v.find("valve.x.flow.area")->optional);
  EXPECT_FALSE(v.find("valve.x.flow.sonic_conductance")->optional);
  FieldVisitor w = orifice_valve();
  read(w);
  EXPECT_FALSE(w.find("valve.x.flow.area")->optional);
  EXPECT_TRUE(w.find("valve.x.flow.sonic_conductance")->optional);
}

TEST(ValveFields, ComplainAboutWhatDoesNotGoTogether) {
  FieldVisitor v = orifice_valve();
  v.numbers_given["valve.x.flow.sonic_conductance"] = {1e-9};
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.flow.sonic_conductance"});

  v = iso_valve();
  v.numbers_given["valve.x.flow.area"] = {1e-7};
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.flow.area"});

  v = iso_valve();
  v.numbers_given["valve.x.opening_ramp"] = {1e-3};
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.profile"});
}

FieldVisitor driven_valve() {
  FieldVisitor v = orifice_valve();
  v.words_given["valve.x.drive"] = "speed-up";
  for (const auto& [key, value] :
       {std::pair{"speed_up.opening_delay", 5e-4}, std::pair{"speed_up.closing_delay", 6e-4},
        std::pair{"coil.power", 1.0}, std::pair{"coil.boost_power", 9.0},
        std::pair{"coil.boost_time", 1e-3}, std::pair{"opening_delay_slope", 1e-9},
        std::pair{"closing_delay_slope", -2e-9}, std::pair{"max_frequency", 350.0},
        std::pair{"fails_above", 2.4e5}, std::pair{"rated_switchings", 5e8}})
    v.numbers_given[std::string("valve.x.") + key] = {value};
  return v;
}

TEST(ValveFields, FillDriveCoilAndLimits) {
  FieldVisitor v = driven_valve();
  const Valve valve = read(v);
  EXPECT_TRUE(v.complaints.empty());
  expect_each_key_once_with_a_line(v);
  EXPECT_EQ(valve.drive, Valve::Drive::speed_up);
  EXPECT_EQ(valve.speed_up.opening, 5e-4);
  EXPECT_EQ(valve.speed_up.closing, 6e-4);
  EXPECT_EQ(valve.coil.power, 1.0);
  EXPECT_EQ(valve.coil.boost_power, 9.0);
  EXPECT_EQ(valve.coil.boost_time, 1e-3);
  EXPECT_EQ(valve.opening_delay_slope, 1e-9);
  EXPECT_EQ(valve.closing_delay_slope, -2e-9);
  EXPECT_EQ(valve.max_frequency, 350);
  EXPECT_EQ(valve.fails_above, 2.4e5);
  EXPECT_EQ(valve.rated_switchings, 5e8);
  EXPECT_EQ(v.find("valve.x.fails_above")->unit, "Pa diff");

  // All later keys are optional.
  for (const char* key : {"drive", "speed_up", "coil", "regulator", "max_frequency", "fails_above"})
    EXPECT_TRUE(v.find(std::string("valve.x.") + key)->optional) << key;
}

TEST(ValveFields, ARegulatorHasARangeAndNothingElseHas) {
  FieldVisitor v = iso_valve();
  v.words_given["valve.x.kind"] = "regulator";
  v.numbers_given["valve.x.regulator.range"] = {6e5};
  v.numbers_given["valve.x.regulator.time_constant"] = {0.02};
  const Valve valve = read(v);
  EXPECT_TRUE(v.complaints.empty());
  EXPECT_EQ(valve.kind, Valve::Kind::regulator);
  EXPECT_EQ(valve.regulator.range, 6e5);
  EXPECT_EQ(valve.regulator.time_constant, 0.02);
  EXPECT_TRUE(v.find("valve.x.profile")->optional);

  v.words_given["valve.x.kind"] = "2-way";
  v.complaints.clear();
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.regulator"});

  v = iso_valve();
  v.words_given["valve.x.kind"] = "regulator";
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.regulator"});
}

TEST(ValveFields, ABoostWantsItsDrive) {
  FieldVisitor v = iso_valve();
  v.numbers_given["valve.x.coil.boost_time"] = {1e-3};
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.coil"});
}

TEST(ValveFields, ACircuitHasBothResistanceAndInductance) {
  FieldVisitor v = driven_valve();
  for (const auto& [key, value] :
       {std::pair{"resistance", 12.0}, std::pair{"inductance", 6e-3},
        std::pair{"hold_voltage", 5.0}, std::pair{"boost_voltage", 24.0},
        std::pair{"release_voltage", 3.0}, std::pair{"motion_voltage", 20.0},
        std::pair{"motion_time", 1.5e-4}})
    v.numbers_given[std::string("valve.x.circuit.") + key] = {value};
  const Circuit c = read(v).circuit;
  EXPECT_TRUE(v.complaints.empty());
  expect_each_key_once_with_a_line(v);
  EXPECT_EQ(c.resistance, 12);
  EXPECT_EQ(c.inductance, 6e-3);
  EXPECT_EQ(c.hold_voltage, 5);
  EXPECT_EQ(c.boost_voltage, 24);
  EXPECT_EQ(c.release_voltage, 3);
  EXPECT_EQ(c.motion_voltage, 20);
  EXPECT_EQ(c.motion_time, 1.5e-4);

  v.numbers_given["valve.x.circuit.inductance"] = {0};
  read(v);
  EXPECT_EQ(v.complaints, Strings{"valve.x.circuit.resistance"});
}

TEST(AirFields, ATankHasAVolumeAndNothingElseHas) {
  FieldVisitor v;
  v.words_given = {{"kind", "tank"}};
  v.numbers_given = {{"pressure", {7e5}}, {"volume", {0.3785}}, {"initial_pressure", {9e5}}};
  Supply supply;
  fields(v, supply);
  EXPECT_TRUE(v.complaints.empty());
  expect_each_key_once_with_a_line(v);
  EXPECT_EQ(supply.kind, Supply::Kind::tank);
  EXPECT_EQ(supply.volume, 0.3785);
  EXPECT_EQ(supply.initial_pressure, 9e5);
  EXPECT_FALSE(v.find("volume")->optional);

  EXPECT_GT(v.find("volume")->min, 0);

  v.words_given["kind"] = "constant";
  v.numbers_given["volume"] = {0.1};
  fields(v, supply);
  EXPECT_EQ(v.complaints, Strings{"volume"});
}

TEST(AirFields, WallsThatAreQuickerThanARunCanBeAreIsothermal) {
  FieldVisitor v;
  v.numbers_given = {{"wall_time", {1e-5}}};
  Air air;
  fields(v, air);
  EXPECT_EQ(v.complaints, Strings{"wall_time"});
  EXPECT_TRUE(v.find("wall_time")->optional);
}

TEST(AirFields, FillEveryMember) {
  FieldVisitor v;
  v.numbers_given = {{"atmosphere", {1e5}},
                     {"temperature", {290}},
                     {"polytropic_exponent", {1.1}},
                     {"gas_constant", {287}},
                     {"supply.pressure", {7e5}}};
  v.words_given = {{"supply.kind", "constant"}};
  Air air;
  Supply supply;
  fields(v, air, supply);
  expect_each_key_once_with_a_line(v);
  EXPECT_EQ(air.atmosphere, 1e5);
  EXPECT_EQ(air.temperature, 290);
  EXPECT_EQ(air.polytropic_exponent, 1.1);
  EXPECT_EQ(air.gas_constant, 287);
  EXPECT_EQ(supply.pressure, 7e5);

  // Pressures of the state are absolute; a file may have gauge pressures, which config converts.
  EXPECT_EQ(v.find("atmosphere")->unit, "Pa abs");
  EXPECT_EQ(v.find("supply.pressure")->unit, "Pa abs");
}

}  // namespace
}  // namespace sinew::gas::fields_test
