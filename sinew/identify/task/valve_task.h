// identify/task/valve_task.h - `sinew identify valve`: flow and delays of a valve, from a chart, a
// filling, pulses, a coil's current or a map of duties.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/valve/valve.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Empty quantities are not known.
struct ValveSettings {
  std::string name = "valve";           // of the valve
  std::string base;                     // valves file with it: what is not identified stays
  std::string kind;                     // chart, fill, pulses, coil, duty; empty: by the columns
  std::string volume, conductance;      // fill, pulses: of the chamber, or of the valve
  bool per_volume = false;              // fill, pulses: C/V is enough
  std::string added_volume;             // fill: joined to the chamber, of each table: "0 L,0.5 L"
  std::string port;                     // pressure on the valve's other side
  std::string exponent;                 // fill: polytropic, of the chamber
  std::string temperature = "20 degC";  // of the air
  std::string frequency;                // of the pulses of a map of duties without such a column
  std::optional<Source> held_out;       // scores the model of a filling
};

// Holds what was found, and the valves file that is written with it.
struct ValveFound {
  ValveResult result;

  // The valves file; `out` is what a refusal calls it. Throws Refusal for delays without a flow,
  // which no simulation could use, and for what the data do not support.
  std::string file(const std::string& out) const;
};

// Throws config::Error and Refusal.
ValveFound find_valve(const std::vector<Source>& sources, const ValveSettings& settings);

// Returns the report, with `refused` where the data do not support all, as `--json` prints it.
Json to_json(const ValveFound& found);

// predict.dat, compensated for the valve's delays.
struct TimingFile {
  std::string text;
  double frequency = 0;  // of the pulses [Hz]
  double worst = 0;      // the delivered duty differs from the commanded one by that at most [-]
};

// Throws Refusal where the delays are not known; empty `frequency` is 100 Hz.
TimingFile timing_of(const ValveFound& found, const std::string& frequency);

}  // namespace sinew::identify
