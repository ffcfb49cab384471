// rollers.*, cylinder.*, supply.*, sensors.*: the parts of a whole machine beside its joints and
// muscles.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/statistics.h"

namespace sinew::analysis {
namespace {

// Share of the time in which a load is below zero.
double lifted_share(const Column& load, const Column& seconds) {
  Column lifted(load.file());
  for (const double newton : load) lifted.push_back(newton < 0 ? 1.0 : 0.0);
  return mean(lifted, seconds);
}

void add_rollers(Figures& f) {
  for (const std::string roller : {"front", "rear"}) {
    const Column load = f.record.column("/true/roller/" + roller + "/load");
    f.add("rollers." + roller + ".min_load_N", smallest, load, f.record.sequence());
    f.add("rollers." + roller + ".max_load_N", largest, load, f.record.sequence());
    f.add("rollers." + roller + ".lifted_share", lifted_share, load, f.record.sequence());
  }
}

void add_cylinder(Figures& f) {
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

// What the program of the thesis prints of its sensors, B.1.
void add_sensors(Figures& f) {
  for (const robot::Sensor& sensor : f.machine.robot.sensors) {
    const Column counts = f.record.column("/sensor/" + sensor.name + "/count");
    const std::string key = "sensors." + sensor.name + ".";
    f.add(key + "mean_count", mean, counts, f.record.sequence());
    f.add(key + "std_count", deviation, counts, f.record.sequence());
  }
}

// How long, how many complete steps and how far the line holds its first pressure, to a hundredth.
// Where it holds it to the end of the sequence these are lower bounds, and their keys end in
// `at_least`.
void add_endurance(Figures& f) {
  const Column line = f.record.column("/true/supply/pressure");
  if (line.empty() || !f.record.has_sequence()) return;
  std::size_t row = f.record.first_row();
  while (row < f.record.end_row() && line[row] > 0.99 * line.front()) ++row;
  const char* bound = line[row] > 0.99 * line.front() ? "_at_least" : "";
  const auto add = [&](const char* of, double value, const char* unit) {
    f.summary.add(fmt::format("supply.full_{}{}{}", of, bound, unit), value);
  };
  add("time", f.record.time(row) - f.record.sequence_start(), "_s");

  double steps = 0;
  for (const int step : f.record.complete_steps()) {
    std::size_t last = 0;
    for (const Stretch& s : f.record.stretches())
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
    const Column column = f.record.column(topic);
    if (!column.empty() && column.back() > 0) f.summary.add(key, column.back());
  };
  for (const robot::Sensor& sensor : f.machine.robot.sensors) {
    const std::string from = "/sensor/" + sensor.name, to = "sensors." + sensor.name;
    counted(to + ".rejected_readings", from + "/rejected");
    counted(to + ".frozen_readings", from + "/frozen");
  }
  counted("low_level.rejected_commands", "/low_level/rejected_commands");
  counted("low_level.gaps", "/low_level/gaps");
  const Column tripped = f.record.column("/low_level/tripped");
  const auto first = std::ranges::find(tripped, 1.0) - tripped.begin();
  if (first < std::ssize(tripped))
    f.summary.add("low_level.tripped_time_s", f.record.time(static_cast<std::size_t>(first)));
}

// Adds the air that has gone into the machine and out of it, what it has grown by, and the rounding
// between the two, for a run that logs all of its air.
void add_air_balance(Figures& f) {
  const auto gained = [&](const std::string& topic) {
    const Column c = f.record.column(topic);
    return c.empty() ? 0.0 : c.back() - c.front();
  };
  if (f.record.column("/true/air/mass").empty()) return;
  // A tank is a part of the machine: only air that passes it enters.
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
  f.add("supply.min_pressure_Pa", smallest, f.record.column("/true/supply/pressure"),
        f.record.sequence());
  add_endurance(f);
  const Column tank = f.record.column("/true/supply/tank_pressure");
  if (!tank.empty()) f.summary.add("supply.end_tank_pressure_Pa", tank.back());
  const Column overruns = f.record.column("/low_level/overruns");
  if (!overruns.empty()) f.summary.add("low_level.overruns", overruns.back());
  if (f.machine.robot.legs.empty()) add_sole(f);
}

void add_sole(Figures& f) {
  for (const robot::Foot::Point& p : f.machine.robot.foot.points)
    f.add("foot." + p.name + ".peak_load_true_N", largest,
          f.record.column("/true/foot/" + p.name + "/load"), f.record.sequence());
}

}  // namespace sinew::analysis
