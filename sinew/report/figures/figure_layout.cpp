#include "sinew/report/figures/figure_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew::report {
namespace {

struct Range {
  double from = INFINITY, to = -INFINITY;
  bool empty() const { return !(from <= to); }
  void add(double value) {
    from = std::min(from, value);
    to = std::max(to, value);
  }
};

bool within(const Axis& axis, double value) {
  return std::isfinite(value) && !(value < axis.from) && !(value > axis.to) &&
         (!axis.logarithmic || value > 0);
}

// Range of the samples that are within the axes.
struct Extent {
  Range x, y;

  void add(const Plot& plot, const Curve& curve) {
    for (std::size_t i = 0; i < std::min(curve.xs.size(), curve.ys.size()); ++i)
      if (within(plot.x, curve.xs[i]) && within(plot.y, curve.ys[i])) {
        x.add(curve.xs[i]);
        y.add(curve.ys[i]);
      }
    if (curve.style == Curve::Style::bars && !y.empty() && !plot.y.logarithmic) y.add(0);
  }
};

// Returns 1, 2 or 5 times a power of ten, at least `step`.
double round_step(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

// Returns n steps; a step below 1 is applied as a division, so that the result is exactly rounded.
double multiple(double step, double n) { return step < 1 ? n / std::round(1 / step) : n * step; }

Scale logarithmic_scale(const Axis& axis, double least, double greatest) {
  Scale out{axis.from, axis.to, 10};
  if (std::isnan(out.from)) out.from = std::pow(10, std::floor(std::log10(least) + 1e-9));
  if (std::isnan(out.to)) out.to = std::pow(10, std::ceil(std::log10(greatest) - 1e-9));
  if (!(out.to > out.from)) out.to = 10 * out.from;
  return out;
}

struct Axes {
  Scale x, y;
  double left, right, height;
};

// Makes room for the names of rows.
void make_room(const std::vector<Axis::Tick>& rows, const Print& print, Axes& axes) {
  std::size_t longest = 0;
  for (const Axis::Tick& row : rows) longest = std::max(longest, letters(row.text));
  if (rows.empty()) return;
  const double wanted = 6 * print.gap + print.letter * static_cast<double>(longest);
  axes.left = std::clamp(wanted, print.left, 0.6 * print.width);
  axes.height = std::max(print.lowest, 1.1 * print.line * static_cast<double>(rows.size()));
}

// Gives both axes the same scale, by the height within its limits, or else by extending one range.
void make_equal(const Print& print, double lowest, double tallest, Axes& axes) {
  const double width = print.width - print.left - print.right;
  const double wanted = width * (axes.y.to - axes.y.from) / (axes.x.to - axes.x.from);
  axes.height = std::clamp(wanted, lowest, tallest);
  Scale& more = wanted < axes.height ? axes.y : axes.x;
  const double by = wanted < axes.height ? axes.height / wanted : wanted / axes.height;
  const double middle = (more.from + more.to) / 2, half = by * (more.to - more.from) / 2;
  more.from = middle - half;
  more.to = middle + half;
  axes.x.step = round_step((axes.x.to - axes.x.from) / 6);
  axes.y.step = round_step((axes.y.to - axes.y.from) / std::min(6.0, axes.height / print.tick));
}

// Reduces the ticks of a short axis, so that their numbers do not overlap.
void separate_ticks(const Plot& plot, const Print& print, Axes& axes) {
  constexpr double number = 6;  // letters per number, with the space between two
  const auto fewer = [](const Axis& axis, Scale& s, double room) {
    if (axis.logarithmic || !axis.ticks.empty() || (s.to - s.from) / s.step <= room) return;
    s.step = round_step((s.to - s.from) / std::max(1.0, room));
  };
  fewer(plot.x, axes.x, (print.width - axes.left - axes.right) / (number * print.letter));
  fewer(plot.y, axes.y, axes.height / (0.8 * print.tick));
}

// Returns the axes of a plot. `height` is that of the data; 0: the default.
Axes axes_of(const Plot& plot, const Print& print, double height) {
  Extent all;
  for (const Curve& c : plot.curves) all.add(plot, c);
  const bool nothing = all.x.empty();
  const bool bars = std::ranges::any_of(
      plot.curves, [](const Curve& c) { return c.style == Curve::Style::bars; });
  const double none = plot.y.logarithmic ? 1 : 0;
  Axes out{scale(plot.x, nothing ? none : all.x.from, nothing ? 1 : all.x.to,
                 !plot.equal_scale && !bars),
           scale(plot.y, nothing ? none : all.y.from, nothing ? 1 : all.y.to, false), print.left,
           print.right, print.plot};
  make_room(plot.y.ticks, print, out);
  if (height > 0) out.height = height;
  separate_ticks(plot, print, out);
  if (plot.equal_scale) {
    make_equal(print, height > 0 ? height : print.lowest, height > 0 ? height : print.tallest, out);
    separate_ticks(plot, print, out);
  }
  if (plot.names == Plot::Names::ends)
    for (const Curve& c : plot.curves)
      if (naming(plot, c) == Plot::Names::ends)
        out.right = std::max(out.right,
                             3 * print.gap + print.letter * static_cast<double>(letters(c.label)));
  return out;
}

std::string in_legend(const Curve& curve) {
  return curve.kind == Curve::Kind::synthetic ? curve.label + " (synthetic)" : curve.label;
}

// Adds the legend in columns of equal width. Returns its height.
double add_legend(const Plot& plot, const Print& print, PlotLayout& out, double top) {
  std::size_t longest = 0;
  for (const std::size_t c : out.curves) {
    if (naming(plot, plot.curves[c]) != Plot::Names::legend) continue;
    out.legend.push_back({c, in_legend(plot.curves[c])});
    longest = std::max(longest, letters(out.legend.back().text));
  }
  if (out.legend.empty()) return 0;
  const double room = print.width - print.left - print.right;
  const double entry = print.sample + 3 * print.gap + print.letter * static_cast<double>(longest);
  const int n = static_cast<int>(out.legend.size());
  const int most = std::clamp(static_cast<int>(room / entry), 1, 4);
  const int rows = (n + most - 1) / most, columns = (n + rows - 1) / rows;
  for (int i = 0; i < n; ++i) {
    out.legend[static_cast<std::size_t>(i)].x = print.left + entry * (i % columns);
    out.legend[static_cast<std::size_t>(i)].y = top + print.line * (i / columns + 0.5);
  }
  return print.line * rows + print.gap;
}

}  // namespace

Plot::Names naming(const Plot& plot, const Curve& curve) {
  if (curve.label.empty() || !curve.in_legend) return Plot::Names::none;
  const bool points = curve.style == Curve::Style::points;
  return plot.names == Plot::Names::ends && points ? Plot::Names::legend : plot.names;
}

Scale scale(const Axis& axis, double least, double greatest, bool tight) {
  if (axis.logarithmic) return logarithmic_scale(axis, least, greatest);
  Scale out{axis.from, axis.to, 1};
  if (std::isnan(out.from)) out.from = std::isnan(out.to) ? least : std::min(least, out.to);
  if (std::isnan(out.to)) out.to = std::max(greatest, out.from);
  if (!(out.to - out.from > 1e-12 * std::max(std::fabs(out.from), std::fabs(out.to)))) {
    // A constant is in the middle.
    const double beside = out.from == 0 ? 1 : 0.1 * std::fabs(out.from);
    if (std::isnan(axis.from)) out.from -= beside;
    if (std::isnan(axis.to)) out.to += beside;
    tight = false;
  }
  out.step = round_step((out.to - out.from) / (tight ? 7 : 6));
  const double first = multiple(out.step, std::floor(out.from / out.step + 1e-9));
  const double last = multiple(out.step, std::ceil(out.to / out.step - 1e-9));
  // A tight end that is close to a tick is moved to it: the first sample of a run may be at 10 ms.
  const double near = tight ? 0.02 * (out.to - out.from) : INFINITY;
  if (std::isnan(axis.from) && out.from - first <= near) out.from = first;
  if (std::isnan(axis.to) && last - out.to <= near) out.to = last;
  return out;
}

Print::Print(const Paper& paper) : width(paper.width), font(paper.font) {
  const double by = font / 7;  // the numbers below were chosen for 7 pt
  const double wide = std::sqrt(width / 252);
  left = 38 * by;
  right = 8 * by;
  line = 9 * by;
  letter = 3.75 * by;
  numbers = 9 * by;
  plot = 105 * wide;
  tallest = 290 * wide;
  tick = 14 * by;
  sample = 16 * by;
  gap = 4 * by;
}

namespace {

// Returns the layout for a given height of each plot's data.
FigureLayout laid_out(const Figure& figure, const Print& print, double height) {
  FigureLayout out;
  double y = print.top;
  for (const Plot& plot : figure.plots) {
    PlotLayout p;
    for (std::size_t c = 0; c < plot.curves.size(); ++c) {
      Extent extent;
      extent.add(plot, plot.curves[c]);
      if (!extent.x.empty()) p.curves.push_back(c);
    }
    const Axes axes = axes_of(plot, print, height);
    p.x = axes.x;
    p.y = axes.y;
    p.left = axes.left;
    p.right = axes.right;
    p.title = y + print.line / 2;
    if (!plot.title.empty()) y += print.line + print.gap / 2;
    y += add_legend(plot, print, p, y);
    p.top = y + print.gap;
    p.bottom = y = p.top + axes.height;
    y += print.numbers + 1.5 * print.line + 2 * print.gap;
    out.plots.push_back(std::move(p));
  }
  out.height = y - 2 * print.gap + print.bottom;
  return out;
}

}  // namespace

FigureLayout layout(const Figure& figure) {
  const Print print(figure.paper);
  FigureLayout out = laid_out(figure, print, 0);
  if (!(figure.paper.height > 0) || figure.plots.empty()) return out;
  double data = 0;
  for (const PlotLayout& p : out.plots) data += p.bottom - p.top;
  const double beside = out.height - data, n = static_cast<double>(figure.plots.size());
  const double least = beside + n * 2 * print.tick;
  if (figure.paper.height < least)
    throw std::invalid_argument(fmt::format(
        "{:.0f} mm at least for figure {}, {} plot{} high", std::ceil(least * 25.4 / 72),
        figure.name, figure.plots.size(), figure.plots.size() == 1 ? "" : "s"));
  return laid_out(figure, print, (figure.paper.height - beside) / n);
}

std::size_t letters(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace sinew::report
