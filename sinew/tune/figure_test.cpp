// Parsing of --report and --where, and the search for the largest value.
#include "sinew/tune/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/config/diagnostics.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune::figure_test {
namespace {

analysis::Summary summary() {
  analysis::Summary s;
  s.add("trolley.distance_m", 1.27);
  s.add("passiveness", 0.9);
  s.add("joints.hip.tracking_rms_rad", 0.1);
  return s;
}

template <class Parse>
std::string message(Parse parse) {
  try {
    parse();
  } catch (const config::Error& e) {
    return e.what();
  }
  return "";
}

TEST(Figure, IsShownInTheRequestedUnit) {
  const auto figures =
      parse_figures("trolley.distance_m, trolley.distance_m [in],passiveness [%],passiveness");
  ASSERT_EQ(figures.size(), 4U);
  EXPECT_EQ(figures[0].heading(), "trolley.distance [m]");
  EXPECT_EQ(figures[1].heading(), "trolley.distance [in]");
  EXPECT_EQ(figures[2].heading(), "passiveness [%]");
  EXPECT_EQ(figures[3].heading(), "passiveness");
  EXPECT_EQ(figures[0].cell(summary()), "1.27");
  EXPECT_EQ(figures[1].cell(summary()), "50");
  EXPECT_EQ(figures[2].cell(summary()), "90");
  EXPECT_EQ(figures[3].cell(summary()), "0.9");
  EXPECT_EQ(parse_figures("air_used_kg")[0].cell(summary()), "") << "absent";
}

TEST(Figure, ReportsWhatIsWrong) {
  const auto of = [](std::string_view text) { return message([=] { parse_figures(text); }); };
  EXPECT_NE(of("trolley.distance_m [lb]").find("a unit of m (length)"), std::string::npos);
  EXPECT_NE(of("trolley.distance_m [in").find("a bracket that closes"), std::string::npos);
  EXPECT_NE(of("trolley.distance_m in").find("in brackets the unit"), std::string::npos);
  EXPECT_NE(of("a,,b").find("a key of summary.json"), std::string::npos);
  EXPECT_NE(of("air_used [g]").find("try \"air_used_kg [g]\""), std::string::npos);
  EXPECT_NE(of("joints.hip.tracking_rms [deg]").find("try \"joints.hip.tracking_rms_rad [deg]\""),
            std::string::npos);
  EXPECT_EQ(nearest_key("trolley.distanc_m", summary()), "trolley.distance_m");
  EXPECT_EQ(nearest_key("trolley.distance_m", summary()), "");
  EXPECT_EQ(nearest_key("something.else", summary()), "");
}

TEST(Condition, ComparesInSi) {
  EXPECT_TRUE(parse_condition("trolley.distance_m < 51 in").holds(summary()));
  EXPECT_FALSE(parse_condition("trolley.distance_m<49in").holds(summary()));
  EXPECT_TRUE(parse_condition("trolley.distance_m >= 1.27 m").holds(summary()));
  EXPECT_FALSE(parse_condition("trolley.distance_m > 1.27 m").holds(summary()));
  EXPECT_TRUE(parse_condition("trolley.distance_m <= 1.27 m").holds(summary()));
  EXPECT_TRUE(parse_condition("passiveness > 80 %").holds(summary()));
  EXPECT_FALSE(parse_condition("air_used_kg < 1 kg").holds(summary())) << "absent";
  const auto of = [](std::string_view text) { return message([=] { parse_condition(text); }); };
  EXPECT_NE(of("passiveness").find("key < value"), std::string::npos);
  EXPECT_NE(of("< 3").find("key < value"), std::string::npos);
  EXPECT_NE(of("trolley.distance_m < 3").find("without a unit"), std::string::npos);
  for (const char* heading : {"air_used [g] < 3", "air_used_kg [g] < 3", "air_used [g] < 3 g"})
    EXPECT_NE(of(heading).find("try \"air_used_kg < 3 g\""), std::string::npos) << of(heading);
  EXPECT_NE(of("air_used < 3 g").find("try \"air_used_kg\""), std::string::npos);
}

// The edge of a step is found within the interval after its halvings.
TEST(Largest, FindsTheEdgeOfAKnownFunction) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(0.0, 10.0);
  for (int i = 0; i < 200; ++i) {
    const double edge = anywhere(random);
    int asked = 0;
    const Largest found = largest({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 12, [&](double x) {
      ++asked;
      return x <= edge;
    });
    ASSERT_EQ(found.is, Largest::Is::between);
    EXPECT_LE(found.value, edge);
    EXPECT_GT(found.fails, edge);
    EXPECT_NEAR(found.fails - found.value, std::pow(0.5, 12), 1e-12);
    EXPECT_LE(asked, 11 + 12);
  }
}

TEST(Largest, ReportsWhereThereIsNoEdge) {
  const std::vector<double> values = {1, 2, 3};
  EXPECT_EQ(largest(values, 5, [](double) { return false; }).is, Largest::Is::never);
  const Largest all = largest(values, 5, [](double) { return true; });
  EXPECT_EQ(all.is, Largest::Is::to_the_end);
  EXPECT_EQ(all.value, 3);
}

// If a condition holds in several intervals, the result is the end of the lowest one.
TEST(Largest, TakesTheLowestPart) {
  const Largest found = largest({1, 2, 3, 4, 5}, 20, [](double x) { return x < 2.5 || x > 3.5; });
  EXPECT_NEAR(found.value, 2.5, 1e-5);
}

}  // namespace
}  // namespace sinew::tune::figure_test
