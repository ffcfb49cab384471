#include "sinew/analysis/record/machine.h"

#include <algorithm>
#include <array>
#include <limits>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/analysis/verdict/reported.fields.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/valve.fields.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/robot.fields.h"
#include "sinew/robot/stand.fields.h"

namespace sinew::analysis {
namespace {

using units::Field;

constexpr std::array<std::string_view, 2> stance_phases = {"foot_plant", "propulsion"};
constexpr std::string_view swing_phase = "swing";

// A table of which only the name is read.
struct Named {
  std::string name;
};

template <class Visitor>
void seconds(Visitor& v, std::string_view name, double& value) {
  v.number({.name = name, .unit = "s", .min = 0, .optional = true}, value);
}

MachineValve machine_valve_of(const gas::Valve& valve) {
  MachineValve out{.name = valve.name, .coil = valve.coil};
  out.rated_switchings = valve.rated_switchings;
  out.kind = valve.kind;
  if (valve.drive != gas::Valve::Drive::speed_up) out.coil.boost_power = out.coil.boost_time = 0;
  if (valve.profile == gas::Valve::Profile::ideal) return out;
  const gas::Delays delays = gas::delays(valve);
  out.shut = delays.opening;
  out.opening = delays.opening + 0.5 * valve.opening_ramp;
  out.closing = delays.closing + 0.5 * valve.closing_ramp;
  return out;
}

void read_parts(config::Reader& reader, Machine& m) {
  if (m.stand) {
    robot::fields(reader, static_cast<robot::Stand&>(*m.stand));
    reader.each({.name = "actuator", .optional = true}, m.actuators,
                [](auto& g, actuator::Actuator& a) { actuator::fields(g, a); });
    reader.group({.name = "drive", .optional = true}, [&](auto& g) {
      g.text({.name = "kind", .optional = true}, m.stand->drive);
      g.number({.name = "period", .unit = "s", .min = 1e-4, .optional = true},
               m.stand->drive_period);
    });
  } else {
    robot::fields(reader, m.robot);
    actuator::fields(reader, m.actuators);
  }
}

// Reads the delays and coils of the valves. A log of another program may lack the other keys.
void read_valves(const config::Node& root, Machine& m) {
  config::Reader reader(root, {.atmosphere = m.atmosphere, .of_a_log = true});
  std::vector<gas::Valve> valves;
  gas::fields(reader, valves);
  reader.finish_part();
  for (const gas::Valve& valve : valves) m.valves.push_back(machine_valve_of(valve));
}

template <class Visitor>
void fields(Visitor& v, MachineFault& fault) {
  double lasts = std::numeric_limits<double>::infinity();
  seconds(v, "at", fault.begin);
  seconds(v, "for", lasts);
  v.text({.name = "of", .optional = true}, fault.of);
  v.text({.name = "what", .optional = true}, fault.what);
  fault.end = fault.begin + lasts;
}

void read_run(config::Reader& reader, Machine& m) {
  reader.text({.name = "title", .optional = true}, m.title);
  reader.text({.name = "reproduces", .optional = true}, m.reproduces);
  reader.group({.name = "sequence", .optional = true},
               [&](auto& g) { g.texts({.name = "phases", .optional = true}, m.sequence); });

  std::vector<Named> phases;
  reader.each({.name = "phase", .optional = true}, phases, [](auto&, Named&) {});
  for (const Named& phase : phases) m.phases.push_back(phase.name);

  reader.group({.name = "log", .optional = true}, [&](auto& g) {
    g.number({.name = "period", .unit = "s", .min = 1e-4, .optional = true}, m.period);
  });
  reader.list({.name = "reported", .optional = true}, m.reported,
              [&](auto& g, Reported& r) { analysis::fields(g, r, m.atmosphere); });
  reader.list({.name = "fault", .optional = true}, m.faults,
              [](auto& g, MachineFault& f) { fields(g, f); });
}

}  // namespace

Machine read_machine(const config::Node& root) {
  Machine m;
  m.atmosphere = config::atmosphere_of(root);
  if (root.find("element")) m.stand.emplace();
  config::Reader reader(root, {.atmosphere = m.atmosphere});
  read_parts(reader, m);
  read_run(reader, m);
  reader.finish_part();
  read_valves(root, m);
  mark_changed(m.reported, root);
  return m;
}

void replace_parts(Machine& m, const std::vector<actuator::Actuator>& actuators,
                   const std::vector<gas::Valve>& valves) {
  m.actuators = actuators;
  m.valves.clear();
  for (const gas::Valve& valve : valves) m.valves.push_back(machine_valve_of(valve));
}

std::string_view phase_name(const Machine& m, int phase) {
  if (phase < 0 || phase >= static_cast<int>(m.phases.size())) return {};
  return m.phases[static_cast<std::size_t>(phase)];
}

bool is_stance(const Machine& m, int phase) {
  return std::find(stance_phases.begin(), stance_phases.end(), phase_name(m, phase)) !=
         stance_phases.end();
}

bool is_swing(const Machine& m, int phase) { return phase_name(m, phase) == swing_phase; }

int find_phase(const Machine& m, std::string_view name) {
  for (std::size_t i = 0; i < m.phases.size(); ++i)
    if (m.phases[i] == name) return static_cast<int>(i);
  return -1;
}

bool has_leg(const Machine& m) { return m.robot.foot.present && robot::is_leg(m.robot); }

MachineValve valve_of(const Machine& m, std::string_view valve) {
  for (const MachineValve& v : m.valves)
    if (v.name == valve) return v;
  return {};
}

double passive(const Machine& m, const robot::Muscle& muscle, double inlet_duty,
               double exhaust_duty) {
  const double open = inlet_duty + exhaust_duty;
  return valve_of(m, muscle.inlet).seals() ? 1.0 - open : 0.0 * open;
}

}  // namespace sinew::analysis
