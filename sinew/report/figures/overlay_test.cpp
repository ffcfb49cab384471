#include "sinew/report/figures/overlay.h"

#include <gmock/gmock.h>

namespace sinew::report::overlay_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = Curve::Kind;

Curve curve(const std::string& label, int color, double value, Kind kind = Kind::computed) {
  return {.label = label, .xs = {0, 1}, .ys = {value, value}, .kind = kind, .color = color};
}

// Returns a figure of the angles of `joints` joints, each with its desired one.
Figure angles(int joints, double value, double wish) {
  Plot plot{.x = {"time", "s"}, .y = {.name = "joint angles", .unit = "deg"}};
  for (int j = 0; j < joints; ++j) {
    const std::string name = "joint " + std::to_string(j);
    plot.curves.push_back(curve(name, j, value));
    plot.curves.push_back(curve(name + " desired", j, wish, Kind::desired));
  }
  return {
      .name = "joint-angles", .title = "Joint angles", .caption = "Of one run.", .plots = {plot}};
}

std::vector<std::string> labels(const Plot& plot) {
  std::vector<std::string> out;
  for (const Curve& c : plot.curves) out.push_back(c.label);
  return out;
}

TEST(Overlay, OfOneChannelHasAColorAndADashForEachRun) {
  const auto both = overlaid({{"measured", {angles(1, 1, 3)}}, {"simulated", {angles(1, 2, 3)}}});
  ASSERT_EQ(both.size(), 1u);
  ASSERT_EQ(both[0].plots.size(), 1u);
  const Plot& plot = both[0].plots[0];
  EXPECT_THAT(labels(plot), ElementsAre("measured", "desired", "simulated"));
  EXPECT_EQ(plot.curves[0].color, 0);
  EXPECT_EQ(plot.curves[2].color, 1);
  EXPECT_EQ(plot.curves[2].dash, 1);
  EXPECT_EQ(plot.curves[2].ys[0], 2);
  EXPECT_THAT(both[0].caption, HasSubstr("measured: Of one run. simulated: Of one run."));
}

TEST(Overlay, OfTwoChannelsStaysOnePlotWhereARunHasItsDash) {
  const auto both = overlaid({{"a", {angles(2, 1, 3)}}, {"b", {angles(2, 2, 4)}}});
  ASSERT_EQ(both[0].plots.size(), 1u);
  const Plot& plot = both[0].plots[0];
  EXPECT_THAT(labels(plot),
              ElementsAre("joint 0, a", "joint 0 desired", "joint 1, a", "joint 1 desired",
                          "joint 0, b", "joint 0 desired, b", "joint 1, b", "joint 1 desired, b"))
      << "what was desired differs";
  EXPECT_EQ(plot.curves[4].color, 0);
  EXPECT_EQ(plot.curves[4].dash, 1);
}

TEST(Overlay, OfManyChannelsHasAPlotForEach) {
  const auto both = overlaid({{"a", {angles(4, 1, 3)}}, {"b", {angles(4, 2, 3)}}});
  ASSERT_EQ(both[0].plots.size(), 4u);
  EXPECT_EQ(both[0].plots[2].title, "joint 2");
  EXPECT_THAT(labels(both[0].plots[2]), ElementsAre("a", "desired", "b"));
  EXPECT_NO_THROW(data(both[0]));
}

TEST(Overlay, ShowsBothInTheUnitOfTheFirst) {
  Figure small = angles(1, 500, 400), large = angles(1, 2, 1);
  small.plots[0].y.unit = "mm";
  small.plots[0].y.scale = 1e3;
  large.plots[0].y.unit = "m";
  large.plots[0].y.scale = 1;
  const Plot plot = overlaid({{"a", {small}}, {"b", {large}}})[0].plots[0];
  EXPECT_EQ(plot.y.unit, "mm");
  EXPECT_THAT(labels(plot), ElementsAre("a", "desired", "b", "desired, b"));
  EXPECT_DOUBLE_EQ(plot.curves[2].ys[0], 2000);
}

TEST(Overlay, KeepsWhatOnlyOneRunHas) {
  Figure other = angles(1, 1, 1);
  other.name = "tension";
  Figure unlike = angles(1, 1, 1);
  unlike.plots[0].y.unit = "count";  // a unit that cannot be converted
  const auto all = overlaid({{"a", {angles(1, 1, 1)}}, {"b", {other, unlike}}});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].plots.size(), 2u) << "two units stand in two plots";
  EXPECT_EQ(all[1].name, "tension");
  EXPECT_THAT(labels(all[1].plots[0]), ElementsAre("b", "desired"));
}

}  // namespace
}  // namespace sinew::report::overlay_test
