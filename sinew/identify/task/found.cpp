#include "sinew/identify/task/found.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/ranges.h>

#include "sinew/config/write/writer.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/page/fit_page.h"
#include "sinew/identify/task/settings.h"
#include "sinew/report/text/text_table.h"

namespace sinew::identify {

std::string digits(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

ParameterFile file_with(std::string text) {
  return {[text = std::move(text)](const std::string&) { return text; }};
}

ParameterFile part_of_robot(config::Node tables, std::string base) {
  return {[tables = std::move(tables), base = std::move(base)](const std::string& out) {
    config::Node robot = robot_over(base, out);
    for (const config::Node& table : tables.children) robot.put(table);
    return config::to_toml(robot);
  }};
}

namespace {

using report::TextTable;
using Shown = TextOptions::Shown;

// --- a report: its laws, and the parameters of the chosen one ---

void put_models(std::string& out, const Report& report) {
  using enum TextTable::Align;
  const bool ends =
      std::ranges::any_of(report.fits, [](const Fit& f) { return f.extrapolated.has_value(); });
  std::vector<std::string> head = {"model",         "parameters", "fit rmse",       "max",
                                   "held out rmse", "max",        "cross-validated"};
  if (ends) head.emplace_back("at the ends");
  head.emplace_back();
  std::vector<TextTable::Align> align(head.size(), right);
  align.front() = align.back() = left;
  TextTable table(head, align);

  const auto rmse = [](const std::optional<Score>& score) {
    return score && score->points > 0 ? fmt::format("{:.2f} %", score->rmse_percent) : "-";
  };
  const auto most = [](const std::optional<Score>& score) {
    return score && score->points > 0 ? fmt::format("{:.2f} %", score->max_percent) : "-";
  };
  for (std::size_t i = 0; i < report.fits.size(); ++i) {
    const Fit& f = report.fits[i];
    if (!f.refused.empty()) {
      std::vector<std::string> row(head.size(), "-");
      row.front() = f.model;
      row.back() = f.refused;
      table.add(row);
      continue;
    }
    std::vector<std::string> row = {f.model,
                                    std::to_string(free_count(f.parameters)),
                                    rmse(f.fit),
                                    most(f.fit),
                                    rmse(f.held_out),
                                    most(f.held_out),
                                    rmse(f.cross_validated)};
    if (ends) row.push_back(rmse(f.extrapolated));
    row.push_back(i == report.chosen ? "<- chosen" : f.not_chosen);
    table.add(row);
  }
  put(out, "{}", table.text());
}

// The value and half its interval to the digits that mean something, multiplied with `scale`.
std::string interval(const Estimate& e, double scale) {
  if (!e.free && e.low == e.high) return e.known;
  if (e.at_bound) return "at the bound of its range";
  if (!std::isfinite(e.high)) return e.identifiable ? "no interval" : "not identifiable";
  return fmt::format("+- {:.2g}{}{}{}", 0.5 * scale * (e.high - e.low),
                     e.identifiable ? "" : ", not identifiable", e.known.empty() ? "" : "; ",
                     e.known);
}

// Returns an error of a profile, in multiples of that of the chosen values.
std::string error_at(double times) {
  if (!std::isfinite(times)) return "-";
  return times < Profile::most ? fmt::format("{:.3g}", times) : "> 10";
}

void put_parameters(std::string& out, const Fit& fit, const TextOptions& how) {
  if (fit.parameters.empty()) return;
  using enum TextTable::Align;
  const bool profiled =
      std::ranges::any_of(fit.parameters, [](const Estimate& e) { return e.profile.has_value(); });
  std::vector<std::string> head = {"parameter", "value", "unit", "95 %"};
  if (profiled) head.insert(head.end(), {"error at half", "at twice", ""});
  TextTable table(head, {left, right, left, left, right, right, left});
  for (const Estimate& e : fit.parameters) {
    const Shown shown = how.shown(e.value, e.unit);
    std::vector<std::string> row = {e.name, fmt::format("{:.6g}", shown.number),
                                    shown.unit == "1" ? "" : shown.unit, interval(e, shown.scale)};
    if (e.profile)
      row.insert(row.end(), {error_at(e.profile->error.front()), error_at(e.profile->error.back()),
                             std::string(e.profile->pinned ? "pinned" : "not pinned") +
                                 (e.profile->near_zero ? ", near zero" : "")});
    else if (profiled)
      row.insert(row.end(), {"-", "-", ""});
    table.add(row);
  }
  put(out, "{}", table.text());
  if (profiled)
    put(out,
        "error at half, at twice: times as large, with that value and all others fitted again; a "
        "value near zero is moved by its scale\n");
}

void put_report(std::string& out, const Report& report, const TextOptions& how) {
  const Shown whole = how.shown(report.full_scale, report.unit);
  put(out, "{}\n", report.subject);
  const std::string of =
      whole.unit == "1" ? "" : fmt::format(", {:.5g} {}", whole.number, whole.unit);
  put(out, "errors of the {} in % of {}{}\n", report.quantity, report.full_scale_is, of);
  if (const std::vector<std::string> names = not_pinned(report); !names.empty())
    put(out, "these data do not pin: {}\n", fmt::join(names, ", "));
  put(out, "\n");
  put_models(out, report);
  if (!report.held_out_is.empty()) put(out, "\nheld out: {}\n", report.held_out_is);
  if (report.fits.size() > 1) put(out, "chosen: {}\n", report.rule);
  put(out, "\n{}: {}  {}\n", report.best().model, report.best().law, report.best().source);
  put_parameters(out, report.best(), how);
  if (const auto& band = report.best().band) {
    const Shown most = how.shown(band->half_95, report.unit);
    const std::string unit = most.unit == "1" ? "" : " " + most.unit;
    const std::string where = band->where.empty() ? "" : ", " + band->where;
    put(out, "68 and 95 % of what it did not see lie within +- {:.3g} and {:.3g}{}{}\n",
        band->half_68 * most.scale, most.number, unit, where);
  }
  for (const std::string& note : report.best().notes) put(out, "note: {}\n", note);
}

}  // namespace

std::string Found::text(const TextOptions& how) const {
  std::string out;
  const bool has_report = is_report_text && !reports.empty();
  if (has_report) put_report(out, reports[0], how);
  if (add_text) add_text(*this, how, out);
  if (!has_report) return out;
  put(out, "\nwhat this does not show:\n");
  for (const std::string& text : does_not_show(reports[0])) put(out, "  {}\n", text);
  return out;
}

std::string Found::page(const std::vector<Source>& sources, double atmosphere,
                        const std::string& version, const std::string& out) const {
  const std::string first = reports[0].title.empty() ? reports[0].subject : reports[0].title;
  return identify::page({.title = title.empty() ? first : title,
                         .version = version,
                         .data = words_of(sources),
                         .atmosphere = atmosphere,
                         .reports = reports,
                         .parameter_file = own_file(out)});
}

std::string Found::own_file(const std::string& out) const {
  if (files.empty() || !refused.empty()) return "";
  try {
    return file(out);
  } catch (const Refusal&) {
    if (!out.empty()) throw;
    return "";
  }
}

}  // namespace sinew::identify
