#include "sinew/tune/sensitivity_table.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/json/json.h"
#include "sinew/tune/table.h"

namespace sinew::tune {
namespace {

// A column: its heading, and what of an effect stands in it.
struct ShownNumber {
  const char* heading;
  Estimate Effect::*which;
  bool with_interval;
};

std::vector<ShownNumber> numbers(Method method) {
  if (method == Method::one_at_a_time)
    return {{"to the low end", &Effect::to_low, false},
            {"to the high end", &Effect::to_high, false}};
  if (method == Method::morris)
    return {{"mean size", &Effect::mean_size, true},
            {"mean", &Effect::mean, true},
            {"spread", &Effect::spread, false}};
  return {{"alone", &Effect::first, true}, {"with all others", &Effect::total, true}};
}

const char* to_text(Method method) {
  if (method == Method::one_at_a_time) return "one at a time";
  return method == Method::morris ? "morris" : "sobol";
}

std::string cell(double x) { return fmt::format("{:.6g}", x); }

// Returns the figures of a column, not a number where a run has none.
std::vector<double> column(const std::vector<Row>& rows, std::size_t index) {
  std::vector<double> out;
  for (const Row& row : rows)
    out.push_back(row.cells[index].empty() ? std::nan("") : std::stod(row.cells[index]));
  return out;
}

}  // namespace

Sweep sweep_of(const Design& design, Sweep base) {
  const auto refuse = [](const char* setting, std::string found, std::string expected,
                         std::string try_this = "") {
    config::fail({setting, 0, 0}, "", std::move(found), std::move(expected), std::move(try_this));
  };
  if (!base.sample || base.sample->ranges.empty())
    refuse("range", "none", "what is varied", "range=\"KEY=from:to unit\"");
  if (!base.axes.empty()) refuse("vary", base.axes.front().key, "ranges alone");
  if (base.largest) refuse("largest", base.largest->axis.key, "ranges alone");
  if (base.report.empty()) refuse("report", "no figure", "at least one", "report=\"duration_s\"");
  const std::size_t all = size(design);
  if (all > most_points)
    refuse("points", fmt::format("{} runs", all), fmt::format("at most {}", most_points));
  base.sample->points = all;
  base.sample->given = shares(design);
  return base;
}

std::vector<FigureSensitivity> sensitivities(const Design& design, const Sweep& runs,
                                             const std::vector<Row>& rows) {
  std::vector<FigureSensitivity> out;
  for (std::size_t i = 0; i < runs.report.size(); ++i)
    out.push_back({runs.report[i].heading(),
                   sensitivity(design, column(rows, runs.sample->ranges.size() + i))});
  return out;
}

std::vector<std::string> sensitivity_headings(Method method) {
  std::vector<std::string> out{"figure", "range"};
  for (const ShownNumber& n : numbers(method)) {
    out.emplace_back(n.heading);
    if (!n.with_interval) continue;
    out.push_back(fmt::format("{}, low", n.heading));
    out.push_back(fmt::format("{}, high", n.heading));
  }
  return out;
}

std::vector<std::vector<std::string>> sensitivity_rows(const Design& design, const Sweep& runs,
                                                       const std::vector<FigureSensitivity>& all) {
  std::vector<std::vector<std::string>> out;
  for (const FigureSensitivity& f : all)
    for (std::size_t i = 0; i < runs.sample->ranges.size(); ++i) {
      std::vector<std::string> row{f.figure, runs.sample->ranges[i].axis.heading()};
      for (const ShownNumber& n : numbers(design.method)) {
        const Estimate e = f.found ? f.found->effects[i].*n.which : Estimate{};
        const auto add = [&](double x) { row.push_back(f.found ? cell(x) : ""); };
        add(e.value);
        if (n.with_interval) add(e.low), add(e.high);
      }
      out.push_back(std::move(row));
    }
  return out;
}

std::string sensitivity_json(const Design& design, const Sweep& runs,
                             const std::vector<FigureSensitivity>& all) {
  Json out{{"format", "sinew.sensitivity/1"},
           {"method", to_text(design.method)},
           {"runs", size(design)},
           {"figures", Json::array()}};
  for (const FigureSensitivity& f : all) {
    Json figure{{"figure", f.figure}};
    if (f.found) {
      figure["mean"] = f.found->mean;
      figure["standard_deviation"] = std::sqrt(f.found->variance);
      figure["left_out"] = f.found->left_out;
      figure["ranges"] = Json::array();
      for (std::size_t i = 0; i < f.found->effects.size(); ++i) {
        Json range{{"range", runs.sample->ranges[i].axis.heading()}};
        for (const ShownNumber& n : numbers(design.method)) {
          const Estimate& e = f.found->effects[i].*n.which;
          range[n.heading] =
              n.with_interval ? Json::array({e.value, e.low, e.high}) : Json(e.value);
        }
        figure["ranges"].push_back(std::move(range));
      }
    }
    out["figures"].push_back(std::move(figure));
  }
  return out.text(2) + "\n";
}

}  // namespace sinew::tune
