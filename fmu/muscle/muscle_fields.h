// fmu/muscle/muscle_fields.h - keys of an FMU's parameters: those of Sinew's files, combined for
// one muscle.
#pragma once

#include <string>
#include <utility>

#include "fmu/slave/sheet.h"
#include "sinew/actuator/actuator.fields.h"
#include "sinew/air/muscle.h"
#include "sinew/gas/air.fields.h"
#include "sinew/gas/hose.fields.h"
#include "sinew/gas/leak.fields.h"
#include "sinew/gas/valve.fields.h"

namespace sinew::fmu {

// Visits the fields of a muscle besides those of its actuator, valves and hose.
template <class Visitor>
void bundle_fields(Visitor& v, int& count, double& external_volume) {
  v.integer({.name = "count", .min = 1, .max = 100, .doc = "actuators in parallel"}, count);
  v.number({.name = "external_volume",
            .unit = "m3",
            .min = 0,
            .max = 1,
            .doc = "of hoses and fittings, downstream of the valves, of the whole bundle"},
           external_volume);
}

template <class Visitor>
void fields(Visitor& v, air::Muscle& muscle) {
  bundle_fields(v, muscle.count, muscle.external_volume);
  v.group({.name = "actuator"}, [&](auto& g) { actuator::fields(g, muscle.actuator); });
  v.group({.name = "inlet"}, [&](auto& g) { gas::fields(g, muscle.inlet); });
  if (muscle.inlet.kind == gas::Valve::Kind::two_way)
    v.group({.name = "exhaust"}, [&](auto& g) { gas::fields(g, muscle.exhaust); });
  v.group({.name = "hose"}, [&](auto& g) { gas::fields(g, muscle.hose); });
  v.group({.name = "leak"}, [&](auto& g) { gas::fields(g, muscle.leak); });
}

// Adds the inputs of a muscle's length and its rate; returns their indices.
inline std::pair<std::size_t, std::size_t> add_length(Sheet& sheet, double start, const char* doc) {
  using C = Variable::Causality;
  const std::size_t length = sheet.add({.name = "length",
                                        .causality = C::input,
                                        .unit = "m",
                                        .start = start,
                                        .min = 0,
                                        .doc = doc,
                                        .rate = static_cast<int>(sheet.variables().size()) + 1});
  return {length, sheet.add({.name = "rate",
                             .causality = C::input,
                             .unit = "m/s",
                             .min = -100,
                             .max = 100,
                             .doc = "of the length, below 0 while it contracts"})};
}

// Returns the fault of an actuator's length with the importer's name for it: shorter than the caps
// alone, or longer than these and one and a half threads. Empty: no fault.
inline std::string wrong_length(const actuator::Actuator& a, const std::string& name,
                                double length) {
  const double least = a.caps.length, most = least + 1.5 * a.braid.thread_length;
  if (length > least && length <= most) return {};
  return name + ": found " + text_of(length) + " m; expected more than " + text_of(least) +
         " m (the caps alone), at most " + text_of(most) + " m (one and a half threads)";
}

// Returns whether an importer has no use for a parameter: those of coils, as an FMU does not
// compute electrical energy, and of the counted mesh, which is redundant with thread and turns.
inline bool is_idle(const Parameter& p) {
  for (const char* part : {".coil.", ".circuit.", ".trapezoids."})
    if (p.name.find(part) != std::string::npos) return true;
  return false;
}

}  // namespace sinew::fmu
