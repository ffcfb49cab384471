// Pressure in a chamber with a pulsed valve: both delays, and C/V.
//
// sealed: the chamber is shut between the pulses. vents: a 3-way valve connects it to the room
// then.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/valve/edges.h"
#include "sinew/identify/valve/fill.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

namespace {

struct Record {
  std::vector<double> time, pressure;  // [s], [Pa abs]
  Edges commands;
  double shortest = 0;  // shortest pulse or gap [s]
  double rate = 0;      // fastest change while the coil is on [Pa/s]
  bool fills = true;

  double range() const { return largest(pressure) - smallest(pressure); }
};

struct PulseModel {
  std::string_view name, law;
  bool vents = false;
  double exponent = 0;  // 0: fitted
};

constexpr std::string_view law_sealed = "V d rho/dt = m' from t + t_o to t + t_c, ISO 6358";
constexpr std::string_view law_vents = "the same, and to the room the rest of the time";
constexpr std::array pulse_models{PulseModel{"sealed isothermal", law_sealed, false, 1},
                                  PulseModel{"sealed polytropic", law_sealed, false, 0},
                                  PulseModel{"venting isothermal", law_vents, true, 1},
                                  PulseModel{"venting polytropic", law_vents, true, 0}};

Record record_of(const Measured& data) {
  Record r{.time = data["time"], .pressure = data["pressure"], .commands = edges_of(data)};
  refuse_constant(data, "pressure", 5e3, "a pressure that follows the command by 5 kPa or more",
                  "the columns, and the valve");
  refuse_clipped(data, "pressure", "a sensor with a larger range, or shorter pulses");
  r.shortest = r.time.back() - r.time.front();
  const std::vector<Opening>& e = r.commands.edges;
  for (std::size_t i = 1; i < e.size(); ++i)
    if (e[i].time - e[i - 1].time > 0) r.shortest = std::min(r.shortest, e[i].time - e[i - 1].time);
  if (r.shortest < 4 * r.commands.sample)
    throw Refusal(data.file + ": time",
                  fmt::format("pulses or gaps of {:.2g} samples", r.shortest / r.commands.sample),
                  "at least 4: the sample rate is too low", "a faster sampling, or longer pulses");

  // Fastest change of the pressure, over a quarter of the shortest pulse.
  const auto lag =
      std::max<std::size_t>(2, static_cast<std::size_t>(0.25 * r.shortest / r.commands.sample));
  for (std::size_t i = lag; i < r.time.size(); ++i) {
    const double rate =
        (r.pressure[i] - r.pressure[i - lag]) / std::max(r.time[i] - r.time[i - lag], 1e-9);
    if (std::abs(rate) > std::abs(r.rate)) r.rate = rate;
  }
  // Direction while the coil is on: from the whole first pulse.
  double before = r.pressure.front(), on = -unbounded, off = unbounded;
  for (const Opening& edge : e) {
    if (edge.open && on == -unbounded) on = edge.time;
    if (!edge.open && on != -unbounded && off == unbounded) off = edge.time;
  }
  for (std::size_t i = 0; i < r.time.size(); ++i) {
    if (r.time[i] <= on) before = r.pressure[i];
    if (r.time[i] <= off) r.fills = r.pressure[i] > before;
  }
  return r;
}

std::vector<FreeValue> free_values(const PulseModel& model, const Record& r,
                                   const ValveOptions& options) {
  std::vector<FreeValue> out;
  const auto add = [&](Parameter p, double ValvedChamber::*member) {
    out.push_back({std::move(p), member});
  };
  const double top = largest(r.pressure), range = r.range();
  const double flow =
      gas::mass_flow_iso6358(1.0, 0.3, r.fills ? 1.2 * top : top, options.air.temperature, 0.0);
  const double k = std::abs(r.rate) / (options.air.gas_constant * options.air.temperature * flow);
  add({"conductance_per_volume", "1/(s Pa)", k, 1e-3 * k, 20 * k, k, true}, &Chamber::conductance);
  add({"opening_delay", "s", 0.1 * r.shortest, 0, r.shortest, 0.1 * r.shortest},
      &ValvedChamber::opening_delay);
  add({"closing_delay", "s", 0.1 * r.shortest, 0, r.shortest, 0.1 * r.shortest},
      &ValvedChamber::closing_delay);
  add({"critical_pressure_ratio", "1", 0.4, 0, 0.95, 1}, &Chamber::critical_ratio);
  if (model.exponent == 0)
    add({"polytropic_exponent", "1", 1.2, 1, 5.0 / 3.0, 1}, &Chamber::exponent);
  if (model.vents) add({"vent_over_conductance", "1", 1, 1e-3, 20, 1, true}, &Chamber::vent);
  if (!options.port && r.fills)
    add({"port_pressure", "Pa abs", 1.2 * top, top - 0.05 * range, 3 * top, range, true},
        &Chamber::port);
  add({"start_pressure", "Pa abs", r.pressure.front(),
       std::max(1e3, r.pressure.front() - 0.2 * range), r.pressure.front() + 0.2 * range, range},
      &Chamber::start);
  return out;
}

bool is_delay(const Parameter& p) { return p.name.ends_with("_delay"); }

Candidate candidate_of(const PulseModel& model, const Record& r, const ValveOptions& options) {
  const std::vector<FreeValue> free = free_values(model, r, options);
  Candidate out{.model = std::string(model.name),
                .law = std::string(model.law),
                .source = "3.4, gas/delay.h; ISO 6358-1",
                .options = {.correlated = true,
                            .most_steps = 60,
                            .widest_interval = 0.25,
                            .difference = 1e-3},
                .may_be_at_bound = {"start_pressure", "opening_delay", "closing_delay",
                                    "critical_pressure_ratio", "polytropic_exponent"}};
  for (const FreeValue& f : free) out.parameters.push_back(f.parameter);
  for (const double factor : {1.0, 0.2, 4.0}) {
    std::vector<double>& start = out.starts.emplace_back();
    for (const Parameter& p : out.parameters)
      start.push_back(p.start * (is_delay(p) ? factor : 1.0));
  }
  out.predict = [&model, &r, &options, free](std::span<const double> p,
                                             std::span<double> pressure) {
    ValvedChamber c;
    c.port = options.port.value_or(options.air.atmosphere);
    if (model.exponent > 0) c.exponent = model.exponent;
    for (std::size_t i = 0; i < p.size(); ++i) c.*free[i].member = p[i];
    return simulate(c, options.air, delayed(r.commands.edges, c.opening_delay, c.closing_delay),
                    r.time, pressure);
  };
  return out;
}

// Returns the estimate widened by the sampling of the command: an edge is anywhere between two
// samples, and equally for every edge if one clock made both.
Estimate widened(Estimate e, double half) {
  e.low -= half;
  e.high += half;
  return e;
}

}  // namespace

ValveResult identify_pulses(const Measured& data, const ValveOptions& options) {
  const Record r = record_of(data);
  ValveResult out = before(options);
  Report& report = out.report;
  report.set_subject("delays of a valve by the pressure behind it", "pressure", "Pa diff",
                     "the pressure's range");
  report.full_scale = r.range();
  report.held_out_is = "the last third of the record";
  report.not_shown = {
      "how the delays change with the supply's voltage, and the flow of another chamber"};
  report.notes = data.notes;
  std::vector<Candidate> candidates;
  for (const PulseModel& model : pulse_models)
    candidates.push_back(candidate_of(model, r, options));
  std::vector<int> is_last;
  for (std::size_t i = 0; i < r.time.size(); ++i) is_last.push_back(i >= r.time.size() * 2 / 3);
  fit_candidates(candidates,
                 {.measured = r.pressure, .splits = {each_part_held_out(is_last).back()}}, report);
  report.rows = {
      .x = "time", .x_unit = "s", .unit = "Pa abs", .at = r.time, .measured = r.pressure};
  conclude(report);
  if (report.best().fit.rmse_percent > options.worst_fit)
    throw Refusal(
        data.file,
        fmt::format("{:.2g} % of the range left by the best model", report.best().fit.rmse_percent),
        fmt::format("at most {:g} %: a chamber that only this valve fills or vents",
                    options.worst_fit),
        "a rigid chamber, the other valves shut");

  const std::string valve = "valve." + options.name + ".";
  for (Estimate& e : report.fits[report.chosen].parameters) {
    const bool opening = e.name == "opening_delay", closing = e.name == "closing_delay";
    if (!opening && !closing) continue;
    e = widened(e, 0.5 * r.commands.sample);
    if (!e.identifiable) continue;
    (opening ? out.valve.opening_delay : out.valve.closing_delay) = e.value;
    (opening ? out.opening_known : out.closing_known) = true;
    out.valve.profile = gas::Valve::Profile::dead_time;
    out.provenance.fitted(valve + e.name, e, "sinew identify valve " + data.file);
  }
  report.notes.push_back(fmt::format(
      "the intervals of the delays include half a sample, {:.3g} ms, of the command's edge",
      0.5e3 * r.commands.sample));
  if (options.volume) {
    for (Estimate& e : report.fits[report.chosen].parameters)
      if (e.name == "conductance_per_volume")
        e = scaled(e, "sonic_conductance", "m3/(s Pa)", *options.volume);
    replace_flow(gas::Flow::Law::iso6358, "sinew identify valve " + data.file, out);
  }
  if (!out.opening_known || !out.closing_known)
    out.refused = fmt::format(
        "delays: found no instant of {} that the pressure determines; expected pulses that the "
        "pressure follows; try more pulses, a smaller volume, or a faster sampling",
        out.opening_known ? "closing" : "opening");
  return out;
}

}  // namespace sinew::identify
