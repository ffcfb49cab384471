// cli/identify_print.cpp - what the methods of `sinew identify` found, as words and tables.
#include "cli/identify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/settings.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/prediction.h"
#include "sinew/config/quantity.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using report::TextTable;
using Align = TextTable::Align;

config::UnitsToShow si_or_asked(const PrintOptions& how) {
  return units_asked(how.units, units::UnitSet::si);
}

std::string digits(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

// --- a report: its laws, and the parameters of the chosen one ---

void print_models(const identify::Report& report) {
  using enum TextTable::Align;
  const bool ends = std::ranges::any_of(
      report.fits, [](const identify::Fit& f) { return f.extrapolated.has_value(); });
  std::vector<std::string> head = {"model",         "parameters", "fit rmse",       "max",
                                   "held out rmse", "max",        "cross-validated"};
  if (ends) head.emplace_back("at the ends");
  head.emplace_back();
  std::vector<TextTable::Align> align(head.size(), right);
  align.front() = align.back() = left;
  TextTable table(head, align);

  const auto rmse = [](const std::optional<identify::Score>& score) {
    return score && score->points > 0 ? fmt::format("{:.2f} %", score->rmse_percent) : "-";
  };
  const auto most = [](const std::optional<identify::Score>& score) {
    return score && score->points > 0 ? fmt::format("{:.2f} %", score->max_percent) : "-";
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

// Returns an error of a profile, in multiples of that of the chosen values.
std::string error_at(double times) {
  if (!std::isfinite(times)) return "-";
  return times < identify::Profile::most ? fmt::format("{:.3g}", times) : "> 10";
}

void print_parameters(const identify::Fit& fit, const config::UnitsToShow& asked, double room) {
  if (fit.parameters.empty()) return;
  using enum TextTable::Align;
  const bool profiled = std::ranges::any_of(
      fit.parameters, [](const identify::Estimate& e) { return e.profile.has_value(); });
  std::vector<std::string> head = {"parameter", "value", "unit", "95 %"};
  if (profiled) head.insert(head.end(), {"error at half", "at twice", ""});
  TextTable table(head, {left, right, left, left, right, right, left});
  for (const identify::Estimate& e : fit.parameters) {
    const Retold shown = retold(e.value, e.unit, asked, room);
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
  fmt::print("{}", table.text());
  if (profiled)
    fmt::print(
        "error at half, at twice: times as large, with that value and all others fitted again; a "
        "value near zero is moved by its scale\n");
}

// --- what each method adds ---

// Methods that know no muscle beside the trajectories.
void print_methods(const identify::DynamicResult& found, const config::UnitsToShow& asked) {
  const units::ShownUnit length = asked.asked ? asked.units.of("m") : units::ShownUnit{"mm", 1e3};
  const units::ShownUnit force = asked.units.of("N"), damping = asked.units.of("N s/m");
  // The columns keep decimals of their own in units that nobody chose.
  const auto in = [&](const units::ShownUnit& unit, double si, int decimals = 4) {
    return asked.asked ? fmt::format("{:.4g}", unit.of(si))
                       : fmt::format("{:.{}f}", unit.of(si), decimals);
  };
  TextTable table(
      {"file", "method", "Q [" + length.name + "]", "friction at rest [" + force.name + "]",
       "c [" + damping.name + "]", "zeta [53]"},
      {Align::left, Align::left, Align::right, Align::right, Align::right, Align::right});
  const auto row = [&](const identify::DecaySummary& s, const char* method,
                       const identify::Damping& d) {
    table.add({s.file, method, in(length, d.coulomb_length, 5),
               in(force, d.coulomb_length * s.stiffness), in(damping, d.viscous),
               fmt::format("{:.4f}", d.ratio)});
  };
  for (const identify::DecaySummary& s : found.records) {
    if (s.printed) row(s, "two points, [45] as printed", *s.printed);
    if (s.exact) row(s, "two points, exact", *s.exact);
    row(s, "all turns", s.all.damping);
    table.add({s.file, "trajectory, " + found.report.best().model,
               in(length, found.loss.coulomb_length, 5), in(force, s.friction),
               in(damping, found.loss.viscous), ""});
  }
  fmt::print("\n{}", table.text());
  for (const identify::DecaySummary& s : found.records)
    if (!s.exact) fmt::print("no two points: {}\n", s.why_not);
}

void print_combinations(const identify::JointResult& found) {
  TextTable table({"what the data tell apart, best first", "95 %"},
                  {TextTable::Align::left, TextTable::Align::right});
  for (const identify::Combination& c : found.combinations)
    table.add({c.text, std::isfinite(c.relative_error)
                           ? fmt::format("+- {:.2g} %", 100 * c.relative_error)
                           : "not at all"});
  fmt::print("\n{}", table.text());
}

// Prints the share of the variance that each law explains, and its scores on the held-out rows.
void print_explained(const identify::Report& report) {
  TextTable table({"model", "R2", "held out", "nrmse", "r"},
                  {Align::left, Align::right, Align::right, Align::right, Align::right});
  for (const identify::Fit& f : report.fits) {
    if (!f.refused.empty()) continue;
    const identify::Score unseen = f.held_out.value_or(identify::Score{});
    table.add({f.model, fmt::format("{:.4f}", f.fit.explained), digits(unseen.explained, "{:.4f}"),
               digits(unseen.nrmse, "{:.4f}"), digits(unseen.correlation, "{:.4f}")});
  }
  fmt::print("\n{}", table.text());
}

void print_stiffness(const identify::PairResult& found, const config::UnitsToShow& asked) {
  const char* unit = found.rotary ? "N m/rad" : "N/m";
  const units::ShownUnit shown = asked.units.of(unit);
  const identify::PairStiffness& s = found.stiffness;
  fmt::print("\nstiffness, springs and trapped air together: {:.5g} +- {:.2g} {}",
             shown.of(s.value), shown.of(s.uncertainty), shown.name);
  if (std::isfinite(s.air)) fmt::print(", of it {:.4g} {} the air's", shown.of(s.air), shown.name);
  fmt::print("\n");
}

// Change with the position, pressure and law of the air.
void print_air(const identify::PairResult& found) {
  if (!found.air) return;
  const identify::PairAir& air = *found.air;
  const identify::Fit& best = air.report.best();
  fmt::print("\ntrapped air, {}: {}; {:.2f} % of {}\n", best.model, best.law, best.fit.rmse_percent,
             air.report.full_scale_is);
  TextTable table({"parameter", "value", "unit", "95 %"},
                  {Align::left, Align::right, Align::left, Align::left});
  for (const identify::Estimate& e : best.parameters)
    table.add({e.name, fmt::format("{:.6g}", e.value), e.unit,
               !e.free                  ? e.known
               : e.at_bound             ? "at the bound of its range"
               : !std::isfinite(e.high) ? "not identifiable"
                                        : fmt::format("+- {:.2g}", 0.5 * (e.high - e.low))});
  fmt::print("{}", table.text());
}

std::string percent(double share) { return digits(100 * share, "{:.2f} %"); }

// The unit of a scale: one that was asked for, else one of what was set, as the files have it.
std::string shown_scale(const identify::Calibration& c, const std::string& display,
                        const config::UnitsToShow& asked) {
  if (!asked.asked) return scale_unit_for(c, display);
  const std::string unit = scale_unit(c);
  if (units::told_unit(unit)) return asked.units.of(unit).name;
  const auto told = units::told_unit(display);
  return scale_unit_for(c, told ? asked.units.of(told->held).name : display);
}

// Table 4-1, and what else one calibration tells of each sensor.
void print_table(const identify::Calibration& c, const std::string& shown) {
  using enum TextTable::Align;
  const std::string unit = scale_unit(c);
  TextTable table({"sensor", "scale [" + shown + "]", "95 %", "at rest [V]", "model", "held out",
                   "linearity", "hysteresis", "noise [mV]", "step [mV]", "error from average"},
                  {left, right, right, right, left, right, right, right, right, right, right});
  const auto add = [&](const std::string& name, double sensitivity, auto... rest) {
    const double scale = config::convert(scale_of(c, sensitivity), unit, shown);
    table.add({name, digits(scale, "{:.5g}"), rest...});
  };
  for (const identify::SensorResult& r : c.sensors) {
    const identify::Fit& best = r.report.best();
    add(r.name, r.sensitivity,
        digits(config::convert(scale_uncertainty(c, r), unit, shown), "+- {:.2g}"),
        digits(r.at_rest, "{:.4f}"), best.model,
        best.held_out ? percent(best.held_out->rmse_percent / 100) : "-", percent(r.linearity),
        percent(r.hysteresis), digits(1000 * r.noise, "{:.2g}"), digits(1000 * r.step, "{:.3g}"),
        c.sensors.size() > 1 ? digits(100 * r.deviation, "{:+.1f} %") : "-");
  }
  if (c.sensors.size() > 1) add("average", c.average);
  fmt::print("{}", table.text());
}

// --- tables before a fit, and plans ---

void print_files(const std::vector<identify::RecognisedFile>& files) {
  TextTable table({"file", "rows", "is", "columns"},
                  {TextTable::Align::left, TextTable::Align::right});
  for (const identify::RecognisedFile& f : files) {
    std::string columns;
    for (const identify::RecognisedColumn& c : f.columns)
      columns +=
          fmt::format("{}{} {} … {}", columns.empty() ? "" : ", ", c.name, c.lowest, c.highest);
    table.add(
        {f.file, std::to_string(f.rows),
         f.is_recording ? fmt::format("a recording, {:.3g} % settled", 100 * f.settled) : "a table",
         columns});
  }
  fmt::print("{}\n", table.text_within(width_of_output()));
}

void print_mounts(const std::vector<identify::RecognisedMount>& mounts) {
  using enum TextTable::Align;
  TextTable table({"muscle [mm]", "mount [mm]", "points", "pressures", "from [kPa]", "to [kPa]",
                   "largest force [N]", "branches"},
                  {right, right, right, right, right, right, right, left});
  for (const identify::RecognisedMount& m : mounts)
    table.add({m.rest_length > 0 ? fmt::format("{:.4g}", 1e3 * m.rest_length) : "?",
               fmt::format("{:.4g}", 1e3 * m.length),
               m.held_out > 0 ? fmt::format("{} + {} held out", m.points, m.held_out)
                              : std::to_string(m.points),
               std::to_string(m.pressures), fmt::format("{:.4g}", m.lowest / 1e3),
               fmt::format("{:.4g}", m.highest / 1e3), fmt::format("{:.4g}", m.strongest),
               m.branches.empty() ? "unknown" : m.branches});
  if (!table.empty()) fmt::print("{}\n", table.text());
}

void print_noise(const identify::ForceNoise& noise) {
  if (noise.readings == 0)
    fmt::print("noise of force: unknown, as no reading is repeated\n\n");
  else
    fmt::print("noise of force: {:.2g} N, {:.2g} % of the largest, from {} {}\n\n", noise.deviation,
               100 * noise.share, noise.readings, noise.from);
}

void print_checks(const std::vector<identify::Check>& checks) {
  for (const identify::Check& c : checks) {
    fmt::print("{:<6}  {:<17}  {}\n", identify::word(c.light), c.name, as_options(c.evidence));
    if (!c.advice.empty()) fmt::print("{:27}{}\n", "", as_options(c.advice));
  }
}

void print_determined(const identify::DeterminedLaw& law) {
  if (!law.refused.empty()) {
    fmt::print("\nwhat a fit could determine: not evaluated, {}\n", as_options(law.refused));
    return;
  }
  TextTable table({"a fit could determine", "known", "to know more, measure"});
  for (const identify::Determined& d : law.parameters) table.add({d.name, d.words, d.advice});
  fmt::print("\n{}by the richest law, {}: {}\n", table.text(), law.model, law.law);
}

// Before anything is measured nothing is known, and how little does not matter.
std::string percent_or_more(double share) {
  return share > 1 ? "> 100 %" : fmt::format("{:.2g} %", 100 * share);
}

// Numbers in the units of --units; else in those of a ruler and a regulator.
struct PlanUnits {
  config::UnitsToShow asked;
  double room = 0;  // that gauges read against [Pa]

  Retold of(double si, const std::string& unit, const Retold& otherwise) const {
    return asked.asked ? retold(si, unit, asked, room) : otherwise;
  }
  Retold length(double x) const { return of(x, "m", {1e3 * x, "mm", 1e3}); }
  Retold pressure(double x) const { return of(x, "Pa gauge", {1e-3 * x, "kPa gauge", 1e-3}); }
  Retold force(double x) const { return of(x, "N", {x, "N", 1}); }
};

std::string text_of(const Retold& r) { return fmt::format("{:.4g} {}", r.number, r.unit); }

std::string numbers_of(const std::vector<double>& pressures, const PlanUnits& units) {
  std::vector<double> out;
  for (const double p : pressures) out.push_back(units.pressure(p).number);
  return fmt::format("{:.4g}", fmt::join(out, " "));
}

void print_mounts(const identify::PlanFound& found, const PlanUnits& units) {
  using enum TextTable::Align;
  const std::string over = fmt::format("up and down over [{}]", units.pressure(0).unit);
  TextTable table({"mount", "length", over, "readings", "minutes", "error rms", "95 % at worst"},
                  {right, right, left, right, right, right, right});
  const identify::MeasurementPlan& plan = found.plan;
  table.add({found.measured > 0 ? "before" : "none", "", "", std::to_string(found.measured), "0",
             percent_or_more(plan.before.rms), percent_or_more(plan.before.half_width)});
  double time = 0;
  for (std::size_t i = 0; i < plan.mounts.size(); ++i) {
    const identify::PlannedMount& m = plan.mounts[i];
    time += m.time;
    table.add({std::to_string(i + 1), text_of(units.length(m.length)),
               numbers_of(m.pressures, units), std::to_string(m.readings()),
               fmt::format("{:.0f}", time / 60), percent_or_more(m.after.rms),
               percent_or_more(m.after.half_width)});
  }
  fmt::print("{}", table.text());
}

void print_plan(const identify::PlanFound& found, const PlanUnits& units) {
  const identify::MeasurementPlan& plan = found.plan;
  const identify::PlanRegion& r = plan.region;
  const bool worst = found.options.criterion == identify::PlanCriterion::worst;
  fmt::print("plan for {}\n", found.subject);
  fmt::print("errors of the force in % of the largest, {}, over {:.4g} to {} and {:.4g} to {}\n\n",
             text_of(units.force(found.muscle.scales.full_scale)), units.length(r.shortest).number,
             text_of(units.length(r.longest)), units.pressure(r.lowest).number,
             text_of(units.pressure(r.highest)));
  print_mounts(found, units);
  if (plan.mounts.empty()) {
    fmt::print("\nnothing more to measure: {} was wanted\n", percent_or_more(found.options.error));
    return;
  }
  const double after = plan.after().of(found.options.criterion);
  const double before = plan.before.of(found.options.criterion);
  fmt::print("\n{} {} and {} readings in {:.0f} minutes: {}{} ({} wanted{}{})\n",
             plan.mounts.size(), plan.mounts.size() == 1 ? "mount" : "mounts", plan.readings(),
             plan.time() / 60,
             found.measured > 0 ? fmt::format("{} -> ", percent_or_more(before)) : "",
             percent_or_more(after), percent_or_more(found.options.error),
             worst ? ", 95 % at the worst place" : ", rms", plan.reached ? "" : "; not reached");
}

}  // namespace

void print_report(const identify::Report& report, const PrintOptions& how) {
  const config::UnitsToShow asked = si_or_asked(how);
  const double room = how.atmosphere;
  const Retold whole = retold(report.full_scale, report.unit, asked, room);
  fmt::print("{}\n", report.subject);
  const std::string of =
      whole.unit == "1" ? "" : fmt::format(", {:.5g} {}", whole.number, whole.unit);
  fmt::print("errors of the {} in % of {}{}\n", report.quantity, report.full_scale_is, of);
  if (const std::vector<std::string> names = identify::not_pinned(report); !names.empty())
    fmt::print("these data do not pin: {}\n", fmt::join(names, ", "));
  fmt::print("\n");
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

void print_unseen(const identify::Report& report) {
  fmt::print("\nwhat this does not show:\n");
  for (const std::string& text : identify::does_not_show(report)) fmt::print("  {}\n", text);
}

void print_more(const identify::DynamicFound& found, const PrintOptions& how) {
  print_methods(found.result, si_or_asked(how));
}

void print_more(const identify::JointFound& found, const PrintOptions&) {
  print_combinations(found.result);
}

void print_more(const identify::PairFound& found, const PrintOptions& how) {
  print_explained(found.result.report);
  print_stiffness(found.result, si_or_asked(how));
  print_air(found.result);
}

void print_more(const identify::RunFitFound& found, const PrintOptions& how) {
  if (found.score.empty()) return;
  const config::UnitsToShow asked = si_or_asked(how);
  // The units of a protractor and a gauge, where none were chosen.
  const auto shown = [&](const std::string& unit) {
    if (asked.asked) return asked.units.of(unit);
    if (unit == "Pa diff") return units::ShownUnit{"kPa", 1e-3};
    if (unit == "m") return units::ShownUnit{"mm", 1e3};
    if (unit == "N") return units::ShownUnit{"N", 1};
    return units::ShownUnit{unit == "rad" ? "deg" : "deg/s", 180 / std::numbers::pi};
  };
  TextTable table({"score", "", "rms", "", "nrmse", "r", "R2"},
                  {Align::left, Align::left, Align::right, Align::left, Align::right, Align::right,
                   Align::right});
  for (const identify::Report& part : found.score) {
    const units::ShownUnit unit = shown(part.unit);
    const auto add = [&](const std::string& name, const identify::Score& s) {
      table.add({part.quantity, name, fmt::format("{:.4g}", unit.of(s.rmse)), unit.name,
                 digits(s.nrmse, "{:.4f}"), digits(s.correlation, "{:.5f}"),
                 digits(s.explained, "{:.5f}")});
    };
    const auto& parts = part.errors[0].parts;
    for (const identify::PartError& one : parts) add(one.name, one.score);
    if (parts.size() > 1) add(fmt::format("all {}", parts.size()), *part.best().held_out);
  }
  fmt::print("\nopen loop, by the valve commands alone: {}\n{}", found.score[0].held_out_is,
             table.text());
}

void print_more(const identify::GeometryFound& found, const PrintOptions& how) {
  if (found.report) return;
  const config::UnitsToShow asked = si_or_asked(how);
  const std::string unit = asked.asked ? asked.units.of("m").name : "mm";
  fmt::print("thread_length  {}  [17]\nturns          {}  [18]\nshortest       {}  [5], [6]\n",
             config::format_quantity(found.braid.thread_length, "m", unit),
             config::format_number(found.braid.turns),
             config::format_quantity(actuator::shortest_length(found.braid), "m", unit));
}

void print_more(const identify::SensorFound& found, const PrintOptions& how) {
  const identify::Calibration& c = found.calibration;
  if (c.sensors.size() == 1) fmt::print("\n");
  print_table(c, shown_scale(c, found.display, si_or_asked(how)));
}

void print_more(const identify::Checkup& found, const PrintOptions&) {
  print_files(found.recognised.files);
  print_mounts(found.recognised.mounts);
  print_noise(found.recognised.noise);
  print_checks(found.checks);
  print_determined(found.determined);
}

void print_more(const identify::ScaleFound& found, const PrintOptions&) {
  const actuator::Prediction& p = found.actuator.prediction;
  fmt::print("a muscle of {:.4g} mm, like that of {:.4g} mm\n", 1e3 * p.rest_length,
             1e3 * found.from);
  fmt::print("largest force  {:.4g} N at {:.4g} mm and {:.4g} kPa gauge\n", found.largest,
             1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (found.corrected_by != 1)
    fmt::print("its reading    the law times {:.4f}\n", found.corrected_by);
  else
    fmt::print("one reading    --reading \"{:.4g} mm, {:.4g} kPa gauge, FORCE\" corrects it most\n",
               1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (p.inside_95 > 0)
    fmt::print("68 % within    {:.3g} N\n95 % within    {:.3g} N of the law\n",
               actuator::widest_inside_68(p), actuator::widest_inside_95(p));
}

void print_more(const identify::PlanFound& found, const PrintOptions& how) {
  print_plan(found, {units_asked(how.units, units::UnitSet::metric), how.atmosphere});
}

}  // namespace sinew::cli
