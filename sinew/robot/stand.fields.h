// robot/stand.fields.h - the keys of a test stand as a machine.
#pragma once

#include <string_view>
#include <vector>

#include "sinew/robot/muscle.fields.h"
#include "sinew/robot/stand.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::robot {

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
  what.doc = "value at that time";
  v.list({.name = name, .optional = true, .doc = doc}, list,
         [&](auto& g, signals::Schedule::Point& p) {
           units::amount(g, "at", "s", "time", p.at);
           g.number(what, p.value);
         });
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i].at < list[i - 1].at)
      units::report_conflict(v, name, "instants that go back", "ascending ones");
}

template <class Visitor>
void fields(Visitor& v, Stand::Element::Cylinder& c) {
  constexpr std::string_view why = "a cylinder that can be seen";
  size(v, "bore", "m", 1e-5, why, "diameter of the piston; 0: a muscle, not a cylinder", c.bore);
  units::optional_amount(v, "rod_diameter", "m", "diameter of the rod", c.rod_diameter);
  size(v, "stroke", "m", 1e-5, why, "travel of the piston", c.stroke);
  size(v, "dead_volume", "m3", 1e-15, why, "smallest air volume of the rod's side, with hoses",
       c.dead_volume);
}

template <class Visitor>
void fields(Visitor& v, Stand::Element& e) {
  v.text({.name = "name", .optional = true, .doc = "name in the log's topics"}, e.name);
  v.text({.name = "actuator", .optional = true, .doc = "name in files.actuator"}, e.actuator);
  v.integer({.name = "count",
             .min = 1,
             .max = 16,
             .optional = true,
             .doc = "number of actuators in parallel"},
            e.count);
  units::optional_amount(v, "external_volume", "m3",
                         "volume of hoses and fittings behind the valves", e.external_volume);
  v.text({.name = "inlet", .optional = true, .doc = "name in files.valves; also of a 3-way valve"},
         e.inlet);
  v.text({.name = "exhaust", .optional = true, .doc = "name in files.valves"}, e.exhaust);
  v.group({.name = "hose", .optional = true, .doc = "hose between valves and element"},
          [&](auto& g) { gas::fields(g, e.hose); });
  v.group({.name = "leak", .optional = true, .doc = "leak to the room"},
          [&](auto& g) { gas::fields(g, e.leak); });
  v.group({.name = "cylinder", .optional = true, .doc = "air cylinder in place of the muscle"},
          [&](auto& g) { fields(g, e.cylinder); });
}

template <class Visitor>
void fields(Visitor& v, Stand::Load& load) {
  using Mode = Stand::Load::Mode;
  v.choice({.name = "mode", .doc = "hanging: a mass [36]; driven: a prescribed length"}, load.mode,
           {{"hanging", Mode::hanging}, {"driven", Mode::driven}});
  constexpr double least_mass = 1e-9, least_length = 1e-4;
  constexpr std::string_view mass = "what hangs weighs a microgram";
  constexpr std::string_view length = "a muscle that can be seen";
  size(v, "mass", "kg", least_mass, mass, "hanging: mass of the load", load.mass);
  points(v, "weights", {.name = "mass", .unit = "kg", .min = least_mass, .why = mass},
         "hanging: mass over time, in steps", load.weights);
  v.number({.name = "force",
            .unit = "N",
            .min = -1e6,
            .optional = true,
            .doc = "hanging: force in addition to the weight, positive downwards"},
           load.force);
  points(v, "forces", {.name = "force", .unit = "N"},
         "hanging: that force over time, linear in between", load.forces);
  size(v, "length", "m", least_length, length, "driven: length of the element", load.length);
  points(v, "lengths", {.name = "length", .unit = "m", .min = least_length, .why = length},
         "driven: length over time, linear in between", load.lengths);
  v.number({.name = "gravity",
            .unit = "m/s2",
            .min = 0,
            .max = 100,
            .why = "Jupiter has 25 m/s2",
            .optional = true,
            .doc = "hanging: acceleration of gravity; 0: only forces act"},
           load.gravity);
}

template <class Visitor>
void fields(Visitor& v, Stand::Charge& charge) {
  using Mode = Stand::Charge::Mode;
  v.choice({.name = "mode",
            .doc = "sealed: the air at the start stays; valves: those of the element; regulated: a "
                   "set pressure"},
           charge.mode,
           {{"sealed", Mode::sealed}, {"valves", Mode::valves}, {"regulated", Mode::regulated}});
  constexpr double least = 1e3;
  constexpr std::string_view why = "air of a muscle, no vacuum";
  size(v, "pressure", "Pa abs", least, why, "regulated: pressure of the air", charge.pressure);
  points(v, "pressures", {.name = "pressure", .unit = "Pa abs", .min = least, .why = why},
         "regulated: pressure over time, linear in between", charge.pressures);
}

template <class Visitor>
void fields(Visitor& v, Transducer& t) {
  using Of = Transducer::Of;
  v.choice({.name = "of", .doc = "measured quantity"}, t.of,
           {{"length", Of::length},
            {"force", Of::force},
            {"pressure", Of::pressure},
            {"acceleration", Of::acceleration}});
  const std::string_view unit = t.of == Of::length     ? "m"
                                : t.of == Of::force    ? "N"
                                : t.of == Of::pressure ? "Pa diff"
                                                       : "m/s2";
  v.number({.name = "low", .unit = unit, .doc = "quantity at count 0 of the 12-bit converter"},
           t.low);
  v.number({.name = "high", .unit = unit, .doc = "quantity at count 4095"}, t.high);
  units::optional_amount(v, "noise", unit, "standard deviation of the reading", t.noise);
  units::optional_amount(v, "scale", "1", "factor of the reading; 1: calibrated", t.scale);
  v.number(
      {.name = "offset", .unit = unit, .optional = true, .doc = "reading at a quantity of zero"},
      t.offset);
  units::optional_amount(v, "resolution", unit,
                         "step of a dial or display, in measured.csv; 0: that of the counts",
                         t.resolution);
  if (!(t.high > t.low)) units::report_conflict(v, "high", "no range", "more than low");
}

// Visits element, load, air and transducers.
template <class Visitor>
void fields(Visitor& v, Stand& s) {
  v.group({.name = "element", .doc = "muscle or cylinder that is tested"},
          [&](auto& g) { fields(g, s.element); });
  v.group({.name = "load", .doc = "load on the element"}, [&](auto& g) { fields(g, s.load); });
  v.group({.name = "charge", .doc = "air supply of the element"},
          [&](auto& g) { fields(g, s.charge); });
  v.each({.name = "sensor", .optional = true, .doc = "transducers, by name"}, s.sensors,
         [](auto& g, Transducer& t) { fields(g, t); });
}

}  // namespace sinew::robot
