// Figures muscles.<m>.* on wear: cycles of contraction and pressure by rain flow, shares of a life.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sinew/actuator/life.h"
#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/rain_flow.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/sensing.h"

namespace sinew::analysis {
namespace {

// Returns the angles of the joints that the muscle crosses, empty for others; nothing if one of the
// muscle's own was not logged.
std::optional<std::vector<Column>> angles(const Figures& f, const robot::Muscle& m) {
  std::vector<Column> out;
  for (const robot::Joint& j : f.machine.robot.joints) {
    const bool crosses = j.name == m.joint || j.name == m.second.joint;
    out.push_back(crosses ? f.record.column("/joint/" + j.name + "/angle") : Column());
    if (crosses && out.back().empty()) return {};
  }
  return out;
}

// Returns the contraction by the measured angles, less that of L_max; empty if it is unknown.
Column contraction(const Figures& f, const robot::Muscle& m, double longest) {
  const auto measured = angles(f, m);
  if (!measured || !(longest > 0)) return {};
  std::vector<double> now;
  for (const robot::Joint& j : f.machine.robot.joints) now.push_back(j.rest_angle);
  Column out = f.record.new_column();
  for (std::size_t i = 0; i < f.record.rows(); ++i) {
    for (std::size_t j = 0; j < now.size(); ++j)
      if (!(*measured)[j].empty()) now[j] = (*measured)[j][i];
    out.push_back(1 - robot::muscle_length(f.machine.robot, m, now) / longest);
  }
  return out;
}

// Returns the gauge pressure by the sensor's scale that the controller assumes; empty without one.
Column measured_pressure(const Figures& f, std::size_t muscle) {
  const int s = robot::pressure_sensor_of(f.machine.robot, static_cast<int>(muscle));
  if (s < 0) return {};
  const robot::Sensor& sensor = f.machine.robot.sensors[static_cast<std::size_t>(s)];
  if (!(sensor.assumed_scale > 0)) return {};
  const robot::SensorLine line = robot::assumed_tension(sensor, f.machine.robot.converter);
  Column out = f.record.new_column();
  for (const double count : f.record.column("/sensor/" + sensor.name + "/count"))
    out.push_back(line.value(count));
  return out;
}

// Adds the share of one actuator's life that these cycles used, with bounds that are known. The
// pressure of each cycle is at most the largest of the run.
void add_life_share(Figures& f, const std::string& key, const actuator::Life& life,
                    const std::vector<Cycle>& cycles, double largest_pressure) {
  if (!actuator::has_life(life)) return;
  actuator::Bounds used{0, 0};
  for (const Cycle& c : cycles)
    actuator::add_damage(used, actuator::cycles_of_life(life, c.range, largest_pressure), c.count);
  const bool over = life.cycles_under > 0 && !(life.pressure > 0);
  const bool under =
      std::isfinite(used.most) && (!(life.pressure > 0) || largest_pressure <= life.pressure);
  if (over) f.add(key + "life_share_over", [&] { return used.least; });
  if (under) f.add(key + "life_share_under", [&] { return used.most; });
}

// Adds number and largest range of the cycles of a pressure.
void add_pressure(Figures& f, const std::string& key, const std::string& suffix,
                  const Column& pressure) {
  if (pressure.empty()) return;
  const std::vector<Cycle> cycles = rain_flow(pressure, least_pressure);
  f.add(key + "pressure_cycles" + suffix, [&] { return cycles_in(cycles); });
  f.add(key + "largest_pressure_range" + suffix + "_diff_Pa",
        [&] { return largest_range(cycles); });
}

// Returns the largest value; NaN without any.
double top(const Column& values) {
  double out = no_figure;
  for (const double x : values) out = std::fmax(out, x);
  return out;
}

}  // namespace

void add_wear(Figures& f, std::size_t muscle) {
  const robot::Muscle& m = f.machine.robot.muscles[muscle];
  const std::string key = "muscles." + m.name + ".";
  const auto wants = [&](const char* what) { return f.wants(key + what); };
  const bool share = wants("life_share_");
  Column real, measured;
  if (share || wants("pressure_cycles") || wants("largest_pressure_range")) {
    real = f.record.column("/true/muscle/" + m.name + "/pressure");
    measured = measured_pressure(f, muscle);
    add_pressure(f, key, "", measured);
    add_pressure(f, key, "_true", real);
  }
  if (!share && !wants("contraction_cycles") && !wants("largest_contraction_range")) return;
  const actuator::Actuator a = robot::actuator_of(m, f.machine.actuators);
  const Column shortening = contraction(f, m, a.long_end.length);
  if (shortening.empty()) return;
  const std::vector<Cycle> cycles = rain_flow(shortening, least_contraction);
  f.add(key + "contraction_cycles", [&] { return cycles_in(cycles); });
  f.add(key + "largest_contraction_range", [&] { return largest_range(cycles); });
  const double pressure = real.empty() ? top(measured) : top(real) - f.machine.atmosphere;
  add_life_share(f, key, a.life, cycles, pressure);
}

}  // namespace sinew::analysis
