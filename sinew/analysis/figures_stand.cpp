// analysis/figures_stand.cpp - figures of a run on the test stand, from its log alone.
//
//   stand.…    lengths, forces, pressures at their extremes, air used, cycles
//   swing.…    a load that swings freely: turning points, period, damping by [45]-[53]
//   pulsed.…   means and ripples of the last five periods of a pulsed valve
//   track.…    length against the desired one
//   sweep.…    settled lengths by duty, "sweep.42_5.length_m"
//
// docs/theory/test-stand.md has the definitions. A key that does not apply is absent.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/rain_flow.h"

namespace sinew::analysis {
namespace {

using signals::Column;

constexpr double seconds_per_ns = 1e-9;

struct Log {
  const Figures& figures;
  const MachineStand& stand;
  Column time;  // [s]

  bool wants(std::string_view part) const { return figures.wants(part); }
  void add(const std::string& key, double value) const {
    if (wants(key)) figures.summary.add(key, value);
  }
  const Column* find(const std::string& topic) const {
    const signals::Series* series = figures.record.find(topic);
    return series ? &series->columns[0] : nullptr;
  }

  // Return a channel's values at `time`, or nullptr if it was recorded at other times.
  const Column* of_stand(const std::string& what) const { return at_time("/stand/" + what); }
  const Column* muscle(const std::string& what) const {
    return at_time("/muscle/" + stand.element.name + "/" + what);
  }

 private:
  const Column* at_time(const std::string& topic) const {
    const signals::Series* series = figures.record.true_or_measured(topic);
    return series && series->time_ns == figures.record.time_ns() ? &series->columns[0] : nullptr;
  }
};

// Adds the extremes of values(), which returns a column or nullptr.
template <class Values>
void add_extremes(const Log& log, const std::string& key, const Values& values) {
  const std::string least = "stand.least_" + key, greatest = "stand.greatest_" + key;
  if (!log.wants(least) && !log.wants(greatest)) return;
  const Column* column = values();
  if (!column || column->empty()) return;
  log.add(least, std::ranges::min(*column));
  log.add(greatest, std::ranges::max(*column));
}

void add_stand(const Log& log) {
  log.add("duration_s", log.time.back());
  const Column* length = log.of_stand("length");
  if (length && !length->empty()) {
    log.add("stand.start_length_m", length->front());
    log.add("stand.final_length_m", length->back());
  }
  add_extremes(log, "length_m", [&] { return length; });
  add_extremes(log, "force_N", [&] { return log.of_stand("force"); });
  add_extremes(log, "pressure_Pa", [&] { return log.muscle("pressure"); });
  if (log.wants("stand.air_used_kg"))
    if (const Column* in = log.muscle("air_in"); in && !in->empty())
      log.add("stand.air_used_kg", in->back());
  if (!log.wants("stand.switchings")) return;
  std::size_t edges = 0;
  for (const signals::Series& s : log.figures.record.table().series)
    if (s.topic.name.starts_with("/valve/"))
      edges += log.figures.record.find(s.topic.name)->time_ns.size();
  if (edges > 0) log.add("stand.switchings", static_cast<double>(edges));
}

// Adds the cycles of contraction and pressure, by rain flow, of a stand with a muscle.
void add_wear(const Log& log, const Machine& machine) {
  const auto a =
      std::ranges::find(machine.actuators, log.stand.element.actuator, &actuator::Actuator::name);
  if (a == machine.actuators.end()) return;
  const double longest = a->long_end.length;
  if (log.wants("stand.contraction_cycles"))
    if (const Column* length = log.of_stand("length"); length && longest > 0)
      log.add("stand.contraction_cycles",
              cycles_in(rain_flow(*length, least_contraction * longest)));
  if (log.wants("stand.pressure_cycles"))
    if (const Column* pressure = log.muscle("pressure"))
      log.add("stand.pressure_cycles", cycles_in(rain_flow(*pressure, least_pressure)));
}

// A maximum of a sampled curve: the vertex of the parabola through three samples.
struct Turn {
  double at = 0, value = 0;
};
std::vector<Turn> tops(const Column& time, const Column& x) {
  std::vector<Turn> out;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    if (!(x[i] >= x[i - 1] && x[i] > x[i + 1])) continue;
    const double bend = x[i - 1] - 2 * x[i] + x[i + 1], tilt = 0.5 * (x[i + 1] - x[i - 1]);
    const double step = time[i + 1] - time[i];
    out.push_back({time[i] - step * tilt / bend, x[i] - 0.5 * tilt * tilt / bend});
  }
  return out;
}

// Adds the damping by [45]-[53] from the first and the third swing; the mass is the hanging load.
void add_damping(const Log& log, const std::vector<Turn>& turns, double rest, double period) {
  const double x1 = turns[0].value - rest, dx1 = turns[0].value - turns[1].value;
  const double x3 = turns[2].value - rest, dx3 = turns[2].value - turns[3].value;
  log.add("swing.first_amplitude_m", x1);
  log.add("swing.first_loss_m", dx1);
  log.add("swing.damping_ratio", std::log(x1 / (x1 - dx1)) / (2 * std::numbers::pi));
  const double b = 1 - (dx1 - dx3) / (x1 - x3);
  log.add("swing.coulomb_length_m", (dx1 - x1 * (1 - b)) / 4);
  const Column* mass = log.of_stand("mass");
  if (mass && !mass->empty())
    log.add("swing.viscous_N_s_per_m", 2 * mass->front() / period * std::log(1 / b));
}

// Adds the figures of a load that is released from rest and swings until it rests again.
void add_swing(const Log& log) {
  if (!log.wants("swing.")) return;
  const Column* length = log.of_stand("length");
  const Column* speed = log.of_stand("velocity");
  const Column* mass = log.of_stand("mass");
  if (log.stand.drive != "none" || !mass || !length || !speed || length->empty()) return;
  if (mass->front() != mass->back() || speed->front() != 0) return;
  std::vector<Turn> turns{{0, length->front()}};
  for (const Turn& t : tops(log.time, *length)) turns.push_back(t);
  const double rest = length->back();
  if (turns.size() < 6 || !(turns[0].value - rest > 1e-5)) return;

  const double period = (turns[4].at - turns[0].at) / 4;
  log.add("swing.first_period_s", turns[1].at);
  log.add("swing.period_s", period);
  log.add("swing.frequency_Hz", 1 / period);
  for (std::size_t k = 1; k < 6; ++k) log.add(fmt::format("swing.peak_{}_m", k), turns[k].value);
  add_damping(log, turns, rest, period);
  const double near = 0.02 * (turns[0].value - rest);
  double settled = 0;
  for (std::size_t i = 0; i < length->size(); ++i)
    if (std::fabs((*length)[i] - rest) > near) settled = log.time[i];
  log.add("swing.settling_time_s", settled);
}

struct Window {
  std::size_t begin = 0, end = 0;
};

// Returns the samples of the last five whole periods of the drive.
Window last_periods(const Log& log) {
  const double last = log.time.back(), period = log.stand.drive_period;
  const double whole = std::floor(last / period + 1e-6) * period;
  Window w;
  const auto sample = [&](double t) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(log.time, t - 0.25 * (log.time[1] - log.time[0])) -
        log.time.begin());
  };
  w.begin = sample(whole - 5 * period);
  w.end = sample(whole);
  return w;
}

struct Ripple {
  double mean = 0, ripple = 0;
};

// Returns mean and ripple of the values in the window; nothing without values.
std::optional<Ripple> ripple_of(const Window& w, const Column* values) {
  if (!values || w.end <= w.begin) return {};
  const std::vector<double> last = values->slice(w.begin, w.end);
  double sum = 0;
  for (const double x : last) sum += x;
  const auto [least, most] = std::ranges::minmax(last);
  return Ripple{sum / static_cast<double>(last.size()), most - least};
}

bool pulses(const std::string& drive) {
  return drive == "pwm" || drive == "feed-forward" || drive == "feedback";
}

// Adds means and ripples of the last periods; returns the mean length [m], if there is one.
std::optional<double> add_pulsed(const Log& log) {
  if (!pulses(log.stand.drive) || log.time.back() < 5 * log.stand.drive_period ||
      log.time.size() < 2)
    return {};
  const Window w = last_periods(log);
  const auto add = [&](const Column* values, const std::string& mean_key,
                       const std::string& ripple_key) -> std::optional<double> {
    const std::optional<Ripple> its = ripple_of(w, values);
    if (!its) return {};
    log.add("pulsed." + mean_key, its->mean);
    log.add("pulsed." + ripple_key, its->ripple);
    return its->mean;
  };
  const auto length = add(log.of_stand("length"), "length_m", "length_ripple_m");
  if (log.wants("pulsed.pressure"))
    add(log.muscle("pressure"), "pressure_Pa", "pressure_ripple_diff_Pa");
  if (log.wants("pulsed.force")) add(log.of_stand("force"), "force_N", "force_ripple_N");
  return length;
}

// `settled`: the mean length of the last periods [m], if there is one.
void add_track(const Log& log, std::optional<double> settled) {
  if (!log.wants("track.")) return;
  const Column* length = log.of_stand("length");
  const Column* desired = log.find("/desired/length");
  if (!length || !desired || length->empty() || desired->size() != length->size()) return;
  double square = 0;
  for (std::size_t i = 0; i < length->size(); ++i) {
    const double error = (*length)[i] - (*desired)[i];
    square += error * error;
  }
  log.add("track.rms_m", std::sqrt(square / static_cast<double>(length->size())));
  if (settled) log.add("track.final_error_m", *settled - desired->back());
}

void add_sweep(const Figures& f) {
  if (!f.wants("sweep.")) return;
  const auto column = [&](const char* topic) {
    const signals::Series* series = f.record.find(topic);
    return series ? &series->columns[0] : nullptr;
  };
  const Column* duty = column("/sweep/duty");
  if (!duty) return;
  for (std::size_t i = 0; i < duty->size(); ++i) {
    std::string percent = fmt::format("{:.6g}", 100 * (*duty)[i]);
    std::ranges::replace(percent, '.', '_');
    const auto add = [&](const char* topic, const char* key) {
      if (const Column* c = column(topic))
        f.summary.add(fmt::format("sweep.{}.{}", percent, key), (*c)[i]);
    };
    add("/true/sweep/length", "length_m");
    add("/true/sweep/ripple", "length_ripple_m");
    add("/true/sweep/pressure", "pressure_Pa");
    add("/true/sweep/force", "force_N");
  }
}

}  // namespace

void add_stand(Figures& f) {
  add_sweep(f);
  const signals::Times& time_ns = f.record.time_ns();
  if (time_ns.empty()) return;
  Log log{f, *f.machine.stand, f.record.new_column()};
  for (const std::int64_t ns : time_ns)
    log.time.push_back(seconds_per_ns * static_cast<double>(ns));
  add_stand(log);
  add_wear(log, f.machine);
  add_swing(log);
  add_track(log, add_pulsed(log));
}

}  // namespace sinew::analysis
