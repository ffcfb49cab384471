#include "sinew/run/setup/actuator_text.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "sinew/config/quantity.h"
#include "sinew/report/text/text_table.h"

namespace sinew::run {

using Point = actuator::OperatingPoint;

namespace {

// A quantity that is reported of a point: key of the JSON, words, SI unit and that of inches and
// pounds.
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
    {"effectiveness", "effectiveness", &Point::effectiveness, "1", "1"},
    {"coulomb_bound_N", "dry friction, at most", &Point::coulomb_bound, "N", "lbf"},
    {"velocity_m_per_s", "velocity", &Point::velocity, "m/s", "in/s"},
    {"sliding_tension_N", "tension, sliding", &Point::sliding_tension, "N", "lbf"},
    {"viscous_loss_N", "of it viscous", &Point::viscous_loss, "N", "lbf"},
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

// A dash where the law gives no number.
std::string shown(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

// The columns of a table of points: title, and what stands under it.
struct Cell {
  std::string title;
  std::function<std::string(const Point&)> text;
};

std::vector<Cell> cells_for(bool moves, const std::string& length, const std::string& pressure) {
  const auto in = [](double Point::*value, const char* unit, std::string display,
                     const char* format) {
    return [=](const Point& p) { return shown(config::convert(p.*value, unit, display), format); };
  };
  const auto plain = [](double Point::*value, const char* format) {
    return [=](const Point& p) { return shown(p.*value, format); };
  };
  std::vector<Cell> out = {
      {"length [" + length + "]", in(&Point::length, "m", length, "{:.5g}")},
      {"pressure [" + pressure + "]", in(&Point::gauge_pressure, "Pa gauge", pressure, "{:.5g}")},
      {"tension [N]", plain(&Point::tension, "{:.3f}")},
      {"Eff", plain(&Point::effectiveness, "{:.4f}")},
      {"k at p [N/m]", plain(&Point::stiffness_at_constant_pressure, "{:.1f}")},
      {"k sealed [N/m]", plain(&Point::stiffness_sealed, "{:.1f}")},
      {"friction [N]", plain(&Point::coulomb_bound, "{:.3f}")}};
  if (moves) out.push_back({"sliding [N]", plain(&Point::sliding_tension, "{:.3f}")});
  out.push_back({"volume [mL]", in(&Point::volume, "m3", "mL", "{:.3f}")});
  out.push_back({"diameter [mm]", in(&Point::diameter, "m", "mm", "{:.3f}")});
  out.push_back({"angle [deg]", in(&Point::braid_angle, "rad", "deg", "{:.3f}")});
  return out;
}

}  // namespace

std::string text_of(const Point& p) {
  report::TextTable table({"", "SI", "in, lbf, psi"},
                          {report::TextTable::Align::left, report::TextTable::Align::right,
                           report::TextTable::Align::right});
  for (const Row& row : rows) {
    const double value = p.*row.value;
    const bool plain = std::string_view(row.unit) == "1";
    if (!std::isfinite(value)) {
      if (row.value != &Point::velocity && row.value != &Point::sliding_tension &&
          row.value != &Point::viscous_loss)
        table.add({row.words, "-"});
      continue;
    }
    table.add({row.words, config::format_quantity(value, row.unit, row.unit),
               plain ? "" : config::format_quantity(value, row.unit, row.display)});
  }
  return table.text();
}

std::string table_of(const std::vector<Point>& points, const std::string& length,
                     const std::string& pressure) {
  const std::vector<Cell> cells = cells_for(std::isfinite(points[0].velocity), length, pressure);
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
  nlohmann::ordered_json out;
  for (const Row& row : rows)
    if (std::isfinite(p.*row.value)) out[row.key] = p.*row.value;
  out["beyond"] = p.beyond;
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace sinew::run
