// robot/wiring/wiring.fields.h - the keys of [wiring] in robots/*/wiring.toml.
#pragma once

#include "sinew/robot/wiring/wiring.h"
#include "sinew/units/field.h"

namespace sinew::robot {

template <class Visitor>
void fields(Visitor& v, Wiring::Signal& s) {
  v.integer({.name = "pin", .min = 1, .max = 255, .doc = "of the terminal block"}, s.pin);
  v.integer({.name = "ground", .min = 1, .max = 255, .doc = "pin of its ground"}, s.ground);
  v.integer({.name = "channel",
             .min = -1,
             .max = 255,
             .optional = true,
             .doc = "of the converter; -1: not given"},
            s.channel);
  v.flag({.name = "spare", .optional = true, .doc = "a wire without a sensor"}, s.spare);
}

template <class Visitor>
void fields(Visitor& v, Wiring::Line& line) {
  v.integer({.name = "pin", .min = 1, .max = 255, .doc = "of the terminal block"}, line.pin);
  v.integer({.name = "common", .min = 1, .max = 255, .doc = "pin of its return"}, line.common);
  v.integer({.name = "bit", .min = 0, .max = 15, .doc = "of the ports, by the table"}, line.bit);
}

template <class Visitor>
void fields(Visitor& v, Wiring::Valve& valve) {
  v.text({.name = "of", .doc = "muscle, cylinder_up or cylinder_down"}, valve.of);
  v.integer({.name = "plumbing", .min = 1, .max = 255, .doc = "number of its hose"},
            valve.plumbing);
  v.group({.name = "inlet", .doc = "the valve that fills"},
          [&](auto& g) { fields(g, valve.inlet); });
  v.group({.name = "exhaust", .doc = "the valve that empties"},
          [&](auto& g) { fields(g, valve.exhaust); });
}

template <class Visitor>
void fields(Visitor& v, Wiring& w) {
  v.group({.name = "wiring", .optional = true, .doc = "pins, channels and bits"}, [&](auto& g) {
    g.flag({.name = "present", .doc = "false: no wiring"}, w.present);
    g.choice(
        {.name = "polarity", .doc = "what a port's bit does"}, w.polarity,
        {{"low opens", Wiring::Polarity::low_opens}, {"high opens", Wiring::Polarity::high_opens}});
    g.choice({.name = "bits", .doc = "whose numbers the ports have: the muscles' `bit`, or these"},
             w.bits, {{"robot", Wiring::Bits::robot}, {"table", Wiring::Bits::table}});
    g.each({.name = "signal", .optional = true, .doc = "sensors, by name"}, w.signals,
           [](auto& s, Wiring::Signal& signal) { fields(s, signal); });
    g.each({.name = "valve", .optional = true, .doc = "pairs of valves"}, w.valves,
           [](auto& s, Wiring::Valve& valve) { fields(s, valve); });
    g.each({.name = "power", .optional = true, .doc = "supply lines"}, w.power,
           [](auto& s, Wiring::Power& power) {
             s.integer({.name = "pin", .min = 1, .max = 255, .doc = "of the terminal block"},
                       power.pin);
           });
  });
}

}  // namespace sinew::robot
