// experiment/rig/rig.fields.h - the keys of experiments/rig/*.toml.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/experiment/fault.fields.h"
#include "sinew/experiment/log_table.fields.h"
#include "sinew/experiment/rig/rig.h"
#include "sinew/gas/air.fields.h"
#include "sinew/gas/valve.fields.h"
#include "sinew/robot/muscle.fields.h"
#include "sinew/units/complain.h"
#include "sinew/units/field.h"

namespace sinew::rig {

// A number that has its default where it stands alone.
template <class Visitor>
void amount(Visitor& v, std::string_view name, std::string_view unit, double min,
            std::string_view doc, double& value) {
  v.number({.name = name, .unit = unit, .min = min, .optional = true, .doc = doc}, value);
}

// A quantity of a part that may be missing: 0 stands for none, any other value is at least `least`.
template <class Visitor>
void size(Visitor& v, std::string_view name, std::string_view unit, double least,
          std::string_view why, std::string_view doc, double& value) {
  v.number({.name = name,
            .unit = unit,
            .min = 0,
            .least = least,
            .why = why,
            .optional = true,
            .doc = doc},
           value);
}

// [{ at = "1 s", <what.name> = "…" }, …]; `what` says what is there.
template <class Visitor>
void points(Visitor& v, std::string_view name, units::Field what, std::string_view doc,
            std::vector<plant::Point>& list) {
  what.doc = "there";
  v.list({.name = name, .optional = true, .doc = doc}, list, [&](auto& g, plant::Point& p) {
    g.number({.name = "at", .unit = "s", .min = 0, .doc = "instant"}, p.at);
    g.number(what, p.value);
  });
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i].at < list[i - 1].at)
      units::complain(v, name, "instants that go back", "ascending ones");
}

template <class Visitor>
void fields(Visitor& v, Element::Cylinder& c) {
  constexpr std::string_view why = "a cylinder that can be seen";
  size(v, "bore", "m", 1e-5, why, "diameter of the piston", c.bore);
  amount(v, "rod_diameter", "m", 0, "", c.rod_diameter);
  size(v, "stroke", "m", 1e-5, why, "", c.stroke);
  size(v, "dead_volume", "m3", 1e-15, why, "of the rod's side, with hoses", c.dead_volume);
}

template <class Visitor>
void fields(Visitor& v, Element& e) {
  v.text({.name = "name", .optional = true, .doc = "in the log's topics"}, e.name);
  v.text({.name = "actuator", .optional = true, .doc = "of files.actuator"}, e.actuator);
  v.integer({.name = "count", .min = 1, .max = 16, .optional = true, .doc = "side by side"},
            e.count);
  amount(v, "external_volume", "m3", 0, "of hoses and fittings behind the valves",
         e.external_volume);
  v.text({.name = "inlet", .optional = true, .doc = "of files.valves; a 3-way valve stands here"},
         e.inlet);
  v.text({.name = "exhaust", .optional = true, .doc = "of files.valves"}, e.exhaust);
  v.group({.name = "hose", .optional = true, .doc = "between valves and element"},
          [&](auto& g) { gas::fields(g, e.hose); });
  v.group({.name = "leak", .optional = true, .doc = "to the room"},
          [&](auto& g) { gas::fields(g, e.leak); });
  v.group({.name = "cylinder", .optional = true, .doc = "an air cylinder in the muscle's place"},
          [&](auto& g) { fields(g, e.cylinder); });
}

template <class Visitor>
void fields(Visitor& v, Load& load) {
  using Mode = plant::Load::Mode;
  v.choice({.name = "mode", .doc = "hanging: a mass [36]; driven: the length is prescribed"},
           load.mode, {{"hanging", Mode::hanging}, {"driven", Mode::driven}});
  constexpr double least_mass = 1e-9, least_length = 1e-4;
  constexpr std::string_view mass = "what hangs weighs a microgram";
  constexpr std::string_view length = "a muscle that can be seen";
  size(v, "mass", "kg", least_mass, mass, "hanging", load.mass);
  points(v, "weights", {.name = "mass", .unit = "kg", .min = least_mass, .why = mass},
         "hanging: what hangs from an instant on", load.weights);
  amount(v, "force", "N", -1e6, "hanging: on the mass beside its weight, down > 0", load.force);
  points(v, "forces", {.name = "force", .unit = "N"}, "hanging: the same over time", load.forces);
  size(v, "length", "m", least_length, length, "driven", load.length);
  points(v, "lengths", {.name = "length", .unit = "m", .min = least_length, .why = length},
         "driven: over time", load.lengths);
  v.number({.name = "gravity",
            .unit = "m/s2",
            .min = 0,
            .max = 100,
            .why = "Jupiter has 25 m/s2",
            .optional = true,
            .doc = "hanging: what the mass weighs by; 0: it floats, and only forces pull"},
           load.gravity);
}

template <class Visitor>
void fields(Visitor& v, Charge& charge) {
  using Mode = plant::Charge::Mode;
  v.choice({.name = "mode", .doc = "sealed from the start on, by the valves, or held"}, charge.mode,
           {{"sealed", Mode::sealed}, {"valves", Mode::valves}, {"regulated", Mode::regulated}});
  constexpr double least = 1e3;
  constexpr std::string_view why = "air of a muscle, no vacuum";
  size(v, "pressure", "Pa abs", least, why, "regulated", charge.pressure);
  points(v, "pressures", {.name = "pressure", .unit = "Pa abs", .min = least, .why = why},
         "regulated: over time", charge.pressures);
}

template <class Visitor>
void law_fields(Visitor& v, Drive& d) {
  amount(v, "desired", "m", 0, "feed-forward, feedback: length", d.desired);
  points(v, "lengths",
         {.name = "length", .unit = "m", .min = 0, .why = "no muscle is shorter than nothing"},
         "feed-forward, feedback: desired over time", d.lengths);
  amount(v, "believed_load", "N", 0, "feed-forward: what hangs on the element", d.believed_load);
  v.choice({.name = "law", .optional = true, .doc = "feedback"}, d.law,
           {{"on-off", Drive::Law::on_off}, {"proportional", Drive::Law::proportional}});
  v.text({.name = "sensor", .optional = true, .doc = "feedback: of the length"}, d.sensor);
  amount(v, "dead_band", "m", 0, "feedback: error without a pulse", d.dead_band);
  amount(v, "gain", "1/m", 0, "proportional: duty per error", d.gain);
}

template <class Visitor>
void fields(Visitor& v, Drive& d) {
  using Kind = Drive::Kind;
  v.choice({.name = "kind", .doc = "what opens and shuts the valves"}, d.kind,
           {{"none", Kind::none},
            {"pwm", Kind::pwm},
            {"pulses", Kind::pulses},
            {"feed-forward", Kind::feed_forward},
            {"feedback", Kind::feedback}});
  v.number({.name = "period",
            .unit = "s",
            .min = 1e-3,
            .max = 6,
            .optional = true,
            .doc = "of pulses and laws, a multiple of 0.1 ms"},
           d.period);
  v.number({.name = "duty", .unit = "1", .min = 0, .max = 1, .optional = true, .doc = "pwm"},
           d.duty);
  points(v, "duties",
         {.name = "duty", .unit = "1", .min = 0, .max = 1, .why = "a share of the period"},
         "pwm: from an instant on", d.duties);
  v.list({.name = "pulses", .optional = true, .doc = "single ones"}, d.pulses,
         [](auto& g, Drive::Pulse& p) {
           g.number({.name = "at", .unit = "s", .min = 0, .doc = "edge of the coil"}, p.at);
           g.number({.name = "open", .unit = "s", .min = 0, .doc = "how long"}, p.open);
           g.flag({.name = "exhaust", .optional = true, .doc = "of the exhaust, not the inlet"},
                  p.exhaust);
         });
  law_fields(v, d);
}

template <class Visitor>
void fields(Visitor& v, plant::Transducer& t) {
  using Of = plant::Transducer::Of;
  v.choice({.name = "of", .doc = "what it reads"}, t.of,
           {{"length", Of::length},
            {"force", Of::force},
            {"pressure", Of::pressure},
            {"acceleration", Of::acceleration}});
  const std::string_view unit = t.of == Of::length     ? "m"
                                : t.of == Of::force    ? "N"
                                : t.of == Of::pressure ? "Pa diff"
                                                       : "m/s2";
  v.number({.name = "low", .unit = unit, .doc = "of the 12-bit converter, count 0"}, t.low);
  v.number({.name = "high", .unit = unit, .doc = "of the converter, count 4095"}, t.high);
  amount(v, "noise", unit, 0, "standard deviation", t.noise);
  amount(v, "scale", "1", 0, "what it makes of the quantity; 1: calibrated well", t.scale);
  amount(v, "offset", unit, -units::unbounded, "what it reads of nothing", t.offset);
  amount(v, "resolution", unit, 0, "of a dial or display, in measured.csv; 0: the counts'",
         t.resolution);
  if (!(t.high > t.low)) units::complain(v, "high", "no range", "more than low");
}

template <class Visitor>
void start_fields(Visitor& v, Experiment& e) {
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 0,
            .max = 2e6,
            .least = 1e3,
            .why = "air of a muscle, no vacuum",
            .optional = true,
            .doc = "of the air"},
           e.start_pressure);
  size(v, "length", "m", 1e-4, "a muscle that can be seen", "0: where the load hangs",
       e.start_length);
  v.number({.name = "displacement",
            .unit = "m",
            .optional = true,
            .doc = "from there with the same air, down > 0"},
           e.displacement);
}

template <class Visitor>
void fields(Visitor& v, Sweep& s) {
  const auto share = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "1", .min = 0, .max = 1, .doc = doc}, value);
  };
  share("from", "first duty", s.from);
  share("to", "last duty", s.to);
  v.number({.name = "step",
            .unit = "1",
            .min = 0,
            .max = 1,
            .least = 1e-4,
            .why = "each step is a run of its own",
            .doc = "between them"},
           s.step);
}

template <class Visitor>
void fields(Visitor& v, Measured& m) {
  size(v, "period", "s", 1e-4, "a tick", "between rows of measured.csv; 0: that of the log",
       m.period);
  amount(v, "from", "s", 0, "the first row", m.from);
}

template <class Visitor>
void fields(Visitor& v, Experiment& e) {
  v.text({.name = "title", .doc = "of the experiment"}, e.title);
  v.text({.name = "reproduces", .optional = true, .doc = "section and figures"}, e.reproduces);
  v.integer({.name = "seed", .min = 0, .optional = true, .doc = "of the sensors' noise"}, e.seed);
  v.number({.name = "duration", .unit = "s", .min = 1e-3, .max = 1e5, .doc = "of the run"},
           e.duration);
  v.number({.name = "step",
            .unit = "s",
            .min = 1e-6,
            .max = 1e-2,
            .optional = true,
            .doc = "between committed nodes"},
           e.step);
  v.number({.name = "accuracy",
            .unit = "1",
            .min = 1e-12,
            .max = 1e-3,
            .optional = true,
            .doc = "of a swing, per radian of it: shorter pieces between nodes"},
           e.accuracy);
  v.group({.name = "element", .doc = "what is tried"}, [&](auto& g) { fields(g, e.element); });
  v.group({.name = "load", .doc = "what pulls it"}, [&](auto& g) { fields(g, e.load); });
  v.group({.name = "charge", .doc = "its air"}, [&](auto& g) { fields(g, e.charge); });
  v.group({.name = "start", .optional = true, .doc = "at time 0"},
          [&](auto& g) { start_fields(g, e); });
  v.group({.name = "drive", .optional = true, .doc = "of the valves"},
          [&](auto& g) { fields(g, e.drive); });
  v.group({.name = "sweep", .optional = true, .doc = "each duty on a stand of its own"},
          [&](auto& g) { fields(g, e.sweep); });
  v.each({.name = "sensor", .optional = true, .doc = "transducers, by name"}, e.sensors,
         [](auto& g, plant::Transducer& t) { fields(g, t); });
  v.list({.name = "fault", .optional = true, .doc = "what breaks, when"}, e.faults,
         [](auto& g, experiment::Fault& f) { experiment::fields(g, f); });
  v.group({.name = "measured", .optional = true, .doc = "what the sensors leave as CSV"},
          [&](auto& g) { fields(g, e.measured); });
  v.group({.name = "log", .optional = true, .doc = "what is recorded"},
          [&](auto& g) { experiment::fields(g, e.log); });
  v.group({.name = "page", .optional = true, .doc = "how people see the run"},
          [&](auto& g) { config::fields(g, e.page); });
  v.list({.name = "reported", .optional = true, .doc = "printed beside our figures"}, e.reported,
         [](auto& g, config::Reported& r) {
           config::fields(g, r);
           config::check_class(g, r);
         });
}

template <class Visitor>
void machine_fields(Visitor& v, Experiment& e) {
  v.each({.name = "actuator", .optional = true, .doc = "actuators, by name"}, e.actuators,
         [](auto& g, actuator::Actuator& a) { actuator::fields(g, a); });
  v.each({.name = "valve", .optional = true, .doc = "valves, by name"}, e.valves,
         [](auto& g, gas::Valve& valve) { gas::fields(g, valve); });
  v.group({.name = "air", .doc = "atmosphere and supply"},
          [&](auto& g) { gas::fields(g, e.air, e.supply); });
}

}  // namespace sinew::rig
