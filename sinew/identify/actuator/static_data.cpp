#include "sinew/identify/actuator/static_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "sinew/identify/actuator/static_settled.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

constexpr double turn = 0.1;  // share of the range of pressures; a smaller reversal ends no branch
constexpr int bins = 25;      // over the range of pressures
constexpr std::size_t fewest = 3;               // samples in a bin
constexpr double largest_zero_force = 0.25;     // share of the range of forces
constexpr double largest_zero_pressure = 0.05;  // share of the range of pressures
constexpr double same_pressure = 0.02;    // share of the largest pressure; closer ones are the same
constexpr double same_force = 0.02;       // share of the range of forces; closer ones are the same
constexpr double same_length = 0.01;      // share of the length; closer ones are one mount
constexpr int fewest_rests = 6;           // in a recording that steps from level to level
constexpr std::size_t most_omitted = 60;  // samples of a recording that are kept for display

constexpr std::pair<std::string_view, double> branch_words[] = {
    {"fill", 1.0}, {"vent", -1.0}, {"auf", 1.0}, {"ab", -1.0}};

constexpr ColumnSpec static_specs[] = {
    {"force", "N", 0.05, 2e4, optional_column, "tension of the muscle"},
    {"load", "kg", 0.005, 2e3, optional_column, "mass that hangs on the muscle, instead of force"},
    {"pressure", "Pa gauge", 1e4, 5e6, needed_column, "in the muscle"},
    {"length", "m", 0.005, 5, optional_column, "of the muscle"},
    {"rest_length", "m", 0.005, 5, optional_column,
     "of the muscle without pressure and load, where the file has several muscles"},
    {"contraction",
     "1",
     0,
     0.6,
     optional_column,
     "share of the rest length by which the muscle is shorter, instead of length",
     {},
     "length"},
    {"branch", "1", 0, 0, optional_column, "fill or vent", branch_words},
    {"time", "s", 0, 0, optional_column, "of a recording"},
};

std::vector<double> force_of(const Measured& m) {
  if (m.has("force") == m.has("load"))
    throw Refusal(m.file, m.has("force") ? "both force and load" : "neither force nor load",
                  "one of them", m.has("force") ? "" : "names.force=NAME");
  if (m.has("force")) return m["force"];
  std::vector<double> out = m["load"];
  for (double& x : out) x *= units::standard_gravity;
  return out;
}

// Returns the length of every row: a column, or the rest length less the contraction.
std::vector<double> length_of(const Measured& m, const StaticInput& input) {
  if (m.has("length")) return m["length"];
  if (m.has("contraction")) {
    if (!m.has("rest_length") && !(input.rest_length > 0))
      throw Refusal(m.file, "a contraction, and no rest length to count it from",
                    "the length of the muscle without pressure and load", "rest_length=\"250 mm\"");
    std::vector<double> out;
    for (std::size_t i = 0; i < m.rows(); ++i)
      out.push_back((m.has("rest_length") ? m["rest_length"][i] : input.rest_length) *
                    (1 - m["contraction"][i]));
    return out;
  }
  throw Refusal(m.file, "no length",
                "a column of lengths or contractions, or the one length of this file",
                "names.length=NAME, or values.length=\"205 mm\"");
}

// Refuses a sensor at its upper limit. The lower limit is allowed: a slack muscle stays there.
void refuse_full(const Measured& m, std::string_view column, const std::vector<double>& values) {
  const Clipping c = clipping(values);
  if (c.at_top == 0) return;
  throw Refusal(
      fmt::format("{}: {}", m.file, column),
      fmt::format("{} samples that stay at {}: the sensor or its converter is at its end", c.at_top,
                  m.has(column) ? in_unit_of_file(m, column, c.top, 5)
                                : units::format_quantity(c.top, "N", "N", 5)),
      "readings within its range", "a sensor of a larger range, or less pressure");
}

// Refuses rows of one length whose force falls as the pressure rises, beyond noise: columns are
// swapped or a sign is wrong. Rows at constant force are skipped, as they do not show this.
void refuse_falling(const Measured& m, const std::vector<double>& force,
                    const std::vector<double>& length) {
  const std::vector<double>& p = m["pressure"];
  const std::vector<int> group =
      mount_groups(length, 0.005 * largest(length), widest_mount * largest(length));
  double rise = 0, pressures = 0, forces = 0;
  for (int g = 0; g <= *std::max_element(group.begin(), group.end()); ++g) {
    std::vector<double> ps, fs;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (group[i] != g) continue;
      ps.push_back(p[i]);
      fs.push_back(force[i]);
    }
    if (largest(fs) - smallest(fs) < same_force * (largest(force) - smallest(force))) continue;
    const double p0 = median(ps), f0 = median(fs);
    for (std::size_t i = 0; i < ps.size(); ++i) {
      rise += (ps[i] - p0) * (fs[i] - f0);
      pressures += (ps[i] - p0) * (ps[i] - p0);
      forces += (fs[i] - f0) * (fs[i] - f0);
    }
  }
  if (rise < -0.3 * std::sqrt(pressures * forces))
    throw Refusal(m.file, "force that falls while the pressure rises", "a muscle that pulls",
                  "names.force=NAME, if columns are swapped, or the sign of the force");
}

// Returns running medians, so that the noise of single samples makes no turns.
std::vector<double> smooth(std::span<const double> values) { return running_medians(values, 7); }

// Returns running medians without wild readings at the ends, where medians are of few samples.
std::vector<double> without_wild_ends(std::span<const double> values) {
  constexpr std::size_t end = 3;
  std::vector<double> out = smooth(values);
  if (out.size() < 4 * end) return out;
  std::fill_n(out.begin(), end, out[end]);
  std::fill_n(out.rbegin(), end, out[out.size() - 1 - end]);
  return out;
}

// Returns whether the length of the muscle changes during the recording. Single wild readings do
// not count.
bool is_sweep(const Measured& m, const std::vector<double>& length) {
  if (!m.has("time")) return false;
  const std::vector<double> smoothed = without_wild_ends(length);
  return largest(smoothed) - smallest(smoothed) > same_length * median(length);
}

void check(const Measured& m, const std::vector<double>& force, const std::vector<double>& length) {
  const auto pressure = std::ranges::find(m.columns, "pressure", &recording::Column::name);
  const bool is_one_of_several = pressure != m.columns.end() && pressure->is_stated;
  if (!is_one_of_several && !is_sweep(m, length))
    refuse_constant(m, "pressure", same_pressure * largest(m["pressure"]),
                    "several pressures: a static law describes how force grows with them",
                    "fill the muscle step by step");
  if (m.has("time")) refuse_full(m, "pressure", m["pressure"]);
  if (m.has("time")) refuse_full(m, "force", force);

  refuse_falling(m, force, length);
}

// Returns the rows at which the pressure reverses: ends of the branches.
std::vector<std::size_t> turns_of(const std::vector<double>& p, double least) {
  std::vector<std::size_t> out{0};
  std::size_t low = 0, high = 0;
  int direction = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p[i] > p[high]) high = i;
    if (p[i] < p[low]) low = i;
    if (direction >= 0 && p[high] - p[i] > least) {
      if (direction > 0 || high > 0) out.push_back(high);
      direction = -1;
      low = i;
      high = i;
    } else if (direction <= 0 && p[i] - p[low] > least) {
      if (direction < 0) out.push_back(low);
      direction = 1;
      high = i;
      low = i;
    }
  }
  out.push_back(p.size());
  return out;
}

// Returns the zero readings: those before the pressure begins to rise.
Zero vented_start(const std::vector<double>& p, const std::vector<double>& f, StaticData& data,
                  const std::string& file) {
  const double lowest = smallest(p), range = largest(p) - lowest;
  std::size_t quiet = 0;
  while (quiet < p.size() && std::abs(p[quiet] - p[0]) < 0.01 * range) ++quiet;
  if (quiet < 10) {
    data.warnings.push_back(file + ": no rest at its beginning; zeros are taken as they are");
    return {};
  }
  Zero zero{.force = median(std::span(f).first(quiet)),
            .pressure = median(std::span(p).first(quiet)),
            .from = "the vented start"};
  if (std::abs(zero.pressure) > largest_zero_pressure * range) {
    data.warnings.push_back(
        fmt::format("{}: begins at {:.3g} kPa, which is no zero; pressure is taken as it is", file,
                    zero.pressure / 1e3));
    return {};
  }
  if (std::abs(zero.force) > largest_zero_force * (largest(f) - smallest(f))) {
    data.warnings.push_back(fmt::format(
        "{}: begins with {:.3g} N, which is no zero; force is taken as it is", file, zero.force));
    zero.force = 0;
  }
  return zero;
}

// Adds the bins of one branch, rows `from` to `to`, from samples that have settled.
void add_branch(const std::vector<double>& p, const std::vector<double>& f,
                const std::vector<bool>& settled, std::size_t from, std::size_t to, double width,
                const StaticPoint& like, StaticData& data) {
  std::vector<std::vector<double>> pressures, forces;
  for (std::size_t i = from; i < to; ++i) {
    if (!settled[i]) continue;
    const auto bin = static_cast<std::size_t>(std::max(0.0, std::floor(p[i] / width + 0.5)));
    if (bin >= pressures.size()) pressures.resize(bin + 1), forces.resize(bin + 1);
    pressures[bin].push_back(p[i]);
    forces[bin].push_back(f[i]);
  }
  for (std::size_t bin = 0; bin < pressures.size(); ++bin) {
    if (pressures[bin].empty()) continue;
    StaticPoint point = like;
    point.pressure = median(pressures[bin]);
    point.force = median(forces[bin]);
    if (pressures[bin].size() >= fewest) {
      data.points.push_back(point);
      continue;
    }
    StaticOmitted& few = data.omitted(
        "too few samples at a pressure",
        fmt::format("fewer than {} at rest in a step of 1/{} of the pressures", fewest, bins));
    few.count += pressures[bin].size();
    few.points.insert(few.points.end(), pressures[bin].size(), point);
  }
}

// Returns the samples at rest of a recording that steps from level to level. A recording whose
// pressure moves slowly all the time has no levels: all of its samples are used, and a note reports
// this.
std::vector<bool> choose_samples(const Measured& m, const std::vector<double>& p,
                                 StaticData& data) {
  const Settled settled = settled_samples(m["time"], p);
  if (settled.moving() == 0) return settled.sample;
  if (settled.rests < fewest_rests) {
    data.notes.push_back(
        fmt::format("{}: the pressure moves without resting at levels: every sample is used, and "
                    "the force may lag behind",
                    m.file));
    return std::vector<bool>(p.size(), true);
  }
  data.notes.push_back(
      fmt::format("{}: {} of {} samples left out, as the pressure moves by more than {:.2g} kPa in "
                  "{:.2g} s",
                  m.file, settled.moving(), p.size(), settled.most / 1e3, settled.window));
  return settled.sample;
}

// Keeps an even selection of the samples that were left out, for display.
void omit_moving(const std::vector<double>& p, const std::vector<double>& f,
                 const std::vector<bool>& settled, const StaticPoint& like, StaticData& data) {
  const auto count = static_cast<std::size_t>(std::ranges::count(settled, false));
  if (count == 0) return;
  StaticOmitted& moving =
      data.omitted("pressure still moving",
                   "the pressure, smoothed, changes within 0.12 s by more than 0.5 % of its range, "
                   "or than 6 of its scatters where that is more");
  moving.count += count;
  const std::size_t stride = 1 + (count - 1) / most_omitted;
  for (std::size_t i = 0, k = 0; i < settled.size(); ++i) {
    if (settled[i] || k++ % stride != 0) continue;
    moving.points.push_back(like);
    moving.points.back().pressure = p[i];
    moving.points.back().force = f[i];
  }
}

// Adds the points of a recording in which the muscle is pulled from length to length at resting
// pressure: the median of each length step, at each pressure level, in each direction.
void add_sweep(const Measured& m, const StaticInput& input, StaticData& data) {
  const std::vector<double>& p = m["pressure"];
  const std::vector<double> l = length_of(m, input), f = force_of(m);
  const Settled found = settled_samples(m["time"], p);
  const std::vector<bool> settled = found.rests > 0 ? found.sample : std::vector(p.size(), true);
  const std::vector<double> smoothed = without_wild_ends(l);
  const double low = smallest(smoothed), range = largest(smoothed) - low, top = largest(p);
  const std::vector<std::size_t> turns = turns_of(smoothed, turn * range);
  const std::vector<int> level = groups_of(p, same_pressure * top, 5 * same_pressure * top);

  struct Rows {
    std::vector<double> length, pressure, force;
  };
  std::map<std::tuple<std::size_t, int, int>, Rows> steps;
  for (std::size_t i = 0, way = 0; i < p.size(); ++i) {
    if (way + 1 < turns.size() && i >= turns[way + 1]) ++way;
    if (!settled[i]) continue;
    const int step = static_cast<int>(std::floor(bins * (l[i] - low) / range));
    Rows& rows = steps[{way, level[i], std::min(step, bins - 1)}];
    rows.length.push_back(l[i]);
    rows.pressure.push_back(p[i]);
    rows.force.push_back(f[i]);
  }
  StaticOmitted few{.reason = "too few samples at a length",
                    .criterion = fmt::format(
                        "fewer than {} at rest in a step of 1/{} of the lengths", fewest, bins)};
  for (const auto& [step, rows] : steps) {
    const StaticPoint point{.length = median(rows.length),
                            .pressure = median(rows.pressure),
                            .force = median(rows.force),
                            .rest_length = input.rest_length,
                            .fitted = input.fitted};
    if (rows.length.size() >= fewest) {
      data.points.push_back(point);
      continue;
    }
    few.count += rows.length.size();
    few.points.insert(few.points.end(), rows.length.size(), point);
  }
  if (few.count == std::accumulate(settled.begin(), settled.end(), std::size_t{0}))
    throw Refusal(m.file, fmt::format("a length that changes, in {} rows", m.rows()),
                  fmt::format("at least {} rows in a step of 1/{} of the lengths, at one pressure",
                              fewest, bins),
                  "a slower sweep, or a table of points at rest, without the time");
  if (few.count > 0) {
    StaticOmitted& all = data.omitted(few.reason, few.criterion);
    all.count += few.count;
    all.points.insert(all.points.end(), few.points.begin(), few.points.end());
  }
  data.notes.push_back(fmt::format(
      "{}: pulled from {:.4g} to {:.4g} mm on {} ways{}: the medians of {} steps are fitted; the "
      "zeros are taken as they are",
      m.file, 1e3 * low, 1e3 * (low + range), turns.size() - 1,
      found.rests > 0 ? ", where the pressure rests" : "", bins));
}

// Leaves out the samples of a hold at another length than that of the most: wild readings.
void leave_out_wild(const std::vector<double>& lengths, double length, const std::string& file,
                    std::vector<bool>& settled, StaticData& data) {
  const double far = std::max(same_length * length, 8 * spread(lengths));
  std::size_t count = 0, one = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (std::abs(lengths[i] - length) <= far) continue;
    settled[i] = false;
    one = count++ == 0 ? i : one;
  }
  if (count > 0)
    data.warnings.push_back(
        fmt::format("{}: {} of {} samples left out, as their length, such as {:.4g} mm, is not "
                    "that of the hold, {:.4g} mm",
                    file, count, lengths.size(), 1e3 * lengths[one], 1e3 * length));
}

Zero add_recording(const Measured& m, const StaticInput& input, StaticData& data) {
  std::vector<double> p = m["pressure"], f = force_of(m);
  const std::vector<double> lengths = length_of(m, input);
  const double length = median(lengths);
  const Zero zero = vented_start(smooth(p), f, data, m.file);
  for (double& x : p) x -= zero.pressure;
  for (double& x : f) x -= zero.force;

  const double range = largest(p) - smallest(p);
  const std::vector<std::size_t> turns = turns_of(smooth(p), turn * range);
  std::vector<bool> settled = choose_samples(m, p, data);
  leave_out_wild(lengths, length, m.file, settled, data);
  StaticPoint like{.length = length, .rest_length = input.rest_length, .fitted = input.fitted};
  omit_moving(p, f, settled, like, data);
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const std::size_t last = std::min(turns[i + 1], p.size() - 1);
    like.branch = p[last] > p[turns[i]] ? Branch::fill : Branch::vent;
    add_branch(p, f, settled, turns[i], turns[i + 1], range / bins, like, data);
  }
  data.notes.push_back(fmt::format("{}: {} branches; zeros {:.3g} N, {:.3g} kPa from {}", m.file,
                                   turns.size() - 1, zero.force, zero.pressure / 1e3,
                                   zero.from.empty() ? "nowhere" : zero.from));
  return zero;
}

// Returns the force reading of the slack muscle: rows of one length, from the lowest pressure
// up, whose force does not change. Median of all such rows; 0 if there are too few.
double slack_force(const std::vector<double>& length, const std::vector<double>& p,
                   const std::vector<double>& f) {
  const double range = largest(p) - smallest(p), near = 0.005 * (largest(f) - smallest(f));
  const std::vector<int> group =
      mount_groups(length, 0.005 * largest(length), widest_mount * largest(length));
  std::vector<double> slack;
  for (int g = 0; g <= *std::max_element(group.begin(), group.end()); ++g) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (group[i] == g) rows.push_back(i);
    std::stable_sort(rows.begin(), rows.end(),
                     [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> level;
    std::size_t last = 0;
    for (const std::size_t row : rows) {
      if (!level.empty() && std::abs(f[row] - median(level)) > near) break;
      level.push_back(f[row]);
      last = row;
    }
    if (level.size() >= 4 && p[last] - p[rows.front()] > 0.12 * range)
      slack.insert(slack.end(), level.begin(), level.end());
  }
  return slack.empty() ? 0.0 : median(slack);
}

Zero add_table(const Measured& m, const StaticInput& input, StaticData& data) {
  const std::vector<double> length = length_of(m, input);
  std::vector<double> force = force_of(m);
  Zero zero{.force = slack_force(length, m["pressure"], force)};
  if (std::abs(zero.force) > largest_zero_force * (largest(force) - smallest(force))) {
    data.warnings.push_back(
        fmt::format("{}: {:.3g} N where it is slack, which is no zero; force is taken as it is",
                    m.file, zero.force));
    zero.force = 0;
  }
  if (zero.force != 0) {
    zero.from = "slack rows";
    data.notes.push_back(fmt::format("{}: zero {:.3g} N from slack rows", m.file, zero.force));
  }
  for (std::size_t i = 0; i < m.rows(); ++i) {
    StaticPoint point{.length = length[i],
                      .pressure = m["pressure"][i],
                      .force = force[i] - zero.force,
                      .rest_length = m.has("rest_length") ? m["rest_length"][i] : input.rest_length,
                      .fitted = input.fitted};
    if (m.has("branch")) point.branch = m["branch"][i] > 0 ? Branch::fill : Branch::vent;
    if (!m.weights.empty()) {
      point.weight = m.weights[i];
      const double per_response = m.has("load") ? units::standard_gravity : 1;  // [N/kg], [1]
      point.variance = m.variances[i] * per_response * per_response;
    }
    data.points.push_back(point);
  }
  return zero;
}

}  // namespace

StaticOmitted& StaticData::omitted(const std::string& reason, const std::string& criterion) {
  const auto at = std::ranges::find(left_out, reason, &StaticOmitted::reason);
  if (at != left_out.end()) return *at;
  return left_out.emplace_back(StaticOmitted{.reason = reason, .criterion = criterion});
}

std::span<const ColumnSpec> static_columns() { return static_specs; }

Zero add_points(const Measured& m, const StaticInput& input, StaticData& data) {
  if (m.rows() == 0) throw Refusal(m.file, "no rows", "rows of numbers", "");
  check(m, force_of(m), length_of(m, input));
  for (const std::string& note : m.notes) data.notes.push_back(m.file + ": " + note);
  if (is_sweep(m, length_of(m, input))) {
    add_sweep(m, input, data);
    return {};
  }
  return m.has("time") ? add_recording(m, input, data) : add_table(m, input, data);
}

std::set<double> muscles_in(std::span<const StaticPoint> points) {
  const std::vector<double> all = values_of(points, &StaticPoint::rest_length);
  return {all.begin(), all.end()};
}

std::vector<StaticPoint> points_of(std::span<const StaticPoint> points, double rest_length) {
  std::vector<StaticPoint> out;
  std::ranges::copy_if(points, std::back_inserter(out),
                       [=](const StaticPoint& p) { return p.rest_length == rest_length; });
  return out;
}

std::vector<double> values_of(std::span<const StaticPoint> points, double StaticPoint::*value) {
  std::vector<double> out;
  for (const StaticPoint& p : points) out.push_back(p.*value);
  return out;
}

bool has_branch(std::span<const StaticPoint> points, Branch branch) {
  return std::ranges::find(points, branch, &StaticPoint::branch) != points.end();
}

double give_longest(std::vector<StaticPoint>& points) {
  const double longest = std::max(0.0, largest(values_of(points, &StaticPoint::length)));
  double given = 0;
  for (StaticPoint& p : points)
    if (!(p.rest_length > 0)) p.rest_length = given = longest;
  return given;
}

void sort_points(std::vector<StaticPoint>& points) {
  const auto key = [](const StaticPoint& p) {
    return std::tuple(p.rest_length, -static_cast<int>(p.branch), p.length, p.pressure, p.force,
                      p.fitted);
  };
  std::sort(points.begin(), points.end(),
            [&](const StaticPoint& a, const StaticPoint& b) { return key(a) < key(b); });
}

std::vector<int> groups_of(std::span<const double> values, double gap, double most) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<int> out(values.size());
  if (values.empty()) return out;
  int group = 0;
  double first = values[order[0]], before = first, widest = 0;
  for (const std::size_t i : order) {
    if (values[i] - before > gap) {
      ++group;
      first = values[i];
    }
    before = values[i];
    widest = std::max(widest, values[i] - first);
    out[i] = group;
  }
  if (widest <= most) return out;
  const double lowest = values[order[0]];
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<int>(std::floor((values[i] - lowest) / (0.5 * most)));
  return out;
}

std::vector<int> mount_groups(std::span<const double> lengths, double gap, double widest) {
  const std::vector<int> chain = groups_of(lengths, gap, std::numeric_limits<double>::infinity());
  std::map<int, std::pair<double, double>> ends;  // ends of each chain
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    auto& [first, last] = ends.try_emplace(chain[i], lengths[i], lengths[i]).first->second;
    first = std::min(first, lengths[i]);
    last = std::max(last, lengths[i]);
  }
  // A sweep is divided into whole steps, so that no group is narrower than the others.
  std::vector<std::pair<int, int>> step;  // chain and step of each length
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto [first, last] = ends.at(chain[i]);
    const double width = last - first;
    const double steps = width > widest ? std::round(width / (0.5 * widest)) : 1;
    const double at = width > 0 ? std::floor((lengths[i] - first) / width * steps) : 0;
    step.emplace_back(chain[i], static_cast<int>(std::min(at, steps - 1)));
  }
  const std::set<std::pair<int, int>> all(step.begin(), step.end());
  std::vector<int> out;
  for (const auto& one : step)
    out.push_back(static_cast<int>(std::distance(all.begin(), all.find(one))));
  return out;
}

}  // namespace sinew::identify
