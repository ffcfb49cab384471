// tests/worlds/stand.cpp - the test stand as a subject: hanging, driven, regulated, with an air
// cylinder in the muscle's place, and each option of its air.
#include <cmath>

#include "sinew/actuator/braid.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/run.h"
#include "sinew/world/stand.h"
#include "tests/places.h"
#include "tests/worlds/on_world.h"

namespace sinew::worlds {
namespace {

using plant::StandSetup;
using plant::StandTruth;

StandSetup varied(StandSetup s, const Variant& v) {
  actuator::Actuator& a = s.muscle.actuator;
  if (v.smooth || v.lossless) a.loss.coulomb_length = 0;
  if (v.lossless) {
    s.air.polytropic_exponent = 1.4;
    a.loss = {};
    a.effectiveness = {};
    a.bladder = {};
  }
  if (v.step > 0) s.step = v.step;
  if (v.pressure > 0 && s.charge.mode != robot::Stand::Charge::Mode::regulated)
    s.start.pressure = v.pressure;
  if (v.displaced && s.load.mode == robot::Stand::Load::Mode::hanging) s.start.displacement = 2e-3;
  return s;
}

struct OfStand {
  using World = plant::Stand;
  using Setup = StandSetup;

  static std::size_t channels(const Setup& s) { return s.transducers.size(); }

  template <class Take>
  static void visit(const Setup&, const StandTruth& x, Take take) {
    take("length", Kind::place, x.length);
    take("velocity", Kind::rate, x.velocity);
    take("acceleration", Kind::other, x.acceleration);
    take("force", Kind::tension, x.force);
    take("friction", Kind::other, x.friction);
    take("sticks", Kind::other, x.sticks ? 1.0 : 0.0);
    take("load", Kind::other, x.load);
    take("pressure", Kind::pressure, x.pressure);
    take("air", Kind::mass, x.air);
    take("air in", Kind::mass, x.air_in);
    take("air out", Kind::mass, x.air_out);
    take("air leaked", Kind::mass, x.air_leaked);
    take("inlet", Kind::other, x.inlet);
    take("exhaust", Kind::other, x.exhaust);
    take("supply", Kind::pressure, x.supply_pressure);
    take("tank", Kind::pressure, x.tank_pressure);
  }

  // Air from a tank stays within the stand.
  static std::vector<Account> air(const Setup& s, const StandTruth& x, double held) {
    const bool has_tank = s.supply.kind == gas::Supply::Kind::tank;
    std::vector<Account> out{{"stand", held, has_tank ? 0.0 : x.air_in, x.air_out, x.air_leaked}};
    if (!(s.muscle.hose.volume > 0))
      out.push_back({"element", x.air, x.air_in, x.air_out, x.air_leaked});
    return out;
  }

  static double energy(const Setup& s, const StandTruth& x) {
    double volume = s.muscle.external_volume +
                    s.muscle.count * actuator::volume(s.muscle.actuator.braid, x.length);
    if (s.cylinder) volume = air::volume(*s.cylinder, air::up, s.cylinder->stroke - x.length);
    const double air = x.pressure * volume / (s.air.polytropic_exponent - 1.0);
    return 0.5 * x.load * x.velocity * x.velocity - x.load * s.load.gravity * x.length + air +
           s.air.atmosphere * volume;
  }
};
using OnStand = OnWorld<OfStand>;

using Sets = std::vector<std::string>;

Subject of_setup(const std::string& name, const StandSetup& s) {
  Subject out{.name = "stand_" + name,
              .make = [s](const Variant& v) { return std::make_unique<OnStand>(varied(s, v)); },
              .step = s.step};
  const gas::Valve& inlet = s.cylinder ? s.cylinder->inlet[air::up] : s.muscle.inlet;
  const bool valves = s.charge.mode == robot::Stand::Charge::Mode::valves;
  if (valves) out.taps = {{0, inlet.kind == gas::Valve::Kind::regulator}};
  if (valves && inlet.kind == gas::Valve::Kind::two_way) out.taps.push_back({1});
  const bool leaks = s.muscle.leak.area > 0 || s.muscle.leak.conductance > 0 || !s.faults.empty();
  const bool seals = !leaks && s.charge.mode != robot::Stand::Charge::Mode::regulated &&
                     (!valves || inlet.kind == gas::Valve::Kind::two_way);
  out.conserves = seals && s.load.mode == robot::Stand::Load::Mode::hanging &&
                  !(s.muscle.hose.volume > 0) && !(s.air.wall_time > 0) &&
                  !(s.muscle.actuator.hysteresis.half_width > 0);
  return out;
}

// One of each kind of fault. They begin and end between two steps of the laws: there the supply
// jumps.
std::vector<experiment::Fault> broken() {
  using What = experiment::Fault::What;
  return {
      {.at = 0.0703, .lasts = 0.0503, .of = "bpa.inlet", .what = What::stuck_open},
      {.at = 0.2001, .of = "bpa", .what = What::leaking, .area = 2e-9},
      {.at = 0.3007, .lasts = 0.1004, .of = "supply", .what = What::failed, .pressure = 3e5},
      {.at = 0.4509, .lasts = 0.2, .of = "bpa.exhaust", .what = What::leaking, .share = 0.02},
      {.at = 0.6511, .lasts = 0.1, .of = "bpa.inlet", .what = What::stuck_shut},
      {.at = 0.8013, .of = "bpa", .what = What::blocked},
  };
}

Subject of_stand_experiment(const std::string& name, const std::string& file, Sets sets = {},
                            const std::vector<experiment::Fault>& faults = {}) {
  const auto load = [file, faults](const Sets& with) {
    experiment::Experiment e =
        experiment::load(sinew::test::source_dir() + "/experiments/rig/" + file + ".toml", with);
    e.faults = faults;
    return e;
  };
  Subject out = of_setup(name, run::stand_setup(load(sets)));
  sets.push_back("duration=1 s");
  const experiment::Experiment shorter = load(sets);
  out.run = [shorter](bool every_tick, int) {
    const run::Outcome o = run::run(shorter, {.every_tick = every_tick});
    return o.status == signals::Status::ok ? o.table : signals::Table{};
  };
  return out;
}

// The cylinder of 6.3 with a weight on its rod, filled and vented through two valves.
StandSetup hanging_cylinder() {
  StandSetup s = run::stand_setup(
      experiment::load(sinew::test::source_dir() + "/experiments/rig/sealed-cylinder.toml", {}));
  const StandSetup valves = run::stand_setup(
      experiment::load(sinew::test::source_dir() + "/experiments/rig/feedback.toml", {}));
  s.cylinder->inlet[air::up] = valves.muscle.inlet;
  s.cylinder->exhaust[air::up] = valves.muscle.exhaust;
  s.load = valves.load;
  s.charge.mode = robot::Stand::Charge::Mode::valves;
  s.air.polytropic_exponent = 1.4;
  const double ring = air::area(*s.cylinder, air::up);
  s.start = {.pressure = s.air.atmosphere + s.load.mass.at(0) * s.load.gravity / ring,
             .length = 0.5 * s.cylinder->stroke};
  return s;
}

// A tensile machine pulls to and fro while the regulator's set point moves and jumps.
StandSetup regulated() {
  StandSetup s = run::stand_setup(
      experiment::load(sinew::test::source_dir() + "/experiments/rig/length-sweep.toml", {}));
  s.load.length = signals::Schedule({{0, 0.075}, {0.3003, 0.085}, {0.5003, 0.085}, {0.9003, 0.07}});
  s.charge.pressure =
      signals::Schedule({{0, 2e5}, {0.4, 5e5}, {0.6003, 5e5}, {0.6003, 3e5}, {1, 4e5}});
  s.start = {};
  return s;
}

// The stand integrates also between nodes, in pieces that suit its fastest rate, and so states
// between nodes are as exact as the nodes. Measured: 6.4e-9 m, 3.3e-5 N, 0.18 Pa, 5e-12 kg.
Limits limits_of(const std::string& name) {
  Limits l{.preview_angle = 0,
           .preview_place = 2e-8,
           .preview_tension = 1e-4,
           .preview_pressure = 0.5,
           .preview_mass = 2e-11,
           .rubbing_angle = 0,
           .rubbing_place = 2e-8,
           .rubbing_tension = 1e-4,
           .error = 1e-9,
           .driven_order = 1.5,
           .driven_error = 1e-7,
           .energy = 1e-10};
  // Vents from the start on: choked, not choked, linear (order 2.4).
  if (name == "stand_3_way") l.order = 1.5;
  // Pieces of one length, whatever the step (1e-10 m; driven 1.1e-8).
  if (name == "stand_hose_with_air") l.order = l.driven_order = -2;
  // Settles at the supply's pressure within a few milliseconds (order 1.4, 4e-10 m).
  if (name == "stand_hanging_cylinder") l.driven_order = 0.5;
  return l;
}

}  // namespace

std::vector<Subject> stand_subjects() {
  const Sets tank{"air.supply.kind=tank", "air.supply.volume=0.1 L",
                  "air.supply.initial_pressure=80 psi gauge"};
  const std::string pipe = "law = \"pipe\", length = \"0.5 m\", inner_diameter = \"2.5 mm\"";
  std::vector<Subject> all{
      of_stand_experiment("sealed", "trapped-60-6"),
      of_stand_experiment("3_way", "pwm-25hz-5lb"),
      of_stand_experiment("hanging", "feedback"),
      of_stand_experiment("driven", "isometric"),
      of_stand_experiment("length_sweep", "length-sweep"),
      of_setup("regulated", regulated()),
      of_stand_experiment("driven_cylinder", "sealed-cylinder"),
      of_setup("hanging_cylinder", hanging_cylinder()),
      of_stand_experiment("hose_with_air", "feedback",
                          {"element.hose={ " + pipe + ", volume = \"2.45e-6 m3\" }"}),
      of_stand_experiment("hose_without_air", "feedback", {"element.hose={ " + pipe + " }"}),
      of_stand_experiment("tank", "feedback", tank),
      of_stand_experiment("leak", "feedback", {"element.leak={ area = \"1e-9 m2\" }"}),
      of_stand_experiment("heat", "feedback", {"air.wall_time=0.3 s"}),
      of_stand_experiment("broken", "feedback", {}, broken()),
  };
  for (Subject& s : all) s.limits = limits_of(s.name);
  return all;
}

}  // namespace sinew::worlds
