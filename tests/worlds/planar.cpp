// tests/worlds/planar.cpp - planar machines as subjects: every mechanism with every kind of air,
// each for its own purpose.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>

#include "sinew/actuator/braid.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/run.h"
#include "sinew/world/driven/driven_muscle.h"
#include "sinew/world/machine.h"
#include "tests/places.h"
#include "tests/six_legs.h"
#include "tests/worlds/breaks.h"
#include "tests/worlds/on_world.h"

namespace sinew::worlds {
namespace {

using experiment::Experiment;
using plant::Setup;
using plant::Truth;

// --- what is the same for all planar worlds
// -------------------------------------------------------

void make_smooth(Setup& s) {
  for (robot::Joint& j : s.robot.joints) j.dry_friction = 0;
  s.robot.trolley.drag = s.robot.trolley.breakaway = 0;
  s.robot.cylinder.friction = 0;
  s.robot.ground.present = false;
  for (air::Muscle& m : s.muscles) m.actuator.loss.coulomb_length = 0;
}

void make_lossless(Setup& s) {
  make_smooth(s);
  s.air.polytropic_exponent = 1.4;
  for (robot::Joint& j : s.robot.joints) j.damping = j.damper = 0;
  s.robot.cylinder.damping = s.robot.cylinder.stop_damping = 0;
  for (air::Muscle& m : s.muscles) {
    m.actuator.loss = {};
    m.actuator.effectiveness = {};
    m.actuator.bladder = {};
    m.actuator.long_end.stiffness = m.actuator.long_end.damping = 0;
  }
}

Setup varied(Setup s, const Variant& v) {
  if (v.smooth) make_smooth(s);
  if (v.lossless) make_lossless(s);
  if (v.step > 0) s.steps.body = v.step;
  if (v.pressure > 0) s.start.pressure = v.pressure;
  if (v.displaced) {
    s.start.joint_angle.front() += 0.1;
    s.start.joint_angle.back() += 0.05;
    if (s.cylinder) s.start.lift = 0.5 * s.cylinder->stroke;
  }
  return s;
}

bool has_cylinder(const Setup& s) {
  return s.cylinder && s.cylinder->mode == air::Cylinder::Mode::valves;
}

// All numbers of a truth, in the order of `quantities`.
template <class Take>
void visit(const Setup& s, const Truth& x, Take take) {
  take("trolley", Kind::place, x.x);
  take("trolley rate", Kind::rate, x.x_rate);
  take("lift", Kind::place, x.lift);
  take("lift rate", Kind::rate, x.lift_rate);
  for (std::size_t j = 0; j < s.robot.joints.size(); ++j) {
    take("angle", Kind::angle, x.angle[j]);
    take("angle rate", Kind::rate, x.rate[j]);
    take("torque", Kind::other, x.torque[j]);
  }
  for (std::size_t i = 0; i < s.muscles.size(); ++i) {
    take("tension", Kind::tension, x.tension[i]);
    take("pressure", Kind::pressure, x.pressure[i]);
    take("length", Kind::place, x.length[i]);
    take("mass", Kind::mass, x.mass[i]);
    take("air in", Kind::mass, x.air_in[i]);
    take("air out", Kind::mass, x.air_out[i]);
    take("air leaked", Kind::mass, x.air_leaked[i]);
  }
  for (std::size_t c = 0; c < 2; ++c) {
    take("cylinder pressure", Kind::pressure, x.cylinder_pressure[c]);
    take("cylinder in", Kind::mass, x.cylinder_in[c]);
    take("cylinder out", Kind::mass, x.cylinder_out[c]);
  }
  for (std::size_t leg = 0; leg < std::max<std::size_t>(1, s.robot.legs.size()); ++leg) {
    const plant::FootTruth& foot = x.foot[leg];
    take("foot x", Kind::place, foot.x);
    take("foot y", Kind::place, foot.y);
    take("ground x", Kind::other, foot.force_x);
    take("ground y", Kind::other, foot.force_y);
  }
  for (int d = 0; d < robot::discs_of(s.robot); ++d)
    take("disc", Kind::other, x.disc_force[static_cast<std::size_t>(d)]);
  take("front roller", Kind::other, x.roller_front);
  take("rear roller", Kind::other, x.roller_rear);
  take("supply", Kind::pressure, x.supply_pressure);
  take("tank", Kind::pressure, x.tank_pressure);
  take("all air", Kind::other, x.air_mass);
  take("air past the tank", Kind::mass, x.air_past_tank);
}

// Each muscle that has no air in its hose, and its cylinder's chambers where the truth has them.
std::vector<Account> accounts(const Setup& s, const Truth& x) {
  std::vector<Account> out;
  for (std::size_t i = 0; i < s.muscles.size(); ++i)
    if (!(s.muscles[i].hose.volume > 0))
      out.push_back({s.muscles[i].name, x.mass[i], x.air_in[i], x.air_out[i], x.air_leaked[i]});
  return out;
}

// The machine as a whole: air from a tank stays within it, except for the air that its line gives
// while a fault has cut it off.
Account machine_account(const Setup& s, const Truth& x, double held) {
  Account all{.of = "machine", .held = held, .entered = x.air_past_tank};
  const bool tank = s.supply.kind == gas::Supply::Kind::tank;
  for (std::size_t i = 0; i < s.muscles.size(); ++i) {
    if (!tank) all.entered += x.air_in[i];
    all.left += x.air_out[i];
    all.leaked += x.air_leaked[i];
  }
  for (std::size_t c = 0; c < 2; ++c) {
    if (!tank) all.entered += x.cylinder_in[c];
    all.left += x.cylinder_out[c];
  }
  return all;
}

// Returns the energy of a sealed polytrope, and of the room air that its volume displaces  [J].
double air_energy(const Setup& s, double pressure, double volume) {
  return pressure * volume / (s.air.polytropic_exponent - 1.0) + s.air.atmosphere * volume;
}

double energy_of(const Setup& s, const Truth& x) {
  plant::BodyState<robot::max_joints> m;
  m.at[plant::along_track] = x.x;
  m.rate[plant::along_track] = x.x_rate;
  m.at[plant::up] = x.lift;
  m.rate[plant::up] = x.lift_rate;
  double sum = 0;
  for (std::size_t j = 0; j < s.robot.joints.size(); ++j) {
    const int on = robot::parent_of(s.robot, j);
    const auto parent = plant::first_link + static_cast<std::size_t>(std::max(on, 0));
    m.at[plant::first_link + j] = (on < 0 ? 0.0 : m.at[parent]) + x.angle[j];
    m.rate[plant::first_link + j] = (on < 0 ? 0.0 : m.rate[parent]) + x.rate[j];
    const robot::Joint& joint = s.robot.joints[j];
    const double turn = x.angle[j] - joint.spring_angle;
    if (joint.spring > 0) sum += 0.5 * joint.spring * turn * turn;
  }
  sum += energy(plant::body_of<robot::max_joints>(s.robot), m);
  for (std::size_t i = 0; i < s.muscles.size(); ++i) {
    const air::Muscle& a = s.muscles[i];
    const double volume =
        a.count * actuator::volume(a.actuator.braid, x.length[i]) + a.external_volume;
    sum += air_energy(s, x.pressure[i], volume);
  }
  for (const air::Side side : {air::up, air::down})
    if (has_cylinder(s))
      sum += air_energy(s, x.cylinder_pressure[side], air::volume(*s.cylinder, side, x.lift));
  return sum;
}

struct OfPlanar {
  using World = plant::Machine;
  using Setup = plant::Setup;

  static std::size_t channels(const Setup& s) { return s.robot.sensors.size(); }
  template <class Take>
  static void visit(const Setup& s, const Truth& x, Take take) {
    worlds::visit(s, x, take);
  }
  static std::vector<Account> air(const Setup& s, const Truth& x, double held) {
    std::vector<Account> out = accounts(s, x);
    out.push_back(machine_account(s, x, held));
    return out;
  }
  static double energy(const Setup& s, const Truth& x) { return energy_of(s, x); }
};
using Planar = OnWorld<OfPlanar>;

// A leg in the second lane of as many as the processor has.
class InLane : public plant::Machine {
 public:
  explicit InLane(const Setup& s) : InLane(s, std::make_unique<plant::Batch>(8, s)) {}

 private:
  InLane(const Setup& s, std::unique_ptr<plant::Batch> batch)
      : Machine((batch->replace(1, s), plant::LegLane(*batch, 1))), batch_(std::move(batch)) {}

  std::unique_ptr<plant::Batch> batch_;
};
struct OfLane : OfPlanar {
  using World = InLane;
};

// --- a driven length
// ------------------------------------------------------------------------------

struct OfDriven {
  using World = plant::DrivenWorld;
  using Setup = plant::DrivenSetup;

  static std::size_t channels(const Setup&) { return 0; }
  template <class Take>
  static void visit(const Setup&, const plant::DrivenTruth& x, Take take) {
    take("length", Kind::place, x.length);
    take("tension", Kind::tension, x.tension);
    take("pressure", Kind::pressure, x.pressure);
    take("mass", Kind::mass, x.air.mass);
    take("air in", Kind::mass, x.air.in);
    take("air out", Kind::mass, x.air.out);
  }
  static std::vector<Account> air(const Setup&, const plant::DrivenTruth& x, double) {
    return {{"muscle", x.air.mass, x.air.in, x.air.out, x.air.leak}};
  }
  static double energy(const Setup&, const plant::DrivenTruth&) { return 0; }
};

std::vector<Tap> taps_of(const Setup& s) {
  using Valve = gas::Valve::Kind;
  std::vector<Tap> out;
  for (std::size_t i = 0; i < s.muscles.size(); ++i) {
    const auto inlet = static_cast<std::uint8_t>(2 * i);
    const Valve kind = s.muscles[i].inlet.kind;
    out.push_back({inlet, kind == Valve::regulator});
    if (kind == Valve::two_way) out.push_back({static_cast<std::uint8_t>(inlet + 1)});
  }
  if (has_cylinder(s))
    for (std::size_t v = 0; v < 4; ++v)
      out.push_back({static_cast<std::uint8_t>(2 * s.muscles.size() + v)});
  return out;
}

bool all_seal(const Setup& s) {
  return std::ranges::all_of(s.muscles, [](const air::Muscle& m) {
    return m.inlet.kind == gas::Valve::Kind::two_way && m.leak.area == 0 && m.leak.conductance == 0;
  });
}

// --- the subjects
// ---------------------------------------------------------------------------------

using Sets = std::vector<std::string>;

// A shipped experiment by its name, or any by its path.
Experiment load(const std::string& name, const Sets& sets) {
  if (name.starts_with("/")) return experiment::load(name, sets);
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

Subject of_setup(const std::string& name, const Setup& s) {
  Subject out{.name = name,
              .make = [s](const Variant& v) { return std::make_unique<Planar>(varied(s, v)); },
              .taps = taps_of(s),
              .step = s.steps.body};
  // Between hose and muscle, and at walls, energy of the flow is lost; memory of the mesh too.
  out.conserves = s.faults.empty() && all_seal(s) && !(s.air.wall_time > 0) &&
                  (!s.cylinder || s.cylinder->mode == air::Cylinder::Mode::valves);
  for (const air::Muscle& m : s.muscles)
    out.conserves = out.conserves && !(m.hose.volume > 0) &&
                    !(m.actuator.hysteresis.half_width > 0) && m.actuator.creep.share[0] == 0;
  return out;
}

// Returns a shipped experiment as a subject, with or without changes; its closed loop walks one
// step.
Subject of_experiment(const std::string& name, const std::string& file, Sets sets = {},
                      const Breaks& faults = {}) {
  Experiment e = load(file, sets);
  e.faults = faults;
  const Setup s = run::planar_setup(e);
  Subject out = of_setup(name, s);
  sets.push_back("sequence.repeat=1");
  Experiment once = load(file, sets);
  once.faults = faults;
  out.run = [once](bool every_tick, int extra_readers) {
    const run::Outcome o =
        run::run(once, {.every_tick = every_tick, .extra_readers = extra_readers});
    return o.status == signals::Status::ok ? o.table : signals::Table{};
  };
  return out;
}

// The leg with its ankle driven by a pair like the knee's.
Setup three_driven_joints() {
  Setup s = run::planar_setup(load("walk-with-ankle", {}));
  robot::Joint& ankle = s.robot.joints[2];
  ankle.kind = robot::Joint::Kind::driven;
  ankle.moment_arm = 0.5 * s.robot.joints[1].moment_arm;
  for (std::size_t k = 2; k < 4; ++k) {
    robot::Muscle m = s.robot.muscles[k];
    m.joint = ankle.name;
    m.name = m.role == robot::Muscle::Role::flexor ? "ankle_flexor" : "ankle_extensor";
    s.robot.muscles.push_back(m);
    s.muscles.push_back(s.muscles[k]);
    s.muscles.back().name = m.name;
  }
  return s;
}

Setup with_memory() {
  Setup s = run::planar_setup(load("walk-test-1", {}));
  for (air::Muscle& m : s.muscles) {
    m.actuator.hysteresis = {
        .half_width = 700, .width_per_contraction = 35e3, .volume_pressure = 7e5};
    m.actuator.creep = {.share = {0.05, 0.035}, .time = {0.9, 20}};
  }
  return s;
}

// A walk's knee flexor along the lengths of a table, as a CSV file has them.
Subject driven_length() {
  const Setup leg = run::planar_setup(load("walk-test-1", {}));
  std::istringstream csv(R"(time [s],length [m]
0,0.085
0.2113,0.078
0.4,0.078
0.7007,0.088
1.1,0.081
)");
  signals::Schedule length;
  std::string row;
  std::getline(csv, row);
  while (std::getline(csv, row)) {
    const std::size_t comma = row.find(',');
    length.points.push_back({std::stod(row), std::stod(row.substr(comma + 1))});
  }
  const plant::DrivenSetup s{leg.muscles[2], leg.air, leg.supply, length, 2e5};
  return {.name = "driven_length",
          .make =
              [s](const Variant& v) {
                plant::DrivenSetup with = s;
                if (v.step > 0) with.step = v.step;
                if (v.pressure > 0) with.pressure = v.pressure;
                return std::make_unique<OnWorld<OfDriven>>(with);
              },
          .taps = {{0}, {1}},
          .step = s.step};
}

// The leg of the walk in a lane.
Subject leg_in_a_lane() {
  Subject out = of_experiment("leg_in_a_lane", "walk-test-1");
  const Setup s = run::planar_setup(load("walk-test-1", {}));
  out.make = [s](const Variant& v) { return std::make_unique<OnWorld<OfLane>>(varied(s, v)); };
  return out;
}

// The largest machine, from files that are made here.
Subject six_legs() {
  const auto folder =
      std::filesystem::temp_directory_path() / ("sinew-worlds-" + std::to_string(getpid()));
  Subject out = of_experiment("six_legs", test::write_six_legs(folder, sinew::test::source_dir()));
  std::filesystem::remove_all(folder);
  return out;
}

// Below the set point of its regulator from the start on: the line falls with every pulse.
const Sets tank{"air.supply.kind=tank", "air.supply.volume=0.2 L",
                "air.supply.initial_pressure=80 psi gauge"};
const Sets leak{"muscle.hip_flexor.leak={ area = \"1e-8 m2\" }",
                "muscle.knee_extensor.leak={ conductance = \"1e-11 kg/(s Pa)\" }"};
const Sets failing{"valve.exhaust.fails_above=90 psi diff",
                   "valve.inlet.opening_delay_slope=1e-10 s/Pa"};

Sets pipes() {
  Sets out;
  for (const char* m : {"hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor"})
    out.push_back(std::string("muscle.") + m +
                  ".hose={ law = \"pipe\", length = \"0.5 m\", inner_diameter = \"2.5 mm\" }");
  return out;
}

}  // namespace

std::vector<Subject> planar_subjects() {
  const Sets regulated_cylinder{"cylinder.mode=regulator", "cylinder.pressure=60 psi gauge"};
  std::vector<Subject> all{
      of_experiment("one_joint", "one-joint"),
      of_experiment("leg", "walk-test-1"),
      leg_in_a_lane(),
      driven_length(),
      of_experiment("leg_3_way", "walk-3-way"),
      of_setup("three_joints", three_driven_joints()),
      of_experiment("ankle", "walk-with-ankle"),
      of_experiment("two_joint_muscle", "three-muscles"),
      of_experiment("pressure_sensors", "walk-with-pressures"),
      of_experiment("tank", "walk-test-1", tank),
      of_experiment("regulators", "walk-with-regulators"),
      of_experiment("moving_cylinder", "cylinder-following"),
      of_experiment("regulated_cylinder", "walk-test-1", regulated_cylinder),
      of_experiment("hoses_with_air", "walk-with-hoses"),
      of_experiment("hoses_without_air", "walk-test-1", pipes()),
      of_experiment("leak", "walk-test-1", leak),
      of_experiment("heat", "walk-test-1", {"air.wall_time=0.3 s"}),
      of_setup("memory", with_memory()),
      of_experiment("failing_valves", "walk-test-1", failing),
      of_experiment("dampers", "damper"),
      of_experiment("two_legs", "walk-two-legs"),
      six_legs(),
      of_experiment("breakaway", "walk-test-1", {"trolley.breakaway=3 lbf"}),
      of_experiment("broken_valves", "walk-test-1", {}, of_valves()),
      of_experiment("broken_air", "walk-test-1", {}, of_everything()),
      of_experiment("broken_hoses", "walk-with-hoses", {}, of_everything()),
      of_experiment("broken_tank", "walk-test-1", tank, of_everything()),
      of_experiment("broken_heat", "walk-test-1", {"air.wall_time=0.3 s"}, of_everything()),
      of_experiment("broken_cylinder", "cylinder-following", {}, of_the_cylinder()),
  };
  for (Subject& s : all) s.limits = planar_limits(s.name);
  return all;
}

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> out = planar_subjects();
    for (Subject& s : stand_subjects()) out.push_back(std::move(s));
    return out;
  }();
  return all;
}

}  // namespace sinew::worlds
