// robot/stand.fields.h - the keys of a test stand as a machine.
#pragma once

#include <string_view>
#include <vector>

#include "sinew/robot/muscle.fields.h"
#include "sinew/robot/stand.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::robot {

// Visits a number with a default.
template <class Visitor>
void amount(Visitor& v, std::string_view name, std::string_view unit, double min,
            std::string_view doc, double& value) {
  v.number({.name = name, .unit = unit, .min = min, .optional = true, .doc = doc}, value);
}

// Visits a quantity of an optional part: 0 means no such part, any other value is at least `least`.
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

// Visits [{ at = "1 s", <what.name> = "…" }, …]; `what` describes the value.
template <class Visitor>
void points(Visitor& v, std::string_view name, units::Field what, std::string_view doc,
            std::vector<signals::Schedule::Point>& list) {
  what.doc = "there";
  v.list({.name = name, .optional = true, .doc = doc}, list,
         [&](auto& g, signals::Schedule::Point& p) {
           g.number({.name = "at", .unit = "s", .min = 0, .doc = "instant"}, p.at);
           g.number(what, p.value);
         });
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i].at < list[i - 1].at)
      units::report_conflict(v, name, "instants that go back", "ascending ones");
}

template <class Visitor>
void fields(Visitor& v, Stand::Element::Cylinder& c) {
  constexpr std::string_view why = "a cylinder that can be seen";
  size(v, "bore", "m", 1e-5, why, "diameter of the piston", c.bore);
  amount(v, "rod_diameter", "m", 0, "", c.rod_diameter);
  size(v, "stroke", "m", 1e-5, why, "", c.stroke);
  size(v, "dead_volume", "m3", 1e-15, why, "of the rod's side, with hoses", c.dead_volume);
}

template <class Visitor>
void fields(Visitor& v, Stand::Element& e) {
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
void fields(Visitor& v, Stand::Load& load) {
  using Mode = Stand::Load::Mode;
  v.choice({.name = "mode", .doc = "hanging: a mass [36]; driven: the length is prescribed"},
           load.mode, {{"hanging", Mode::hanging}, {"driven", Mode::driven}});
  constexpr double least_mass = 1e-9, least_length = 1e-4;
  constexpr std::string_view mass = "what hangs weighs a microgram";
  constexpr std::string_view length = "a muscle that can be seen";
  size(v, "mass", "kg", least_mass, mass, "hanging", load.mass);
  points(v, "weights", {.name = "mass", .unit = "kg", .min = least_mass, .why = mass},
         "hanging: what hangs from an instant on", load.weights);
  amount(v, "force", "N", -1e6, "hanging: on the mass in addition to its weight, down > 0",
         load.force);
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
void fields(Visitor& v, Stand::Charge& charge) {
  using Mode = Stand::Charge::Mode;
  v.choice({.name = "mode", .doc = "sealed from the start on, by the valves, or held"}, charge.mode,
           {{"sealed", Mode::sealed}, {"valves", Mode::valves}, {"regulated", Mode::regulated}});
  constexpr double least = 1e3;
  constexpr std::string_view why = "air of a muscle, no vacuum";
  size(v, "pressure", "Pa abs", least, why, "regulated", charge.pressure);
  points(v, "pressures", {.name = "pressure", .unit = "Pa abs", .min = least, .why = why},
         "regulated: over time", charge.pressures);
}

template <class Visitor>
void fields(Visitor& v, Transducer& t) {
  using Of = Transducer::Of;
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
  if (!(t.high > t.low)) units::report_conflict(v, "high", "no range", "more than low");
}

// Visits element, load, air and transducers.
template <class Visitor>
void fields(Visitor& v, Stand& s) {
  v.group({.name = "element", .doc = "what is tried"}, [&](auto& g) { fields(g, s.element); });
  v.group({.name = "load", .doc = "what pulls it"}, [&](auto& g) { fields(g, s.load); });
  v.group({.name = "charge", .doc = "its air"}, [&](auto& g) { fields(g, s.charge); });
  v.each({.name = "sensor", .optional = true, .doc = "transducers, by name"}, s.sensors,
         [](auto& g, Transducer& t) { fields(g, t); });
}

}  // namespace sinew::robot
