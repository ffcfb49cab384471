#include "sinew/identify/machine/driven_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>

#include "sinew/config/diagnostics.h"
#include "sinew/robot/legs.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/valve_commands.h"
#include "sinew/world/machine.h"

namespace sinew::identify {

// --- channels of a recorded run ---

namespace {

using experiment::Experiment;
using signals::Tick;
using Of = RunChannel::Of;
using Kind = robot::Sensor::Kind;

constexpr double rounding_variance = 1.0 / 12;  // rounding to a whole number [count^2]

Tick nearest_tick(std::int64_t time_ns) {
  return (time_ns + signals::tick_nanoseconds / 2) / signals::tick_nanoseconds;
}

// Returns the channel of a sensor; empty for a quantity that cannot move.
std::optional<RunChannel> channel_of(const Experiment& e, const robot::Sensor& sensor) {
  const int joint = robot::find_joint(e.robot, sensor.of);
  const int muscle = robot::find_muscle(e.robot, sensor.of);
  const double per_volt = e.robot.converter.counts_per_volt();
  RunChannel out{.name = sensor.name, .unit = "count", .at_zero = sensor.at_rest};
  const bool of_joint = sensor.kind == Kind::angle || sensor.kind == Kind::velocity;
  const bool of_muscle = sensor.kind == Kind::tension || sensor.kind == Kind::pressure;
  if ((of_joint && joint < 0) || (of_muscle && muscle < 0) || sensor.kind == Kind::fixed) return {};
  out.index = static_cast<std::size_t>(of_joint ? joint : of_muscle ? muscle : 0);
  out.of = sensor.kind == Kind::angle      ? Of::angle
           : sensor.kind == Kind::velocity ? Of::rate
           : sensor.kind == Kind::tension  ? Of::tension
           : sensor.kind == Kind::pressure ? Of::pressure
                                           : Of::lift;
  const bool per_unit = sensor.kind == Kind::angle || sensor.kind == Kind::cylinder;
  out.per_unit = per_unit ? per_volt / sensor.scale : per_volt * sensor.scale;
  out.noise = std::sqrt(sensor.noise * sensor.noise + rounding_variance);
  out.bottom = 0;
  out.top = e.robot.converter.top();
  return out;
}

// Returns the topic of the sensor's quantity in a recording; empty if it has none.
std::string topic_of(const Experiment& e, const RunChannel& c) {
  if (c.of == Of::angle) return robot::topic_of_joint(e.robot, c.index) + "/angle";
  if (c.of == Of::rate) return robot::topic_of_joint(e.robot, c.index) + "/velocity";
  if (c.of == Of::tension) return robot::topic_of_muscle(e.robot, c.index) + "/tension";
  if (c.of == Of::pressure) return robot::topic_of_muscle(e.robot, c.index) + "/pressure";
  return "/cylinder/position";
}

// Turns a sensor's channel into one of the quantity itself, in the SI unit of its topic.
RunChannel quantity_channel(const Experiment& e, RunChannel c, const signals::Series& series) {
  c.name = series.topic.name;
  c.unit = series.topic.fields[0].unit;
  c.noise /= std::abs(c.per_unit);
  c.per_unit = 1;
  c.at_zero = c.of == Of::angle      ? e.robot.joints[c.index].rest_angle
              : c.of == Of::pressure ? e.air.atmosphere
                                     : 0.0;
  c.bottom = -std::numeric_limits<double>::infinity();
  c.top = std::numeric_limits<double>::infinity();
  return c;
}

// Ticks at which a sensor's conversions begin and are read, within a period.
struct Converted {
  Tick start = 0, read = 0, period = 100;

  // Returns the start of the last conversion read at or before the row; negative: none.
  Tick last_before(Tick row) const {
    const Tick into = ((row - read) % period + period) % period;
    return row - into - (read - start);
  }
};

void add_samples(const signals::Series& series, const Converted* scan, RunChannel& c) {
  for (std::size_t i = 0; i < series.time_ns.size(); ++i) {
    const double value = series.columns[0][i];
    const Tick row = nearest_tick(series.time_ns[i]);
    const Tick at = scan ? scan->last_before(row) : row;
    // Rows between conversions repeat the last value.
    if (!std::isfinite(value) || at < 0 || (!c.at.empty() && at <= c.at.back())) continue;
    c.at.push_back(at);
    c.value.push_back(value);
  }
}

// Leaves out long runs at the limits of the converter, where the value is unknown.
void leave_out_ends(RunChannel& c) {
  constexpr std::size_t around = 10;  // samples kept at each side
  const std::size_t n = c.value.size();
  std::vector<bool> out(n, false);
  const auto at_end = [&](std::size_t i) { return c.value[i] <= c.bottom || c.value[i] >= c.top; };
  std::size_t run = 0;  // length of the run at a limit
  for (std::size_t i = 0; i < n; ++i) {
    run = at_end(i) ? run + 1 : 0;
    if (run >= 2 * around + 1) out[i - around] = true;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (out[i]) continue;
    c.at[kept] = c.at[i];
    c.value[kept++] = c.value[i];
  }
  c.at.resize(kept);
  c.value.resize(kept);
}

// Returns the noise of a recording from its third differences, in which slow motion vanishes.
double noise_of(const std::vector<double>& v) {
  std::vector<double> d;
  for (std::size_t i = 3; i < v.size(); ++i)
    d.push_back(std::abs(v[i] - 3 * v[i - 1] + 3 * v[i - 2] - v[i - 3]));
  if (d.empty()) return 0;
  std::ranges::nth_element(d, d.begin() + static_cast<std::ptrdiff_t>(d.size() / 2));
  constexpr double median = 0.6745;  // |x| of a unit normal; squared weights sum to 20
  return d[d.size() / 2] / (median * std::sqrt(20.0));
}

// Adds pressures measured by external instruments, if the robot has no sensor for them.
void add_instruments(const Experiment& e, const signals::Table& recorded,
                     std::vector<RunChannel>& out) {
  for (std::size_t m = 0; m < e.robot.muscles.size(); ++m) {
    const std::string topic = robot::topic_of_muscle(e.robot, m) + "/pressure";
    const signals::Series* series = recorded.find(topic);
    const bool sensed = std::ranges::any_of(
        out, [&](const RunChannel& c) { return c.of == Of::pressure && c.index == m; });
    if (!series || sensed || series->time_ns.size() < 4) continue;
    RunChannel c = quantity_channel(e, {.of = Of::pressure, .index = m}, *series);
    add_samples(*series, nullptr, c);
    constexpr double least = 100;  // accuracy of a laboratory gauge [Pa]
    c.noise = std::max(least, noise_of(c.value));
    out.push_back(std::move(c));
  }
}

}  // namespace

double RunChannel::quantity(const plant::Truth& truth, const robot::Robot& robot,
                            double atmosphere) const {
  if (of == Of::angle) return truth.angle[index] - robot.joints[index].rest_angle;
  if (of == Of::rate) return truth.rate[index];
  if (of == Of::tension) return truth.tension[index];
  if (of == Of::pressure) return truth.pressure[index] - atmosphere;
  return truth.lift;
}

double RunChannel::expected(double quantity) const {
  const double mean = at_zero + per_unit * quantity;
  // Mean of max(bottom, x), with x normal about `mean`, and the same at the upper limit.
  const auto excess = [](double z) {  // mean of max(0, x), x normal about z
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
    return z * 0.5 * std::erfc(-z / std::numbers::sqrt2) + density;
  };
  constexpr double far = 6;  // in standard deviations: no clipping
  if (mean < bottom + far * noise) return bottom + noise * excess((mean - bottom) / noise);
  if (mean > top - far * noise) return top - noise * excess((top - mean) / noise);
  return mean;
}

std::vector<RunChannel> run_channels(const Experiment& e, const signals::Table& recorded,
                                     bool imported, const std::string& name) {
  const run::Boards boards(run::boards_of(e));
  const signals::Scan scan = boards.scan();
  std::vector<RunChannel> out;
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s) {
    std::optional<RunChannel> c = channel_of(e, e.robot.sensors[s]);
    if (!c) continue;
    Converted converted{.period = scan.period};
    for (const signals::Conversion& one : scan.conversions)
      if (one.channel.index == s) converted = {one.start, one.read, scan.period};
    const signals::Series* counts = recorded.find("/sensor/" + c->name + "/count");
    const signals::Series* quantity = recorded.find(topic_of(e, *c));
    // Counts that were computed from recorded quantities use assumed scales.
    const bool made = counts && imported && counts->topic.description.starts_with("from /");
    if (counts && !(made && quantity)) {
      add_samples(*counts, imported ? nullptr : &converted, *c);
    } else if (quantity) {
      *c = quantity_channel(e, *c, *quantity);
      add_samples(*quantity, nullptr, *c);
    }
    leave_out_ends(*c);
    // A constant reading carries no information.
    if (std::ranges::adjacent_find(c->value, std::not_equal_to<>()) != c->value.end())
      out.push_back(std::move(*c));
  }
  add_instruments(e, recorded, out);
  if (out.empty())
    config::fail({name, 0, 0}, "", "no channel of a sensor that moves",
                 "counts of sensors, or angles, tensions, pressures",
                 "a mapping that names their columns, as sinew import makes it");
  return out;
}

using experiment::Experiment;

namespace {

// Returns whether all edges coincide with rows of a table: their times are then only known to a
// row.
bool is_of_rows(const signals::Series& edges, const std::vector<RunChannel>& channels) {
  return std::ranges::all_of(edges.time_ns, [&](std::int64_t time) {
    const signals::Tick at = time / signals::tick_nanoseconds;
    return std::ranges::binary_search(channels[0].at, at);
  });
}

// Adds the edge from which a valve stays open to the end although its duty is zero: the final
// vent is not in the duties, and its time is only known to a row of the table.
void add_last_vent(const signals::Series& open, const signals::Series& duty, std::size_t valve,
                   std::vector<signals::Edge>& out) {
  constexpr std::size_t rows = 3;  // more than a pulse
  std::size_t idle = duty.time_ns.size(), opened = open.time_ns.size();
  while (idle > 0 && duty.columns[0][idle - 1] == 0) --idle;
  while (opened > 0 && open.columns[0][opened - 1] > 0) --opened;
  if (idle + rows > duty.time_ns.size() || opened == open.time_ns.size()) return;
  const std::int64_t from = std::max(open.time_ns[opened], duty.time_ns[idle]);
  if (from <= duty.time_ns[duty.time_ns.size() - rows])
    out.push_back(
        {.at = nearest_tick(from), .valve = {static_cast<std::uint8_t>(valve)}, .open = true});
}

}  // namespace

DrivenRun::DrivenRun(const Experiment& e, const signals::Table& recorded, bool imported,
                     const std::string& name)
    : channels_(run_channels(e, recorded, imported, name)) {
  signals::Table table = recorded;
  std::vector<signals::Edge> vents;
  const std::vector<std::string> edges = run::edge_topics(e), duties = run::duty_topics(e);
  for (std::size_t v = 0; v < edges.size(); ++v) {
    const signals::Series* series = recorded.find(edges[v]);
    if (!imported || !series || series->time_ns.empty() || !is_of_rows(*series, channels_))
      continue;
    if (const signals::Series* duty = recorded.find(duties[v])) {  // exact within the period
      add_last_vent(*series, *duty, v, vents);
      std::erase_if(table.series, [&](const auto& s) { return s.topic.name == edges[v]; });
    } else {
      coarse_.push_back(edges[v]);
    }
  }
  run::ValveCommands commands = run::valve_commands(e, table, name);
  edges_ = std::move(commands.edges);
  for (const signals::Edge& vent : vents) {
    std::erase_if(edges_, [&](const signals::Edge& one) {
      return one.valve.index == vent.valve.index && one.at >= vent.at;
    });
    edges_.push_back(vent);
  }
  std::ranges::stable_sort(edges_, {}, &signals::Edge::at);
  rebuilt_ = std::move(commands.rebuilt);
  for (std::size_t c = 0; c < channels_.size(); ++c)
    for (const signals::Tick at : channels_[c].at) {
      instants_.push_back({at, instants_.size(), c});
      time_.push_back(static_cast<double>(at) * signals::tick_seconds);
    }
  std::ranges::stable_sort(instants_, {}, &Instant::at);
}

double DrivenRun::duration() const {
  return static_cast<double>(instants_.back().at) * signals::tick_seconds;
}

template <class Visit>
bool DrivenRun::drive(const Experiment& e, double until, Visit visit) const {
  plant::Machine machine(run::planar_setup(e));
  std::size_t edge = 0;
  signals::Tick shown = -1;
  plant::Truth truth;
  for (const Instant& i : instants_) {
    const double t = static_cast<double>(i.at) * signals::tick_seconds;
    if (t > until) break;
    for (; edge < edges_.size() && edges_[edge].at <= i.at; ++edge)
      (void)machine.port().drive(edges_[edge]);
    // Several sensors may be sampled at the same instant.
    if (i.at != shown) truth = machine.truth(t);
    shown = i.at;
    if (machine.failure() || !visit(i, truth)) return false;
  }
  return true;
}

bool DrivenRun::predict(const Experiment& e, std::span<double> out, double until) const {
  return drive(e, until, [&](const Instant& i, const plant::Truth& truth) {
    const RunChannel& c = channels_[i.channel];
    out[i.sample] = c.expected(c.quantity(truth, e.robot, e.air.atmosphere));
    return std::isfinite(out[i.sample]);
  });
}

int DrivenRun::landings(const Experiment& e, double until) const {
  std::array<bool, robot::max_legs> foot{};
  std::array<bool, robot::max_discs> disc{};
  int out = 0;
  bool first = true;
  const auto note = [&](bool& down, double force) {
    out += !first && force > 0 && !down ? 1 : 0;
    down = force > 0;
  };
  (void)drive(e, until, [&](const Instant&, const plant::Truth& truth) {
    for (std::size_t k = 0; k < foot.size(); ++k) note(foot[k], truth.foot[k].force_y);
    for (std::size_t k = 0; k < disc.size(); ++k) note(disc[k], truth.disc_force[k]);
    first = false;
    return true;
  });
  return out;
}

}  // namespace sinew::identify
