#include "sinew/report/figures/figure.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "sinew/report/figures/figure_layout.h"
#include "sinew/report/figures/gnuplot.h"
#include "sinew/report/figures/test_figure.h"

namespace sinew::report::figure_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using test::nan;
using test::walk;

// --- data ---

TEST(FigureData, PutsCurvesWithTheSameXIntoOneSheet) {
  const FigureData d = data(walk());
  ASSERT_EQ(d.sheets.size(), 3u);
  EXPECT_EQ(d.sheets[0].name, "walk-angles");
  EXPECT_THAT(d.sheets[0].headings, ElementsAre("time [s]", "hip [deg]", "hip desired [deg]"));
  EXPECT_EQ(d.sheets[1].name, "walk-force");
  EXPECT_THAT(d.sheets[1].headings, ElementsAre("time [s]", "force [N]"));
  EXPECT_EQ(d.sheets[2].name, "walk-force-hung-on-the-stand");
  EXPECT_EQ(d.places[0][1].sheet, 0u);
  EXPECT_EQ(d.places[0][1].column, 2u);
  EXPECT_EQ(d.places[1][1].sheet, 2u);
}

TEST(FigureData, ReadsBackToTheSameBitsAndGapsAreNaN) {
  const Figure figure = walk();
  const std::string text = csv(data(figure).sheets[0]);
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "time [s],hip [deg],hip desired [deg]");
  for (std::size_t row = 0; row < 4; ++row) {
    ASSERT_TRUE(std::getline(in, line));
    std::istringstream cells(line);
    for (const double expected :
         {figure.plots[0].curves[0].xs[row], figure.plots[0].curves[0].ys[row],
          figure.plots[0].curves[1].ys[row]}) {
      std::string cell;
      std::getline(cells, cell, ',');
      if (std::isnan(expected))
        EXPECT_EQ(cell, "NaN");
      else
        EXPECT_EQ(std::stod(cell), expected);
    }
  }
  EXPECT_FALSE(std::getline(in, line));
}

TEST(FigureData, NamesEverySheetAndColumnOnce) {
  Figure figure = walk();
  for (Plot& plot : figure.plots) plot.name = "same";
  figure.plots[0].curves[1].label = "hip";
  const FigureData d = data(figure);
  EXPECT_THAT(d.sheets[0].headings, ElementsAre("time [s]", "hip [deg]", "hip 2 [deg]"));
  EXPECT_EQ(d.sheets[0].name, "walk-same");
  EXPECT_EQ(d.sheets[1].name, "walk-same-2");
}

TEST(FigureData, QuotesAHeadingWithAComma) {
  EXPECT_THAT(csv(data(walk()).sheets[2]), HasSubstr("\"hung, on the stand [N]\"\n"));
}

TEST(FigureData, RefusesUnlikeNumbersAndNamesThatAreNoFiles) {
  Figure figure = walk();
  figure.plots[0].curves[1].ys.pop_back();
  try {
    data(figure);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "figure walk: hip desired: found 4 x and 3 y; expected as many of both");
  }
  figure = walk();
  figure.name = "../it's";
  EXPECT_THROW(data(figure), std::invalid_argument);
}

TEST(Once, LeavesOutWhereAPathWasBefore) {
  // The path is a square twice, then leaves it at its third corner.
  const Curve path{
      .label = "path", .xs = {0, 1, 1, 0, 0, 1, 1, 2, 3}, .ys = {0, 0, 1, 1, 0, 0, 1, 2, 2}};
  const Curve drawn = once(path);
  EXPECT_THAT(drawn.xs, ElementsAre(0, 1, 1, 0, 2, 1, 2, 3));
  EXPECT_THAT(drawn.ys, ElementsAre(0, 0, 1, 1, ::testing::IsNan(), 1, 2, 2));
  EXPECT_EQ(drawn.label, "path");

  const Curve new_ways{.xs = {0, nan, 1, 2}, .ys = {0, 5, nan, 3}};
  EXPECT_EQ(once(new_ways).xs.size(), 4u) << "gaps stay";
}

TEST(FileName, IsOneThatEverySystemTakes) {
  EXPECT_EQ(file_name_of("Hip flexor: at 45 psi!"), "hip-flexor-at-45-psi");
  EXPECT_EQ(file_name_of("6-4"), "6-4");
  EXPECT_EQ(file_name_of("../../etc"), "etc");
  EXPECT_EQ(file_name_of("°"), "figure");
}

// --- layout ---

TEST(Scale, EndsAtRoundNumbersAroundTheData) {
  for (double least = -1234.5; least < 1000; least += 37.7)
    for (double span = 1e-3; span < 1e4; span *= 3.7) {
      const Scale s = scale({}, least, least + span, false);
      EXPECT_LE(s.from, least + 1e-9 * span);
      EXPECT_GE(s.to, least + span * (1 - 1e-9));
      EXPECT_NEAR(std::remainder(s.from, s.step), 0, 1e-6 * s.step);
      EXPECT_NEAR(std::remainder(s.to, s.step), 0, 1e-6 * s.step);
      EXPECT_LE((s.to - s.from) / s.step, 8.001);
      EXPECT_GE((s.to - s.from) / s.step, 1.999);
    }
}

TEST(Scale, KeepsWhatTheAxisPrescribes) {
  const Scale s = scale({.from = 0.3, .to = 7.7}, 2, 3, false);
  EXPECT_EQ(s.from, 0.3);
  EXPECT_EQ(s.to, 7.7);
  const Scale constant = scale({}, 5, 5, true);
  EXPECT_LT(constant.from, 5);
  EXPECT_GT(constant.to, 5);
  const Scale decades = scale({.logarithmic = true}, 0.02, 300, false);
  EXPECT_DOUBLE_EQ(decades.from, 0.01);
  EXPECT_DOUBLE_EQ(decades.to, 1000);
}

TEST(Layout, ShowsALengthAsLongInXAsInY) {
  for (const double height : {0.02, 1.0, 3.0, 40.0}) {
    Figure figure{.name = "path", .plots = {{.equal_scale = true}}};
    figure.plots[0].curves = {{.label = "foot", .xs = {0, 1, 2}, .ys = {0, height, 0}}};
    const PlotLayout p = layout(figure).plots[0];
    const double across = (Print().width - Print().left - Print().right) / (p.x.to - p.x.from);
    EXPECT_NEAR((p.bottom - p.top) / (p.y.to - p.y.from) / across, 1, 1e-9) << height;
    EXPECT_LE(p.y.from, 0);
    EXPECT_GE(p.y.to, height);
  }
}

TEST(Layout, KeepsTheLegendAboveTheDataHoweverLongItIs) {
  Figure figure{.name = "many", .plots = {{.title = "Many"}}};
  for (int i = 0; i < 13; ++i)
    figure.plots[0].curves.push_back(
        {.label = "curve number " + std::to_string(i), .xs = {0, 1}, .ys = {0, 1}});
  const PlotLayout p = layout(figure).plots[0];
  ASSERT_EQ(p.legend.size(), 13u);
  for (const LegendEntry& e : p.legend) {
    EXPECT_LT(e.y + Print().line / 2, p.top);
    EXPECT_GT(e.y - Print().line / 2, p.title);
    EXPECT_LT(e.x + Print().sample, Print().width);
  }
}

TEST(Layout, MakesRoomForNamesOfRowsAndAtTheEnds) {
  Figure figure = walk();
  const PlotLayout usual = layout(figure).plots[0];
  figure.plots[0].y.ticks = {{1, "knee extensor exhaust"}, {2, "hip"}};
  figure.plots[0].names = Plot::Names::ends;
  figure.plots[0].curves[0].label = "a name at the end";
  const PlotLayout named = layout(figure).plots[0];
  EXPECT_GE(named.left, usual.left + 21 * Print().letter / 2);
  EXPECT_GE(named.right, usual.right + 17 * Print().letter / 2);
  EXPECT_TRUE(named.legend.empty());
  EXPECT_EQ(usual.legend.size(), 2u);
  figure.plots[0].curves[1].style = Curve::Style::points;  // points have no end
  EXPECT_EQ(layout(figure).plots[0].legend.size(), 1u);
  figure.plots[0].names = Plot::Names::legend;
  figure.plots[0].curves[1].in_legend = false;
  EXPECT_EQ(layout(figure).plots[0].legend.size(), 1u);
}

TEST(Layout, FollowsThePaper) {
  Figure figure = walk();
  const FigureLayout usual = layout(figure);
  figure.paper = {.width = 510, .font = 9};
  const FigureLayout wide = layout(figure);
  EXPECT_GT(wide.height, usual.height);
  EXPECT_NEAR(wide.plots[0].left / usual.plots[0].left, 9.0 / 7, 1e-12);
  for (const double height : {250.0, 400.0, 900.0}) {
    figure.paper.height = height;
    const FigureLayout l = layout(figure);
    EXPECT_NEAR(l.height, height, 1e-9);
    EXPECT_NEAR(l.plots[0].bottom - l.plots[0].top, l.plots[1].bottom - l.plots[1].top, 1e-9);
  }
  figure.paper.height = 100;
  EXPECT_THROW(layout(figure), std::invalid_argument) << "two plots have no room";
}

// --- script ---

TEST(Script, DrawsEveryCurveOfAPlotWithADashOfItsOwn) {
  Figure figure{.name = "dashes", .plots = {{.x = {.name = "x"}, .y = {.name = "y"}}}};
  for (const Curve::Kind kind : {Curve::Kind::computed, Curve::Kind::desired})
    for (int color = 0; color < 8; ++color)
      figure.plots[0].curves.push_back(
          {.label = "c", .xs = {0, 1}, .ys = {0, 1}, .kind = kind, .color = color});
  const std::string text = script(figure, data(figure), {Picture::svg});
  std::set<std::string> dashes;
  std::istringstream lines(text);
  for (std::string l; std::getline(lines, l);)
    if (const auto at = l.find(" dashtype "); at != l.npos && l.find("using") != l.npos)
      dashes.insert(l.substr(at, l.find(" linecolor") - at));
  EXPECT_EQ(dashes.size(), 16u);
}

}  // namespace
}  // namespace sinew::report::figure_test
