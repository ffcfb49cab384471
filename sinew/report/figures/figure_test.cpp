#include "sinew/report/figures/figure.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "sinew/report/figures/figure_layout.h"
#include "sinew/report/figures/figure_script.h"
#include "sinew/report/figures/gnuplot.h"

namespace sinew::report {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

const double nan = std::nan("");

// Text with everything that some program on the way could take for its own.
const std::string nasty = R"(it's "q" a_b^{c}@d }{ \ \n & <x> `date` $y %d # µ°²)";

Figure walk() {
  const std::vector<double> t{0, 0.1, 0.2, 0.3};
  Plot angles{.name = "angles", .x = {"time", "s"}, .y = {"joint angle", "deg"}};
  angles.curves = {{.label = "hip", .xs = t, .ys = {1, 1.0 / 3, nan, 4}, .color = 0},
                   {.label = "hip desired",
                    .xs = t,
                    .ys = {1, 2, 3, 4},
                    .kind = Curve::Kind::desired,
                    .color = 0}};
  Plot force{.name = "force", .x = {"time", "s"}, .y = {"force", "N"}};
  force.curves = {{.xs = t, .ys = {0, -5, 5, 0}},
                  {.label = "hung, on the stand",
                   .xs = {0, 0.3},
                   .ys = {1, 2},
                   .kind = Curve::Kind::synthetic,
                   .style = Curve::Style::points}};
  return {.name = "walk", .title = "Walk", .caption = "A walk", .plots = {angles, force}};
}

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
  // A square twice, then a way off from its third corner.
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
  figure.plots[0].curves[1].style = Curve::Style::points;  // these have no end
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

// --- through gnuplot ---

bool has_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

// A folder with a figure's files, drawn; removed afterwards.
class Drawn {
 public:
  explicit Drawn(const Figure& figure) {
    std::string name = fs::temp_directory_path() / "sinew-figure-XXXXXX";
    folder_ = mkdtemp(name.data());
    const FigureData d = data(figure);
    for (const Sheet& s : d.sheets) std::ofstream(folder_ / (s.name + ".csv")) << csv(s);
    std::ofstream(folder_ / "a.gp") << script(figure, d, {Picture::svg, Picture::png});
    const std::string run = "cd " + folder_.string() + " && gnuplot -d a.gp 2>messages";
    code = std::system(run.c_str());
    messages = text("messages");
    svg = text(figure.name + ".svg");
    png = text(figure.name + ".png");
  }
  ~Drawn() { fs::remove_all(folder_); }
  Drawn(const Drawn&) = delete;
  Drawn& operator=(const Drawn&) = delete;

  int code = 1;
  std::string messages, svg, png;

 private:
  std::string text(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

std::string as_xml(std::string text) {
  for (const auto& [from, to] : {std::pair("&", "&amp;"), std::pair("<", "&lt;")})
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += std::strlen(to))
      text.replace(at, 1, to);
  return text;
}

std::string without_entity_of_greater(std::string svg) {
  for (std::size_t at = 0; (at = svg.find("&gt;", at)) != svg.npos;) svg.replace(at, 4, ">");
  return svg;
}

TEST(Gnuplot, ShowsAllTextAsItWasTyped) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  Figure figure = walk();
  Plot& plot = figure.plots[0];
  plot.title = "T " + nasty;
  plot.x.name = "X " + nasty;
  plot.y.name = "Y " + nasty;
  plot.curves[0].label = "L " + nasty;
  plot.curves[1].label = "line\nbreak\\";
  const Drawn drawn(figure);
  ASSERT_EQ(drawn.code, 0) << drawn.messages;
  EXPECT_EQ(drawn.messages, "");
  const std::string svg = without_entity_of_greater(drawn.svg);
  for (const std::string& text :
       {"T " + nasty, "X " + nasty + " [s]", "Y " + nasty + " [deg]", "L " + nasty})
    EXPECT_THAT(svg, HasSubstr("<text>" + as_xml(text) + "</text>"));
  EXPECT_THAT(svg, HasSubstr("<text>line break\\</text>"));
  EXPECT_THAT(svg, HasSubstr("(synthetic)</text>"));
}

TEST(Gnuplot, NamesRowsAndEndsOfCurves) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  Figure figure = walk();
  Plot& plot = figure.plots[0];
  const std::string row = "it's 5 % of {a_b}";
  plot.y.ticks = {{1, row}, {2, "second row"}, {3, nasty + nasty}};
  plot.names = Plot::Names::ends;
  plot.curves[1].in_legend = false;
  const Drawn drawn(figure);
  ASSERT_EQ(drawn.code, 0) << drawn.messages;
  EXPECT_EQ(drawn.messages, "");
  const std::string svg = without_entity_of_greater(drawn.svg);
  for (const std::string& text : {row, std::string("second row"), std::string("hip")})
    EXPECT_THAT(svg, HasSubstr(as_xml(text) + "</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("hip desired</text>")));
}

TEST(Gnuplot, GivesTheSameBytesAgainWithoutADate) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  const Drawn once(walk()), again(walk());
  ASSERT_EQ(once.code, 0) << once.messages;
  EXPECT_TRUE(once.svg == again.svg);
  EXPECT_TRUE(once.png == again.png);
  EXPECT_GT(once.png.size(), 5000u);
  EXPECT_THAT(once.svg, HasSubstr("<svg"));
}

std::string bytes_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

TEST(Gnuplot, DrawsAPdfWithItsFontsAndWithoutADate) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  const fs::path folder = fs::path(::testing::TempDir()) / ("pdf-" + std::to_string(::getpid()));
  fs::create_directory(folder);
  Figure figure = walk();
  figure.paper = {.width = 84 / 25.4 * 72, .height = 60 / 25.4 * 72, .decimal_comma = true};
  figure.plots[0].y.name = "Gelenkwinkel der Hüfte";
  const FigureData numbers = data(figure);
  for (const Sheet& sheet : numbers.sheets)
    std::ofstream(folder / (sheet.name + ".csv")) << csv(sheet);
  std::ofstream(folder / "walk.gp") << script(figure, numbers, {Picture::pdf});
  std::vector<std::string> made;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(draw(folder, {"walk.gp"}).empty());
    take_date_out(folder / "walk.pdf");
    made.push_back(bytes_of(folder / "walk.pdf"));
  }
  fs::remove_all(folder);
  EXPECT_THAT(made[0], AllOf(::testing::StartsWith("%PDF"), HasSubstr("/FontFile"),
                             Not(HasSubstr("CreationDate")), HasSubstr("startxref")));
  EXPECT_THAT(made[0], HasSubstr("/MediaBox [ 0 0 238 170 ]")) << "84 mm by 60 mm";
  EXPECT_TRUE(made[0] == made[1]);
}

TEST(Gnuplot, LeavesAGapWhereThereIsNoNumber) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  Figure figure{.name = "gap", .plots = {{.x = {"x", ""}, .y = {"y", ""}}}};
  figure.plots[0].curves = {{.xs = {0, 1, 2, 3, 4}, .ys = {0, 1, 1, 1, 0}}};
  const Drawn whole(figure);
  figure.plots[0].curves[0].ys[2] = nan;
  const Drawn gap(figure);
  ASSERT_EQ(gap.code, 0) << gap.messages;
  // Every stretch of a line begins with an M.
  EXPECT_EQ(std::ranges::count(gap.svg, 'M'), std::ranges::count(whole.svg, 'M') + 1);
}

TEST(Gnuplot, DrawsWhatHasNoNumbersAtAll) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  Figure figure{.name = "empty",
                .plots = {{.x = {.name = "x"}, .y = {.name = "y", .logarithmic = true}}}};
  figure.plots[0].curves = {{.label = "gone", .xs = {1, 2}, .ys = {nan, -3}}};
  const Drawn drawn(figure);
  ASSERT_EQ(drawn.code, 0) << drawn.messages;
  EXPECT_EQ(drawn.messages, "");
  EXPECT_THAT(drawn.svg, AllOf(HasSubstr("no data"), Not(HasSubstr("gone"))));
}

TEST(Gnuplot, DrawsEveryStyleOfACurve) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  Figure figure{.name = "styles", .plots = {{.x = {"time", "s"}, .y = {"y", "1/s"}}}};
  using enum Curve::Style;
  for (const Curve::Style style : {line, marked, steps, points, bars})
    figure.plots[0].curves.push_back(
        {.label = "style", .xs = {0, 1, 2}, .ys = {1, 3, 2}, .style = style});
  figure.plots[0].spans = {
      {0.5, 1}, {1.5, 9}, {0.2, 0.3, Span::Of::fault}, {1.9, 5, Span::Of::fault}};
  const Drawn drawn(figure);
  ASSERT_EQ(drawn.code, 0) << drawn.messages;
  EXPECT_EQ(drawn.messages, "");
  const std::string text = script(figure, data(figure), {Picture::svg});
  const auto count = [&](const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; ++at) ++n;
    return n;
  };
  EXPECT_EQ(count("fillcolor"), 4u);
  EXPECT_EQ(count("'#f9dccf'"), 2u);
  EXPECT_EQ(count("'#b3401a'"), 3u) << "one fault lasts beyond the axis";
}

}  // namespace
}  // namespace sinew::report
