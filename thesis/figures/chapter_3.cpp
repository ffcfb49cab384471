// thesis/figures/chapter_3.cpp - figures of the valve: 3-4, 3-13. Those of the test stand are in
// chapter_3_stand.cpp.
#include <cmath>

#include "sinew/gas/delay.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/pulse.h"
#include "sinew/units/constants.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using report::Curve;
using units::psi;

// Returns the flow of the maker's chart: into the room, over the supply pressure.
Exhibit figure_3_4(const Sources& from) {
  gas::Flow flow = from.chapter3.flow;
  flow.efficiency = 1;
  Curve volume{.source =
                   "[42]-[44] with A_p C_q = 1.8e-5 ft2, which 3.3 took from the maker's "
                   "chart; liters of air at 20 degC and 1 bar"};
  for (double p = 0; p <= 120; p += p < 8 ? 0.125 : 2) {
    const double up = from.air.atmosphere + p * psi;
    const double m = gas::mass_flow(flow, from.air, up, from.air.atmosphere);
    volume.xs.push_back(p);
    volume.ys.push_back(m / gas::iso_density * 6e4);
  }

  // As 3.3 uses the chart: A_p C_q from the choked flow at 100 psi, by [42].
  constexpr double square_foot = 0.09290304;
  const double choked = gas::choked_parameter(from.air.gas_constant) *
                        (from.air.atmosphere + 100 * psi) / std::sqrt(from.air.temperature);
  const double area =
      report::value_at(trace(volume), 100) / 6e4 * gas::iso_density / choked / square_foot;
  return {
      {.name = "3-4",
       .title = "Flow of the 758 valve over supply pressure",
       .caption = "Into the room, through one open channel.",
       .plots = {{.x = {"supply pressure", "psi gauge"},
                  .y = {"flow", "L/min", 0},
                  .curves = {volume}}},
       .missing = {{"the maker's chart",
                    "lost with the figure; what was read from it is A_p C_q"}}},
      {Section("3.3").number(put_in, "A_p C_q, taken back from the chart", "1.8e-5 ft2",
                             "the same by [42] from our curve at 100 psi", area * 1e5, "1e-5 ft2",
                             analysis::measured(1.8, 0.1),
                             "the flow was drawn from this number, so only the way back is tested"),
       report::not_applicable("3.3", "The chart itself", "", "lost with the figure")}};
}

Exhibit figure_3_13(const Sources& from) {
  const gas::Delays delays = gas::delays(from.chapter3);
  std::vector<Curve> curves;
  for (const double f : {25.0, 50.0}) {
    Curve c{.label = f == 25 ? "25 Hz" : "50 Hz",
            .source = "opens after 4 ms, shuts after 1 ms: robots/leg/valves.toml [valve.758]"};
    for (double d = 0; d <= 100; d += 0.5) {
      c.xs.push_back(d);
      c.ys.push_back(100 * gas::delivered_duty(d / 100, 1 / f, delays.opening, delays.closing));
    }
    curves.push_back(std::move(c));
  }
  // The largest command at which the valve stays shut, and the smallest at which it stays open.
  const auto shut_to = [](const Curve& c) {
    double last = 0;
    for (std::size_t i = 0; i < c.xs.size() && c.ys[i] == 0; ++i) last = c.xs[i];
    return last;
  };
  const Section text("3.4");
  const char* drawn = "drawn in steps of 0.5 %";
  const char* rounded = "printed in whole percents; 42.5 % is 17 of 40 ms";
  return {{.name = "3-13",
           .title = "Actual over commanded duty cycle",
           .caption = "A valve that opens 4 ms late and shuts 1 ms late.",
           .plots = {{.x = {"commanded duty cycle", "%", 0, 100},
                      .y = {"actual duty cycle", "%", 0, 100},
                      .curves = curves}}},
          {text.number(code_against_code, "A command of 50 % at 25 Hz opens the valve for", "43 %",
                       "actual duty", report::value_at(trace(curves[0]), 50), "%",
                       analysis::percentage(43), rounded),
           text.number(code_against_code, "A command of 50 % at 50 Hz opens the valve for", "35 %",
                       "actual duty", report::value_at(trace(curves[1]), 50), "%",
                       analysis::percentage(35), "printed in whole percents"),
           text.number(code_against_code, "Commands of less than 4 ms do not open it, at 25 Hz",
                       "10 %", "largest command with no flow", shut_to(curves[0]), "%",
                       analysis::percentage(10), drawn),
           text.number(code_against_code, "Commands of less than 4 ms do not open it, at 50 Hz",
                       "20 %", "largest command with no flow", shut_to(curves[1]), "%",
                       analysis::percentage(20), drawn),
           text.number(code_against_code, "With less than 1 ms to shut it stays open, at 25 Hz",
                       "97.5 %", "least command that never shuts it",
                       report::first_at_least(trace(curves[0]), 100), "%",
                       analysis::percentage(97.5), drawn),
           text.number(code_against_code, "With less than 1 ms to shut it stays open, at 50 Hz",
                       "95 %", "least command that never shuts it",
                       report::first_at_least(trace(curves[1]), 100), "%", analysis::percentage(95),
                       drawn)}};
}

}  // namespace

Exhibits valve_laws(const Sources& from) { return {figure_3_4(from), figure_3_13(from)}; }

}  // namespace sinew::thesis
