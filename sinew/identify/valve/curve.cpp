#include "sinew/identify/valve/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

constexpr std::size_t fewest_on_the_way = 8;  // samples between 10 and 90 %
constexpr double smallest_range = 5e3;        // [Pa]
constexpr std::size_t most_alternating = 8;   // curves in one table

std::string pressure_text(double p) { return units::format_quantity(p, "Pa abs", "kPa abs", 4); }

// Returns the first row beyond this share of the change; rows() if no row is.
std::size_t first_beyond(const Curve& c, double share) {
  for (std::size_t i = 0; i < c.pressure.size(); ++i)
    if (c.share(c.pressure[i]) >= share) return i;
  return c.pressure.size();
}

// Returns the sum of squared residuals of these rows about a rest up to the row `last`, followed by
// a straight rise or fall.
double left_by_rest(const Curve& c, std::span<const std::size_t> rows, std::size_t last) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const std::size_t i : rows) {
    const double since = std::max(0.0, c.time[i] - c.time[last]), p = c.pressure[i] - c.pressure[0];
    n += 1;
    x += since;
    y += p;
    xx += since * since;
    xy += since * p;
    yy += p * p;
  }
  const double across = xx - x * x / n, along = xy - x * y / n;
  return std::max(0.0, yy - y * y / n - (across > 0 ? along * along / across : 0.0));
}

// Returns whether the record begins before the pressure moves: a rest of two rows or more fits the
// first tenth of the change much better than a rise from the first row. Long records are thinned.
bool rests_first(const Curve& c) {
  constexpr std::size_t enough = 200;
  const std::size_t moves = first_beyond(c, 0.03), end = std::max(first_beyond(c, 0.1), moves + 2);
  if (moves < 2 || end > c.time.size()) return moves >= 2;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < end; i += 1 + end / enough) rows.push_back(i);
  const double from_first = left_by_rest(c, rows, 0);
  for (std::size_t last = 1; last < moves; last += 1 + moves / enough)
    if (left_by_rest(c, rows, last) < 0.5 * from_first) return true;
  return false;
}

void find_ends(const Measured& data, Curve& c) {
  const std::size_t n = c.pressure.size(), tail = std::max<std::size_t>(3, n / 20);
  c.end = median(std::span(c.pressure).last(std::min(tail, n)));
  c.start = c.pressure.front();
  if (c.range() < smallest_range)
    throw Refusal(data.file + ": pressure",
                  fmt::format("{} at the start and {} at the end", pressure_text(c.start),
                              pressure_text(c.end)),
                  "a chamber that fills or vents by more than 5 kPa", "the columns, and the valve");
  const std::size_t moves = first_beyond(c, 0.03);
  c.opening_seen = rests_first(c);
  if (c.opening_seen)
    c.start = median(std::span(c.pressure).first(std::min<std::size_t>(moves, 9)));
}

void find_rate(const Measured& data, Curve& c) {
  const std::size_t a = first_beyond(c, 0.1), b = first_beyond(c, 0.9);
  const std::size_t on_the_way = b > a ? b - a : 0;
  if (on_the_way < fewest_on_the_way)
    throw Refusal(
        data.file + ": time", fmt::format("{} samples between 10 and 90 % of the way", on_the_way),
        fmt::format("at least {}: the sample rate is too low for this volume", fewest_on_the_way),
        "a faster sampling, or a larger volume");
  const std::size_t from = first_beyond(c, 0.15), to = std::max(first_beyond(c, 0.5), from + 2);
  c.rate = (c.pressure[to] - c.pressure[from]) / std::max(c.time[to] - c.time[from], 1e-9);
  const std::size_t last = c.time.size() - 1, tenth = last - std::max<std::size_t>(last / 10, 4);
  const double at_end = (c.pressure[last] - c.pressure[tenth]) / (c.time[last] - c.time[tenth]);
  c.settled = std::abs(at_end) < 0.1 * std::abs(c.rate);
  const std::size_t moves = first_beyond(c, 0.03);
  c.opening = c.opening_seen ? c.time[moves - 1] : c.time.front();
}

// Throws Refusal for a clipped curve. A flow through a valve slows down as the pressures approach
// each other; a curve that reaches its end at full rate and then stays on one value shows the
// limit of the sensor.
void refuse_saturated(const Measured& data, const Curve& c) {
  const std::size_t a = first_beyond(c, 0.6), b = first_beyond(c, 0.95);
  const double extreme = c.fills() ? largest(c.pressure) : smallest(c.pressure);
  const auto top = std::find(c.pressure.begin(), c.pressure.end(), extreme);
  const auto at = static_cast<std::size_t>(top - c.pressure.begin());
  std::size_t stays = 0;
  while (at + stays < c.pressure.size() && c.pressure[at + stays] == extreme) ++stays;
  if (stays < 5 || at <= b || b <= a) return;

  const double before = (c.share(c.pressure[b]) - c.share(c.pressure[a])) / (c.time[b] - c.time[a]);
  const double last = (1.0 - c.share(c.pressure[b - 1])) / (c.time[at] - c.time[b - 1]);
  if (last < 0.7 * before) return;
  throw Refusal(data.file + ": pressure",
                fmt::format("{} samples at {} right after full speed: the sensor or its converter "
                            "is at its end",
                            stays, pressure_text(extreme)),
                "a curve that slows down as it reaches the pressure of the port",
                "a sensor with a larger range, or a lower pressure");
}

// Throws Refusal if the rows of several curves alternate: a sample is then closer to one a few rows
// before than to its neighbour.
void refuse_alternating(const Measured& data, const Curve& c) {
  const auto way = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < c.pressure.size(); ++i)
      sum += std::abs(c.pressure[i] - c.pressure[i - lag]);
    return sum / static_cast<double>(c.pressure.size() - lag);
  };
  const double next = way(1);
  for (std::size_t lag = 2; lag <= most_alternating && 4 * lag < c.pressure.size(); ++lag)
    if (next > 4 * way(lag))
      throw Refusal(data.file + ": pressure", fmt::format("{} curves whose rows take turns", lag),
                    "the rows of one filling or venting",
                    "where=\"valve=inlet\", with the column that names the valve of a row");
}

void refuse_to_and_fro(const Measured& data, const Curve& c) {
  double most = c.start;  // farthest value so far
  std::size_t where = 0;
  for (std::size_t i = 0; i < c.pressure.size(); ++i) {
    if (c.share(c.pressure[i]) > c.share(most)) most = c.pressure[i];
    if (c.share(most) - c.share(c.pressure[i]) > 0.15 && where == 0) where = i;
  }
  if (where == 0) return;
  throw Refusal(
      fmt::format("{}:{}: pressure", data.file, data.lines[where]),
      fmt::format("a fall back by more than 15 % of the way, to {}",
                  pressure_text(c.pressure[where])),
      "one filling or one venting",
      "where=\"valve=inlet\", if a column names the valve of a row; or a column `command`, for "
      "pulses");
}

// Removes rows long after the pressure has settled, which would only improve the score.
void cut_hold(Curve& c) {
  const std::size_t settled = first_beyond(c, 0.98);
  if (settled >= c.time.size()) return;
  const double until = c.opening + 2.0 * (c.time[settled] - c.opening);
  std::size_t keep = settled;
  while (keep < c.time.size() && c.time[keep] <= until) ++keep;
  if (keep == c.time.size()) return;
  c.notes.push_back(
      fmt::format("{} of {} rows are fitted, until {:.4g} s: of the hold, as long as it took to "
                  "come within 2 %",
                  keep, c.time.size(), c.time[keep - 1]));
  c.time.resize(keep);
  c.pressure.resize(keep);
}

void add_time_notes(const Measured& data, Curve& c) {
  std::size_t same = 0;
  for (std::size_t i = 1; i < c.time.size(); ++i) same += c.time[i] == c.time[i - 1];
  if (same > 0)
    c.notes.push_back(
        fmt::format("{}: {} rows have the time of the row before them", data.file, same));
  if (!c.opening_seen)
    c.notes.emplace_back(
        "the curve begins while the pressure moves: the valve's instant is not in it");
}

}  // namespace

Curve curve_of(const Measured& data) {
  Curve c{.time = data["time"], .pressure = data["pressure"], .notes = data.notes};
  if (data.rows() < 2 * fewest_on_the_way)
    throw Refusal(data.file, fmt::format("{} rows", data.rows()),
                  fmt::format("at least {}", 2 * fewest_on_the_way), "a longer record");
  refuse_alternating(data, c);
  find_ends(data, c);
  find_rate(data, c);
  refuse_saturated(data, c);
  refuse_to_and_fro(data, c);
  cut_hold(c);
  add_time_notes(data, c);
  return c;
}

}  // namespace sinew::identify
