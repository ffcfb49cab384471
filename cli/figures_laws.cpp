// cli/figures_laws.cpp - figures of the thesis that are laws drawn: 2-6, 2-11, 2-13, 3-4, 3-13,
// 4-8, 4-9.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/thesis_figures.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/gas/coil_current.h"
#include "sinew/gas/orifice.h"
#include "sinew/signals/pulse.h"
#include "sinew/units/constants.h"

namespace sinew::cli {
namespace {

using Kind = Curve::Kind;
using units::inch, units::psi, units::pound_force;

constexpr double millisecond = 1e-3;

// 20 to 110 psi, the range of figure 2-6.
std::vector<double> gauge_pressures() {
  std::vector<double> out;
  for (int p = 20; p <= 110; p += 10) out.push_back(p);
  return out;
}

// Lengths from L_min to beyond the figure's right end, L_max among them  [in].
std::vector<double> lengths(const actuator::Actuator& a, double longest) {
  const double shortest = actuator::shortest_length(a.braid) / inch;
  std::vector<double> out{shortest, a.long_end.length / inch};
  for (int i = 0; i <= std::lround(longest / 0.025); ++i)
    if (0.025 * i > shortest) out.push_back(0.025 * i);
  std::ranges::sort(out);
  return out;
}

Sheet family(const std::string& name, const std::string& quantity, const std::string& unit) {
  Sheet sheet{name, {"length [in]"}, {}};
  for (const double p : gauge_pressures())
    sheet.headings.push_back(fmt::format("{} at {:.0f} psi gauge [{}]", quantity, p, unit));
  return sheet;
}

void add_2_6(FigureSet& set, const FigureSources& from) {
  const actuator::Braid& braid = from.actuator.braid;
  Sheet force = family("2-6-force", "force", "lbf");
  Sheet stiffness = family("2-6-stiffness", "stiffness", "lbf/in");
  for (const double l : lengths(from.actuator, 4.0)) {
    std::vector<double> f{l}, k{l};
    for (const double p : gauge_pressures()) {
      f.push_back(actuator::ideal_tension(braid, l * inch, p * psi) / pound_force);
      k.push_back(actuator::ideal_stiffness(braid, l * inch, p * psi) / (pound_force / inch));
    }
    force.rows.push_back(f);
    stiffness.rows.push_back(k);
  }
  const Figure figure{"2-6", "Force and stiffness at 20 to 110 psi"};
  set.add(figure, Kind::computed, "[22], without effectiveness", force);
  set.add(figure, Kind::computed, "[26], without effectiveness", stiffness);
}

void add_2_11(FigureSet& set, const FigureSources& from) {
  Sheet sheet{"2-11",
              {"gauge pressure [psi gauge]", "effectiveness by the text [-]",
               "effectiveness by appendix A [-]"},
              {}};
  actuator::Effectiveness text = from.actuator.effectiveness, code = text;
  text.argument = actuator::Effectiveness::Argument::gauge;
  code.argument = actuator::Effectiveness::Argument::absolute;
  for (double p = 0; p <= 110; p += 5)
    sheet.rows.push_back({p, actuator::effectiveness(text, p * psi, from.air.atmosphere),
                          actuator::effectiveness(code, p * psi, from.air.atmosphere)});
  set.add({"2-11", "Effectiveness over pressure"}, Kind::computed,
          "[30] with gauge pressure as the text has it, with absolute as appendix A", sheet);
}

void add_2_13(FigureSet& set, const FigureSources& from) {
  const actuator::Actuator& a = from.actuator;
  Sheet sheet{"2-13", {"length [in]"}, {}};
  const std::vector<double> pressures{20, 40, 60, 80, 100};
  for (const double p : pressures)
    sheet.headings.push_back(fmt::format("force at {:.0f} psi gauge [lbf]", p));
  for (const double l : lengths(a, 4.0)) {
    sheet.rows.push_back({l});
    for (const double p : pressures)
      sheet.rows.back().push_back(actuator::tension(a, l * inch, 0, p * psi, from.air.atmosphere) /
                                  pound_force);
  }
  const Figure figure{"2-13", "Force over length at constant pressure: the long end effect"};
  set.add(figure, Kind::computed, "[31], [32] for the thesis's own actuator", sheet);
  set.curves.push_back({"2-13", "Shadow Robot Company's data (1999)", Kind::unavailable,
                        "of a larger actuator whose size is not given", "", "", ""});
}

// Flow of the maker's chart: into the room, over the supply's pressure.
void add_3_4(FigureSet& set, const FigureSources& from) {
  Sheet sheet{"3-4",
              {"supply pressure [psi gauge]", "flow to the atmosphere [L/min]",
               "mass flow to the atmosphere [g/s]"},
              {}};
  for (double p = 0; p <= 120; p += 2) {
    gas::Flow flow = from.chapter3.flow;
    flow.efficiency = 1;
    const double up = from.air.atmosphere + p * psi;
    const double m = gas::mass_flow(flow, from.air, up, from.air.atmosphere);
    sheet.rows.push_back({p, m / gas::iso_density * 6e4, m * 1e3});
  }
  set.add(
      {"3-4", "Flow over pressure of the 758 valve"}, Kind::computed,
      "[42]-[44] with A_p C_q = 1.8e-5 ft2, which 3.3 took from the maker's chart; L/min of air "
      "at 20 degC and 1 bar",
      sheet);
  set.curves.push_back({"3-4", "the maker's chart", Kind::unavailable,
                        "lost with the figure; what was read from it is A_p C_q", "", "", ""});
}

void add_3_13(FigureSet& set, const FigureSources& from) {
  const gas::Delays delays = gas::delays(from.chapter3);
  Sheet sheet{
      "3-13", {"commanded duty [%]", "actual duty at 25 Hz [%]", "actual duty at 50 Hz [%]"}, {}};
  for (double d = 0; d <= 100; d += 0.5) {
    sheet.rows.push_back({d});
    for (const double f : {25.0, 50.0})
      sheet.rows.back().push_back(
          100 * signals::delivered_duty(d / 100, 1 / f, delays.opening, delays.closing));
  }
  set.add({"3-13", "Actual over commanded duty cycle"}, Kind::computed,
          "3.4: opens after 4 ms, shuts after 1 ms; robots/leg/valves.toml [valve.758]", sheet);
}

void add_coil(FigureSet& set, const Figure& figure, const gas::Valve& valve, double frequency,
              const std::vector<double>& pressures) {
  Sheet sheet{figure.number, {"time [ms]", "command [-]"}, {}};
  const double period = 1 / frequency, step = 0.02 * millisecond;
  std::vector<std::vector<gas::CurrentPiece>> traces;
  for (const double p : pressures) {
    sheet.headings.push_back(fmt::format("current at {:.0f} psi gauge [A]", p));
    traces.push_back(gas::coil_current(valve, p * psi, period, 0.5, 2));
  }
  for (int k = 0; k * step <= 2 * period + 1e-9; ++k) {
    const double t = k * step, phase = t / period - std::floor(t / period + 1e-9);
    sheet.rows.push_back({t / millisecond, phase < 0.5 - 1e-9 ? 1.0 : 0.0});
    for (const auto& trace : traces) sheet.rows.back().push_back(gas::current(trace, t));
  }
  set.add(figure, Kind::synthetic,
          "an R-L circuit with speed-up drive and back-EMF, gas/coil_current.h; its values are "
          "guesses in robots/leg/valves-at-the-bench.toml",
          sheet);
}

}  // namespace

void add_actuator_figures(FigureSet& set, const FigureSources& from) {
  add_2_6(set, from);
  add_2_11(set, from);
  add_2_13(set, from);
}

void add_valve_figures(FigureSet& set, const FigureSources& from) {
  add_3_4(set, from);
  add_3_13(set, from);
  add_coil(set, {"4-8", "Coil current of the inlet valve, 125 Hz, 50 %, 100 psi"}, from.inlet, 125,
           {100});
  add_coil(set, {"4-9", "Coil current of the exhaust valve, 100 Hz, 50 %"}, from.exhaust, 100,
           {0, 30, 60, 90});
}

}  // namespace sinew::cli
