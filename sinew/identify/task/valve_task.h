// identify/task/valve_task.h - `sinew identify valve`: flow and delays of a valve, from a chart, a
// filling, pulses, a coil's current or a map of duties.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/task/settings.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct ValveSettings {
  std::string kind, volume, conductance, added_volume;
  bool per_volume = false;
  std::string port, exponent, temperature = "20 degC";
  HeldOut hold_out;
  std::string name = "valve", base, frequency;
};

template <class Visitor>
void fields(Visitor& v, ValveSettings& s) {
  v.method({.name = "valve",
            .doc = "flow and delays, from a chart, a filling, pulses, a coil's current or a map of "
                   "duties"});
  v.choice({.name = "kind",
            .doc = "what was measured; absent: by the columns",
            .words = {"chart", "fill", "pulses", "coil", "duty"}},
           s.kind);
  v.quantity({.name = "volume",
              .unit = "m3",
              .range = config::above_zero(config::air_volume.high, config::air_volume.why),
              .doc = "fill, pulses: of the chamber, hoses included"},
             s.volume);
  v.quantity({.name = "conductance",
              .unit = "m3/(s Pa)",
              .range = config::above_zero(1, "a valve of this size fills a hall"),
              .doc = "fill, pulses: of the valve, for the volume instead"},
             s.conductance);
  v.quantities({.name = "added_volume",
                .unit = "m3",
                .range = config::air_volume,
                .doc = "fill: joined to the chamber, of each file: \"0 L,0.5 L\"; two fillings "
                       "give conductance and volume apart"},
               s.added_volume);
  v.flag({.name = "per_volume", .doc = "fill, pulses: C/V is enough"}, s.per_volume);
  v.quantity({.name = "port",
              .unit = "Pa abs",
              .range = config::air_pressure,
              .doc = "pressure on the valve's other side, the room's when venting; fitted without",
              .option = "supply,port"},
             s.port);
  v.quantity(
      {.name = "exponent",
       .unit = "1",
       .range = config::polytropic,
       .doc = "fill: polytropic, of the chamber: 1 isothermal, 1.4 adiabatic; tried without"},
      s.exponent);
  v.quantity({.name = "temperature",
              .unit = "K",
              .range = {200, 400, "of air in a laboratory"},
              .doc = "of the air"},
             s.temperature);
  v.hold_out({.name = "hold_out", .doc = "OTHER.csv that scores the model of a filling"},
             s.hold_out);
  v.text({.name = "name", .doc = "of the valve"}, s.name);
  v.file(
      {.name = "base",
       .doc = "VALVES.toml with a valve of that name: what is not identified is kept from there"},
      s.base);
  v.quantity({.name = "frequency",
              .unit = "Hz",
              .range = config::pulses,
              .doc = "of the pulses: of a map of duties without such a column, and of the duties' "
                     "timing"},
             s.frequency);
}

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
