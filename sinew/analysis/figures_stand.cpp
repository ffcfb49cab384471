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
#include <vector>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/rain_flow.h"
#include "sinew/analysis/warnings.h"

namespace sinew::analysis {
namespace {

using signals::Column;

constexpr double seconds_per_ns = 1e-9;

// Returns the true channel of a simulation, "/true/stand/length", or else the measured one,
// "/stand/length"; nullptr if both are missing or empty.
const signals::Series* known(const signals::Table& table, const std::string& topic) {
  const signals::Series* series = table.find("/true" + topic);
  if (!series) series = table.find(topic);
  return series && !series->time_ns.empty() ? series : nullptr;
}

struct Log {
  const signals::Table& table;
  const MachineStand& stand;
  Summary& summary;
  const signals::Times& time_ns;
  Column time;  // [s]

  const Column* find(const std::string& topic) const { return table.column(topic); }

  // Return a channel's values at `time`, or nullptr if it was recorded at other times.
  const Column* of_stand(const std::string& what) const { return at_time("/stand/" + what); }
  const Column* muscle(const std::string& what) const {
    return at_time("/muscle/" + stand.element.name + "/" + what);
  }

 private:
  const Column* at_time(const std::string& topic) const {
    const signals::Series* series = known(table, topic);
    return series && series->time_ns == time_ns ? &series->columns[0] : nullptr;
  }
};

void add_extremes(Log& log, const Column* values, const std::string& key) {
  if (!values || values->empty()) return;
  const auto [least, most] = std::ranges::minmax(*values);
  log.summary.add("stand.least_" + key, least);
  log.summary.add("stand.greatest_" + key, most);
}

void add_stand(Log& log) {
  log.summary.add("duration_s", log.time.back());
  const Column* length = log.of_stand("length");
  if (length && !length->empty()) {
    log.summary.add("stand.start_length_m", length->front());
    log.summary.add("stand.final_length_m", length->back());
  }
  add_extremes(log, length, "length_m");
  add_extremes(log, log.of_stand("force"), "force_N");
  add_extremes(log, log.muscle("pressure"), "pressure_Pa");
  if (const Column* in = log.muscle("air_in"); in && !in->empty())
    log.summary.add("stand.air_used_kg", in->back());
  std::size_t edges = 0;
  for (const signals::Series& s : log.table.series)
    if (s.topic.name.starts_with("/valve/")) edges += s.time_ns.size();
  if (edges > 0) log.summary.add("stand.switchings", static_cast<double>(edges));
}

// Adds the cycles of contraction and pressure, by rain flow, of a stand with a muscle.
void add_wear(Log& log, const Machine& machine) {
  const auto a =
      std::ranges::find(machine.actuators, log.stand.element.actuator, &actuator::Actuator::name);
  if (a == machine.actuators.end()) return;
  const double longest = a->long_end.length;
  if (const Column* length = log.of_stand("length"); length && longest > 0)
    log.summary.add("stand.contraction_cycles",
                    cycles_in(rain_flow(*length, least_contraction * longest)));
  if (const Column* pressure = log.muscle("pressure"))
    log.summary.add("stand.pressure_cycles", cycles_in(rain_flow(*pressure, least_pressure)));
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
void add_damping(Log& log, const std::vector<Turn>& turns, double rest, double period) {
  const double x1 = turns[0].value - rest, dx1 = turns[0].value - turns[1].value;
  const double x3 = turns[2].value - rest, dx3 = turns[2].value - turns[3].value;
  log.summary.add("swing.first_amplitude_m", x1);
  log.summary.add("swing.first_loss_m", dx1);
  log.summary.add("swing.damping_ratio", std::log(x1 / (x1 - dx1)) / (2 * std::numbers::pi));
  const double b = 1 - (dx1 - dx3) / (x1 - x3);
  log.summary.add("swing.coulomb_length_m", (dx1 - x1 * (1 - b)) / 4);
  const Column* mass = log.of_stand("mass");
  if (mass && !mass->empty())
    log.summary.add("swing.viscous_N_s_per_m", 2 * mass->front() / period * std::log(1 / b));
}

// Adds the figures of a load that is released from rest and swings until it rests again.
void add_swing(Log& log) {
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
  log.summary.add("swing.first_period_s", turns[1].at);
  log.summary.add("swing.period_s", period);
  log.summary.add("swing.frequency_Hz", 1 / period);
  for (std::size_t k = 1; k < 6; ++k)
    log.summary.add(fmt::format("swing.peak_{}_m", k), turns[k].value);
  add_damping(log, turns, rest, period);
  const double near = 0.02 * (turns[0].value - rest);
  double settled = 0;
  for (std::size_t i = 0; i < length->size(); ++i)
    if (std::fabs((*length)[i] - rest) > near) settled = log.time[i];
  log.summary.add("swing.settling_time_s", settled);
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

void add_ripple(Log& log, const Window& w, const Column* values, const std::string& mean_key,
                const std::string& ripple_key) {
  if (!values || w.end <= w.begin) return;
  const std::vector<double> last = values->slice(w.begin, w.end);
  double sum = 0;
  for (const double x : last) sum += x;
  const auto [least, most] = std::ranges::minmax(last);
  log.summary.add("pulsed." + mean_key, sum / static_cast<double>(last.size()));
  log.summary.add("pulsed." + ripple_key, most - least);
}

bool pulses(const std::string& drive) {
  return drive == "pwm" || drive == "feed-forward" || drive == "feedback";
}

void add_pulsed(Log& log) {
  if (!pulses(log.stand.drive) || log.time.back() < 5 * log.stand.drive_period ||
      log.time.size() < 2)
    return;
  const Window w = last_periods(log);
  add_ripple(log, w, log.of_stand("length"), "length_m", "length_ripple_m");
  add_ripple(log, w, log.muscle("pressure"), "pressure_Pa", "pressure_ripple_diff_Pa");
  add_ripple(log, w, log.of_stand("force"), "force_N", "force_ripple_N");
}

void add_track(Log& log) {
  const Column* length = log.of_stand("length");
  const Column* desired = log.find("/desired/length");
  if (!length || !desired || length->empty() || desired->size() != length->size()) return;
  double square = 0;
  for (std::size_t i = 0; i < length->size(); ++i) {
    const double error = (*length)[i] - (*desired)[i];
    square += error * error;
  }
  log.summary.add("track.rms_m", std::sqrt(square / static_cast<double>(length->size())));
  if (const double* settled = log.summary.find("pulsed.length_m"))
    log.summary.add("track.final_error_m", *settled - desired->back());
}

void add_sweep(const signals::Table& table, Summary& summary) {
  const Column* duty = table.column("/sweep/duty");
  if (!duty) return;
  for (std::size_t i = 0; i < duty->size(); ++i) {
    std::string percent = fmt::format("{:.6g}", 100 * (*duty)[i]);
    std::ranges::replace(percent, '.', '_');
    const auto add = [&](const char* topic, const char* key) {
      if (const Column* c = table.column(topic))
        summary.add(fmt::format("sweep.{}.{}", percent, key), (*c)[i]);
    };
    add("/true/sweep/length", "length_m");
    add("/true/sweep/ripple", "length_ripple_m");
    add("/true/sweep/pressure", "pressure_Pa");
    add("/true/sweep/force", "force_N");
  }
}

}  // namespace

Summary summarize_stand(const signals::Table& table, const Machine& machine) {
  Summary summary;
  summary.title = machine.title;
  summary.reproduces = machine.reproduces;
  summary.faults = machine.faults;
  add_sweep(table, summary);
  const signals::Series* rows = known(table, "/stand/length");
  if (!rows) rows = known(table, "/stand/force");
  if (!rows) rows = known(table, "/muscle/" + machine.stand->element.name + "/pressure");
  summary.warnings = texts(warnings(table, machine));
  if (!rows) return summary;
  Log log{table, *machine.stand, summary, rows->time_ns, Column(rows->time_ns.file())};
  for (const std::int64_t ns : rows->time_ns)
    log.time.push_back(seconds_per_ns * static_cast<double>(ns));
  summary.faults = begun_by(machine.faults, log.time.back());
  add_stand(log);
  add_wear(log, machine);
  add_swing(log);
  add_pulsed(log);
  add_track(log);
  return summary;
}

}  // namespace sinew::analysis
