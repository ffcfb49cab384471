// Field table of actuator.toml: its keys, its units, and keys that exclude each other.

#include <gtest/gtest.h>

#include <set>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/actuator/thesis_actuator.h"
#include "tests/field_visitor.h"

namespace sinew::actuator::fields_test {
namespace {

using tests::FieldVisitor;

// Possible values of robots/*/actuator.toml, in SI.
FieldVisitor leg() {
  FieldVisitor v;
  v.numbers_given = {
      {"braid.thread_length", {0.1071372}},
      {"braid.turns", {2.3125}},
      {"effectiveness.polynomial", {0.9969, 7.25e-8, -4.2e-13}},
      {"effectiveness.scale", {0.91}},
      {"effectiveness.valid", {1000, 700000}},
      {"long_end.length", {0.0995}},
      {"long_end.stiffness", {87563}},
      {"long_end.damping", {122}},
      {"short_end.stiffness", {87000}},
      {"short_end.damping", {120}},
      {"loss.viscous", {3.5}},
      {"loss.coulomb_length", {0.00047}},
      {"loss.stick", {0}},
      {"bladder.stiffness", {364}},
      {"bladder.rest_length", {0.08}},
      {"bladder.quadratic", {120}},
      {"bladder.cubic", {-3e4}},
      {"bladder.saturating_tension", {4}},
      {"bladder.saturation_length", {0.003}},
      {"bladder.valid", {0.06, 0.099}},
      {"effectiveness.threshold", {2e4}},
      {"caps.length", {0.004}},
      {"taper.gain", {1.1}},
      {"taper.extra_gain", {0.2}},
      {"taper.extra_pressure", {1e5}},
      {"taper.rest_length", {0.098}},
      {"wall.thickness", {0.0008}},
      {"air.offset", {2e-6}},
      {"hysteresis.half_width", {2500}},
      {"hysteresis.width_per_pressure", {0.004}},
      {"hysteresis.width_per_contraction", {4e4}},
      {"hysteresis.width_per_tension", {0.02}},
      {"hysteresis.volume_pressure", {1e6}},
      {"creep.share", {0.03, 0.02}},
      {"creep.time", {0.5, 10}},
      {"life.contraction", {0.2}},
      {"life.pressure", {6e5}},
      {"life.cycles_over", {182}},
      {"life.cycles_under", {2587}},
      {"life.exponent", {1, 8}},
      {"life.factor", {1, 24}},
  };
  v.words_given = {{"effectiveness.argument", "absolute"},
                   {"short_end.law", "zero"},
                   {"loss.coulomb_scale", "sealed"}};
  return v;
}

TEST(ActuatorFields, FillEveryMember) {
  FieldVisitor v = leg();
  Actuator a;
  fields(v, a);
  EXPECT_TRUE(v.complaints.empty());

  EXPECT_EQ(a.braid.thread_length, 0.1071372);
  EXPECT_EQ(a.braid.turns, 2.3125);
  EXPECT_EQ(a.effectiveness.c0, 0.9969);
  EXPECT_EQ(a.effectiveness.c1, 7.25e-8);
  EXPECT_EQ(a.effectiveness.c2, -4.2e-13);
  EXPECT_EQ(a.effectiveness.scale, 0.91);
  EXPECT_EQ(a.effectiveness.argument, Effectiveness::Argument::absolute);
  EXPECT_EQ(a.effectiveness.valid_from, 1000);
  EXPECT_EQ(a.effectiveness.valid_to, 700000);
  EXPECT_EQ(a.long_end.length, 0.0995);
  EXPECT_EQ(a.long_end.stiffness, 87563);
  EXPECT_EQ(a.long_end.damping, 122);
  EXPECT_EQ(a.short_end.law, ShortEnd::Law::zero);
  EXPECT_EQ(a.short_end.stiffness, 87000);
  EXPECT_EQ(a.short_end.damping, 120);
  EXPECT_EQ(a.loss.viscous, 3.5);
  EXPECT_EQ(a.loss.coulomb_length, 0.00047);
  EXPECT_EQ(a.loss.coulomb_scale, Loss::Scale::sealed);
  EXPECT_FALSE(a.loss.stick);
  EXPECT_EQ(a.bladder.stiffness, 364);
  EXPECT_EQ(a.bladder.rest_length, 0.08);
  EXPECT_EQ(a.hysteresis.half_width, 2500);
  EXPECT_EQ(a.hysteresis.width_per_pressure, 0.004);
  EXPECT_EQ(a.hysteresis.width_per_contraction, 4e4);
  EXPECT_EQ(a.hysteresis.width_per_tension, 0.02);
  EXPECT_EQ(a.hysteresis.volume_pressure, 1e6);
  EXPECT_EQ(a.creep.share, (std::array{0.03, 0.02}));
  EXPECT_EQ(a.creep.time, (std::array{0.5, 10.0}));
  EXPECT_EQ(a.life.contraction, 0.2);
  EXPECT_EQ(a.life.pressure, 6e5);
  EXPECT_EQ(a.life.cycles_over, 182);
  EXPECT_EQ(a.life.cycles_under, 2587);
  EXPECT_EQ(a.life.exponent_least, 1);
  EXPECT_EQ(a.life.exponent_most, 8);
  EXPECT_EQ(a.life.factor_least, 1);
  EXPECT_EQ(a.life.factor_most, 24);
}

TEST(ActuatorFields, ALifeHasAReferenceAndBoundsInOrder) {
  FieldVisitor v = leg();
  v.numbers_given["life.contraction"] = {0};
  Actuator a;
  fields(v, a);
  EXPECT_EQ(v.complaints, std::vector<std::string>{"life.contraction"});

  FieldVisitor crossed = leg();
  crossed.numbers_given["life.cycles_under"] = {100};
  fields(crossed, a);
  EXPECT_EQ(crossed.complaints, std::vector<std::string>{"life.cycles_under"});
}

TEST(ActuatorFields, ALooseBladderRemovesWhatItExcludes) {
  FieldVisitor v = leg();
  v.words_given["bladder.fit"] = "liner";
  Actuator a;
  fields(v, a);
  EXPECT_TRUE(v.complaints.empty());
  EXPECT_EQ(a.bladder.stiffness, 0);
  EXPECT_EQ(a.bladder.saturating_tension, 0);
  EXPECT_EQ(a.effectiveness.threshold, 0);
  EXPECT_EQ(a.wall.thickness, 0);
}

TEST(ActuatorFields, RequestWhatWasGivenAndAFewMore) {
  FieldVisitor v = leg();
  Actuator a;
  fields(v, a);
  std::set<std::string> asked;
  for (const auto& field : v.asked) {
    EXPECT_TRUE(asked.insert(field.key).second) << field.key << " twice";
    EXPECT_FALSE(field.doc.empty()) << field.key;
    EXPECT_EQ(field.doc.find('\n'), std::string::npos) << field.key;
  }
  for (const auto& [key, value] : v.numbers_given) EXPECT_TRUE(asked.count(key)) << key;
  for (const auto& [key, value] : v.words_given) EXPECT_TRUE(asked.count(key)) << key;
}

TEST(ActuatorFields, LeaveTheDefaultsWhereNothingIsGiven) {
  FieldVisitor v;
  Actuator a = thesis_actuator();
  fields(v, a);
  EXPECT_EQ(a.braid.thread_length, thesis_actuator().braid.thread_length);
  EXPECT_EQ(a.effectiveness.c2, thesis_actuator().effectiveness.c2);
  EXPECT_EQ(a.effectiveness.valid_to, thesis_actuator().effectiveness.valid_to);
  EXPECT_TRUE(v.complaints.empty());
}

TEST(ActuatorFields, TrapezoidsStandForThreadAndTurns) {
  FieldVisitor v = leg();
  v.numbers_given.erase("braid.thread_length");
  v.numbers_given.erase("braid.turns");
  v.numbers_given["braid.trapezoids.lengthwise"] = {37};
  v.numbers_given["braid.trapezoids.around"] = {16};
  v.numbers_given["braid.trapezoids.side"] = {0.0014478};
  Actuator a;
  fields(v, a);
  EXPECT_TRUE(v.complaints.empty());
  EXPECT_DOUBLE_EQ(a.braid.thread_length, 0.1071372);
  EXPECT_DOUBLE_EQ(a.braid.turns, 2.3125);
}

std::vector<std::string> complaints(FieldVisitor v) {
  Actuator a;
  fields(v, a);
  return v.complaints;
}

TEST(ActuatorFields, ComplainAboutWhatDoesNotGoTogether) {
  using Strings = std::vector<std::string>;

  FieldVisitor v = leg();
  v.numbers_given["braid.trapezoids.lengthwise"] = {37};
  v.numbers_given["braid.trapezoids.around"] = {16};
  v.numbers_given["braid.trapezoids.side"] = {0.0014478};
  EXPECT_EQ(complaints(v), Strings{"braid.trapezoids"});

  v = leg();
  v.numbers_given.erase("braid.turns");
  EXPECT_EQ(complaints(v), Strings{"braid.thread_length"});

  v = leg();
  v.numbers_given["effectiveness.polynomial"] = {1, 0, 0, 0};
  EXPECT_EQ(complaints(v), Strings{"effectiveness.polynomial"});

  v = leg();
  v.numbers_given["effectiveness.valid"] = {7e5, 0};
  EXPECT_EQ(complaints(v), Strings{"effectiveness.valid"});

  v = leg();
  v.numbers_given["long_end.length"] = {0.05};
  EXPECT_EQ(complaints(v), Strings{"long_end"});

  v = leg();
  v.words_given["loss.coulomb_scale"] = "constant";
  EXPECT_EQ(complaints(v), Strings{"loss.coulomb_scale"});

  v = leg();
  v.numbers_given["bladder.valid"] = {0.099, 0.06};
  EXPECT_EQ(complaints(v), Strings{"bladder.valid"});

  v = leg();
  v.numbers_given.erase("bladder.saturation_length");
  EXPECT_EQ(complaints(v), Strings{"bladder.saturating_tension"});

  v = leg();
  v.numbers_given.erase("taper.extra_pressure");
  EXPECT_EQ(complaints(v), Strings{"taper.extra_gain"});

  v = leg();
  v.numbers_given.erase("taper.rest_length");
  EXPECT_EQ(complaints(v), Strings{"taper"});

  for (const std::vector<double>& times :
       {std::vector<double>{0.5}, {0.5, 0}, {0.5, 10, 20}, std::vector<double>{}}) {
    v = leg();
    v.numbers_given["creep.time"] = times;
    EXPECT_EQ(complaints(v), Strings{"creep.share"});
  }
}

TEST(ActuatorFields, AShorterPolynomialEndsInZeros) {
  FieldVisitor v = leg();
  v.numbers_given["effectiveness.polynomial"] = {0.95};
  Actuator a;
  fields(v, a);
  EXPECT_EQ(a.effectiveness.c0, 0.95);
  EXPECT_EQ(a.effectiveness.c1, 0);
  EXPECT_EQ(a.effectiveness.c2, 0);
}

}  // namespace
}  // namespace sinew::actuator::fields_test
