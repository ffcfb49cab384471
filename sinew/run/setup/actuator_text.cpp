#include "sinew/run/setup/actuator_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"

namespace sinew::run {

using Point = actuator::OperatingPoint;

namespace {

// A reported quantity of a point: key in JSON, words, SI unit, and unit in inches and pounds.
struct Row {
  const char* key;
  const char* words;
  double Point::*value;
  const char* unit;
  const char* display;
};
constexpr Row rows[] = {
    {"length_m", "length", &Point::length, "m", "in"},
    {"gauge_pressure_Pa", "pressure", &Point::gauge_pressure, "Pa gauge", "psi gauge"},
    {"tension_N", "tension, at rest", &Point::tension, "N", "lbf"},
    {"half_68_N", "68 % of measured, +-", &Point::half_68, "N", "lbf"},
    {"half_95_N", "95 % of measured, +-", &Point::half_95, "N", "lbf"},
    {"effectiveness", "effectiveness", &Point::effectiveness, "1", "1"},
    {"coulomb_bound_N", "dry friction, at most", &Point::coulomb_bound, "N", "lbf"},
    {"velocity_m_per_s", "velocity", &Point::velocity, "m/s", "in/s"},
    {"sliding_tension_N", "tension, sliding", &Point::sliding_tension, "N", "lbf"},
    {"viscous_loss_N", "viscous part", &Point::viscous_loss, "N", "lbf"},
    {"stiffness_at_constant_pressure_N_per_m", "stiffness, constant pressure",
     &Point::stiffness_at_constant_pressure, "N/m", "lbf/in"},
    {"stiffness_sealed_N_per_m", "stiffness, valves shut", &Point::stiffness_sealed, "N/m",
     "lbf/in"},
    {"passive_stiffness_N_per_m", "stiffness without air", &Point::passive_stiffness, "N/m",
     "lbf/in"},
    {"volume_m3", "volume", &Point::volume, "m3", "in3"},
    {"diameter_m", "diameter", &Point::diameter, "m", "in"},
    {"braid_angle_rad", "braid angle", &Point::braid_angle, "rad", "deg"},
};

// Returns a dash if the value is not finite.
std::string shown(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

// A column of a table of points: its title and the text of a point.
struct Cell {
  std::string title;
  std::function<std::string(const Point&)> text;
};

// The default units of a table's columns.
struct ColumnUnits {
  std::string length, pressure, force = "N", stiffness = "N/m", volume = "mL", diameter = "mm",
                                angle = "deg";
};

ColumnUnits in_units(const units::ShownUnits& shown) {
  const std::string length = shown.of("m").name;
  return {length,
          shown.of("Pa gauge").name,
          shown.of("N").name,
          shown.of("N/m").name,
          shown.of("m3").name,
          length,
          shown.of("rad").name};
}

std::vector<Cell> cells_for(bool moves, bool predicts, const ColumnUnits& u) {
  std::vector<Cell> out;
  const auto add = [&](const char* title, double Point::*value, const char* unit,
                       const std::string& display, const char* format) {
    out.push_back({fmt::format("{} [{}]", title, display), [=](const Point& p) {
                     return shown(units::convert(p.*value, unit, display), format);
                   }});
  };
  add("length", &Point::length, "m", u.length, "{:.5g}");
  add("pressure", &Point::gauge_pressure, "Pa gauge", u.pressure, "{:.5g}");
  add("tension", &Point::tension, "N", u.force, "{:.3f}");
  if (predicts) add("+- 95 %", &Point::half_95, "N", u.force, "{:.3g}");
  out.push_back({"Eff", [](const Point& p) { return shown(p.effectiveness, "{:.4f}"); }});
  const char* digits = u.stiffness == "N/m" ? "{:.1f}" : "{:.4g}";
  add("k at p", &Point::stiffness_at_constant_pressure, "N/m", u.stiffness, digits);
  add("k sealed", &Point::stiffness_sealed, "N/m", u.stiffness, digits);
  add("friction", &Point::coulomb_bound, "N", u.force, "{:.3f}");
  if (moves) add("sliding", &Point::sliding_tension, "N", u.force, "{:.3f}");
  add("volume", &Point::volume, "m3", u.volume, u.volume == "m3" ? "{:.4g}" : "{:.3f}");
  add("diameter", &Point::diameter, "m", u.diameter, u.diameter == "m" ? "{:.4g}" : "{:.3f}");
  add("angle", &Point::braid_angle, "rad", u.angle, "{:.3f}");
  return out;
}

// Returns whether the quantity is shown only on request.
bool is_on_request(const Row& row) {
  return row.value == &Point::velocity || row.value == &Point::sliding_tension ||
         row.value == &Point::viscous_loss || row.value == &Point::half_68 ||
         row.value == &Point::half_95;
}

}  // namespace

std::string text_of(const Point& p, const units::ShownUnits* units) {
  using enum report::TextTable::Align;
  const std::vector<std::string> titles =
      units ? std::vector<std::string>{"", ""} : std::vector<std::string>{"", "SI", "in, lbf, psi"};
  report::TextTable table(titles, {left, right, right});
  for (const Row& row : rows) {
    const double value = p.*row.value;
    if (!std::isfinite(value)) {
      if (!is_on_request(row)) table.add({row.words, "-"});
    } else if (units) {
      const std::string_view unit = row.unit;
      table.add({row.words, unit == "1" ? units::format_quantity(value, "1", "1")
                                        : units->text(value, unit, 6)});
    } else {
      const bool plain = std::string_view(row.unit) == "1";
      table.add({row.words, units::format_quantity(value, row.unit, row.unit),
                 plain ? "" : units::format_quantity(value, row.unit, row.display)});
    }
  }
  return units ? table.text().substr(1) : table.text();
}

std::string table_of(const std::vector<Point>& points, const std::string& length,
                     const std::string& pressure, const units::ShownUnits* units) {
  const std::vector<Cell> cells = cells_for(
      std::isfinite(points[0].velocity),
      std::ranges::any_of(points, [](const Point& p) { return std::isfinite(p.half_95); }),
      units ? in_units(*units) : ColumnUnits{.length = length, .pressure = pressure});
  std::vector<std::string> titles;
  for (const Cell& cell : cells) titles.push_back(cell.title);
  titles.emplace_back("");
  std::vector<report::TextTable::Align> align(cells.size(), report::TextTable::Align::right);
  report::TextTable table(titles, align);
  for (const Point& p : points) {
    std::vector<std::string> row;
    for (const Cell& cell : cells) row.push_back(cell.text(p));
    row.emplace_back(p.beyond.empty() ? "" : "*");
    table.add(std::move(row));
  }
  return table.text();
}

std::string json_of(const Point& p) {
  Json out;
  for (const Row& row : rows)
    if (std::isfinite(p.*row.value)) out[row.key] = p.*row.value;
  out["beyond"] = p.beyond;
  return out.text();
}

}  // namespace sinew::run
