#include "sinew/design/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sinew/report/page/page.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/unit.h"

namespace sinew::design {

namespace {

using config::TextOptions;
using report::TextTable;

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string digits(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

// Returns a number in the unit that a value or column has for itself, else in the chosen one.
TextOptions::Shown shown_as(double si, const std::string& unit, const std::string& own,
                            const TextOptions& how) {
  if (own.empty()) return how.shown(si, unit);
  const units::Unit of = units::read_unit(own).unit;
  const double scale = of.denominator / of.numerator;
  return {si * scale, own, scale};
}

// Returns the same for a page, which converts units of SI by itself.
std::pair<double, std::string> on_page(double si, const std::string& unit, const std::string& own) {
  const TextOptions::Shown shown = shown_as(si, unit, own, {});
  return {shown.number, shown.unit};
}

std::string shown_unit(const TextOptions::Shown& shown) {
  return shown.unit == "1" ? "" : shown.unit;
}

void put_values(std::string& out, const Result& result, const TextOptions& how) {
  using enum TextTable::Align;
  TextTable table({"", "value", "unit", "from", "to", ""}, {left, right, left, right, right, left});
  for (const Value& v : result.values) {
    const TextOptions::Shown shown = shown_as(v.number, v.unit, v.shown_in, how);
    const auto bound = [&](double x) {
      return std::isfinite(x) ? digits(shown_as(x, v.unit, v.shown_in, how).number) : std::string();
    };
    table.add(
        {v.name, digits(shown.number), shown_unit(shown), bound(v.low), bound(v.high), v.note});
  }
  out += table.text_within(how.width);
}

std::string text_of(const Cell& cell, const Column& column, const TextOptions& how) {
  if (const auto* words = std::get_if<std::string>(&cell)) return *words;
  return digits(shown_as(std::get<double>(cell), column.unit, column.shown_in, how).number);
}

// Returns whether the first row has words in this column.
bool has_words(const Table& table, std::size_t column) {
  return !table.rows.empty() && std::holds_alternative<std::string>(table.rows[0][column]);
}

void put_table(std::string& out, const Table& table, const TextOptions& how) {
  std::vector<std::string> heads;
  std::vector<TextTable::Align> align;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& c = table.columns[i];
    const std::string unit = shown_unit(shown_as(0, c.unit, c.shown_in, how));
    heads.push_back(unit.empty() ? c.name : fmt::format("{} [{}]", c.name, unit));
    align.push_back(has_words(table, i) ? TextTable::Align::left : TextTable::Align::right);
  }
  TextTable lines(heads, align);
  for (std::size_t r = 0; r < std::min(table.rows.size(), table.shown); ++r) {
    std::vector<std::string> row;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      row.push_back(text_of(table.rows[r][i], table.columns[i], how));
    lines.add(row);
  }
  fmt::format_to(std::back_inserter(out), "\n{}\n{}", table.title, lines.text_within(how.width));
  if (table.rows.size() > table.shown)
    fmt::format_to(std::back_inserter(out), "… and {} more rows, in json=true and on the page\n",
                   table.rows.size() - table.shown);
}

// Gives each curve without a color the next one of its plot; a band has that of the curve before.
std::vector<report::Plot> with_colors(std::vector<report::Plot> plots) {
  for (report::Plot& plot : plots) {
    int color = 0;
    for (report::Curve& c : plot.curves) {
      const bool band = c.style == report::Curve::Style::band;
      if (c.color == report::Curve::next) c.color = band ? std::max(color - 1, 0) : color++;
    }
  }
  return plots;
}

}  // namespace

const Value& Result::of(const std::string& key) const {
  const auto at = std::ranges::find(values, key, &Value::key);
  if (at == values.end()) throw std::out_of_range("no value " + key);
  return *at;
}

std::string text_of(const Result& result, const TextOptions& how) {
  std::string out = result.title + "\n\n";
  if (!result.values.empty()) put_values(out, result, how);
  for (const Table& table : result.tables)
    if (!table.rows.empty()) put_table(out, table, how);
  if (!result.notes.empty()) out += "\n";
  for (const std::string& note : result.notes) out += "note: " + note + "\n";
  if (!result.unseen.empty()) out += "\nwhat this does not show:\n";
  for (const std::string& text : result.unseen) out += "  " + text + "\n";
  return out;
}

Json to_json(const Result& result) {
  Json out{{"format", "sinew.design/1"}, {"design", result.method}, {"title", result.title}};
  for (const Value& v : result.values) {
    out[v.key] = number_json(v.number);
    if (std::isfinite(v.low)) out[v.key + "_low"] = v.low;
    if (std::isfinite(v.high)) out[v.key + "_high"] = v.high;
  }
  for (const Table& table : result.tables) {
    Json rows = Json::array();
    for (const auto& row : table.rows) {
      Json one = Json::object();
      for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const auto* words = std::get_if<std::string>(&row[i]);
        one[table.columns[i].key] = words ? Json(*words) : number_json(std::get<double>(row[i]));
      }
      rows.push_back(std::move(one));
    }
    out[table.key] = std::move(rows);
  }
  if (!result.refused.empty()) out["refused"] = result.refused;
  out["notes"] = result.notes;
  out["warnings"] = result.warnings;
  out["does_not_show"] = result.unseen;
  return out;
}

std::string page_of(const Result& result, double atmosphere, const std::string& version) {
  Json values = Json::array(), tables = Json::array();
  for (const Value& v : result.values) {
    const auto shown = [&](double si) { return on_page(si, v.unit, v.shown_in).first; };
    values.push_back({{"key", v.key},
                      {"name", v.name},
                      {"value", number_json(shown(v.number))},
                      {"unit", on_page(0, v.unit, v.shown_in).second},
                      {"low", number_json(shown(v.low))},
                      {"high", number_json(shown(v.high))},
                      {"note", v.note}});
  }
  for (const Table& table : result.tables) {
    Json columns = Json::array(), rows = Json::array();
    for (const Column& c : table.columns)
      columns.push_back({{"name", c.name}, {"unit", on_page(0, c.unit, c.shown_in).second}});
    for (const auto& row : table.rows) {
      Json cells = Json::array();
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Column& c = table.columns[i];
        const auto* words = std::get_if<std::string>(&row[i]);
        cells.push_back(
            words ? Json(*words)
                  : number_json(on_page(std::get<double>(row[i]), c.unit, c.shown_in).first));
      }
      rows.push_back(std::move(cells));
    }
    tables.push_back({{"title", table.title}, {"columns", columns}, {"rows", rows}});
  }
  return report::page(report::DesignPage{.title = result.title,
                                         .version = version,
                                         .atmosphere = atmosphere,
                                         .values = values,
                                         .tables = tables,
                                         .plots = with_colors(result.plots),
                                         .refused = result.refused,
                                         .notes = result.notes,
                                         .warnings = result.warnings,
                                         .unseen = result.unseen});
}

}  // namespace sinew::design
