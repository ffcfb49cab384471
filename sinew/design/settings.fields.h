// design/settings.fields.h - settings of every design calculation: a struct of texts as users write
// them, and its rows (config/setting_rows.h). An empty quantity is not given.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "sinew/config/setting_rows.h"
#include "sinew/gas/storage.h"

namespace sinew::design {

using config::Setting;

constexpr config::Range part_length = config::above_zero(10, "no part of a robot is longer");

// --- joint ---

// Muscles, moment arm and mount length of a joint with an antagonistic pair.
struct JointSettings {
  std::string actuator, name, rest_length;
  std::string torque, load, lever, time;
  std::string angles, motion;
  std::string pressure, arm = "cam", moment_arm;
  int most = 4;
  std::string external_volume = "0 m3";
  std::string base, joint;
};

template <class Visitor>
void fields(Visitor& v, JointSettings& s) {
  constexpr config::Range turn =
      config::above_zero(2 * std::numbers::pi, "a joint turns less than once");
  v.method(
      {"joint", "Choose number, length and moment arm of a joint's muscles", config::Tables::none});
  v.file(Setting{"actuator", "actuator file of the muscle"}.required(), s.actuator);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.text({"rest_length",
          "QUANTITY: rest length, or several as from:to:step: the file's muscle is scaled to it; "
          "default: the file's own"},
         s.rest_length);
  v.quantity({"torque", "torque in both directions, at each of the angles", "N m",
              config::above_zero(1e5, "no joint of a robot has more")},
             s.torque);
  v.quantity({"load",
              "mass at the end of a lever, in place of the torque: that of its weight while the "
              "lever is level",
              "kg", config::above_zero(1e4, "no joint carries more")},
             s.load);
  v.quantity(
      {"lever", "length of that lever: distance from the joint to the load", "m", part_length},
      s.lever);
  v.quantity({"time",
              "time of a stroke over the angles: adds the torque that speeds up the load and "
              "slows it down",
              "s", config::above_zero(3600, "no stroke takes longer")},
             s.time);
  v.quantity(
      Setting{"angles", "range of angles over which the torque is needed", "rad", turn}.required(),
      s.angles);
  v.quantity({"motion", "range of motion without a load; default: the angles", "rad", turn},
             s.motion);
  v.quantity(Setting{"pressure", "highest pressure in a muscle", "Pa gauge",
                     config::above_zero(config::greatest_pressure, config::air_pressure.why)}
                 .required(),
             s.pressure);
  v.choice({"arm", "moment arm: a round cam, or a lever that a straight muscle pulls"}, s.arm,
           {"cam", "lever"});
  v.text({"moment_arm",
          "QUANTITY: radius of the cam or length of the lever, or from:to:step; default: twelve "
          "that allow the motion"},
         s.moment_arm);
  v.integer(
      {"most", "largest number of muscles side by side", "", {1, 100, "no more fit side by side"}},
      s.most);
  v.quantity(
      {"external_volume", "volume of hose and fittings of one muscle", "m3", config::air_volume},
      s.external_volume);
  v.file({"base", "robot file with this joint, base of the robot file that is written"}, s.base);
  v.text(Setting{"joint", "name of the joint in that file"}.in_python("joint_name"), s.joint);
}

// --- valve ---

// Valve of a muscle, for times of filling and venting and for pulses.
struct ValveSettings {
  std::string volume, actuator, name, length, contracted_length;
  int count = 1;
  std::string external_volume = "0 m3", uncertainty = "0 %";
  std::string supply, pressure, start = "0 bar gauge", vent_to;
  std::string fill_time, vent_time;
  std::string frequency, least_duty = "10 %", greatest_duty = "90 %", step;
  std::string critical_ratio = "0.3", flow, opening_delay, closing_delay;
  std::vector<std::string> catalogue;
};

// Visits the rows of the muscle that a valve fills.
template <class Visitor>
void volume_fields(Visitor& v, ValveSettings& s) {
  v.quantity({"volume", "air volume of the muscle, in place of its file", "m3", config::air_volume},
             s.volume);
  v.file({"actuator", "actuator file of the muscle"}, s.actuator);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.quantity({"length", "length of the muscle as it begins to fill", "m", part_length}, s.length);
  v.quantity({"contracted_length", "length of the filled muscle; default: it does not move", "m",
              part_length},
             s.contracted_length);
  v.integer(
      {"count", "muscles side by side at the valve", "", {1, 100, "no more fit side by side"}},
      s.count);
  v.quantity(
      {"external_volume", "volume of hose and fittings up to the valve", "m3", config::air_volume},
      s.external_volume);
  v.quantity({"uncertainty", "share by which the whole volume may be smaller or larger", "1",
              config::from_zero(0.9, "a share of the volume")},
             s.uncertainty);
}

// Visits the rows of a valve that is judged together with those of the catalogue.
template <class Visitor>
void given_valve_fields(Visitor& v, ValveSettings& s) {
  constexpr config::Range delay = config::from_zero(1, "no valve is slower");
  v.quantity({"critical_ratio", "critical pressure ratio b of ISO 6358-1, where flow needs one",
              "1", config::from_zero(0.999, "a share of the upstream pressure")},
             s.critical_ratio);
  v.text({"flow",
          "flow of a valve of your own, as published: \"C 0.4 L/(s bar)\", \"Qn 100 L/min\", "
          "\"Kv 0.035\", \"Cv 0.04\" or \"A 1.2 mm2\"; it is converted and judged"},
         s.flow);
  v.quantity({"opening_delay", "time in which that valve opens", "s", delay}, s.opening_delay);
  v.quantity({"closing_delay", "time in which that valve shuts", "s", delay}, s.closing_delay);
  v.texts({"catalogue",
           "FILE: valves to choose from, of a valves or robot file; default: Sinew's own, "
           "data/valves.toml"},
          s.catalogue);
}

template <class Visitor>
void fields(Visitor& v, ValveSettings& s) {
  constexpr config::Range gauge = {-units::atmosphere, config::greatest_pressure,
                                   config::air_pressure.why};
  constexpr config::Range time = config::above_zero(3600, "no muscle fills more slowly");
  constexpr config::Range duty = config::above_zero(1, "a share of the period");
  v.method({"valve", "Find the flow and delays that a muscle needs, and valves that have them",
            config::Tables::none});
  volume_fields(v, s);
  v.quantity(Setting{"supply", "pressure of the supply", "Pa gauge", gauge}.required(), s.supply);
  v.quantity(Setting{"pressure", "pressure of the filled muscle", "Pa gauge", gauge}.required(),
             s.pressure);
  v.quantity({"start", "pressure of the muscle before it fills", "Pa gauge", gauge}, s.start);
  v.quantity({"vent_to", "pressure at the end of venting; default: a tenth of the filled muscle's",
              "Pa gauge", gauge},
             s.vent_to);
  v.quantity({"fill_time", "time in which the muscle fills, or contracts", "s", time}, s.fill_time);
  v.quantity({"vent_time", "time in which the muscle vents, or extends", "s", time}, s.vent_time);
  v.quantity({"frequency", "frequency of the pulses", "Hz", config::pulses}, s.frequency);
  v.quantity({"least_duty", "smallest duty that opens the valve", "1", duty}, s.least_duty);
  v.quantity({"greatest_duty", "greatest duty that lets the valve shut", "1", duty},
             s.greatest_duty);
  v.quantity({"step", "largest change of the pressure by one pulse of the smallest duty", "Pa diff",
              config::above_zero(config::greatest_pressure, config::air_pressure.why)},
             s.step);
  given_valve_fields(v, s);
}

// --- air ---

// Time for which a bottle, a tank or a compressor lasts.
struct AirSettings {
  std::string use;
  std::string volume, pressure, mass, line, lowest;
  std::string droop, droop_flow;
  std::vector<std::string> compressor;
  std::string compressor_mass;
  std::string name, length, contraction, cycles, muscle_pressure;
  int muscles = 0;
  std::string external_volume = "0 m3";
};

template <class Visitor>
void fields(Visitor& v, AirSettings& s) {
  constexpr config::Range stored = config::above_zero(
      gas::highest_stored_pressure - units::atmosphere, "compressibilities are known up to it");
  constexpr config::Range weight = config::above_zero(1e4, "no robot carries more");
  v.method({"air", "Find how long a bottle, a tank or a compressor lasts", config::Tables::none});
  v.file(
      Setting{"use",
              "source of the consumption: folder of a run or its summary.json, table of a sweep, "
              "or file with an actuator"}
          .required(),
      s.use);
  v.quantity({"volume", "volume of the bottle or tank", "m3",
              config::above_zero(config::air_volume.high, config::air_volume.why)},
             s.volume);
  v.quantity({"pressure", "pressure of the full bottle or tank", "Pa gauge", stored}, s.pressure);
  v.quantity({"mass", "mass of the empty bottle with its regulator", "kg", weight}, s.mass);
  v.quantity({"line", "set pressure of the regulator; default: that of the run or the muscle",
              "Pa gauge", stored},
             s.line);
  v.quantity(
      {"lowest", "pressure in the line below which the robot stops; default: the set pressure",
       "Pa gauge", stored},
      s.lowest);
  v.quantity({"droop", "fall of the regulator's pressure when air flows", "Pa diff",
              config::above_zero(config::greatest_pressure, "no regulator falls further")},
             s.droop);
  v.quantity({"droop_flow", "flow of free air at which it falls that far", "m3/s",
              config::above_zero(1, "no regulator passes more")},
             s.droop_flow);
  v.texts(Setting{"compressor",
                  "POINT: \"100 psi gauge, 6.2 L/min, 120 W\": pressure, free flow and electrical "
                  "power, which may be left out"}
              .repeated(),
          s.compressor);
  v.quantity({"compressor_mass", "mass of the compressor", "kg", weight}, s.compressor_mass);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.integer({"muscles",
             "number of muscles that are filled in each cycle",
             "",
             {0, 10000, "no robot has more"}},
            s.muscles);
  v.quantity({"cycles", "frequency at which each muscle is filled", "Hz",
              config::above_zero(1000, "no muscle works faster")},
             s.cycles);
  v.quantity({"length", "length of a vented muscle; default: its rest length", "m", part_length},
             s.length);
  v.quantity({"contraction",
              "contraction of a full muscle, as a share of that length",
              "1",
              {0, 0.5, "no braid contracts further"}},
             s.contraction);
  v.quantity({"muscle_pressure", "pressure of a full muscle; default: the set pressure", "Pa gauge",
              config::above_zero(config::greatest_pressure, config::air_pressure.why)},
             s.muscle_pressure);
  v.quantity(
      {"external_volume", "volume of hose and fittings of one muscle", "m3", config::air_volume},
      s.external_volume);
}

// --- life ---

// Cycles and time until a muscle of a robot fails.
struct LifeSettings {
  std::string actuator, name, made;
  bool silicone = false;
  std::string contraction, pressure, cycles, duty = "100 %", duration;
  int muscles = 1;
};

template <class Visitor>
void fields(Visitor& v, LifeSettings& s) {
  v.method(
      {"life", "Find how many cycles and how long muscles last, as a range", config::Tables::none});
  v.file(Setting{"actuator", "actuator file of the muscle, with its table [life]"}.required(),
         s.actuator);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.choice(
      {"made", "kind of the muscle's ends, in place of [life]: published tests of such muscles"},
      s.made, {"clamped", "swaged"});
  v.quantity(Setting{"contraction", "range of contraction in a cycle, of the stretched length", "1",
                     config::above_zero(0.5, "no braid contracts further")}
                 .required(),
             s.contraction);
  v.quantity({"pressure", "largest pressure in a cycle", "Pa gauge",
              config::above_zero(config::greatest_pressure, config::air_pressure.why)},
             s.pressure);
  v.quantity(Setting{"cycles", "cycles of each muscle per time, while the robot moves", "Hz",
                     config::above_zero(1000, "no muscle works faster")}
                 .required(),
             s.cycles);
  v.quantity({"duty", "share of the time in which the robot moves", "1",
              config::above_zero(1, "of the time")},
             s.duty);
  v.integer({"muscles", "number of muscles of the robot", "", {1, 10000, "no robot has more"}},
            s.muscles);
  v.quantity(
      {"duration", "time that the robot is to last: gives the probability that no muscle fails",
       "s", config::above_zero(1e9, "no robot lasts longer")},
      s.duration);
}

}  // namespace sinew::design
