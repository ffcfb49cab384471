// units/units_test.cpp - constants, dimensions and the unit grammar.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sinew/units/literals.h"
#include "sinew/units/unit.h"

namespace sinew::units::units_test {
namespace {

using namespace literals;

TEST(Constants, AgreeWithEachOther) {
  EXPECT_DOUBLE_EQ(pound_force, pound_mass * standard_gravity);
  EXPECT_DOUBLE_EQ(psi, pound_force / (inch * inch));
  EXPECT_NEAR(slug, 14.593903, 1e-6);
}

TEST(Constants, GaugeAndAbsoluteAreInverse) {
  static_assert(absolute(0) == atmosphere);
  EXPECT_DOUBLE_EQ(gauge(absolute(62.0_psi)), 62.0_psi);
  EXPECT_DOUBLE_EQ(absolute(10.0_psi, 1e5), 1e5 + 10.0_psi);
}

TEST(Literals, EqualTheUnitsOfFiles) {
  EXPECT_EQ(3.15_in, read_unit("in").unit.to_si(3.15));
  EXPECT_EQ(0.24_in3, read_unit("in3").unit.to_si(0.24));
  EXPECT_EQ(1.8e-5_ft2, read_unit("ft2").unit.to_si(1.8e-5));
  EXPECT_EQ(278.0_deg, read_unit("deg").unit.to_si(278));
  EXPECT_EQ(0.293_ms, read_unit("ms").unit.to_si(0.293));
  EXPECT_EQ(read_unit("%").unit.to_si(55), 0.55);
  EXPECT_EQ(528.0_degR, read_unit("degR").unit.to_si(528));
}

// The grammar works at compile time.
static_assert(read_unit("lbf in s/rad").ok);
static_assert(read_unit("lb in2").unit.dimension == Dimension{.mass = 1, .length = 2});
static_assert(read_unit("1/psi2").unit.denominator == psi * psi);
static_assert(read_unit("").ok == false);

TEST(Unit, EveryUnitOfTheTableIsItsOwnInverse) {
  for (const Unit& unit : known_units) {
    for (double x : {-3.15, 0.0, 1.0, 62.0, 1e6}) {
      const double tolerance = 1e-12 * (std::abs(x) + std::abs(unit.offset));
      EXPECT_NEAR(unit.from_si(unit.to_si(x)), x, tolerance) << unit.name;
    }
    EXPECT_EQ(find_unit(unit.name), &unit) << "a name stands twice in the table";
  }
}

TEST(Unit, CompoundsHaveTheDimensionTheySay) {
  const Dimension joint_stiffness{.mass = 1, .length = 2, .time = -2, .angle = -1};
  EXPECT_EQ(read_unit("N m/rad").unit.dimension, joint_stiffness);
  EXPECT_EQ(read_unit("lbf in/rad").unit.dimension, joint_stiffness);
  EXPECT_EQ(read_unit("lbf*in/deg").unit.dimension, joint_stiffness);
  EXPECT_EQ(read_unit("%/(lbf in/rad)").unit.dimension, combine({}, joint_stiffness, -1));
  EXPECT_EQ(read_unit("% s/count").unit.dimension, (Dimension{.time = 1, .count = -1}));
  EXPECT_EQ(read_unit("kg/(s Pa)").unit.dimension, (Dimension{.length = 1, .time = 1}));
  EXPECT_EQ(read_unit("psi2").unit.dimension, (Dimension{.mass = 2, .length = -2, .time = -4}));
}

TEST(Unit, CompoundsHaveTheSizeTheySay) {
  EXPECT_DOUBLE_EQ(read_unit("lbf in/rad").unit.to_si(35), 35 * pound_force * inch);
  EXPECT_DOUBLE_EQ(read_unit("%/(lbf in/rad)").unit.to_si(6.5), 0.065 / (pound_force * inch));
  EXPECT_DOUBLE_EQ(read_unit("L/(s bar)").unit.to_si(2), 2e-8);
  EXPECT_DOUBLE_EQ(read_unit("lb in2").unit.to_si(10.36), 10.36 * pound_mass * inch * inch);
  EXPECT_DOUBLE_EQ(read_unit("degC").unit.to_si(20), 293.15);
}

TEST(Unit, PoundOfMassAndOfForceDiffer) {
  EXPECT_EQ(find_unit("lb")->dimension, dimension::mass);
  EXPECT_EQ(find_unit("lbf")->dimension, dimension::force);
}

TEST(Unit, NamesThePieceItDoesNotKnow) {
  EXPECT_EQ(read_unit("lbf inch/rad").trouble, "inch");
  EXPECT_EQ(read_unit("N m/rad s").trouble, "s");  // a/b c is ambiguous
  EXPECT_EQ(read_unit("W/degC").trouble, "degC");  // a scale with an offset
  EXPECT_EQ(read_unit("a/b/c").trouble, "a");
  EXPECT_EQ(read_unit("m/s/s").trouble, "/s");
  EXPECT_FALSE(read_unit("N/").ok);
  EXPECT_FALSE(read_unit("(N m").ok);
  EXPECT_FALSE(read_unit("m)").ok);
  EXPECT_FALSE(read_unit(std::string(1000, '(')).ok);
}

}  // namespace
}  // namespace sinew::units::units_test
