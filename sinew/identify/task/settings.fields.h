// identify/task/settings.fields.h - settings of every method, and of `sinew force-beam`: a
// struct of texts as users write them, and its rows (settings.h). An empty quantity is unknown.
#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "sinew/identify/actuator/creep.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/joint/joint.h"
#include "sinew/identify/motion/dynamic.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// --- geometry ---

// Thread length and turns of a braid, from lengths and diameters or from counted trapezoids.
struct GeometrySettings {
  std::string trapezoids, side, thread_thickness = "0 mm", name = "bpa";
};

template <class Visitor>
void fields(Visitor& v, GeometrySettings& s) {
  v.method({"geometry",
            "Find thread length and turns, from counted trapezoids or lengths and diameters",
            Tables::optional});
  v.text(
      {"trapezoids", "LENGTHWISE,AROUND: trapezoids counted on the opened mesh, in place of data"},
      s.trapezoids);
  v.quantity({"side", "side of one trapezoid", "m",
              config::above_zero(1, "of one trapezoid between two threads")},
             s.side);
  v.quantity({"thread_thickness",
              "thread thickness, subtracted from diameters measured outside the threads", "m",
              config::from_zero(0.1, "of one thread")},
             s.thread_thickness);
  v.text({"name", "name of the actuator"}, s.name);
}

// --- sensor ---

// Calibration of the sensors in a robot's file.
struct SensorSettings {
  std::string known;
  std::vector<std::string> sensors;
  std::string rest;
  int bits = 12;
  std::string full_scale = "5 V";
  HeldOut hold_out;
  bool average = false;
  std::string base;
};

template <class Visitor>
void fields(Visitor& v, SensorSettings& s) {
  v.method({"sensor", "Calibrate sensors: scale, offset, linearity, hysteresis and noise"});
  v.text({"known",
          "quantity that was set, where the file has several: load, force, tension, angle, length, "
          "position, pressure or velocity"},
         s.known);
  v.texts(Setting{"sensors", "columns to calibrate; default: all in volts or counts"}.at_commas(),
          s.sensors);
  v.quantity({"rest", "known value at the joint's rest angle; default: 0"}, s.rest);
  v.integer({"bits", "bits of the converter", "", {1, 16, "of a converter"}}, s.bits);
  v.quantity({"full_scale", "voltage of the largest count", "V",
              config::above_zero(1000, "of a converter")},
             s.full_scale);
  v.hold_out({"hold_out",
              "data that score: level (each known value, predicted from the others) or a file of "
              "another calibration; default: level"},
             s.hold_out);
  v.flag({"average", "write one scale for all sensors, as the thesis's controller assumes"},
         s.average);
  v.file(Setting{"base", "robot file with these sensors; the parameter file is then a robot file"}
             .of_file(),
         s.base);
}

// --- dynamic ---

// Losses of a muscle in motion, from a mass that swings on trapped air.
struct DynamicSettings {
  std::string actuator, name, mass, pressure, external_volume = "0 m3", exponent;
  int count = 1;
  HeldOut hold_out;
  std::string model;
  ConstraintTexts constraints;
};

constexpr config::Range parallel_actuators = {1, 100, "actuators in parallel"};

template <class Visitor>
void fields(Visitor& v, DynamicSettings& s) {
  v.method(
      {"dynamic", "Find viscous loss and dry friction from a mass that swings on trapped air"});
  v.file(
      Setting{"actuator", "actuator file whose braid, tension law and ends the search starts from"}
          .required(),
      s.actuator);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.quantities(Setting{"mass", "mass that moves; one, or one per file with commas", "kg",
                       config::above_zero(1e6, "hangs on the muscle")}
                   .required(),
               s.mass);
  v.quantities(
      {"pressure", "air pressure as the mass hangs; one, or one per file; default: as measured",
       "Pa abs", config::air_pressure},
      s.pressure);
  v.quantities(
      {"external_volume", "volume of hose and fittings up to the shut valve; one, or one per file",
       "m3", config::air_volume},
      s.external_volume);
  v.quantity({"exponent", "polytropic exponent; default: from measured pressure, else 1.4", "1",
              config::polytropic},
             s.exponent);
  v.integer({"count", "actuators in parallel", "", parallel_actuators}, s.count);
  v.hold_out(Setting{"hold_out",
                     "file that scores the laws and is not fitted; default: each file in turn, or "
                     "the last third of the only one"}
                 .repeated(),
             s.hold_out);
  v.choice({"model", "fit only this law"}, s.model, dynamic_models());
  fields(v, s.constraints);
}

// --- joint ---

// Names of the joint and its muscles in the robot's file.
struct JointNames {
  std::string joint = "joint", flexor = "joint_flexor", extensor = "joint_extensor";
  std::string flexion = "raises angle";  // or "lowers angle": effect of a shorter flexor
};

// Force law and moment arm of a joint's muscles, without a length test rig. Empty quantities
// come from a column or are fitted.
struct JointSettings {
  std::string actuator, name;
  int count = 1;
  JointNames names{.flexor = "", .extensor = ""};
  std::string rest_angle = "0 rad", load, lever = "0 m", down = "270 deg";
  std::string limb = "0 kg", limb_lever = "0 m";
  std::string moment_arm, flexor_length, extensor_length;
  bool keep_force = false, torque_bias = false, torque_gain = false, moving = false;
  HeldOut hold_out;
  std::string model, base;
  ConstraintTexts constraints;
  host::Tally* tried = nullptr;  // counts models that have been tried; may be null
};

// Visits the settings of the load on the joint.
template <class Visitor>
void load_fields(Visitor& v, JointSettings& s) {
  constexpr double turns = 4 * std::numbers::pi;
  constexpr config::Range angle{-turns, turns, "two turns; a joint makes less than one"};
  constexpr config::Range mass = config::from_zero(1e6, "of what hangs on a joint");
  constexpr config::Range lever = config::from_zero(1000, "from the joint's axis");
  v.quantity({"rest_angle", "joint angle at which the muscles' lengths are given", "rad", angle},
             s.rest_angle);
  v.quantity({"load", "mass at the lever, where no column torque or load has it", "kg", mass},
             s.load);
  v.quantity({"lever", "distance from the joint to the load", "m", lever}, s.lever);
  v.quantity({"down", "angle at which the lever points straight down", "rad", angle}, s.down);
  v.quantity({"limb", "mass of the limb itself", "kg", mass}, s.limb);
  v.quantity({"limb_lever", "distance from the joint to the limb's center of mass", "m", lever},
             s.limb_lever);
}

// Visits the settings of the muscles, and of the parts of the torque that are fitted.
template <class Visitor>
void known_fields(Visitor& v, JointSettings& s) {
  constexpr config::Range size = config::above_zero(1000, "of a robot");
  const std::string_view known = "known value at the rest angle, which is not fitted";
  v.quantity({"moment_arm", known, "m", size}, s.moment_arm);
  v.quantity({"flexor_length", known, "m", size}, s.flexor_length);
  v.quantity({"extensor_length", known, "m", size}, s.extensor_length);
  v.flag({"keep_force", "keep the effectiveness of the actuator's file"}, s.keep_force);
  v.flag({"torque_bias", "fit an offset of the torque for each file"}, s.torque_bias);
  v.flag({"torque_gain",
          "fit a torque gain for each file but the first; if the force is kept, for it too"},
         s.torque_gain);
  v.flag({"moving",
          "the joint moves, over a column time; also fit its dry friction and damping, and the "
          "delay of the torque"},
         s.moving);
}

template <class Visitor>
void fields(Visitor& v, JointSettings& s) {
  v.method({"joint", "Find force law and moment arm from joint angle, pressures and a known load",
            Tables::needed, joint_models().size()});
  v.file(
      Setting{"actuator", "actuator file with the braid, from which the search starts"}.required(),
      s.actuator);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.integer({"count", "actuators in parallel in a muscle", "", {1, 100, "actuators in parallel"}},
            s.count);
  v.choice({"flexion", "effect of a shorter flexor on the angle"}, s.names.flexion,
           {"raises angle", "lowers angle"});
  load_fields(v, s);
  known_fields(v, s);
  v.hold_out(
      {"hold_out", "file that scores the models and is not fitted; default: every third row"},
      s.hold_out);
  v.choice({"model", "fit only this model"}, s.model, joint_models());
  v.text(Setting{"joint", "name in the robot's file"}.in_python("joint_name"), s.names.joint);
  v.text({"flexor", "name of the flexor; default: <joint>_flexor"}, s.names.flexor);
  v.text({"extensor", "name of the extensor; default: <joint>_extensor"}, s.names.extensor);
  v.file(Setting{"base", "robot file with this joint, base of the written file"}.of_file(), s.base);
  fields(v, s.constraints);
}

// --- pair ---

// A sealed antagonistic pair that is moved.
struct PairSettings {
  std::string rigs;
  HeldOut hold_out;
  std::string window = "20 ms", model;
  ConstraintTexts constraints;
  std::string joint = "joint", base;
};

template <class Visitor>
void fields(Visitor& v, PairSettings& s) {
  v.method({"pair",
            "Find stiffness, dry friction, losses and trapped air of an antagonistic pair that is "
            "sealed and moved by hand or motor"});
  v.text(Setting{"rigs", "A,A,B: rig of each file; files of one rig share its sensors"}.at_commas(),
         s.rigs);
  v.hold_out(Setting{"hold_out",
                     "times of each file, \"7 s..14 s\" or \"7 s..\", or another file, that score "
                     "the laws and are not fitted"}
                 .repeated(),
             s.hold_out);
  v.quantity({"window", "duration of the fitted parabolas that give velocity and acceleration", "s",
              config::above_zero(10, "of a few samples")},
             s.window);
  v.choice({"model", "fit only this law"}, s.model, pair_models());
  fields(v, s.constraints);
  v.text(Setting{"joint", "name in the robot's file that is written"}.in_python("joint_name"),
         s.joint);
  v.file({"base", "robot file with this joint, base of the written file"}, s.base);
}

// --- valve ---

// Flow and delays of a valve, from a chart, a filling, pulses, coil current or a duty map.
struct ValveSettings {
  std::string kind, volume, conductance, added_volume;
  bool per_volume = false;
  std::string port, exponent, temperature = "20 degC";
  HeldOut hold_out;
  std::string name = "valve", base, frequency;
};

template <class Visitor>
void fields(Visitor& v, ValveSettings& s) {
  v.method({"valve",
            "Find flow and delays of a valve from a chart, a filling, pulses, a coil's current or "
            "a map of duties"});
  v.choice({"kind", "what was measured; default: by the columns"}, s.kind,
           {"chart", "fill", "pulses", "coil", "duty"});
  v.quantity({"volume", "fill, pulses: volume of the chamber, hoses included", "m3",
              config::above_zero(config::air_volume.high, config::air_volume.why)},
             s.volume);
  v.quantity({"conductance", "fill, pulses: conductance, in place of the volume", "m3/(s Pa)",
              config::above_zero(1, "a valve of this size fills a hall")},
             s.conductance);
  v.quantities({"added_volume",
                "fill: volume joined to the chamber in each file, \"0 L,0.5 L\"; two fillings "
                "separate conductance and volume",
                "m3", config::air_volume},
               s.added_volume);
  v.flag({"per_volume", "fill, pulses: find only conductance by volume, C/V"}, s.per_volume);
  v.quantity(Setting{"port",
                     "pressure on the valve's other side, the room's when venting; default: fitted",
                     "Pa abs", config::air_pressure}
                 .called("supply,port"),
             s.port);
  v.quantity(
      {"exponent", "fill: polytropic exponent, 1 (isothermal) to 1.4 (adiabatic); default: tried",
       "1", config::polytropic},
      s.exponent);
  v.quantity({"temperature", "temperature of the air", "K", {200, 400, "of air in a laboratory"}},
             s.temperature);
  v.hold_out({"hold_out", "file of another filling, which scores the model"}, s.hold_out);
  v.text({"name", "name of the valve"}, s.name);
  v.file({"base", "valves file with a valve of that name: what is not identified is taken from it"},
         s.base);
  v.quantity({"frequency",
              "frequency of the pulses, for a map of duties without such a column and for the "
              "duties' timing",
              "Hz", config::pulses},
             s.frequency);
}

// --- static and check ---

// Static law of an actuator, from force, length and pressure.
struct StaticSettings {
  std::string rest_length, actuator, branch = "both";
  std::vector<std::string> fit_where;
  HeldOut hold_out;
  std::string diameter, volume;
  bool anyway = false;
  std::vector<std::string> predict;
  std::string model, name = "bpa";
  host::Tally* tried = nullptr;  // counts laws that have been tried; may be null
};

// Settings of `check`: those of `static` that concern the tables.
struct CheckSettings {
  StaticSettings how;
};

constexpr config::Range actuator_length = config::above_zero(1000, "of an actuator");

// Visits the settings that concern the tables.
template <class Visitor>
void table_fields(Visitor& v, StaticSettings& s) {
  v.quantity({"rest_length", "rest length, without pressure and load; default: the longest length",
              "m", actuator_length},
             s.rest_length);
  v.file({"actuator", "actuator file whose braid is taken as known"}, s.actuator);
  v.choice({"branch", "points to fit: fill, vent or both"}, s.branch, {"fill", "vent", "both"});
  v.texts({"fit_where", "NAME=VALUE,...: fit only rows with these values and hold out the others"},
          s.fit_where);
  v.hold_out({"hold_out",
              "data that are not fitted but predicted: pressure (every second one), length or "
              "muscle (each in turn), or another file"},
             s.hold_out);
  v.quantity({"diameter",
              "diameter of the air in the muscle without pressure and load; gives its volume, with "
              "which the force is compared",
              "m", config::above_zero(1, "of a muscle")},
             s.diameter);
}

template <class Visitor>
void fields(Visitor& v, StaticSettings& s) {
  v.method({"static", "Find the static law of an actuator from force, length and pressure",
            Tables::needed, static_models().size()});
  table_fields(v, s);
  v.quantity({"volume",
              "air volume of the (longest) muscle without pressure and load, where it was measured",
              "m3", config::above_zero(1, "of a muscle")},
             s.volume);
  v.flag({"anyway", "fit even if a check is red; see `sinew identify check`"}, s.anyway);
  v.texts({"predict", "rest_length=LENGTH: also write this unmeasured muscle, in a file of its own",
           "m"},
          s.predict);
  v.text({"model", "fit only this law"}, s.model);
  v.text({"name", "name of the actuator"}, s.name);
}

template <class Visitor>
void fields(Visitor& v, CheckSettings& s) {
  v.method({"check", "Check measurements and list what `identify static` can find in them"});
  table_fields(v, s.how);
}

// --- creep ---

// Creep and dry friction from filling, holding and venting. It has no settings.
struct CreepSettings {
  host::Tally* tried = nullptr;  // counts laws that have been tried; may be null
};

template <class Visitor>
void fields(Visitor& v, CreepSettings&) {
  v.method({"creep",
            "Find creep and dry friction, an actuator's [creep] and [hysteresis], from force at "
            "one length while the muscle is filled, held and vented",
            Tables::needed, creep_models().size()});
}

// --- scale ---

// An actuator scaled to another rest length than the measured one.
struct ScaleSettings {
  std::string file, rest_length, actuator, reading, name, atmosphere = "14.7 psi";
};

template <class Visitor>
void fields(Visitor& v, ScaleSettings& s) {
  v.method({"scale", "Scale an identified muscle to another rest length", Tables::none});
  v.file(
      Setting{"file", "actuator file that `identify static` has written"}.required().called("FILE"),
      s.file);
  v.quantity(Setting{"rest_length", "rest length of the new muscle, without pressure and load", "m",
                     config::above_zero(1000, "of a muscle")}
                 .required(),
             s.rest_length);
  v.text({"actuator", "name of the actuator, where the file has several"}, s.actuator);
  v.text({"reading",
          "LENGTH,PRESSURE,FORCE: one reading of the new muscle at rest, which corrects the law"},
         s.reading);
  v.text({"name", "name of the new actuator; default: as in the file"}, s.name);
  v.text({"atmosphere", "pressure of the room"}, s.atmosphere);
}

// --- run ---

// Parameters of a machine from a recorded run.
struct RunFitSettings {
  std::string run;
  std::vector<std::string> fit;
  std::string machine;
  std::vector<std::string> sets, priors, freeze;
  std::string hold_out = "20 %", from = "0 s", score;
  int threads = 0;
  std::string base;
  std::function<void(const std::string&)> progress;  // receives progress lines; may be empty
};

template <class Visitor>
void fields(Visitor& v, RunFitSettings& s) {
  v.method({"run", "Find friction, damping, dead times, volumes and leaks from a run of a robot",
            Tables::none});
  v.file(Setting{"run", "run folder or log file, also of an imported recording"}.required().called(
             "RUN"),
         s.run);
  v.texts(Setting{"fit",
                  "keys, or groups of keys, to fit: friction, damping, dead-time, volume, leak; "
                  "default: all groups"}
              .at_commas(),
          s.fit);
  v.file({"machine", "machine that was run; default: resolved.toml in the folder"}, s.machine);
  v.texts(Setting{"sets", "KEY=VALUE: start of the search, or a known value"}.called("start,set"),
          s.sets);
  v.texts(Setting{"priors", "KEY=VALUE±DEVIATION: prior of a fitted number"}.called("prior"),
          s.priors);
  v.texts({"freeze", "KEY=VALUE: known number, which is not fitted"}, s.freeze);
  v.quantity({"hold_out",
              "share of the run, at its end, that scores and is not fitted; 100 %: fit nothing and "
              "score the machine as it is",
              "1"},
             s.hold_out);
  v.file({"score",
          "another run of the machine: its valve commands drive the identified machine; reports "
          "rms, nrmse and correlation"},
         s.score);
  v.quantity(Setting{"from", "time in the run before which nothing is compared", "s",
                     config::from_zero(1e6, "a time of the run")}
                 .in_python("begin"),
             s.from);
  v.integer({"threads", "simulations at once; 0: one per processor", "", {0, 1024, "simulations"}},
            s.threads);
  v.file(Setting{"base", "robot file, which the written file names as its base"}.of_file(), s.base);
}

// --- plan ---

// Plan of lengths and pressures to measure. Empty quantities are unknown, or follow from the
// others.
struct PlanSettings {
  std::string rest_length, branch = "both", diameter, actuator, pressure, noise;
  std::string length_error = "0.1 mm", law_error = "1 %", error = "2 %", criterion = "mean";
  std::string mount_time = "10 min", step_time = "30 s", shortest, longest, lowest;
  int most = 12;
};

// Visits the settings of the muscle and the measurement.
template <class Visitor>
void measurement_fields(Visitor& v, PlanSettings& s) {
  constexpr config::Range length = config::above_zero(1000, "of an actuator");
  v.quantity({"rest_length", "rest length, without pressure and load; default: the longest length",
              "m", length},
             s.rest_length);
  v.choice({"branch", "points of DATA to use: fill, vent or both"}, s.branch,
           {"fill", "vent", "both"});
  v.quantity({"diameter", "diameter of the mesh without pressure and load", "m",
              config::above_zero(1, "of a muscle")},
             s.diameter);
  v.file({"actuator",
          "similar muscle, in place of the diameter; with DATA: file whose braid is known"},
         s.actuator);
  v.quantity({"pressure", "highest pressure that will be measured", "Pa gauge",
              config::above_zero(5e6, "above the room's, in a muscle")},
             s.pressure);
  v.quantity(
      {"noise", "standard deviation of one force reading; default: 2 N, or the scatter of DATA",
       "N", config::above_zero(1e4, "of a force")},
      s.noise);
  v.quantity(
      {"length_error", "error of a mount's length", "m", config::from_zero(0.1, "of a mount")},
      s.length_error);
}

// Visits the settings of the required accuracy and the effort.
template <class Visitor>
void aim_fields(Visitor& v, PlanSettings& s) {
  constexpr config::Range time = config::from_zero(86400, "more than a day for one step");
  constexpr config::Range length = config::above_zero(1000, "of an actuator");
  v.quantity({"law_error",
              "error of the law itself, a share of the largest force; no measurement lowers it",
              "1", config::from_zero(0.5, "of the largest force")},
             s.law_error);
  v.quantity({"error", "error to reach, a share of the largest force", "1",
              config::above_zero(0.5, "of the largest force")},
             s.error);
  v.choice({"criterion",
            "mean: root mean square error over the region; worst: half of the 95 % interval at its "
            "worst place"},
           s.criterion, {"mean", "worst"});
  v.quantity({"mount_time", "time to change the length", "s", time}, s.mount_time);
  v.quantity({"step_time", "time to change the pressure, wait and read", "s", time}, s.step_time);
  v.quantity({"shortest", "shortest length at which the law is to hold", "m", length}, s.shortest);
  v.quantity({"longest", "longest such length; default: the rest length", "m", length}, s.longest);
  v.quantity({"lowest", "lowest pressure at which the law is to hold", "Pa gauge",
              config::above_zero(5e6, "above the room's, in a muscle")},
             s.lowest);
  v.integer({"most", "mounts at most", "", {3, 100, "mounts; fewer cannot try a law"}}, s.most);
}

template <class Visitor>
void fields(Visitor& v, PlanSettings& s) {
  v.method({"plan", "Plan lengths and pressures to measure for an error, and the minutes it takes",
            Tables::optional});
  measurement_fields(v, s);
  aim_fields(v, s);
}

// --- force-beam ---

// A force transducer; the defaults are the thesis's, 4.4. The thesis does not give the gages'
// position and wiring: of the bridges, one gives the measured 0.17 V/lb near the design strain,
// 1000e-6 at 30 lb.
struct TransducerSettings {
  std::string length = "0.75 in", width = "0.3 in", height = "0.15 in", gages = "0.36 in";
  std::string modulus = "10000000 psi";
  double poisson = 0.33;
  std::string yield = "40000 psi";
  double concentration = 1;
  std::string bridge = "poisson";
  double gage_factor = 2;
  std::string excitation = "5 V";
  double gain = 800;
  std::string full_scale = "5 V";
  int bits = 12;
  std::string load = "30 lbf", sensitivity;
};

template <class Visitor>
void fields(Visitor& v, TransducerSettings& s) {
  // A value beyond these limits has a wrong unit.
  constexpr config::Range size = config::above_zero(10, "no transducer is larger");
  constexpr config::Range stress = config::above_zero(1e13, "diamond has 1.2e12 N/m2");
  constexpr config::Range voltage = config::above_zero(1000, "no instrument has more");
  v.method({"force-beam",
            "Compute strain, safety and output of a beam with strain gages; default: the "
            "thesis's beam",
            Tables::none});
  v.quantity({"length", "distance from the load to the mount", "m", size}, s.length);
  v.quantity({"width", "width of the beam", "m", size}, s.width);
  v.quantity({"height", "height of the beam, in the direction of the load", "m", size}, s.height);
  v.quantity({"gages", "distance from the load to the middle of the gages", "m", size}, s.gages);
  v.quantity({"modulus", "Young's modulus of the material", "N/m2", stress}, s.modulus);
  v.number(
      {"poisson", "Poisson's ratio", "", config::from_zero(0.5, "no stretched solid gains more")},
      s.poisson);
  v.quantity(Setting{"yield", "yield stress", "N/m2", stress}.in_python("yield_stress"), s.yield);
  v.number({"concentration",
            "stress concentration factor at the mount",
            "",
            {1, 100, "a mount adds to the stress"}},
           s.concentration);
  v.choice({"bridge",
            "gages of the bridge: quarter (one), half (above and below), poisson (above and below, "
            "along and across) or bending (two above, two below)"},
           s.bridge, {"quarter", "half", "poisson", "bending"});
  v.number({"gage_factor", "gage factor", "", config::above_zero(1000, "semiconductors have 200")},
           s.gage_factor);
  v.quantity({"excitation", "supply voltage of the bridge", "V", voltage}, s.excitation);
  v.number({"gain", "amplifier's gain", "", config::above_zero(1e6, "of an amplifier")}, s.gain);
  v.quantity({"full_scale", "voltage of the largest count", "V", voltage}, s.full_scale);
  v.integer({"bits", "bits of the converter", "", {1, 24, "of a converter"}}, s.bits);
  v.quantity({"load", "load at its end", "N", config::above_zero(1e9, "at the beam's free end")},
             s.load);
  v.quantity({"sensitivity", "sensitivity to reach; gives the places of the gages", "V/N",
              config::above_zero(1e9, "output by load")},
             s.sensitivity);
}

}  // namespace sinew::identify
