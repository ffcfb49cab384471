#include "sinew/report/figures/gnuplot.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/report/figures/figure_layout.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"

namespace sinew::report {

namespace {

constexpr double point = 0.0254 / 72;  // [m]
constexpr config::Range widths{0.03, 1, "from a figure within the text to a poster"};
constexpr config::Range heights{0.02, 1.5, "from a strip to a poster"};

double length(std::string_view name, const std::string& text, const config::Range& range) {
  return config::quantity_setting(name, text, "m", units::atmosphere, range) / point;
}

// Reads the size of letters, "9 pt" or the number alone  [pt].
double letters_of(const std::string& text) {
  const auto [size, unit, error] = units::split_number(units::trimmed(text));
  if (error != std::errc() || (!unit.empty() && unit != "pt"))
    config::fail({"font", 0, 0}, "", config::in_quotes(text), "the size of letters in points",
                 "\"9 pt\"");
  if (!(size >= 4 && size <= 40))
    config::fail({"font", 0, 0}, "", config::in_quotes(text),
                 "4 pt to 40 pt, from what can just be read to a poster", "\"9 pt\"");
  return size;
}

}  // namespace

Paper read_paper(const std::string& width, const std::string& height, const std::string& font) {
  Paper out;
  if (!width.empty()) out.width = length("width", width, widths);
  if (!height.empty()) out.height = length("height", height, heights);
  if (!font.empty()) out.font = letters_of(font);
  return out;
}

namespace {

using Kind = Curve::Kind;
using Style = Curve::Style;
using units::format_number;

// The page's colors, with dashes that distinguish them in grey, and dots for desired curves.
struct DrawingStyle {
  const char *color, *dash, *dots;
};
constexpr DrawingStyle drawing_styles[] = {{"#0072b2", "1", "(1,1.5)"},
                                           {"#d55e00", "(7,2)", "(1,3)"},
                                           {"#009e73", "(7,2,1.5,2)", "(1,1.5,1,4)"},
                                           {"#a8478a", "(3.5,1.5)", "(1,5)"},
                                           {"#c28a00", "(10,2,3,2)", "(1,1.5,1,1.5,1,4)"},
                                           {"#3fa1d9", "(5,1.5,1,1.5,1,1.5)", "(2,3)"},
                                           {"#6b6f76", "(5,4)", "(1,2.2)"},
                                           {"#7a4b12", "(2,1)", "(1,7)"}};

// Returns a gnuplot string in single quotes, in which only the quote is special.
std::string as_literal(std::string_view typed) {
  std::string out = "'";
  for (const char c : typed) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + "'";
}

std::string rounded(double value) { return fmt::format("{:.4f}", value); }

class Script {
 public:
  Script(const Figure& figure, const FigureData& data)
      : figure_(figure), data_(data), layout_(layout(figure)), print_(figure.paper) {}

  std::string text(const std::vector<Picture>& pictures) {
    begin(pictures);
    for (std::size_t p = 0; p < figure_.plots.size(); ++p) draw(p);
    add("unset multiplot");
    add("}}");
    add("set output");
    return std::move(out_);
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> format, Parts&&... parts) {
    out_ += fmt::format(format, std::forward<Parts>(parts)...) + '\n';
  }
  // Return positions as shares of the picture, from the left and from the bottom.
  std::string across(double points) const { return rounded(points / print_.width); }
  std::string up(double points) const { return rounded(1 - points / layout_.height); }

  void begin(const std::vector<Picture>& pictures);
  void terminals(const std::vector<Picture>& pictures);
  void draw(std::size_t p);
  void axis(char name, const Axis& axis, const Scale& scale);
  void titles(const Plot& plot, const PlotLayout& at);
  void legend(const Plot& plot, const PlotLayout& at);
  void ends(const Plot& plot, const PlotLayout& at);
  void spans(const Plot& plot, const Scale& x);
  void curves(std::size_t p);
  std::string place(double x, double y) const {
    return "screen " + across(x) + ", screen " + up(y);
  }

  const Figure& figure_;
  const FigureData& data_;
  const FigureLayout layout_;
  const Print print_;
  std::string out_;
};

// Returns the color of a curve, or the next one if it has no color.
const DrawingStyle& color_style_of(const Plot& plot, std::size_t curve) {
  const int own = plot.curves[curve].color;
  return drawing_styles[(own == Curve::next ? curve : static_cast<std::size_t>(own)) %
                        std::size(drawing_styles)];
}

// Returns the dash of a curve, or that of its color if it has no dash.
const DrawingStyle& dash_of(const Plot& plot, std::size_t curve) {
  const int own = plot.curves[curve].dash;
  return own == Curve::next
             ? color_style_of(plot, curve)
             : drawing_styles[static_cast<std::size_t>(own) % std::size(drawing_styles)];
}

bool has_points(const Curve& c) { return c.style == Style::points || c.style == Style::marked; }

// Returns the line style of a curve, also for an arrow or a label's point.
std::string line_of(const Plot& plot, std::size_t c) {
  const DrawingStyle &color_style = color_style_of(plot, c), &dash = dash_of(plot, c);
  const Curve& curve = plot.curves[c];
  const bool desired = curve.kind == Kind::desired;
  return fmt::format("linewidth {} dashtype {} linecolor rgb '{}'", desired ? "1.0" : "0.9",
                     plot.names == Plot::Names::none ? drawing_styles[0].dash
                     : desired                       ? dash.dots
                                                     : dash.dash,
                     color_style.color);
}

std::string point_of(const Plot& plot, std::size_t c) {
  return fmt::format("pointtype {} pointsize mark", plot.curves[c].kind == Kind::synthetic ? 6 : 7);
}

std::string drawn_with(const Plot& plot, std::size_t c) {
  switch (plot.curves[c].style) {
    case Style::line:
    case Style::other:
    case Style::band:
      return "lines " + line_of(plot, c);
    case Style::steps:
      return "steps " + line_of(plot, c);
    case Style::marked:
      return "linespoints " + line_of(plot, c) + " " + point_of(plot, c);
    case Style::points:
    case Style::held_out:
    case Style::left_out:
      return "points linewidth 0.6 linecolor rgb '" + std::string(color_style_of(plot, c).color) +
             "' " + point_of(plot, c);
    case Style::bars:
      return "boxes fillstyle solid 0.45 border " + line_of(plot, c);
  }
  return "";
}

void Script::begin(const std::vector<Picture>& pictures) {
  std::string formats, files;
  for (const Picture p : pictures) {
    formats += fmt::format("{}{}", formats.empty() ? "" : " ", ending(p));
    files += fmt::format("{}{}.{}", files.empty() ? "" : " and ", figure_.name, ending(p));
  }
  add("# Draws {} from the CSV files in this folder: gnuplot {}.gp", files, figure_.name);
  add("reset");
  add("set encoding utf8");
  add("set datafile separator comma");
  add("set border 3 linewidth 0.5");
  add("set tics out nomirror scale 0.4");
  add("set minussign");
  if (figure_.paper.decimal_comma) add("set decimalsign ','");
  add("unset key");
  add("do for [picture in '{}'] {{", formats);
  terminals(pictures);
  add("set output '{}.'.picture", figure_.name);
  add("set multiplot");
}

// Sets the terminals so that all sizes are in points of 72 to the inch.
void Script::terminals(const std::vector<Picture>& pictures) {
  const auto pixels = [&](double dots, double points) {
    return fmt::format("{:.0f}", points * dots / 72);
  };
  const double font = print_.font;
  for (const Picture p : pictures) {
    add("if (picture eq '{}') {{", ending(p));
    if (p == Picture::svg) {
      add("set terminal svg size {},{} noenhanced font 'Arial,{:.2f}' linewidth {:.3f} "
          "background '#ffffff'",
          pixels(96, print_.width), pixels(96, layout_.height), font * 96 / 72, 96.0 / 72);
      add("heading = ',{:.2f}'; mark = 0.5", (font + 1) * 96 / 72);
    } else if (p == Picture::png) {
      // This terminal's points are 96 to the inch.
      add("set terminal pngcairo size {},{} noenhanced font 'Arial,{}' fontscale {:.3f} "
          "linewidth {:.3f} pointscale {:.3f} background '#ffffff'",
          pixels(300, print_.width), pixels(300, layout_.height), font, 300.0 / 96, 300.0 / 72,
          300.0 / 72);
      add("heading = ',{}'; mark = 0.3", font + 1);
    } else {
      // This terminal's points are 96 to the inch, too, and its lines half a point wide.
      add("set terminal pdfcairo size {:.4f}in,{:.4f}in noenhanced font 'Arial,{}' "
          "fontscale 0.75 linewidth 2",
          print_.width / 72, layout_.height / 72, font);
      add("heading = ',{}'; mark = 0.3", font + 1);
    }
    add("}}");
  }
}

// Returns the ticks. A tick's text is a format, in which a percent sign has to be doubled.
std::string named(const std::vector<Axis::Tick>& ticks) {
  std::string out;
  for (const Axis::Tick& t : ticks) {
    std::string text;
    for (const char c : t.text) text += c == '%' ? "%%" : std::string(1, c);
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", as_literal(text), format_number(t.at));
  }
  return out;
}

void Script::axis(char name, const Axis& axis, const Scale& s) {
  add("{} logscale {}", axis.logarithmic ? "set" : "unset", name);
  add("set {}range [{}:{}]", name, format_number(s.from), format_number(s.to));
  if (axis.logarithmic)
    add("set {}tics 10", name);
  else if (!axis.ticks.empty())
    add("set {}tics ({})", name, named(axis.ticks));
  else
    add("set {}tics {}", name, format_number(s.step));
}

void Script::titles(const Plot& plot, const PlotLayout& at) {
  if (!plot.title.empty())
    add("set label {} at {} left font heading", as_literal(plot.title),
        place(print_.left, at.title));
  if (!plot.y.name.empty())
    add("set label {} at screen {}, graph 0.5 center rotate by 90", as_literal(plot.y.title()),
        across(0.75 * print_.line));
  add("set label {} at graph 0.5, screen {} center", as_literal(plot.x.title()),
      up(at.bottom + print_.numbers + print_.line));
  if (at.curves.empty()) add("set label 'no data' at graph 0.5, graph 0.5 center");
}

void Script::legend(const Plot& plot, const PlotLayout& at) {
  for (const LegendEntry& e : at.legend) {
    const Curve& curve = plot.curves[e.curve];
    if (curve.style != Style::points)
      add("set arrow from {} to {} nohead {}", place(e.x, e.y), place(e.x + print_.sample, e.y),
          line_of(plot, e.curve));
    if (has_points(curve))
      add("set label '' at {} point {} linecolor rgb '{}'", place(e.x + print_.sample / 2, e.y),
          point_of(plot, e.curve), color_style_of(plot, e.curve).color);
    add("set label {} at {} left", as_literal(e.text),
        place(e.x + print_.sample + print_.gap, e.y));
  }
}

// Adds names at the ends of curves.
void Script::ends(const Plot& plot, const PlotLayout& at) {
  for (const std::size_t c : at.curves) {
    const Curve& curve = plot.curves[c];
    if (naming(plot, curve) != Plot::Names::ends) continue;
    std::size_t last = curve.xs.size();
    for (std::size_t i = 0; i < curve.xs.size(); ++i)
      if (!(curve.xs[i] > at.x.to) && std::isfinite(curve.ys[i])) last = i;
    if (last < curve.xs.size())
      add("set label {} at first {}, first {} left offset 0.6,0", as_literal(curve.label),
          format_number(curve.xs[last]), format_number(curve.ys[last]));
  }
}

void Script::spans(const Plot& plot, const Scale& x) {
  for (const Span& s : plot.spans) {
    const double from = std::max(s.from, x.from), to = std::min(s.to, x.to);
    if (!(from < to)) continue;
    const bool fault = s.of == Span::Of::fault;
    add("set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
        "fillcolor rgb '{}' fillstyle solid noborder",
        format_number(from), format_number(to), fault ? "#f9dccf" : "#e8edf3");
    if (!fault) continue;
    for (const double end : {s.from, s.to})
      if (end >= x.from && end <= x.to)
        add("set arrow from first {0}, graph 0 to first {0}, graph 1 nohead back linewidth 0.4 "
            "linecolor rgb '#b3401a'",
            format_number(end));
  }
}

void Script::curves(std::size_t p) {
  const Plot& plot = figure_.plots[p];
  const std::vector<std::size_t>& list = layout_.plots[p].curves;
  if (list.empty()) add("plot NaN");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Place at = data_.places[p][list[i]];
    add("{}'{}.csv' using 1:{} skip 1 with {}{}", i == 0 ? "plot " : "     ",
        data_.sheets[at.sheet].name, at.column + 1, drawn_with(plot, list[i]),
        i + 1 < list.size() ? ", \\" : "");
  }
}

void Script::draw(std::size_t p) {
  const Plot& plot = figure_.plots[p];
  const PlotLayout& at = layout_.plots[p];
  add("");
  add("unset label; unset arrow; unset object");
  add("set lmargin at screen {}; set rmargin at screen {}", across(at.left),
      across(print_.width - at.right));
  add("set tmargin at screen {}; set bmargin at screen {}", up(at.top), up(at.bottom));
  axis('x', plot.x, at.x);
  axis('y', plot.y, at.y);
  add("set format '%h'; set xtics offset 0,0.3; set ytics offset 0.4,0");
  titles(plot, at);
  legend(plot, at);
  if (plot.names == Plot::Names::ends) ends(plot, at);
  spans(plot, at.x);
  if (at.y.from < 0 && at.y.to > 0)
    add("set arrow from graph 0, first 0 to graph 1, first 0 nohead back linewidth 0.4 "
        "linecolor rgb '#9aa4b2'");
  curves(p);
}

}  // namespace

std::optional<Picture> picture_of(std::string_view asked) {
  for (const Picture picture : {Picture::svg, Picture::png, Picture::pdf})
    if (ending(picture) == asked) return picture;
  return std::nullopt;
}

std::string_view ending(Picture picture) {
  return picture == Picture::svg ? "svg" : picture == Picture::png ? "png" : "pdf";
}

std::string script(const Figure& figure, const FigureData& data,
                   const std::vector<Picture>& pictures) {
  return Script(figure, data).text(pictures);
}

namespace {

// Starts gnuplot with its default settings, without those of the user and of the terminal.
pid_t start(const std::filesystem::path& folder, std::string argument) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string name = "gnuplot", defaults = "-d";
  char* const arguments[] = {name.data(), defaults.data(), argument.data(), nullptr};
  pid_t pid = -1;
  if (posix_spawnp(&pid, name.c_str(), &actions, nullptr, arguments, environ) != 0) pid = -1;
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

bool succeeds(pid_t pid) {
  int status = 0;
  while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR) {}
  return pid > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

bool has_gnuplot() {
  // An empty script ends at once.
  return succeeds(start({}, "/dev/null"));
}

std::vector<std::string> draw(const std::filesystem::path& folder,
                              const std::vector<std::string>& scripts) {
  const std::size_t at_once = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
  std::vector<std::string> failed;
  for (std::size_t first = 0; first < scripts.size(); first += at_once) {
    const std::size_t last = std::min(first + at_once, scripts.size());
    std::vector<pid_t> running;
    for (std::size_t i = first; i < last; ++i) running.push_back(start(folder, scripts[i]));
    for (std::size_t i = first; i < last; ++i)
      if (!succeeds(running[i - first])) failed.push_back(scripts[i]);
  }
  return failed;
}

// A PDF refers to its parts by their offsets, so the date is replaced by blanks.
void take_date_out(const std::filesystem::path& pdf) {
  std::ostringstream text;
  text << std::ifstream(pdf, std::ios::binary).rdbuf();
  std::string bytes = text.str();
  const std::size_t from = bytes.rfind("/CreationDate (");
  const std::size_t to = bytes.find(')', from == bytes.npos ? bytes.size() : from);
  if (to == bytes.npos) return;
  bytes.replace(from, to + 1 - from, std::string(to + 1 - from, ' '));
  std::ofstream(pdf, std::ios::binary) << bytes;
}

}  // namespace sinew::report
