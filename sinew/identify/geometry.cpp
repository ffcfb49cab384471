#include "sinew/identify/geometry.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "sinew/identify/quality.h"
#include "sinew/identify/refusal.h"

namespace sinew::identify {

namespace {

constexpr std::array columns{
    Wanted{.name = "length",
           .unit = "m",
           .least = 5e-3,
           .most = 5,
           .doc = "of the mesh between its ends"},
    Wanted{.name = "diameter", .unit = "m", .least = 5e-4, .most = 0.5, .doc = "of the mesh"}};

struct Line {
  double at_zero = 0, slope = 0;
};

// L^2 = b^2 - (n pi)^2 D^2 is a straight line in D^2.
Line straight_line(const std::vector<double>& length, const std::vector<double>& diameter) {
  const auto n = static_cast<double>(length.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < length.size(); ++i) {
    mx += diameter[i] * diameter[i] / n;
    my += length[i] * length[i] / n;
  }
  for (std::size_t i = 0; i < length.size(); ++i) {
    const double dx = diameter[i] * diameter[i] - mx;
    xx += dx * dx;
    xy += dx * (length[i] * length[i] - my);
  }
  return {my - xy / xx * mx, xy / xx};
}

void refuse_poor(const Measured& data) {
  if (data.rows() < 2)
    throw Refusal(data.file, fmt::format("{} pair of length and diameter", data.rows()),
                  "at least two at different lengths",
                  "the mesh pulled long and pushed short, or counted trapezoids");
  const std::vector<double>& length = data["length"];
  refuse_constant(data, "length", 0.05 * largest(length),
                  "lengths that differ by more than 5 %: one length does not tell b from n",
                  "the mesh pulled long and pushed short");
}

}  // namespace

std::span<const Wanted> geometry_columns() { return columns; }

GeometryResult identify_geometry(const Measured& data, double thread_thickness) {
  refuse_poor(data);
  const std::vector<double>& length = data["length"];
  std::vector<double> diameter = data["diameter"];
  for (double& d : diameter) d -= thread_thickness;

  const Line line = straight_line(length, diameter);
  if (!(line.slope < 0) || !(line.at_zero > 0))
    throw Refusal(data.file, "diameters that do not fall as the length grows",
                  "a braid: L^2 + (n pi D)^2 = b^2", "the columns, they may be swapped");
  const double thread = std::sqrt(line.at_zero);
  const double turns = std::sqrt(-line.slope) / std::numbers::pi;

  const Parameter parameters[] = {
      {.name = "thread_length", .unit = "m", .start = thread, .low = 0, .scale = thread},
      {.name = "turns", .unit = "1", .start = turns, .low = 0, .scale = turns}};
  // In diameters, which exist wherever the threads are longer than the mesh.
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < length.size(); ++i) {
      const double around2 = p[0] * p[0] - length[i] * length[i];
      if (around2 < 0) return false;
      r[i] = std::sqrt(around2) / (p[1] * std::numbers::pi) - diameter[i];
    }
    return true;
  };
  const Solution solution = least_squares(residuals, length.size(), parameters);

  GeometryResult out{.braid = {solution.values[0], solution.values[1]}};
  Report& report = out.report;
  report.subject = "braid geometry";
  report.quantity = "diameter";
  report.unit = "m";
  report.full_scale = largest(diameter);
  report.full_scale_is = "the largest diameter";
  Fit fit{.model = "braid", .law = "L^2 + (n pi D)^2 = b^2", .source = "[1]-[4]"};
  fit.parameters = solution.estimates;
  fit.fit = score(solution.residuals, report.full_scale);
  if (length.size() == 2) fit.notes.emplace_back("two pairs fix two values: no error can be seen");
  report.fits.push_back(std::move(fit));
  report.notes = data.notes;
  choose(report);
  return out;
}

}  // namespace sinew::identify
