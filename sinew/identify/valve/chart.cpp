// Pressure-flow chart: area of [44], or C and b_crit of ISO 6358.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

namespace {

constexpr double worst_chart = 10;  // rms of the best law, share of the largest flow [%]

struct Chart {
  std::vector<double> up, down, flow;  // [Pa abs], [Pa abs], [kg/s]

  std::size_t size() const { return flow.size(); }
};

Chart chart_of(const Measured& data, const gas::Air& air) {
  Chart c{.up = data["upstream"]};
  const std::size_t n = c.up.size();
  c.down = data.has("downstream") ? data["downstream"] : std::vector<double>(n, air.atmosphere);
  const bool mass = data.has("mass_flow");
  c.flow = mass ? data["mass_flow"] : data["flow"];
  if (!mass)
    for (double& f : c.flow) f *= gas::iso_density;

  for (std::size_t i = 0; i < n; ++i)
    if (c.down[i] > c.up[i] * (1 + 1e-6) && c.flow[i] > 0)
      throw Refusal(fmt::format("{}:{}: downstream", data.file, data.lines[i]),
                    fmt::format("{:.4g} kPa abs above the {:.4g} kPa abs upstream",
                                1e-3 * c.down[i], 1e-3 * c.up[i]),
                    "flow from the higher to the lower pressure",
                    "the columns, they may be swapped; or gauge for abs");
  if (n < 3)
    throw Refusal(data.file, fmt::format("{} points", n), "at least three", "more of the chart");
  const double most = largest(c.flow);
  if (!(most > 0) || most - smallest(c.flow) < 0.02 * most)
    throw Refusal(data.file + ": flow", "the same flow throughout", "flows at different pressures",
                  "the columns, and the meter's range");
  return c;
}

double predicted(bool iso, std::span<const double> p, const gas::Air& air, double up, double down) {
  const double lower = std::min(up, down);
  return iso ? gas::mass_flow_iso6358(p[0], p[1], up, air.temperature, lower)
             : gas::mass_flow(p[0], up, air.temperature, lower, air);
}

Candidate candidate_of(bool iso, const Chart& c, const gas::Air& air) {
  Candidate out{.model = iso ? "iso6358" : "orifice",
                .law = iso ? "m' = C rho_0 P_up sqrt(T_0/T) sqrt(1 - ((r - b)/(1 - b))^2)"
                           : "m' = A P_up C_m/sqrt(T)",
                .source = iso ? "ISO 6358-1" : "[42]-[44]",
                .options = {.widest_interval = 0.25}};
  double area = 0;  // area of the point with the largest flow, if it were choked
  for (std::size_t i = 0; i < c.size(); ++i)
    area = std::max(area, c.flow[i] / gas::mass_flow(1.0, c.up[i], air.temperature, 0.0, air));
  const double conductance = gas::sonic_conductance_of(area, air);
  if (iso)
    out.parameters = {
        {"sonic_conductance", "m3/(s Pa)", conductance, 0, 100 * conductance, conductance},
        {"critical_pressure_ratio", "1", 0.4, 0, 0.999, 1}};
  else
    out.parameters = {{"area", "m2", area, 0, 100 * area, area}};
  out.predict = [iso, &c, &air](std::span<const double> p, std::span<double> flow) {
    for (std::size_t i = 0; i < c.size(); ++i) flow[i] = predicted(iso, p, air, c.up[i], c.down[i]);
    return true;
  };
  return out;
}

// Refuses a law whose ratio b is not determined by the points.
void refuse_unseen_ratio(Fit& fit) {
  for (const Estimate& b : fit.parameters)
    if (b.name == "critical_pressure_ratio" && !b.identifiable)
      fit.refused =
          b.at_bound ? fmt::format("b would be {:.3g}, the bound of its range", b.value)
                     : "b is not determined: points with downstream/upstream above it are missing";
}

Rows rows_of(const Chart& c) {
  Rows out{.x = "downstream pressure", .x_unit = "Pa abs", .at = c.down, .measured = c.flow};
  for (const double up : c.up) out.group.push_back(fmt::format("{:.4g} kPa abs above", 1e-3 * up));
  return out;
}

void add_choking_note(const Chart& c, Report& report) {
  std::size_t choked = 0;
  for (std::size_t i = 0; i < c.size(); ++i)
    choked += c.down[i] <= gas::critical_pressure_ratio() * c.up[i];
  report.notes.push_back(fmt::format("{} of {} points are choked by [44]", choked, c.size()));
  if (choked == 0)
    report.warnings.emplace_back("no point is choked: C, or the area, is an extrapolation");
}

}  // namespace

ValveResult identify_chart(const Measured& data, const ValveOptions& options) {
  const Chart c = chart_of(data, options.air);
  ValveResult out = before(options);
  Report& report = out.report;
  report.set_subject("flow of a valve by its chart", "mass flow", "kg/s", "the largest flow");
  report.full_scale = largest(c.flow);
  report.held_out_is = "each point by a fit of all the others";
  report.notes = data.notes;
  if (!data.has("mass_flow"))
    report.notes.emplace_back("volume flow is taken as of reference air, 20 degC and 1 bar (ANR)");
  report.not_shown = {"how fast the valve switches, and its flow in the other direction"};
  Trial trial{.measured = c.flow};
  trial.splits = each_row_held_out(c.size());
  fit_candidates({candidate_of(false, c, options.air), candidate_of(true, c, options.air)}, trial,
                 report);
  refuse_unseen_ratio(report.fits.back());
  report.rows = rows_of(c);
  conclude(report);
  refuse_unexplained(report, worst_chart,
                     "where=\"valve=inlet\", if rows of several valves are in one table");
  add_choking_note(c, report);

  const bool iso = report.chosen == 1;
  replace_flow(iso ? gas::Flow::Law::iso6358 : gas::Flow::Law::orifice,
               "sinew identify valve " + data.file, out);
  return out;
}

}  // namespace sinew::identify
