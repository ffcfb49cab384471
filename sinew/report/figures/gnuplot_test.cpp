#include "sinew/report/figures/gnuplot.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "sinew/report/figures/test_figure.h"

namespace sinew::report::gnuplot_test {
namespace {

using test::nan;
using test::walk;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

// Text with all characters that are special to a program between here and the picture.
const std::string nasty = R"(it's "q" a_b^{c}@d }{ \ \n & <x> `date` $y %d # µ°²)";

bool has_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

// A temporary folder with a figure's files and pictures.
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
  // Every segment of a line begins with an M.
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
}  // namespace sinew::report::gnuplot_test
