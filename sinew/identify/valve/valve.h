// identify/valve/valve.h - flow and delays of a valve from several kinds of measurement.
//
//   chart    upstream, downstream, flow         area or C and b_crit       chart.cpp
//   fill     time, pressure                     C/V, exponent; C or V      fill.h
//   pulses   time, pressure, command            delays, C/V                pulses.cpp
//   coil     time, current                      opening delay              coil.cpp
//   duty     duty, delivered duty or flow       delays                     duty.cpp
//
// A filling chamber determines the valve's conductance per volume only: one of the two must be
// measured otherwise, ValveOptions::volume or ::conductance.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Kind of measurement: the table at the head of this file lists the columns of each.
enum class ValveData { chart, fill, pulses, coil, duty };

// Known quantities besides the data.
struct ValveOptions {
  std::string name = "valve";  // name of the valve in the written file
  gas::Valve valve;            // values that are not identified, with their origins
  Provenance provenance;
  gas::Air air;
  std::optional<double> volume;       // volume of the chamber, including hoses [m3]
  std::optional<double> conductance;  // conductance of the valve, instead of the volume [m3/(s Pa)]
  std::optional<double> port;         // pressure on the valve's other side [Pa abs]; empty: fitted
  std::optional<double> exponent;     // polytropic, of the chamber [-]; empty: tried and fitted
  std::optional<double> frequency;    // pulse frequency of a duty map without such a column [Hz]
  bool per_volume = false;            // neither volume nor conductance: C/V is enough
  double worst_fit = 3;               // a fill is refused if the best model is worse [% of range]
};

// The valve as far as it was identified, and the quality of the fit.
struct ValveResult {
  gas::Valve valve;
  bool flow_known = false, opening_known = false, closing_known = false;  // identified
  Provenance provenance;  // origins under "valve.<name>."
  std::string refused;    // problems of the data, in addition to the report
  Report report;
};

// Returns all columns that the methods use.
std::span<const ColumnSpec> valve_columns();

// Returns `wanted`, or the kind that matches the columns. Throws Refusal if the columns match no
// method, or not the wanted one.
ValveData valve_data(const Measured& data, std::optional<ValveData> wanted = {});

// Returns the start of a result: the valve with its known values.
ValveResult before(const ValveOptions& options);

// Writes area, conductance and critical ratio of the chosen law into the valve, each with its
// source; previous values of the flow are removed.
void replace_flow(gas::Flow::Law law, const std::string& source, ValveResult& result);

// Identify the valve. Throw Refusal. `other` is not fitted and scores the model; may be null.
ValveResult identify_chart(const Measured& data, const ValveOptions& options);
ValveResult identify_fill(const Measured& data, const ValveOptions& options,
                          const Measured* other = nullptr);
ValveResult identify_pulses(const Measured& data, const ValveOptions& options);
ValveResult identify_coil(const Measured& data, const ValveOptions& options);
ValveResult identify_duty(const Measured& data, const ValveOptions& options);

// Returns a file of format sinew.valves/1. Values that were not identified are the valve's.
std::string valve_file(gas::Valve valve, const Provenance& provenance);

}  // namespace sinew::identify
