// What a page shows of the test stand: over time, and one quantity against another.
#include <algorithm>
#include <cmath>

#include "sinew/report/page/stand.h"

namespace sinew::report {
namespace {

// Does it move by more than rounding?
bool varies(const Samples& s) {
  if (!s) return false;
  double least = INFINITY, most = -INFINITY;
  for (const double v : *s.values)
    if (std::isfinite(v)) least = std::min(least, v), most = std::max(most, v);
  return most - least > 1e-9 * std::max(std::abs(most), std::abs(least));
}

// One against another over the run, if both move on one clock.
void add_loop(const Channels& channels, const std::string& title, const ChartAxis& x,
              const Channel& xs, const ChartAxis& y, const Channel& ys, std::vector<Chart>& out) {
  const Samples a = channels.find(xs), b = channels.find(ys);
  if (!varies(a) || !varies(b) || *a.time_ns != *b.time_ns) return;
  ChartCurve curve{.label = y.label, .x_channel = xs, .y_channel = ys};
  out.push_back({title, x, y, {std::move(curve)}, "Over the whole run; the dot is its time."});
}

void add_sweep(const Channels& channels, const std::string& title, const std::string& what,
               const std::string& unit, std::vector<Chart>& out) {
  const Samples duty = channels.find({"/sweep/duty"}), values = channels.find({what});
  if (!duty || !values) return;
  ChartCurve line{
      .label = "settled", .x = duty.values->in_memory(), .y = values.values->in_memory()};
  ChartCurve points{.label = "", .style = ChartCurve::Style::points, .x = line.x, .y = line.y};
  out.push_back({title, {"delivered duty", "share"}, {title, unit}, {line, points}, ""});
}

}  // namespace

std::vector<Chart> stand_charts(const Channels& channels, const Stand& s) {
  std::vector<Chart> out;
  const ChartAxis length{"length", "m"}, tension{"tension", "N"}, pressure{"pressure", "Pa"};
  if (!s.empty()) {
    add_loop(channels, "Tension against length", length, s.length, tension, s.tension, out);
    add_loop(channels, "Pressure against length", length, s.length, pressure, s.pressure, out);
    if (s.load == Stand::Load::clamped)
      add_loop(channels, "Tension against pressure", pressure, s.pressure, tension, s.tension, out);
  }
  add_sweep(channels, "Length", "/true/sweep/length", "m", out);
  add_sweep(channels, "Ripple of the length", "/true/sweep/ripple", "m", out);
  add_sweep(channels, "Pressure", "/true/sweep/pressure", "Pa", out);
  add_sweep(channels, "Tension", "/true/sweep/force", "N", out);
  return out;
}

}  // namespace sinew::report
