// identify/valve/valve.h - a valve's flow and delays, from whatever was measured of it.
//
//   chart    upstream, downstream, flow         area or C and b_crit       chart.cpp
//   fill     time, pressure                     C/V, exponent; C or V      fill.h
//   pulses   time, pressure, command            delays, C/V                pulses.cpp
//   coil     time, current                      opening delay              coil.cpp
//   duty     duty, delivered duty or flow       delays                     duty.cpp
//
// A chamber that fills knows its valve's conductance only per volume: one of the two has to be
// measured otherwise, ValveOptions::volume or ::conductance.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/provenance.h"

namespace sinew::identify {

// Says what was measured: the table at the head of this file has the columns of each.
enum class ValveData { chart, fill, pulses, coil, duty };

// Holds what is known besides the data.
struct ValveOptions {
  std::string name = "valve";  // of the valve, in the file that is written
  gas::Valve valve;            // what is not identified, and where it came from
  Provenance provenance;
  gas::Air air;
  std::optional<double> volume;       // of the chamber, hoses included [m3]
  std::optional<double> conductance;  // of the valve, in place of the volume [m3/(s Pa)]
  std::optional<double> port;         // pressure on the valve's other side; fitted without [Pa abs]
  std::optional<double> exponent;     // polytropic, of the chamber; tried and fitted without [-]
  std::optional<double> frequency;    // of the pulses of a duty map without such a column [Hz]
  bool per_volume = false;            // neither volume nor conductance: C/V is enough
  double worst_fit = 3;               // a fill that no model meets better is refused [% of range]
};

// The valve as far as it was found, and how well it fits.
struct ValveResult {
  gas::Valve valve;
  bool flow_known = false, opening_known = false, closing_known = false;  // of the valve
  Provenance provenance;  // of what is known, under "valve.<name>."
  std::string refused;    // what the data do not support, beside what stands in the report
  Report report;
};

// All columns that any of the methods wants.
std::span<const Wanted> valve_columns();

// `wanted`, or by the columns that are there. Throws Refusal where they fit no method, or not that.
ValveData valve_data(const Measured& data, std::optional<ValveData> wanted = {});

// The start of a result: the valve as it was known before.
ValveResult before(const ValveOptions& options);

// Writes area, conductance and critical ratio of the chosen law into the valve, each with its
// source: nothing of the flow that was known before stays.
void replace_flow(gas::Flow::Law law, const std::string& source, ValveResult& result);

// Throw Refusal. `other` was not seen by the fit: it scores the model; nothing for most kinds.
ValveResult identify_chart(const Measured& data, const ValveOptions& options);
ValveResult identify_fill(const Measured& data, const ValveOptions& options,
                          const Measured* other = nullptr);
ValveResult identify_pulses(const Measured& data, const ValveOptions& options);
ValveResult identify_coil(const Measured& data, const ValveOptions& options);
ValveResult identify_duty(const Measured& data, const ValveOptions& options);

// A file of format sinew.valves/1. What was not identified keeps the valve's value.
std::string valve_file(gas::Valve valve, const Provenance& provenance);

}  // namespace sinew::identify
