// muscles.<m>.*, passiveness, air, valves: what the muscles do and what they cost.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/statistics.h"
#include "sinew/analysis/measures/valves.h"

namespace sinew::analysis {
namespace {

std::string topic(const robot::Muscle& m, const char* what) {
  return "/muscle/" + m.name + "/" + what;
}

double mean_duty(const Figures& f, const robot::Muscle& m, const char* what) {
  return mean(f.record.column(topic(m, what)), f.record.sequence());
}

// The valve's edges; nothing where the log or the machine has none. A valve that never opens has an
// empty series.
struct Switching {
  bool logged = false;
  Edges electrical, delivered;
  gas::Coil coil;
};

// `of` is what the valve belongs to, "hip_flexor".
Switching switching(const Figures& f, const std::string& of, const char* which,
                    const std::string& valve) {
  const signals::Series* s = f.record.find("/valve/" + of + "/" + which + "/open");
  if (!s || s->columns.empty() || valve.empty()) return {};
  const MachineValve its = valve_of(f.machine, valve);
  Switching out{.logged = true,
                .electrical = edges_of(s->time_ns, s->columns[0]),
                .delivered = {},
                .coil = its.coil};
  out.delivered = delivered(out.electrical, its.opening, its.closing);
  return out;
}

Switching switching(const Figures& f, const robot::Muscle& m, const char* which) {
  const bool inlet = std::string_view(which) == "inlet";
  return switching(f, m.name, which, inlet ? m.inlet : m.exhaust);
}

// Of all valves, those of the cylinder last.
std::vector<Switching> all_switching(const Figures& f) {
  std::vector<Switching> out;
  for (const robot::Muscle& m : f.machine.robot.muscles)
    for (const char* which : {"inlet", "exhaust"}) out.push_back(switching(f, m, which));
  const robot::Cylinder& c = f.machine.robot.cylinder;
  for (const auto& [of, chamber] : {std::pair{"cylinder_up", &c.up}, {"cylinder_down", &c.down}}) {
    out.push_back(switching(f, of, "inlet", chamber->inlet));
    out.push_back(switching(f, of, "exhaust", chamber->exhaust));
  }
  std::erase_if(out, [](const Switching& s) { return !s.logged; });
  return out;
}

// Share of the sequence's time in which the valve really stands open.
double delivered_duty_anew(const Figures& f, const robot::Muscle& m, const char* which) {
  if (!f.record.has_sequence()) return no_figure;
  const Switching s = switching(f, m, which);
  if (!s.logged) return no_figure;
  const double from = f.record.sequence_start(), to = f.record.sequence_end();
  return open_time(s.delivered, from, to) / (to - from);
}

// Several figures ask for it.
double delivered_duty(const Figures& f, const robot::Muscle& m, const char* which) {
  const auto [at, is_new] = f.delivered_duties.try_emplace(m.name + "/" + which);
  if (is_new) at->second = delivered_duty_anew(f, m, which);
  return at->second;
}

// Of a topic that only grows: what it gains between two rows.
double gained(const Figures& f, const std::string& name, std::size_t from, std::size_t to) {
  const Column c = f.record.column(name);
  return c.empty() ? no_figure : c[to] - c[from];
}

double air_in(const Figures& f, const robot::Muscle& m) {
  return gained(f, "/true" + topic(m, "air_in"), 0, f.record.rows() - 1);
}

// What the converter says of a muscle's tension; nothing where it has no transducer.
struct Reading {
  const robot::Sensor* sensor = nullptr;
  Column counts;
};

Reading reading(const Figures& f, std::size_t muscle) {
  const int s = robot::tension_sensor_of(f.machine.robot, static_cast<int>(muscle));
  if (s < 0) return {};
  const robot::Sensor& sensor = f.machine.robot.sensors[static_cast<std::size_t>(s)];
  return {&sensor, f.record.column("/sensor/" + sensor.name + "/count")};
}

// Share of the sequence at the converter's ceiling.
double clipped(const Figures& f, const Reading& r) {
  Column is_clipped = f.record.new_column();
  for (const double c : r.counts)
    is_clipped.push_back(!std::isfinite(c) ? c : c >= f.machine.robot.converter.top() ? 1.0 : 0.0);
  return mean(is_clipped, f.record.sequence());
}

// The largest tension that the controller believes: one scale for all transducers  [N].
double believed_peak(const Figures& f, const Reading& r) {
  if (!r.sensor || !(r.sensor->assumed_scale > 0)) return no_figure;
  const double counts = largest(r.counts, f.record.sequence());
  return (counts - r.sensor->assumed_at_rest) /
         (r.sensor->assumed_scale * f.machine.robot.converter.counts_per_volt());
}

// All valves together, electrical, within [from, to).
struct Use {
  double openings = 0, time = 0, energy = 0;  // [-], [s], [J]
};

Use use_of(const std::vector<Switching>& valves, double from, double to) {
  Use use;
  for (const Switching& s : valves) {
    use.openings += openings(s.electrical, from, to);
    use.time += open_time(s.electrical, from, to);
    use.energy += coil_energy(s.electrical, s.coil, from, to);
  }
  return use;
}

// One valve whose power nobody knows, and the sum says nothing.
bool power_is_known(const std::vector<Switching>& valves) {
  return std::ranges::all_of(valves, [](const Switching& s) { return s.coil.power > 0; });
}

}  // namespace

double passiveness(const Figures& f, const robot::Muscle& m) {
  return passive(f.machine, m, mean_duty(f, m, "inlet_duty"), mean_duty(f, m, "exhaust_duty"));
}

double delivered_passiveness(const Figures& f, const robot::Muscle& m) {
  const bool seals = valve_of(f.machine, m.inlet).seals;
  return passive(f.machine, m, delivered_duty(f, m, "inlet"),
                 seals ? delivered_duty(f, m, "exhaust") : 0.0);
}

void add_muscles(Figures& f) {
  const Column& sequence = f.record.sequence();
  for (std::size_t i = 0; i < f.machine.robot.muscles.size(); ++i) {
    const robot::Muscle& m = f.machine.robot.muscles[i];
    const std::string key = "muscles." + m.name + ".";
    f.add(key + "peak_tension_N", largest, f.record.column("/true" + topic(m, "tension")),
          sequence);
    f.summary.add(key + "measured_peak_tension_N", believed_peak(f, reading(f, i)));
    f.add(key + "own_scale_peak_tension_N", largest, f.record.column(topic(m, "tension")),
          sequence);
    f.summary.add(key + "clipped_share", clipped(f, reading(f, i)));
    f.summary.add(key + "mean_inlet_duty", mean_duty(f, m, "inlet_duty"));
    f.summary.add(key + "mean_exhaust_duty", mean_duty(f, m, "exhaust_duty"));
    f.summary.add(key + "delivered_inlet_duty", delivered_duty(f, m, "inlet"));
    f.summary.add(key + "delivered_exhaust_duty", delivered_duty(f, m, "exhaust"));
    f.summary.add(key + "passiveness", passiveness(f, m));
    f.summary.add(key + "passiveness_delivered", delivered_passiveness(f, m));
    f.summary.add(key + "air_used_kg", air_in(f, m));
  }
}

void add_passiveness(Figures& f) {
  double commanded = no_figure, delivered = no_figure;
  for (const robot::Muscle& m : f.machine.robot.muscles) {
    commanded = std::fmin(commanded, passiveness(f, m));
    delivered = std::fmin(delivered, delivered_passiveness(f, m));
  }
  f.summary.add("passiveness", commanded);
  f.summary.add("passiveness_delivered", delivered);
}

void add_air(Figures& f) {
  double all = 0, in_sequence = 0;
  for (const robot::Muscle& m : f.machine.robot.muscles) {
    all += air_in(f, m);
    if (f.record.has_sequence())
      in_sequence +=
          gained(f, "/true" + topic(m, "air_in"), f.record.first_row(), f.record.end_row());
  }
  all += cylinder_air(f, 0, f.record.rows() - 1);
  if (f.record.has_sequence())
    in_sequence += cylinder_air(f, f.record.first_row(), f.record.end_row());
  f.summary.add("air_used_kg", all);
  add_rates(f, in_sequence, "air_used_per_step_kg", "air_used_kg_per_m");
}

void add_valves(Figures& f) {
  const std::size_t last = f.record.rows() - 1;
  const std::vector<Switching> valves = all_switching(f);
  if (valves.empty()) return;
  const Use run = use_of(valves, f.record.time(0), f.record.end_of(last));
  Use walk;
  if (f.record.has_sequence())
    walk = use_of(valves, f.record.sequence_start(), f.record.sequence_end());

  f.summary.add("valves.switchings", run.openings);
  add_rates(f, walk.openings, "valves.switchings_per_step", "valves.switchings_per_m");
  f.summary.add("valves.coil_time_s", run.time);
  add_rates(f, walk.time, "valves.coil_time_per_step_s", "valves.coil_time_s_per_m");
  if (!power_is_known(valves)) return;
  f.summary.add("valves.coil_energy_J", run.energy);
  add_rates(f, walk.energy, "valves.coil_energy_per_step_J", "valves.coil_energy_J_per_m");
}

}  // namespace sinew::analysis
