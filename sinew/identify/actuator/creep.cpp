#include "sinew/identify/actuator/creep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

const Wanted creep_wanted[] = {
    {.name = "time", .unit = "s", .doc = "from before the pressure rises"},
    {.name = "force", .unit = "N", .least = 0.05, .most = 2e4, .doc = "tension of the muscle"},
    {.name = "pressure", .unit = "Pa gauge", .least = 1e4, .most = 5e6, .doc = "in the muscle"},
};

// The pressure that comes late, at every row; straight lines between rows, so it is exact.
std::vector<double> late(const std::vector<double>& t, const std::vector<double>& p, double tau) {
  std::vector<double> z{p[0]};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double dt = t[i] - t[i - 1];
    const double rise = dt > 0 ? (p[i] - p[i - 1]) / dt : 0;
    const double lag = rise * tau;
    z.push_back(p[i] - lag + (z.back() - p[i - 1] + lag) * std::exp(-dt / tau));
  }
  return z;
}

// A, P0, then c and tau of each element.
std::vector<double> force(const Measured& m, std::span<const double> x) {
  const std::vector<double>&t = m["time"], &p = m["pressure"];
  std::vector<double> out;
  for (const double each : p) out.push_back(x[0] * std::max(each - x[1], 0.0));
  for (std::size_t k = 2; k + 1 < x.size(); k += 2) {
    const std::vector<double> z = late(t, p, x[k + 1]);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += x[0] * x[k] * std::max(z[i] - x[1], 0.0);
  }
  return out;
}

std::vector<Parameter> parameters(const Measured& m, int elements) {
  const double top = largest(m["pressure"]), pull = largest(m["force"]);
  const double span = m["time"].back() - m["time"].front();
  std::vector<Parameter> out{
      {.name = "slope", .unit = "N/Pa", .start = 2 * pull / top, .low = 0, .scale = pull / top},
      {.name = "threshold",
       .unit = "Pa diff",
       .start = 0.5 * top,
       .low = 0,
       .high = 0.999 * top,
       .scale = 0.1 * top}};
  constexpr std::string_view shares[] = {"share_1", "share_2"};
  constexpr std::string_view times[] = {"time_1", "time_2"};
  for (int k = 0; k < elements; ++k) {
    const double tau = span * (elements == 1 ? 0.1 : k == 0 ? 0.02 : 0.3);
    out.push_back({.name = std::string(shares[k]),
                   .unit = "1",
                   .start = 0.05,
                   .low = 0,
                   .high = 2,
                   .scale = 0.1});
    out.push_back({.name = std::string(times[k]),
                   .unit = "s",
                   .start = tau,
                   .low = 1e-3 * span,
                   .high = 2 * span,
                   .scale = tau});
  }
  return out;
}

// Rows i with i % 2 == part, or all for part < 0.
Solution fit(const Measured& m, int elements, int part) {
  const std::vector<double>& measured = m["force"];
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < m.rows(); ++i)
    if (part < 0 || static_cast<int>(i % 2) == part) rows.push_back(i);
  const Residuals residuals = [&](std::span<const double> x, std::span<double> r) {
    const std::vector<double> f = force(m, x);
    for (std::size_t k = 0; k < rows.size(); ++k) r[k] = f[rows[k]] - measured[rows[k]];
    return true;
  };
  std::vector<Parameter> from = parameters(m, elements);
  std::vector<std::vector<double>> starts;
  for (const double threshold : {0.0, 0.5, 0.9}) {
    std::vector<double> start;
    for (const Parameter& p : from) start.push_back(p.start);
    const double top = largest(m["pressure"]);
    start[1] = threshold * top;
    start[0] = largest(measured) / (top - start[1]);
    starts.push_back(start);
  }
  return least_squares_from(residuals, rows.size(), from, starts);
}

Fit try_elements(const Measured& m, int elements) {
  constexpr std::string_view names[] = {"none", "one", "two"};
  Fit out{.model = std::string(names[elements]),
          .law = "F = A (max(p - P0, 0) + sum c_i max(z_i - P0, 0)), z_i' = (p - z_i)/tau_i",
          .source = "actuator/creep.h"};
  const Solution whole = fit(m, elements, -1);
  out.parameters = whole.estimates;
  const double full = largest(m["force"]);
  out.fit = score(whole.residuals, full);
  out.residuals = whole.residuals;
  std::vector<double> unseen;
  for (int part = 0; part < 2; ++part) {
    const std::vector<double> f = force(m, fit(m, elements, part).values);
    for (std::size_t i = 0; i < m.rows(); ++i)
      if (static_cast<int>(i % 2) != part) unseen.push_back(f[i] - m["force"][i]);
  }
  out.cross_validated = score(unseen, full);
  return out;
}

// From one time constant of the slowest element on: what the pressure's own rise adds meanwhile.
void warn_of_pressure(const Measured& m, const actuator::Creep& creep, Report& report) {
  const std::vector<double>&t = m["time"], &f = m["force"], &p = m["pressure"];
  const double slowest = *std::max_element(creep.time.begin(), creep.time.end());
  if (!(slowest > 0)) return;
  std::size_t from = 0;
  while (from + 2 < t.size() && t[from] < t[0] + slowest) ++from;
  const double by_pressure = report.best().parameters[0].value * (p.back() - p[from]);
  const double growth = f.back() - f[from];
  if (by_pressure < 0.1 * growth) return;
  report.warnings.push_back(fmt::format(
      "creep and pressure are confounded: after {:.3g} s force grows by {:.3g} N, of which the "
      "pressure's rise of {:.2f} % gives {:.3g} N; a law without creep leaves {:.2f} % of the "
      "largest force",
      t[from], growth, 100 * (p.back() / p[from] - 1), by_pressure,
      report.fits[0].fit.rmse_percent));
}

}  // namespace

std::span<const Wanted> creep_columns() { return creep_wanted; }

CreepResult identify_creep(const Measured& data) {
  if (data.rows() < 12)
    throw Refusal(data.file, fmt::format("{} rows", data.rows()), "at least 12", "a longer hold");
  CreepResult out;
  Report& report = out.report;
  report = {.subject = "creep from " + data.file,
            .quantity = "force",
            .unit = "N",
            .full_scale = largest(data["force"]),
            .full_scale_is = "the largest force",
            .notes = data.notes};
  for (int elements = 0; elements <= actuator::Creep::most; ++elements)
    report.fits.push_back(try_elements(data, elements));
  report.rows = {.x = "time", .x_unit = "s", .at = data["time"], .measured = data["force"]};
  choose(report);
  const std::vector<Estimate>& best = report.best().parameters;
  for (std::size_t k = 2; k + 1 < best.size(); k += 2) {
    out.creep.share[(k - 2) / 2] = best[k].value;
    out.creep.time[(k - 2) / 2] = best[k + 1].value;
  }
  warn_of_pressure(data, out.creep, report);
  return out;
}

}  // namespace sinew::identify
