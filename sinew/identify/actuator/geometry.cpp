#include "sinew/identify/actuator/geometry.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

constexpr ColumnSpec geometry_specs[] = {
    {"length", "m", 5e-3, 5, needed_column, "of the mesh between its ends"},
    {"diameter", "m", 5e-4, 0.5, needed_column, "of the mesh"},
};

struct Line {
  double at_zero = 0, slope = 0;
};

// Fits L^2 = b^2 - (n pi)^2 D^2, a straight line in D^2, by the median of the slopes of all
// pairs, which a single wrong point does not change.
Line straight_line(const std::vector<double>& length, const std::vector<double>& diameter) {
  std::vector<double> slopes, at_zero;
  for (std::size_t i = 0; i < length.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double across = (diameter[i] - diameter[k]) * (diameter[i] + diameter[k]);
      if (across != 0) slopes.push_back((length[i] - length[k]) * (length[i] + length[k]) / across);
    }
  const double slope = median(slopes);
  for (std::size_t i = 0; i < length.size(); ++i)
    at_zero.push_back(length[i] * length[i] - slope * diameter[i] * diameter[i]);
  return {median(at_zero), slope};
}

void refuse_poor(const Measured& data) {
  if (data.rows() < 2)
    throw Refusal(data.file, fmt::format("{} pair of length and diameter", data.rows()),
                  "at least two at different lengths",
                  "the mesh pulled long and pushed short, or counted trapezoids");
  bool wide = true;
  for (std::size_t i = 0; i < data.rows(); ++i) wide &= data["diameter"][i] > data["length"][i];
  if (wide)
    throw Refusal(data.file, "a mesh that is wider than long in every row",
                  "lengths above the diameters", "the columns, they may be swapped");
  const std::vector<double>& length = data["length"];
  refuse_constant(
      data, "length", 0.05 * largest(length),
      "lengths that differ by more than 5 %: one length does not determine both b and n",
      "the mesh pulled long and pushed short");
}

void refuse_thick(const Measured& data, const std::vector<double>& diameter, double thickness) {
  if (thickness >= 0 && smallest(diameter) > 0) return;
  throw Refusal(
      data.file + ": diameter",
      fmt::format("{:.4g} m less a thread of {:.4g} m", smallest(diameter) + thickness, thickness),
      "a diameter above zero", "the thickness of one thread, or diameters in mm");
}

// Residuals are in diameters, which exist wherever the thread is longer than the mesh. A
// pair that is far off at the start is probably a typing error and is given little weight in the
// fit.
Candidate candidate_of(const std::vector<double>& length, const std::vector<double>& diameter,
                       double thread, double turns) {
  Candidate out{.model = "braid", .law = "L^2 + (n pi D)^2 = b^2", .source = "[1]-[4]"};
  out.parameters = {
      {.name = "thread_length", .unit = "m", .start = thread, .low = 0, .scale = thread},
      {.name = "turns", .unit = "1", .start = turns, .low = 0, .scale = turns}};
  out.predict = [length](std::span<const double> p, std::span<double> d) {
    for (std::size_t i = 0; i < length.size(); ++i) {
      const double around2 = p[0] * p[0] - length[i] * length[i];
      if (around2 < 0) return false;
      d[i] = std::sqrt(around2) / (p[1] * std::numbers::pi);
    }
    return true;
  };
  std::vector<double> off(length.size());
  out.predict(std::array{thread, turns}, off);
  for (std::size_t i = 0; i < off.size(); ++i) off[i] -= diameter[i];
  const double typical = std::max(spread(off), 1e-3 * largest(diameter));
  if (!outliers(off, 4 * typical).empty()) out.options.outlier = 3 * typical;
  return out;
}

}  // namespace

std::span<const ColumnSpec> geometry_columns() { return geometry_specs; }

GeometryResult identify_geometry(const Measured& data, double thread_thickness) {
  refuse_poor(data);
  const std::vector<double>& length = data["length"];
  std::vector<double> diameter = data["diameter"];
  for (double& d : diameter) d -= thread_thickness;
  refuse_thick(data, diameter, thread_thickness);

  const Line line = straight_line(length, diameter);
  if (!(line.slope < 0) || !(line.at_zero > 0))
    throw Refusal(data.file, "diameters that do not fall as the length grows",
                  "a braid: L^2 + (n pi D)^2 = b^2", "the columns, they may be swapped");
  const double thread = std::sqrt(line.at_zero);
  const double turns = std::sqrt(-line.slope) / std::numbers::pi;

  GeometryResult out;
  Report& report = out.report;
  report.set_subject("braid geometry", "diameter", "m", "the largest diameter");
  report.full_scale = largest(diameter);
  report.not_shown = {
      "how the threads stretch under load, and how thick they are between the ends"};
  fit_candidates({candidate_of(length, diameter, std::max(thread, 1.001 * largest(length)), turns)},
                 {.measured = diameter}, report);
  report.rows = {.x = "length", .x_unit = "m", .at = length, .measured = diameter};
  report.notes = data.notes;
  conclude(report);
  refuse_unexplained(report, 20, "the columns and their units, or another mesh");
  Fit& fit = report.fits.front();
  out.braid = {fit.parameters[0].value, fit.parameters[1].value};
  if (length.size() == 2) fit.notes.emplace_back("two pairs fix two values: no error can be seen");
  for (const std::size_t i : outliers(fit.residuals, 0.02 * largest(diameter)))
    report.warnings.push_back(
        fmt::format("{}:{}: a diameter {:.3g} m off the braid, far from the others: a slip of the "
                    "pen?",
                    data.file, data.lines[i], -fit.residuals[i]));
  return out;
}

}  // namespace sinew::identify
