// robot/wiring/wiring.fields.h - the keys of [wiring] in robots/*/wiring.toml.
#pragma once

#include "sinew/robot/wiring/wiring.h"
#include "sinew/units/field.h"

namespace sinew::robot {

// Visits the number of a pin or a hose.
template <class Visitor>
void pin_field(Visitor& v, std::string_view name, std::string_view doc, int& value) {
  v.integer({.name = name, .min = 1, .max = 255, .doc = doc}, value);
}

template <class Visitor>
void fields(Visitor& v, Wiring::Signal& s) {
  pin_field(v, "pin", "pin of the terminal block", s.pin);
  pin_field(v, "ground", "pin of the signal's ground", s.ground);
  v.integer({.name = "channel",
             .min = -1,
             .max = 255,
             .optional = true,
             .doc = "channel of the converter; -1: unknown"},
            s.channel);
  v.flag({.name = "spare", .optional = true, .doc = "true: a wire without a sensor"}, s.spare);
}

template <class Visitor>
void fields(Visitor& v, Wiring::Line& line) {
  pin_field(v, "pin", "pin of the terminal block", line.pin);
  pin_field(v, "common", "pin of the return wire", line.common);
  v.integer(
      {.name = "bit", .min = 0, .max = 15, .doc = "bit of the output ports, if bits = \"table\""},
      line.bit);
}

template <class Visitor>
void fields(Visitor& v, Wiring::Valve& valve) {
  v.text({.name = "of", .doc = "muscle, cylinder_up or cylinder_down"}, valve.of);
  pin_field(v, "plumbing", "number of the hose", valve.plumbing);
  v.group({.name = "inlet", .doc = "wires of the inlet valve"},
          [&](auto& g) { fields(g, valve.inlet); });
  v.group({.name = "exhaust", .doc = "wires of the exhaust valve"},
          [&](auto& g) { fields(g, valve.exhaust); });
}

template <class Visitor>
void fields(Visitor& v, Wiring& w) {
  v.group({.name = "wiring", .optional = true, .doc = "pins, channels and bits of the wires"},
          [&](auto& g) {
            g.flag({.name = "present", .doc = "false: the wiring is unknown"}, w.present);
            g.choice({.name = "polarity", .doc = "level of an output bit that opens its valve"},
                     w.polarity,
                     {{"low opens", Wiring::Polarity::low_opens},
                      {"high opens", Wiring::Polarity::high_opens}});
            g.choice({.name = "bits",
                      .doc = "source of the output bits: the robot's `bit` keys, or this table"},
                     w.bits, {{"robot", Wiring::Bits::robot}, {"table", Wiring::Bits::table}});
            g.each({.name = "signal", .optional = true, .doc = "wires of the sensors, by sensor"},
                   w.signals, [](auto& s, Wiring::Signal& signal) { fields(s, signal); });
            g.each({.name = "valve", .optional = true, .doc = "wires of a chamber's two valves"},
                   w.valves, [](auto& s, Wiring::Valve& valve) { fields(s, valve); });
            g.each({.name = "power", .optional = true, .doc = "supply lines"}, w.power,
                   [](auto& s, Wiring::Power& power) {
                     pin_field(s, "pin", "pin of the terminal block", power.pin);
                   });
          });
}

}  // namespace sinew::robot
