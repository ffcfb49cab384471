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
  v.method(
      {"valve",
       "flow and delays, from a chart, a filling, pulses, a coil's current or a map of duties"});
  v.choice({"kind", "what was measured; absent: by the columns"}, s.kind,
           {"chart", "fill", "pulses", "coil", "duty"});
  v.quantity({"volume", "fill, pulses: of the chamber, hoses included", "m3",
              config::above_zero(config::air_volume.high, config::air_volume.why)},
             s.volume);
  v.quantity({"conductance", "fill, pulses: of the valve, for the volume instead", "m3/(s Pa)",
              config::above_zero(1, "a valve of this size fills a hall")},
             s.conductance);
  v.quantities({"added_volume",
                "fill: joined to the chamber, of each file: \"0 L,0.5 L\"; two fillings give "
                "conductance and volume apart",
                "m3", config::air_volume},
               s.added_volume);
  v.flag({"per_volume", "fill, pulses: C/V is enough"}, s.per_volume);
  v.quantity(
      Setting{"port", "pressure on the valve's other side, the room's when venting; fitted without",
              "Pa abs", config::air_pressure}
          .called("supply,port"),
      s.port);
  v.quantity(
      {"exponent", "fill: polytropic, of the chamber: 1 isothermal, 1.4 adiabatic; tried without",
       "1", config::polytropic},
      s.exponent);
  v.quantity({"temperature", "of the air", "K", {200, 400, "of air in a laboratory"}},
             s.temperature);
  v.hold_out({"hold_out", "OTHER.csv that scores the model of a filling"}, s.hold_out);
  v.text({"name", "of the valve"}, s.name);
  v.file(
      {"base", "VALVES.toml with a valve of that name: what is not identified is kept from there"},
      s.base);
  v.quantity({"frequency",
              "of the pulses: of a map of duties without such a column, and of the duties' timing",
              "Hz", config::pulses},
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
