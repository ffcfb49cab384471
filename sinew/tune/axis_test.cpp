// Parsing of --vary.
#include "sinew/tune/axis.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/units/quantity.h"

namespace sinew::tune::axis_test {
namespace {

std::vector<std::string> texts(const Axis& axis) {
  std::vector<std::string> out;
  for (const Value& value : axis.values) out.push_back(value.text);
  return out;
}

std::string message(std::string_view text) {
  try {
    parse_axis(text);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "";
}

using Texts = std::vector<std::string>;

TEST(Axis, AListsLastUnitIsEverybodys) {
  const Axis axis = parse_axis("joint.hip.angle_gain = 0.02, 0.035,0.05 %/count");
  EXPECT_EQ(axis.heading(), "joint.hip.angle_gain [%/count]");
  EXPECT_EQ(texts(axis), (Texts{"0.02 %/count", "0.035 %/count", "0.05 %/count"}));
  EXPECT_EQ(axis.set(axis.values[1]), "joint.hip.angle_gain=0.035 %/count");
  EXPECT_EQ(texts(parse_axis("air.supply.pressure=60 psi gauge,80 psi gauge")),
            (Texts{"60 psi gauge", "80 psi gauge"}));
}

TEST(Axis, AreWordsFlagsAndListsAsTheyStand) {
  EXPECT_EQ(texts(parse_axis("low_level.duty_rounding=none,truncate sum")),
            (Texts{"none", "truncate sum"}));
  EXPECT_EQ(texts(parse_axis("valve.inlet.kind=2-way,3-way")), (Texts{"2-way", "3-way"}));
  EXPECT_EQ(texts(parse_axis("sequence.phases=[\"a\",\"b\"],[\"b\"]")),
            (Texts{"[\"a\",\"b\"]", "[\"b\"]"}));
  EXPECT_EQ(parse_axis("ground.present=true,false").heading(), "ground.present");
}

TEST(Axis, ARangeHoldsBothEnds) {
  EXPECT_EQ(texts(parse_axis("k=0:0.4:5 lbf")),
            (Texts{"0 lbf", "0.1 lbf", "0.2 lbf", "0.3 lbf", "0.4 lbf"}));
  EXPECT_EQ(texts(parse_axis("k=20 psi gauge:60 psi gauge:2")),
            (Texts{"20 psi gauge", "60 psi gauge"}));
  EXPECT_EQ(texts(parse_axis("k=3:1:3")), (Texts{"3", "2", "1"}));
}

// The number in --set is the number in the table.
TEST(Axis, ARangesTextsAreItsNumbers) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1e3, 1e3);
  for (int i = 0; i < 100; ++i) {
    const double from = any(random), to = any(random);
    const Axis axis =
        parse_axis("k=" + units::format_number(from) + ":" + units::format_number(to) + ":7 mm");
    ASSERT_EQ(axis.values.size(), 7U);
    for (std::size_t k = 0; k < 7; ++k) {
      const double wanted = from + static_cast<double>(k) * (to - from) / 6.0;
      EXPECT_NEAR(std::stod(axis.values[k].cell), wanted, 1e-11 * 1e3);
      EXPECT_NEAR(config::quantity(axis.values[k].text, "m"), 1e-3 * wanted, 1e-11);
    }
  }
}

TEST(Axis, ReportsWhatIsWrong) {
  EXPECT_NE(message("joint.hip.angle_gain").find("expected KEY=a,b,c"), std::string::npos);
  EXPECT_NE(message("k=1:2").find("from:to:how many"), std::string::npos);
  EXPECT_NE(message("k=1:2:x in").find("from:to:how many"), std::string::npos);
  EXPECT_NE(message("k=1:2:1 in").find("2 to 10000 values"), std::string::npos);
  EXPECT_NE(message("k=1:2:2.5 in").find("2 to 10000 values"), std::string::npos);
  EXPECT_NE(message("k=1:1:3 in").find("two different ends"), std::string::npos);
  EXPECT_NE(message("k=1 in,2 mm").find("one unit"), std::string::npos);
  EXPECT_NE(message("k=1 in:2 mm:3").find("one unit"), std::string::npos);
  EXPECT_NE(message("k=1,,2").find("between two commas"), std::string::npos);
}

TEST(Grid, HasEveryCombinationOnceTheLastAxisFastest) {
  const std::vector<Axis> axes = {parse_axis("a=1,2,3"), parse_axis("b=x,y"), seeds(4)};
  const Grid grid(axes);
  ASSERT_EQ(grid.size(), 24U);
  std::set<std::vector<const Value*>> seen;
  for (std::size_t i = 0; i < grid.size(); ++i) seen.insert(grid.point(i));
  EXPECT_EQ(seen.size(), 24U);
  EXPECT_EQ(grid.point(1)[2]->text, "2");
  EXPECT_EQ(grid.point(4)[1]->text, "y");
  EXPECT_EQ(grid.point(23)[0]->text, "3");
  EXPECT_EQ(Grid({}).size(), 1U);
}

}  // namespace
}  // namespace sinew::tune::axis_test
