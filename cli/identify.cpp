// cli/identify.cpp - `sinew identify`: from measurements to parameter files.
#include "cli/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "cli/identify_columns.h"
#include "cli/identify_page.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"
#include "sinew/recording/stated.h"
#include "sinew/report/page/page.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

// "force=F_N"
void add_pair(std::string_view option, const std::string& text,
              std::map<std::string, std::string>& pairs) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    config::fail({std::string(option), 0, 0}, "", config::in_quotes(text), "name=value");
  pairs[text.substr(0, equals)] = text.substr(equals + 1);
}

// "force=F_N,length=Lage, mm": a comma parts two pairs where a pair follows; else a name has it.
std::vector<std::string> pairs_of(const std::vector<std::string>& texts) {
  std::vector<std::string> out;
  for (const std::string& text : texts) {
    bool is_first = true;
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t comma = std::min(text.find(',', at), text.size());
      const std::string piece = text.substr(at, comma - at);
      if (is_first || piece.find('=') != piece.npos)
        out.push_back(piece);
      else
        out.back() += "," + piece;
      is_first = false;
      at = comma + 1;
    }
  }
  return out;
}

// Something that would be replaced, and that can be read first.
bool is_old_file(const std::string& path) {
  return std::filesystem::exists(path) && !log::is_written_directly(path);
}

// What --force may replace: never somebody's measurements.
bool is_page(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("\"sinew.fit/") != text.npos;
}

bool is_parameter_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  while (std::getline(in, line))
    if (line.starts_with("format") && line.find("\"sinew.") != line.npos) return true;
  return false;
}

void print_models(const identify::Report& report) {
  using enum report::TextTable::Align;
  const bool ends = std::ranges::any_of(
      report.fits, [](const identify::Fit& f) { return f.extrapolated.has_value(); });
  std::vector<std::string> head = {"model",         "parameters", "fit rmse",       "max",
                                   "held out rmse", "max",        "cross-validated"};
  if (ends) head.emplace_back("at the ends");
  head.emplace_back();
  std::vector<report::TextTable::Align> align(head.size(), right);
  align.front() = align.back() = left;
  report::TextTable table(head, align);

  const auto rmse = [](const std::optional<identify::Score>& score) {
    return score ? fmt::format("{:.2f} %", score->rmse_percent) : std::string("-");
  };
  const auto most = [](const std::optional<identify::Score>& score) {
    return score ? fmt::format("{:.2f} %", score->max_percent) : std::string("-");
  };
  for (std::size_t i = 0; i < report.fits.size(); ++i) {
    const identify::Fit& f = report.fits[i];
    if (!f.refused.empty()) {
      std::vector<std::string> row(head.size(), "-");
      row.front() = f.model;
      row.back() = as_options(f.refused);
      table.add(row);
      continue;
    }
    std::vector<std::string> row = {f.model,
                                    std::to_string(identify::free_count(f.parameters)),
                                    rmse(f.fit),
                                    most(f.fit),
                                    rmse(f.held_out),
                                    most(f.held_out),
                                    rmse(f.cross_validated)};
    if (ends) row.push_back(rmse(f.extrapolated));
    row.push_back(i == report.chosen ? "<- chosen" : f.not_chosen);
    table.add(row);
  }
  fmt::print("{}", table.text());
}

// The value and half its interval to the digits that mean something, multiplied with `scale`.
std::string interval(const identify::Estimate& e, double scale) {
  if (!e.free && e.low == e.high) return e.known;
  if (e.at_bound) return "at the bound of its range";
  if (!std::isfinite(e.high)) return e.identifiable ? "no interval" : "not identifiable";
  return fmt::format("+- {:.2g}{}{}{}", 0.5 * scale * (e.high - e.low),
                     e.identifiable ? "" : ", not identifiable", e.known.empty() ? "" : "; ",
                     e.known);
}

void print_parameters(const identify::Fit& fit, const config::UnitsToShow& asked, double room) {
  report::TextTable table({"parameter", "value", "unit", "95 %"},
                          {report::TextTable::Align::left, report::TextTable::Align::right});
  for (const identify::Estimate& e : fit.parameters) {
    const Retold shown = retold(e.value, e.unit, asked, room);
    table.add({e.name, fmt::format("{:.6g}", shown.number), shown.unit == "1" ? "" : shown.unit,
               interval(e, shown.scale)});
  }
  fmt::print("{}", table.text());
}

void print(const identify::Report& report, const config::UnitsToShow& asked, double room) {
  const Retold whole = retold(report.full_scale, report.unit, asked, room);
  fmt::print("{}\n", report.subject);
  const std::string of =
      whole.unit == "1" ? "" : fmt::format(", {:.5g} {}", whole.number, whole.unit);
  fmt::print("errors of the {} in % of {}{}\n\n", report.quantity, report.full_scale_is, of);
  print_models(report);
  if (!report.held_out_is.empty()) fmt::print("\nheld out: {}\n", report.held_out_is);
  if (report.fits.size() > 1) fmt::print("chosen: {}\n", report.rule);
  fmt::print("\n{}: {}  {}\n", report.best().model, report.best().law, report.best().source);
  print_parameters(report.best(), asked, room);
  if (const auto& band = report.best().band) {
    const Retold most = retold(band->half_95, report.unit, asked, room);
    const std::string unit = most.unit == "1" ? "" : " " + most.unit;
    const std::string where = band->where.empty() ? "" : ", " + band->where;
    fmt::print("68 and 95 % of what it did not see lie within +- {:.3g} and {:.3g}{}{}\n",
               band->half_68 * most.scale, most.number, unit, where);
  }
  for (const std::string& note : report.best().notes) fmt::print("note: {}\n", as_options(note));
}

}  // namespace

void add_data_options(Command sub, DataOptions& options) {
  sub.add_option("DATA", options.files, "measurements as CSV, or the folder of a run").required();
  add_table_options(sub, options.table);
  sub.add_option("--template", options.template_file,
                 "FILE.csv: writes a table to fill in, without DATA; --columns alone lists its "
                 "columns");
  sub.add_option("--atmosphere", options.atmosphere, "that gauges read against").show_default();
}

std::vector<identify::Source> sources_of(const DataOptions& options,
                                         const std::vector<std::string>& held_out) {
  identify::Source how;
  const TableOptions& table = options.table;
  for (const std::string& map : pairs_of(table.maps)) add_pair("--map", map, how.names);
  for (const std::string& unit : table.units) add_pair("--unit", unit, how.units);
  for (const std::string& where : table.where) add_pair("--where", where, how.where);
  for (const std::string& offset : table.offsets) add_pair("--offset", offset, how.offsets);
  how.values = table.values;
  std::vector<std::string> files = options.files;
  for (const std::string& text : held_out)  // or the words of a rule, "level"
    if (std::filesystem::exists(text)) files.push_back(text);
  recording::check_stated(how.values, files);
  how.columns = config::at_commas(table.columns);
  how.rate = table.rate;
  how.drop_incomplete = table.settings.drop_incomplete;
  how.encoding = table.settings.encoding;
  how.decimal = table.settings.decimal;
  how.thousands = table.settings.thousands;
  how.dates = table.settings.dates;
  how.spread_times = table.settings.spread_times;
  how.part = table.settings.part;
  how.atmosphere = identify::atmosphere_setting(options.atmosphere);
  return identify::sources_of(options.files, how);
}

void add_wish_options(Command sub, identify::WishTexts& wishes) {
  sub.add_option("--freeze", wishes.freeze,
                 "NAME=VALUE: a parameter that is known and not fitted; may be repeated")
      .takes_one();
  sub.add_option(
         "--prior", wishes.prior,
         "NAME=VALUE±DEVIATION: what is known of a parameter, and how well; may be repeated")
      .takes_one();
  sub.add_option("--tie", wishes.tie, "NAME=OTHER: two parameters that are one; may be repeated")
      .takes_one();
}

void add_result_options(Command sub, ResultOptions& options) {
  sub.add_option("-o,--out", options.out, "the parameter file to write");
  sub.add_flag("--force", options.force, "replace the parameter file and the page");
  sub.add_flag("--json", options.json, "print the report as JSON");
  sub.add_flag("--quiet", options.quiet, "only the report and errors");
  add_report_options(sub, options);
}

void add_report_options(Command sub, ResultOptions& options) {
  Option page =
      sub.add_option("--report", options.report,
                     "FILE.html: a page with the data beside the models; absent: beside --out");
  sub.add_flag("--no-report", options.no_report, "no page").excludes(page);
  add_units(sub, options.units, "of what is printed, else SI; --json and files are in SI");
}

std::string page_of(const ResultOptions& options) {
  if (options.no_report) return "";
  if (!options.report.empty()) return options.report;
  if (options.out.empty() || !report::has_page()) return "";
  return std::filesystem::path(options.out).replace_extension(".html").string();
}

void check_result_options(const ResultOptions& options) {
  if (const std::string page = page_of(options); !page.empty()) {
    report::require_page(page);
    if (page == options.out)
      config::fail({"--out", 0, 0}, "", config::in_quotes(options.out) + ", the page's name too",
                   "a parameter file, such as mine.toml", "another name, or --no-report");
    run::refuse_to_overwrite(page, options.force);
    if (is_old_file(page) && !is_page(page))
      config::fail({page, 0, 0}, "", "something that is no page of `sinew identify`",
                   "a name that is free, or that of such a page", "another one, or --no-report");
  }
  if (options.out.empty()) return;
  run::refuse_to_overwrite(options.out, options.force, {}, ".toml");
  if (is_old_file(options.out) && !is_parameter_file(options.out))
    config::fail({options.out, 0, 0}, "", "something that is no parameter file",
                 "a name that is free, or that of a parameter file", "another one");
}

void write_parameter_file(const std::string& text, const ResultOptions& options) {
  if (options.out.empty()) return;
  run::write_file(options.out, text);
  Messages(options.quiet).note(fmt::format("{}: written", options.out));
}

void tell(const identify::Report& report, const std::string& parameter_file,
          const DataOptions& data, const ResultOptions& options, const Json& json) {
  const Messages messages(options.quiet);
  for (const std::string& note : report.notes) messages.note(note);
  for (const std::string& warning : report.warnings) messages.warning(warning);
  // Files come before what is printed: a reader that ends early, such as head, ends the program.
  write_parameter_file(parameter_file, options);
  leave_page(report.title.empty() ? report.subject : report.title, {&report}, parameter_file, data,
             options);
  if (options.json) {
    fmt::print("{}\n", (json.is_null() ? to_json(report) : json).text(2));
  } else {
    print(report, units_asked(options.units, units::UnitSet::si),
          identify::atmosphere_setting(data.atmosphere));
  }
}

void add_identify(Command app, Action& action) {
  Command sub = app.subcommand("identify", "from measurements to parameter files",
                               "sinew identify geometry mesh.csv -o my-actuator.toml");
  sub.require_subcommand();
  add_identify_geometry(sub, action);
  add_identify_sensor(sub, action);
  add_identify_dynamic(sub, action);
  add_identify_joint(sub, action);
  add_identify_pair(sub, action);
  add_identify_valve(sub, action);
  add_identify_static(sub, action);
  add_identify_creep(sub, action);
  add_identify_check(sub, action);
  add_identify_scale(sub, action);
  add_identify_run(sub, action);
  add_identify_plan(sub, action);
  add_identify_columns(sub, action);
}

}  // namespace sinew::cli
