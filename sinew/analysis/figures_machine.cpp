// Figures of the parts of a machine but its joints: rollers.*, cylinder.*, supply.*, sensors.*,
// muscles.*, passiveness, air and valves.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/statistics.h"
#include "sinew/analysis/measures/valves.h"
#include "sinew/robot/sensing.h"

namespace sinew::analysis {

namespace {

// Returns the share of the time in which a load is below zero.
double lifted_share(const Column& load, const Column& seconds) {
  Column lifted(load.file());
  for (const double newton : load) lifted.push_back(newton < 0 ? 1.0 : 0.0);
  return mean(lifted, seconds);
}

void add_rollers(Figures& f) {
  for (const std::string roller : {"front", "rear"}) {
    const std::string load = "/true/roller/" + roller + "/load";
    f.add("rollers." + roller + ".min_load_N", smallest, load, f.record.sequence());
    f.add("rollers." + roller + ".max_load_N", largest, load, f.record.sequence());
    f.add("rollers." + roller + ".lifted_share", lifted_share, load, f.record.sequence());
  }
}

void add_cylinder(Figures& f) {
  if (!f.wants("cylinder.")) return;
  const Column travel = f.record.column("/true/cylinder/position");
  if (travel.empty()) return;
  f.add("cylinder.min_position_true_m", smallest, travel, f.record.sequence());
  f.add("cylinder.max_position_true_m", largest, travel, f.record.sequence());
  f.add("cylinder.mean_position_true_m", mean, travel, f.record.sequence());
  const Column wanted = f.record.column("/desired/cylinder/position");
  if (!wanted.empty()) {
    Column error = f.record.new_column();
    for (std::size_t i = 0; i < travel.size(); ++i) error.push_back(travel[i] - wanted[i]);
    f.add("cylinder.tracking_rms_m", rms, error, f.record.sequence());
  }
  f.summary.add("cylinder.air_used_kg", cylinder_air(f, 0, f.record.rows() - 1));
}

// Adds mean and deviation of the sensors' counts, as the program of the thesis prints them, B.1.
void add_sensors(Figures& f) {
  for (const robot::Sensor& sensor : f.machine.robot.sensors) {
    const std::string counts = "/sensor/" + sensor.name + "/count";
    const std::string key = "sensors." + sensor.name + ".";
    f.add(key + "mean_count", mean, counts, f.record.sequence());
    f.add(key + "std_count", deviation, counts, f.record.sequence());
  }
}

// Adds the time, the complete steps and the distance for which the line holds its first pressure to
// 1 %. If it holds it to the end of the sequence these are lower bounds, and their keys contain
// `at_least`.
void add_endurance(Figures& f) {
  if (!f.wants("supply.full_")) return;
  const Column line = f.record.column("/true/supply/pressure");
  if (line.empty() || !f.record.has_sequence()) return;
  std::size_t row = f.record.first_row();
  while (row < f.record.end_row() && line[row] > 0.99 * line.front()) ++row;
  const bool to_the_end = line[row] > 0.99 * line.front();
  const auto add = [&](const char* of, double value, const char* unit) {
    f.summary.add(fmt::format("supply.full_{}{}", of, unit), to_the_end ? no_figure : value);
    f.summary.add(fmt::format("supply.full_{}_at_least{}", of, unit),
                  to_the_end ? value : no_figure);
  };
  add("time", f.record.time(row) - f.record.sequence_start(), "_s");

  double steps = 0;
  for (const int step : f.record.complete_steps()) {
    std::size_t last = 0;
    for (const PhaseSpan& s : f.record.phase_spans())
      if (s.step == step) last = s.last;
    if (last <= row) ++steps;
  }
  add("steps", steps, "");
  const Column x = f.record.column("/true/trolley/position");
  if (!x.empty()) add("distance", x[row] - x[f.record.first_row()], "_m");
}

}  // namespace

double cylinder_air(const Figures& f, std::size_t first, std::size_t last) {
  double all = 0;
  if (!f.machine.robot.cylinder.present) return all;
  for (const char* chamber : {"up", "down"}) {
    const Column in = f.record.column(std::string("/true/cylinder/") + chamber + "/air_in");
    if (!in.empty()) all += in[last] - in[first];
  }
  return all;
}

// Adds the counts of rejected readings and commands; a key is absent where its channel was not
// logged.
void add_supervision(Figures& f) {
  const auto counted = [&](const std::string& key, const std::string& topic) {
    if (!f.wants(key)) return;
    const Column column = f.record.column(topic);
    f.summary.add(key, !column.empty() && column.back() > 0 ? column.back() : no_figure);
  };
  for (const robot::Sensor& sensor : f.machine.robot.sensors) {
    const std::string from = "/sensor/" + sensor.name, to = "sensors." + sensor.name;
    counted(to + ".rejected_readings", from + "/rejected");
    counted(to + ".frozen_readings", from + "/frozen");
  }
  counted("low_level.rejected_commands", "/low_level/rejected_commands");
  counted("low_level.gaps", "/low_level/gaps");
  if (!f.wants("low_level.tripped_time_s")) return;
  const Column tripped = f.record.column("/low_level/tripped");
  const auto first = std::ranges::find(tripped, 1.0) - tripped.begin();
  f.summary.add("low_level.tripped_time_s", first < std::ssize(tripped)
                                                ? f.record.time(static_cast<std::size_t>(first))
                                                : no_figure);
}

// Adds the air that entered and left the machine, the change of the air that it contains, and the
// rounding error between them, for a run that logs all of its air.
void add_air_balance(Figures& f) {
  const auto gained = [&](const std::string& topic) {
    const Column c = f.record.column(topic);
    return c.empty() ? 0.0 : c.back() - c.front();
  };
  if (!f.wants("air_balance.") || f.record.column("/true/air/mass").empty()) return;
  // A tank is a part of the machine: its muscles then fill from within, and only the air past the
  // tank enters.
  const bool tank = !f.record.column("/true/supply/tank_pressure").empty();
  double entered = gained("/true/supply/air_past_tank"), left = 0, leaked = 0;
  const auto add = [&](const std::string& at) {
    entered += tank ? 0.0 : gained(at + "/air_in");
    left += gained(at + "/air_out");
    leaked += gained(at + "/air_leaked");
  };
  for (const robot::Muscle& m : f.machine.robot.muscles) add("/true/muscle/" + m.name);
  for (const char* chamber : {"up", "down"}) add(std::string("/true/cylinder/") + chamber);
  const double stored = gained("/true/air/mass");
  f.summary.add("air_balance.entered_kg", entered);
  f.summary.add("air_balance.left_kg", left);
  f.summary.add("air_balance.leaked_kg", leaked);
  f.summary.add("air_balance.stored_kg", stored);
  f.summary.add("air_balance.error_kg", stored - (entered - left - leaked));
}

void add_machine(Figures& f) {
  add_rollers(f);
  add_cylinder(f);
  add_sensors(f);
  f.add("supply.min_pressure_Pa", smallest, "/true/supply/pressure", f.record.sequence());
  add_endurance(f);
  const auto last = [](const Column& values, const Column&) { return values.back(); };
  f.add("supply.end_tank_pressure_Pa", last, "/true/supply/tank_pressure", f.record.sequence());
  f.add("low_level.overruns", last, "/low_level/overruns", f.record.sequence());
  if (f.machine.robot.legs.empty()) add_sole(f);
}

void add_sole(Figures& f) {
  for (const robot::Foot::Point& p : f.machine.robot.foot.points)
    f.add("foot." + p.name + ".peak_load_true_N", largest, "/true/foot/" + p.name + "/load",
          f.record.sequence());
}

// --- muscles, passiveness, air, valves ---

namespace {

std::string topic(const robot::Muscle& m, const char* what) {
  return "/muscle/" + m.name + "/" + what;
}

double mean_duty(const Figures& f, const robot::Muscle& m, const char* what) {
  return mean(f.record.column(topic(m, what)), f.record.sequence());
}

// Edges of a valve; not `logged` if the log or the machine lacks the valve, or if the log has its
// state without its pulses. A valve that never opens has an empty series.
struct Switching {
  bool logged = false;
  Edges electrical, delivered;
  gas::Coil coil;
  double rated = 0;  // openings that the valve is made for; 0: not given [-]
  std::string name;  // "hip_flexor.inlet"
};

// Returns the edges of a valve of `of`, for example "hip_flexor".
Switching switching(const Figures& f, const std::string& of, const char* which,
                    const std::string& valve) {
  const signals::Series* s = f.record.find("/valve/" + of + "/" + which + "/open");
  if (!s || s->columns.empty() || valve.empty() || signals::has_coarse_edges(s->topic)) return {};
  const MachineValve its = valve_of(f.machine, valve);
  Switching out{.logged = true,
                .electrical = edges_of(s->time_ns, s->columns[0]),
                .delivered = {},
                .coil = its.coil,
                .rated = its.rated_switchings,
                .name = of + "." + which};
  out.delivered = delivered(out.electrical, its.opening, its.closing);
  return out;
}

Switching switching(const Figures& f, const robot::Muscle& m, const char* which) {
  const bool inlet = std::string_view(which) == "inlet";
  return switching(f, m.name, which, inlet ? m.inlet : m.exhaust);
}

// Returns the edges of all valves, those of the cylinder last.
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

// Computes the share of the sequence in which the valve is really open [-].
double compute_delivered_duty(const Figures& f, const robot::Muscle& m, const char* which) {
  if (!f.record.has_sequence()) return no_figure;
  const Switching s = switching(f, m, which);
  if (!s.logged) return no_figure;
  const double from = f.record.sequence_start(), to = f.record.sequence_end();
  return open_time(s.delivered, from, to) / (to - from);
}

// Returns the same from the cache, because several figures need it.
double delivered_duty(const Figures& f, const robot::Muscle& m, const char* which) {
  const auto [at, is_new] = f.delivered_duties.try_emplace(m.name + "/" + which);
  if (is_new) at->second = compute_delivered_duty(f, m, which);
  return at->second;
}

// Returns the growth of a running total between two rows.
double gained(const Figures& f, const std::string& name, std::size_t from, std::size_t to) {
  const Column c = f.record.column(name);
  return c.empty() ? no_figure : c[to] - c[from];
}

double air_in(const Figures& f, const robot::Muscle& m) {
  return gained(f, "/true" + topic(m, "air_in"), 0, f.record.rows() - 1);
}

// Counts of a muscle's tension transducer; empty if it has no transducer.
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

// Returns the share of the sequence in which the reading is at the converter's upper limit [-].
double clipped(const Figures& f, const Reading& r) {
  Column is_clipped = f.record.new_column();
  for (const double c : r.counts)
    is_clipped.push_back(!std::isfinite(c) ? c : c >= f.machine.robot.converter.top() ? 1.0 : 0.0);
  return mean(is_clipped, f.record.sequence());
}

// Returns the largest tension by the controller's assumed scale of the transducer  [N].
double measured_peak(const Figures& f, const Reading& r) {
  if (!r.sensor || !(r.sensor->assumed_scale > 0)) return no_figure;
  return robot::assumed_tension(*r.sensor, f.machine.robot.converter)
      .value(largest(r.counts, f.record.sequence()));
}

// Openings, open time and coil energy of all valves within [from, to), by the electrical edges.
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

// Returns whether the coil power of every valve is given: otherwise the energy is unknown.
bool power_is_known(const std::vector<Switching>& valves) {
  return std::ranges::all_of(valves, [](const Switching& s) { return s.coil.power > 0; });
}

}  // namespace

double passiveness(const Figures& f, const robot::Muscle& m) {
  return passive(f.machine, m, mean_duty(f, m, "inlet_duty"), mean_duty(f, m, "exhaust_duty"));
}

double delivered_passiveness(const Figures& f, const robot::Muscle& m) {
  const bool seals = valve_of(f.machine, m.inlet).seals();
  return passive(f.machine, m, delivered_duty(f, m, "inlet"),
                 seals ? delivered_duty(f, m, "exhaust") : 0.0);
}

void add_muscles(Figures& f) {
  const Column& sequence = f.record.sequence();
  for (std::size_t i = 0; i < f.machine.robot.muscles.size(); ++i) {
    const robot::Muscle& m = f.machine.robot.muscles[i];
    const std::string key = "muscles." + m.name + ".";
    if (!f.wants(key)) continue;
    f.add(key + "peak_tension_N", largest, "/true" + topic(m, "tension"), sequence);
    f.add(key + "measured_peak_tension_N", [&] { return measured_peak(f, reading(f, i)); });
    f.add(key + "own_scale_peak_tension_N", largest, topic(m, "tension"), sequence);
    f.add(key + "clipped_share", [&] { return clipped(f, reading(f, i)); });
    f.add(key + "mean_inlet_duty", [&] { return mean_duty(f, m, "inlet_duty"); });
    f.add(key + "mean_exhaust_duty", [&] { return mean_duty(f, m, "exhaust_duty"); });
    f.add(key + "delivered_inlet_duty", [&] { return delivered_duty(f, m, "inlet"); });
    f.add(key + "delivered_exhaust_duty", [&] { return delivered_duty(f, m, "exhaust"); });
    f.add(key + "passiveness", [&] { return passiveness(f, m); });
    f.add(key + "passiveness_delivered", [&] { return delivered_passiveness(f, m); });
    f.add(key + "air_used_kg", [&] { return air_in(f, m); });
    add_wear(f, i);
  }
}

void add_smallest_passiveness(Figures& f, const std::string& key, const std::string& joint) {
  const auto smallest_of = [&](const auto& share) {
    double out = no_figure;
    for (const robot::Muscle& m : f.machine.robot.muscles)
      if (joint.empty() || m.joint == joint || m.second.joint == joint)
        out = std::fmin(out, share(f, m));
    return out;
  };
  f.add(key + "passiveness", [&] { return smallest_of(passiveness); });
  f.add(key + "passiveness_delivered", [&] { return smallest_of(delivered_passiveness); });
}

void add_air(Figures& f) {
  if (!f.wants("air_used_")) return;
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
  if (!f.wants("valves.") || !coarse_valves(f.record.table()).empty()) return;
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
  for (const Switching& s : valves)
    if (s.rated > 0)
      f.summary.add("valves." + s.name + "_life_share",
                    openings(s.electrical, f.record.time(0), f.record.end_of(last)) / s.rated);
  if (!power_is_known(valves)) return;
  f.summary.add("valves.coil_energy_J", run.energy);
  add_rates(f, walk.energy, "valves.coil_energy_per_step_J", "valves.coil_energy_J_per_m");
}

}  // namespace sinew::analysis
