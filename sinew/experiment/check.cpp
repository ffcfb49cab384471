#include "sinew/experiment/check.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "sinew/actuator/body.h"
#include "sinew/config/setting.h"
#include "sinew/config/valve_timing.h"
#include "sinew/control/gait/legs.h"
#include "sinew/experiment/faults.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"
#include "sinew/signals/tick.h"
#include "sinew/units/quantity.h"

namespace sinew::experiment {

namespace {

using List = std::vector<robot::Contradiction>;

// Returns the length as text, in the unit that the file uses at that path.
std::string length_like(const Experiment& e, std::string_view path, double metres) {
  return config::quantity_like(e.origins, path, metres, "m", "in");
}

std::string pressure_like(const Experiment& e, std::string_view path, double pascals) {
  return config::quantity_like(e.origins, path, pascals, "Pa abs", "psi abs", e.air.atmosphere);
}

// Requires that a name refers to an existing item.
template <class Items>
void need(const std::string& key, const std::string& name, const Items& items, List& out) {
  const std::vector<std::string_view> names = config::names_of(items);
  if (std::ranges::count(names, name) > 0) return;
  out.push_back({key, config::in_quotes(name), config::either(names),
                 config::closest_in_quotes(name, names)});
}

// Checks the kinds of valves. A valve that seals needs another to let the air out; one that does
// not has no use for it. The laws of a joint follow from its valves, so both of its muscles
// need the same kind.
void check_valves(const Experiment& e, List& out) {
  using Kind = gas::Valve::Kind;
  for (const robot::Muscle& m : e.robot.muscles) {
    const gas::Valve* inlet = find_valve(e, m.inlet);
    if (!inlet) continue;
    const bool seals = inlet->kind == Kind::two_way;
    const gas::Valve* exhaust = find_valve(e, m.exhaust);
    if (seals && exhaust && exhaust->kind != Kind::two_way)
      out.push_back({"muscle." + m.name + ".exhaust.valve", config::in_quotes(m.exhaust),
                     "a 2-way valve", "a 3-way valve or a regulator stands at the inlet"});
    if (!seals && !m.second.joint.empty())
      out.push_back({"muscle." + m.name + ".inlet.valve", config::in_quotes(m.inlet),
                     "a 2-way valve, as the muscle runs over two joints",
                     "the laws of both joints share its duties only where its valves seal"});
    if (seals == m.exhaust.empty())
      out.push_back({"muscle." + m.name + ".exhaust", seals ? "none" : config::in_quotes(m.exhaust),
                     seals ? "a valve, as the inlet seals" : "none, as the inlet also vents",
                     seals ? "exhaust = { valve = …, bit = … }" : "leave it out"});
    for (const robot::Muscle& other : e.robot.muscles) {
      const gas::Valve* theirs = find_valve(e, other.inlet);
      if (other.joint == m.joint && theirs && theirs->kind != inlet->kind && &other < &m)
        out.push_back({"muscle." + m.name + ".inlet.valve", config::in_quotes(m.inlet),
                       "a valve of the same kind as muscle " + other.name + "'s",
                       config::in_quotes(other.inlet)});
    }
  }
}

// Refuses a hose's volume that is too small for the flow of its valves: the pressure of such a
// chamber changes faster than the air's steps follow. Measured with pipes of 1 m x 2 mm and 50 m x
// 0.1 mm and with valves of 2 to 2000 mm2: up to a volume of 5 um times the valve's area the run
// ends with air that is not finite; from 15 um on, at 2000 mm2 from 50 um on, it does not.
void check_hose(const Experiment& e, const std::string& part, const gas::Hose& hose,
                std::initializer_list<std::string_view> valves, List& out) {
  constexpr double per_area = 50e-6;  // [m]
  // Area with the choked flow of a conductance: psi* / sqrt(R T_0) and rho_0 of the reference air.
  constexpr double area_per_conductance = 503;  // [m2 / (m3/(s Pa))]
  if (hose.law == gas::Hose::Law::none || !(hose.volume > 0)) return;
  double widest = 0;
  for (const std::string_view name : valves)
    if (const gas::Valve* v = find_valve(e, name))
      widest = std::max(widest, v->flow.law == gas::Flow::Law::iso6358
                                    ? area_per_conductance * v->flow.sonic_conductance
                                    : v->flow.area);
  if (hose.volume >= per_area * widest) return;
  const std::string key = part + ".hose.volume";
  const auto text = [&](double volume) {
    return config::quantity_like(e.origins, key, volume, "m3", "mm3");
  };
  out.push_back({key, text(hose.volume),
                 "at least " + text(per_area * widest) + " with valves as wide as its own, or 0",
                 "volume = 0: a hose that only resists the flow"});
}

// Refuses keys of a joint's laws that its valves do not use.
void check_pressure_law(const Experiment& e, List& out) {
  using Kind = gas::Valve::Kind;
  for (const robot::Joint& j : e.robot.joints) {
    Kind kind = Kind::two_way;
    for (const robot::Muscle& m : e.robot.muscles)
      if (const gas::Valve* v = find_valve(e, m.inlet); v && m.joint == j.name) kind = v->kind;
    const robot::PressureLaw& law = j.pressure_law;
    const std::string key = "joint." + j.name + ".pressure_law.";
    if (kind == Kind::two_way && law.bias != robot::PressureLaw{}.bias)
      out.push_back({key + "bias", "a joint with 2-way valves", "3-way valves or regulators",
                     "leave it out"});
    if (kind != Kind::regulator && law.angle_integral > 0)
      out.push_back(
          {key + "angle_integral", "a joint without regulators", "regulators", "leave it out"});
    if (kind != Kind::regulator && law.stiffness_integral > 0)
      out.push_back(
          {key + "stiffness_integral", "a joint without regulators", "regulators", "leave it out"});
  }
}

void check_supply(const Experiment& e, List& out) {
  const auto text = [&](const char* key, double pascals) { return pressure_like(e, key, pascals); };
  if (e.supply.kind == gas::Supply::Kind::tank && !(e.supply.initial_pressure > e.air.atmosphere))
    out.push_back({"air.supply.initial_pressure",
                   text("air.supply.initial_pressure", e.supply.initial_pressure),
                   "above the atmosphere", "initial_pressure = \"150 psi gauge\""});
  const robot::Cylinder& c = e.robot.cylinder;
  if (c.present && c.mode == robot::Cylinder::Mode::regulator && c.pressure > e.supply.pressure)
    out.push_back({"cylinder.pressure", text("cylinder.pressure", c.pressure),
                   "at most the supply's, " + text("cylinder.pressure", e.supply.pressure),
                   "pressure = \"20 psi gauge\""});
}

void check_muscles(const Experiment& e, List& out) {
  for (const robot::Muscle& m : e.robot.muscles) {
    const std::string key = "muscle." + m.name;
    need(key + ".actuator", m.actuator, e.actuators, out);
    need(key + ".inlet.valve", m.inlet, e.valves, out);
    if (!m.exhaust.empty()) need(key + ".exhaust.valve", m.exhaust, e.valves, out);
    check_hose(e, key, m.hose, {m.inlet, m.exhaust}, out);
  }
  const robot::Cylinder& c = e.robot.cylinder;
  if (!c.present) return;
  for (const auto& [key, chamber] : {std::pair{"cylinder.up", &c.up}, {"cylinder.down", &c.down}})
    for (const auto& [which, valve] :
         {std::pair{".inlet.valve", &chamber->inlet}, {".exhaust.valve", &chamber->exhaust}})
      if (!valve->empty()) need(std::string(key) + which, *valve, e.valves, out);
}

// Checks mount lengths: a braid cannot be longer than its thread.
void check_lengths(const Experiment& e, List& out) {
  for (const robot::Muscle& m : e.robot.muscles)
    for (const actuator::Actuator& a : e.actuators) {
      const double longest = a.braid.thread_length + a.caps.length;
      if (a.name != m.actuator || m.mount_length < longest) continue;
      const std::string key = "muscle." + m.name + ".mount_length";
      out.push_back({key, length_like(e, key, m.mount_length),
                     (a.caps.length > 0 ? "less than the length of thread and caps, "
                                        : "less than the thread's length, ") +
                         length_like(e, key, longest),
                     ""});
    }
}

// Checks that a cylinder's chamber has two 2-way valves, and air left at the stop.
void check_cylinder(const Experiment& e, List& out) {
  const robot::Cylinder& c = e.robot.cylinder;
  if (!c.present || c.mode != robot::Cylinder::Mode::valves) return;
  for (const auto& [word, chamber] : {std::pair{"up", &c.up}, std::pair{"down", &c.down}}) {
    const std::string key = std::string("cylinder.") + word;
    for (const auto& [port, name] : {std::pair{".inlet.valve", chamber->inlet},
                                     std::pair{".exhaust.valve", chamber->exhaust}}) {
      const gas::Valve* v = find_valve(e, name);
      if (v && v->kind != gas::Valve::Kind::two_way)
        out.push_back({key + port, config::in_quotes(name), "a 2-way valve", ""});
    }
    if (!(chamber->dead_volume > 0))
      out.push_back({key + ".dead_volume", "0", "above 0, as the chamber has valves",
                     "what is left at the end of the stroke, with the hoses"});
  }
}

void check_start(const Experiment& e, List& out) {
  for (const std::string& name : e.start.blocked) need("start.blocked", name, e.robot.joints, out);
  for (const auto& [name, angle] : e.start.joint_angles)
    need("start.joint_angles." + name, name, e.robot.joints, out);
  for (const robot::Joint& j : e.robot.joints)
    if (!e.start.joint_angles.count(j.name))
      out.push_back({"start.joint_angles", "no " + j.name, "an angle for every joint", ""});
}

// Checks that measures that end a phase have their sensors.
void check_measures(const Experiment& e, List& out) {
  using Kind = gait::Measure::Kind;
  for (std::size_t l = 0; l < robot::legs_of(e.robot).size(); ++l) {
    const robot::Robot leg = robot::only_leg(e.robot, l);
    const auto has = [&](int muscle) { return robot::tension_sensor_of(leg, muscle) >= 0; };
    for (const gait::Phase& phase : e.plan.phases) {
      const gait::Measure m = gait::find_measure(leg, phase.until.measure);
      bool known = m.kind != Kind::tension || has(m.index);
      if (m.kind == Kind::normal_force || m.kind == Kind::friction_force)
        for (std::size_t i = 0; i < leg.muscles.size(); ++i) known &= has(static_cast<int>(i));
      if (!known)
        out.push_back({"phase." + phase.name + ".until", config::in_quotes(phase.until.measure),
                       "a measure that has its sensors", "a [sensor.…] of kind = \"tension\""});
    }
  }
}

// Checks that the start position is within the machine's range.
void check_place(const Experiment& e, List& out) {
  const robot::Trolley& trolley = e.robot.trolley;
  if (trolley.present && (e.start.trolley < 0 || e.start.trolley > trolley.track_length))
    out.push_back({"start.trolley", length_like(e, "start.trolley", e.start.trolley),
                   "0 to the track's end, " + length_like(e, "start.trolley", trolley.track_length),
                   ""});
  const robot::Cylinder& cylinder = e.robot.cylinder;
  const bool lifts = cylinder.present && cylinder.mode != robot::Cylinder::Mode::locked;
  const double top = lifts ? cylinder.stroke : 0.0;
  if (!lifts && e.start.lift > 0)
    out.push_back({"start.lift", length_like(e, "start.lift", e.start.lift),
                   "0: no cylinder lifts the body", "cylinder.mode = \"regulator\" or \"valves\""});
  else if (e.start.lift > top)
    out.push_back({"start.lift", length_like(e, "start.lift", e.start.lift),
                   "0 to the stroke, " + length_like(e, "start.lift", top), ""});
  for (const robot::Joint& joint : e.robot.joints) {
    const double angle = e.start.joint_angles.count(joint.name)
                             ? e.start.joint_angles.at(joint.name)
                             : joint.rest_angle;
    const std::vector<double>& range = joint.stop.range;
    if (!joint.stop.present() || (angle >= range[0] && angle <= range[1])) continue;
    const std::string key = "start.joint_angles." + joint.name;
    const auto text = [&](double rad) {
      return config::quantity_like(e.origins, key, rad, "rad", "deg");
    };
    out.push_back(
        {key, text(angle), "within its stops, " + text(range[0]) + " to " + text(range[1]), ""});
  }
  for (const robot::Link& link : e.robot.links) {
    const std::string key = "link." + link.name + ".center_of_mass";
    if (link.center_of_mass > link.length)
      out.push_back({key, length_like(e, key, link.center_of_mass),
                     "within the link, " + length_like(e, key, link.length), ""});
  }
}

// Returns the mass that rests on the feet: all that moves [kg].
double moving_mass(const robot::Robot& robot) {
  double limbs = robot.cylinder.present ? robot.cylinder.body_mass : 0.0;
  for (const robot::Link& link : robot.links) limbs += link.mass;
  for (std::size_t leg = 0; leg < robot::legs_of(robot).size(); ++leg)
    limbs += robot::foot_of(robot, leg).mass;
  return std::max(limbs, robot.trolley.present ? robot.trolley.moving_mass() : 0.0);
}

// Returns the depth of the lowest disc of a leg's foot in the ground at the start [m].
double start_depth(const Experiment& e, std::size_t leg,
                   const std::vector<robot::LinkPlace>& places) {
  const robot::Foot& foot = robot::foot_of(e.robot, leg);
  const auto link = static_cast<std::size_t>(robot::foot_link(e.robot, leg));
  const double sine = std::sin(places[link].heading), cosine = std::cos(places[link].heading);
  const auto depth = [&](double along, double across, double radius) {
    const double y = e.start.lift + places[link].joint.y + along * sine + across * cosine;
    return e.robot.ground.height - foot.radius + radius - y;
  };
  if (foot.points.empty()) return depth(e.robot.links[link].length, 0, foot.radius);
  double deepest = 0;
  for (const robot::Foot::Point& p : foot.points)
    deepest = std::max(deepest, depth(p.along, p.across, p.radius));
  return deepest;
}

// Refuses feet that start deep in the ground, which would throw the machine into the air. A machine
// at rest presses a foot in by weight / stiffness at most, one that is let go by twice as much; a
// start by hand is less exact.
void check_ground(const Experiment& e, List& out) {
  constexpr double factor = 3.5, least = 1e-3;  // [-], [m]
  if (!e.robot.ground.present) return;
  const double weight = moving_mass(e.robot) * e.robot.gravity;
  const double allowed = std::max(least, factor * weight / e.robot.ground.normal_stiffness);
  std::vector<double> angles;
  for (const robot::Joint& j : e.robot.joints) angles.push_back(e.start.joint_angles.at(j.name));
  const std::vector<robot::LinkPlace> places = robot::places(e.robot, angles);
  const auto text = [&](double metres) { return length_like(e, "ground.height", metres); };
  for (std::size_t leg = 0; leg < robot::legs_of(e.robot).size(); ++leg) {
    if (!robot::foot_of(e.robot, leg).present || robot::foot_link(e.robot, leg) < 0) continue;
    const double depth = start_depth(e, leg, places);
    if (!(depth > allowed)) continue;
    const std::string of =
        e.robot.legs.empty() ? "the foot" : "the foot of leg " + e.robot.legs[leg].name;
    out.push_back({"start.joint_angles",
                   fmt::format("{} {} deep in the ground, which pushes with {:.3g} N", of,
                               text(depth), depth * e.robot.ground.normal_stiffness),
                   "a foot above the ground, or at most " + text(allowed) + " in it",
                   "joint_angles that lift the foot by " + text(depth) + ", or ground.height = \"" +
                       text(e.robot.ground.height - depth) + "\""});
  }
}

// Limits the length of a run and its log; memory does not grow with a run. Beyond a million
// seconds, eleven days, a double no longer resolves a tenth of a nanosecond; a hundred million rows
// are some 100 GB.
void check_size(const Experiment& e, List& out) {
  constexpr double longest = 1e6;  // [s]
  constexpr double most = 1e8;     // samples
  double step = 0;                 // duration of the longest step of a leg
  for (const robot::LegParts& leg : robot::legs_of(e.robot)) {
    const gait::Plan plan = gait::plan_of_leg(e.plan, leg);
    double sum = 0;
    for (const gait::Phase& phase : plan.phases)
      sum += phase.duration * static_cast<double>(std::ranges::count(plan.sequence, phase.name));
    step = std::max(step, sum);
  }
  const double lasts = e.start.settle + e.plan.repeat * step + e.robot.low_level.vent_time;
  if (!(lasts <= longest))
    out.push_back({"sequence", units::format_number(lasts) + " s in all", "at most 1000000 s", ""});
  else if (lasts > most * e.log.period)
    out.push_back({"log.period", units::format_number(lasts / e.log.period) + " samples",
                   "at most 100000000", "a longer period"});
}

void check_pulses(const Experiment& e, List& out) {
  for (const auto* column : {&e.pulses.closing, &e.pulses.opening})
    if (!column->empty() && column->size() != config::ValveTiming::rows)
      out.push_back({"pulses", std::to_string(column->size()) + " numbers", "101, by duty", ""});
}

void check_numbers(const Experiment& e, List& out) {
  const auto whole = [&](const std::string& key, double value, double unit, const char* what) {
    const double n = value / unit;
    if (std::abs(n - std::round(n)) > 1e-9 * std::max(1.0, n))
      out.push_back({key, std::to_string(value) + " s", std::string("a multiple of ") + what, ""});
  };
  whole("log.period", e.log.period, signals::tick_seconds, "0.1 ms");
  const double period = e.robot.low_level.pwm_ticks * signals::tick_seconds;
  whole("control.high_level_period", e.plan.high_level_period, period, "the low level's period");
  if (!e.robot.low_level.valve_timing.empty() && e.robot.low_level.pwm_ticks != 100)
    out.push_back({"low_level.pwm_ticks", std::to_string(e.robot.low_level.pwm_ticks),
                   "100: predict.dat counts the ticks of such a period",
                   "low_level.valve_timing = \"\""});
  if (e.plant != "planar") out.push_back({"plant", config::in_quotes(e.plant), "planar", ""});
}

// Returns the place of the key, or of the first key of the table that it names; preferably one with
// a line.
config::Location place_of(const std::string& key, const Experiment& e) {
  const config::Location nowhere{e.path, 0, 0};
  if (const config::Origin* origin = config::find_origin(e.origins, key))
    return origin->where.file.empty() ? nowhere : origin->where;

  const config::Location* first = nullptr;
  for (const config::Origin& o : e.origins) {
    if (!o.path.starts_with(key + ".")) continue;
    if (o.where.line > 0) return o.where;
    if (!first && !o.where.file.empty()) first = &o.where;
  }
  return first ? *first : nowhere;
}

}  // namespace

void refuse(const std::vector<robot::Contradiction>& wrong, const Experiment& e) {
  if (wrong.empty()) return;
  std::vector<config::Problem> problems;
  for (const robot::Contradiction& c : wrong)
    problems.push_back({place_of(c.key, e), c.key, c.found, c.expected, c.try_this});
  throw config::Error(std::move(problems));
}

void refuse_contradictions(std::string_view kind, const Experiment& e) {
  const bool runs = kind == "experiment";
  List wrong;
  if (e.stand) {
    check_stand(e, wrong);
    return refuse(wrong, e);
  }
  if (!runs && kind != "robot") return;
  check_muscles(e, wrong);
  check_lengths(e, wrong);
  check_valves(e, wrong);
  check_pressure_law(e, wrong);
  check_supply(e, wrong);
  check_cylinder(e, wrong);
  if (runs) check_start(e, wrong);
  check_pulses(e, wrong);
  if (runs) {
    check_numbers(e, wrong);
    check_place(e, wrong);
    check_measures(e, wrong);
    check_faults(e, wrong);
    check_size(e, wrong);
  }
  std::ranges::move(robot::contradictions(e.robot), std::back_inserter(wrong));
  std::ranges::move(robot::contradictions(e.wiring, e.robot), std::back_inserter(wrong));
  if (runs && wrong.empty()) check_ground(e, wrong);
  if (runs && wrong.empty()) wrong = gait::contradictions(e.robot, e.plan);
  refuse(wrong, e);
}

void refuse_unreachable(const Experiment& e) {
  if (!e.stand) refuse(gait::unreachable(e.robot, e.plan), e);
}

// Checks of a test stand.

namespace {

using DriveKind = Stand::Drive::Kind;

class Findings {
 public:
  explicit Findings(std::vector<robot::Contradiction>& out) : out_(out) {}

  void add(std::string key, std::string found, std::string expected, std::string try_this = "") {
    out_.push_back({std::move(key), std::move(found), std::move(expected), std::move(try_this)});
  }
  // Adds an error if a key is given that its table would not use.
  void unused(bool given, std::string key, std::string_view of) {
    if (given) add(std::move(key), "a key of " + std::string(of), "only what is used");
  }
  template <class Items>
  void need(const std::string& key, const std::string& name, const Items& items) {
    experiment::need(key, name, items, out_);
  }
  std::vector<robot::Contradiction>& list() { return out_; }

 private:
  std::vector<robot::Contradiction>& out_;
};

bool whole_ticks(double seconds) {
  const double ticks = seconds / signals::tick_seconds;
  return std::fabs(ticks - std::round(ticks)) < 1e-6;
}

void check_valves_of_stand(const Experiment& e, Findings& out) {
  if (e.stand->charge.mode != robot::Stand::Charge::Mode::valves) {
    out.unused(e.stand->drive.kind != DriveKind::none, "drive.kind", "charge.mode = \"valves\"");
    return;
  }
  out.need("element.inlet", e.stand->element.inlet, e.valves);
  const gas::Valve* inlet = find_valve(e, e.stand->element.inlet);
  if (!inlet) return;
  if (inlet->kind == gas::Valve::Kind::regulator)
    out.add("element.inlet", "a regulator", "a valve", "charge.mode = \"regulated\"");
  if (inlet->kind == gas::Valve::Kind::two_way) {
    out.need("element.exhaust", e.stand->element.exhaust, e.valves);
    const gas::Valve* exhaust = find_valve(e, e.stand->element.exhaust);
    if (exhaust && exhaust->kind != gas::Valve::Kind::two_way)
      out.add("element.exhaust", config::in_quotes(e.stand->element.exhaust), "a 2-way valve",
              "a 3-way valve stands at the inlet");
  } else {
    out.unused(!e.stand->element.exhaust.empty(), "element.exhaust", "a 2-way inlet");
  }
}

void check_element(const Experiment& e, Findings& out) {
  const Stand::Element::Cylinder& c = e.stand->element.cylinder;
  if (c.bore > 0) {
    out.unused(!e.stand->element.actuator.empty(), "element.actuator",
               "an element without a cylinder");
    out.unused(e.stand->element.count != 1, "element.count", "a muscle");
    out.unused(e.stand->element.external_volume > 0, "element.external_volume", "a muscle");
    if (e.stand->element.hose.law != gas::Hose::Law::none || e.stand->element.leak.area > 0 ||
        e.stand->element.leak.conductance > 0)
      out.add("element.cylinder", "a cylinder with a hose or a leak", "those of a muscle");
    if (!(c.stroke > 0 && c.dead_volume > 0 && c.rod_diameter < c.bore))
      out.add("element.cylinder", "no cylinder",
              "a stroke, a dead volume, and a rod thinner than the bore");
    if (e.stand->drive.kind == DriveKind::feed_forward ||
        (e.stand->drive.kind == DriveKind::feedback && e.stand->element.exhaust.empty()))
      out.add("drive.kind", "a law with the model of a muscle", "pwm or pulses for a cylinder");
    return;
  }
  out.need("element.actuator", e.stand->element.actuator, e.actuators);
  check_hose(e, "element", e.stand->element.hose,
             {e.stand->element.inlet, e.stand->element.exhaust}, out.list());
}

void check_load(const Experiment& e, Findings& out) {
  const Stand::Load& l = e.stand->load;
  if (l.mode == robot::Stand::Load::Mode::driven) {
    out.unused(l.mass > 0 || !l.weights.empty(), "load.mass", "mode = \"hanging\"");
    out.unused(l.force != 0 || !l.forces.empty(), "load.force", "mode = \"hanging\"");
    out.unused(e.stand->start_length > 0, "start.length", "mode = \"hanging\"");
    out.unused(e.stand->displacement != 0, "start.displacement", "mode = \"hanging\"");
  } else {
    out.unused(l.length > 0 || !l.lengths.empty(), "load.length", "mode = \"driven\"");
  }
  out.unused(l.mass > 0 && !l.weights.empty(), "load.mass", "a load without weights");
  out.unused(l.force != 0 && !l.forces.empty(), "load.force", "a load without forces");
  out.unused(l.length > 0 && !l.lengths.empty(), "load.length", "a load without lengths");
  const bool regulated = e.stand->charge.mode == robot::Stand::Charge::Mode::regulated;
  const bool prescribed = e.stand->charge.pressure > 0 || !e.stand->charge.pressures.empty();
  out.unused(!regulated && prescribed, "charge.pressure", "mode = \"regulated\"");
  out.unused(regulated && e.stand->start_pressure > 0, "start.pressure",
             "a charge that is not regulated");
}

// Checks lengths: no clamp reaches further than the stand permits (run/setup/machine_setup.h), and
// at a length without volume of air there would be no pressure.
void check_volumes(const Experiment& e, Findings& out) {
  const auto check = [&](const std::string& key, double length) {
    for (const actuator::Actuator& a : e.actuators) {
      if (a.name != e.stand->element.actuator) continue;
      const double longest = 1.5 * a.braid.thread_length;
      const auto text = [&](double metres) {
        return config::quantity_like(e.origins, key, metres, "m", "in");
      };
      if (length > longest) {
        out.add(key, text(length), "at most " + text(longest) + ", 1.5 threads of the muscle",
                "a length that it can have");
        continue;
      }
      if (length > a.caps.length &&
          actuator::volume(a, length) + e.stand->element.external_volume > 0)
        continue;
      out.add(
          key, "a chamber without volume: the muscle is " + text(length) + " long",
          "above " + text(a.caps.length) + " and below the thread's " + text(a.braid.thread_length),
          "an element.external_volume above 0 where it is longer");
    }
  };
  if (e.stand->element.cylinder.bore > 0) return;
  if (e.stand->load.length > 0) check("load.length", e.stand->load.length);
  for (std::size_t i = 0; i < e.stand->load.lengths.size(); ++i)
    check("load.lengths[" + std::to_string(i) + "].length", e.stand->load.lengths[i].value);
  if (e.stand->start_length > 0) check("start.length", e.stand->start_length);
}

// Limits the samples, so that a typing error does not exhaust the memory.
void check_samples(const Experiment& e, Findings& out) {
  constexpr double most = 2'000'000;  // samples
  const double period = e.stand->sweep.step > 0 ? e.stand->duration : e.log.period;
  if (e.stand->duration > most * period)
    out.add("log.period", units::format_number(e.stand->duration / period) + " samples",
            "at most 2000000", "a longer period");
}

void check_law(const Experiment& e, Findings& out) {
  const Stand::Drive& d = e.stand->drive;
  const bool law = d.kind == DriveKind::feed_forward || d.kind == DriveKind::feedback;
  if (law && d.lengths.empty() && !(d.desired > 0))
    out.add("drive.desired", "none", "a length", "desired = \"2.9 in\"");
  out.unused(!law && (d.desired > 0 || !d.lengths.empty()), "drive.desired",
             "kind = \"feed-forward\" or \"feedback\"");
  out.unused(!law && d.assumed_load != 0, "drive.assumed_load", "kind = \"feed-forward\"");
  out.unused(d.kind != DriveKind::feedback && !d.sensor.empty(), "drive.sensor",
             "kind = \"feedback\"");
  out.unused(d.kind != DriveKind::feedback && (d.gain > 0 || d.dead_band > 0), "drive.gain",
             "kind = \"feedback\"");
  if (d.kind != DriveKind::feedback) return;
  out.need("drive.sensor", d.sensor, e.stand->sensors);
  for (const robot::Transducer& t : e.stand->sensors)
    if (t.name == d.sensor && t.of != robot::Transducer::Of::length)
      out.add("drive.sensor", "another quantity", "a sensor of the length");
  if (d.law == Stand::Drive::Law::proportional && !(d.gain > 0))
    out.add("drive.gain", "none", "a duty per length", "gain = \"5 1/in\"");
}

void check_faults_of_stand(const Experiment& e, Findings& out) {
  if (e.faults.empty()) return;
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::regulated) {
    out.add("fault", "a list of faults",
            "none: the pressure is prescribed, and nothing that breaks would change it",
            "charge.mode = \"sealed\" or \"valves\"");
    return;
  }
  check_faults(e.faults, fault_parts(e), out.list());
}

// Checks single pulses: a period gives a valve one opening at most (control/joint/command.h).
void check_pulses(const Stand::Drive& d, Findings& out) {
  const auto ticks = [](double seconds) { return std::llround(seconds / signals::tick_seconds); };
  std::set<std::tuple<bool, bool, std::int64_t>> edges;  // exhaust or inlet; begin or end; period
  for (std::size_t i = 0; i < d.pulses.size(); ++i) {
    const Stand::Drive::Pulse& p = d.pulses[i];
    const std::int64_t from = ticks(p.at), until = from + ticks(p.open), period = ticks(d.period);
    const bool begins = edges.insert({p.exhaust, true, from / period}).second;
    const bool ends = edges.insert({p.exhaust, false, until / period}).second;
    if (!begins || !ends)
      out.add("drive.pulses[" + std::to_string(i) + "]",
              std::string("a second pulse of the ") + (p.exhaust ? "exhaust" : "inlet") +
                  " in one drive.period, " + units::format_number(d.period) + " s",
              "at most one that begins and one that ends", "a shorter drive.period");
  }
}

void check_drive(const Experiment& e, Findings& out) {
  const Stand::Drive& d = e.stand->drive;
  if (!whole_ticks(d.period)) out.add("drive.period", "no whole ticks", "a multiple of 0.1 ms");
  if (!whole_ticks(e.log.period)) out.add("log.period", "no whole ticks", "a multiple of 0.1 ms");
  if (e.stand->charge.mode == robot::Stand::Charge::Mode::valves && d.kind == DriveKind::none)
    out.add("drive.kind", "none", "what opens the valves", "charge.mode = \"sealed\"");
  if (e.stand->measured.from >= e.stand->duration)
    out.add("measured.from", "no row before the end", "less than duration");
  out.unused(d.kind != DriveKind::pwm && (d.duty > 0 || !d.duties.empty()), "drive.duty",
             "kind = \"pwm\"");
  out.unused(d.kind != DriveKind::pulses && !d.pulses.empty(), "drive.pulses", "kind = \"pulses\"");
  if (d.kind == DriveKind::pulses && d.pulses.empty())
    out.add("drive.pulses", "none", "at least one", "[[drive.pulses]]");
  for (const signals::Schedule::Point& p : d.duties)
    if (!(p.value >= 0 && p.value <= 1)) out.add("drive.duties", "no share", "0 to 100 %");
  check_pulses(d, out);
  if (static_cast<double>(e.stand->sensors.size()) + 2 > d.period / signals::tick_seconds)
    out.add("sensor", std::to_string(e.stand->sensors.size()), "fewer than the period has ticks");
  if (e.stand->sensors.size() > static_cast<std::size_t>(robot::board_channels))
    out.add("sensor", std::to_string(e.stand->sensors.size()),
            "at most " + std::to_string(robot::board_channels) + ", the channels of a board");
  check_law(e, out);
  if (!(e.stand->sweep.step > 0)) return;
  if (d.kind != DriveKind::pwm) out.add("sweep", "another drive", "drive.kind = \"pwm\"");
  if (!(e.stand->sweep.from < e.stand->sweep.to))
    out.add("sweep.to", "no more than from", "an ascending sweep");
  if (e.stand->duration < 5 * d.period)
    out.add("duration", "no five periods", "longer than the settling");
}

}  // namespace

void check_stand(const Experiment& e, std::vector<robot::Contradiction>& wrong) {
  Findings out(wrong);
  check_element(e, out);
  check_valves_of_stand(e, out);
  check_load(e, out);
  check_drive(e, out);
  check_faults_of_stand(e, out);
  check_samples(e, out);
  check_volumes(e, out);
}

}  // namespace sinew::experiment
