#include "sinew/identify/task/found_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/prediction.h"
#include "sinew/config/quantity.h"
#include "sinew/identify/contest/evidence.h"
#include "sinew/report/text/text_table.h"

namespace sinew::identify {

namespace {

using report::TextTable;
using Align = TextTable::Align;
using Shown = TextOptions::Shown;

template <class... Arguments>
void put(std::string& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
}

std::string digits(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

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

// --- what each method adds ---

// Damping by each way of evaluation, compared with the fitted trajectories.
void put_methods(std::string& out, const DynamicResult& found, const config::UnitsToShow& chosen) {
  const units::ShownUnit length =
      chosen.is_requested ? chosen.units.of("m") : units::ShownUnit{"mm", 1e3};
  const units::ShownUnit force = chosen.units.of("N"), damping = chosen.units.of("N s/m");
  // Without a choice of units each column has its own number of decimals.
  const auto in = [&](const units::ShownUnit& unit, double si, int decimals = 4) {
    return chosen.is_requested ? fmt::format("{:.4g}", unit.of(si))
                               : fmt::format("{:.{}f}", unit.of(si), decimals);
  };
  TextTable table(
      {"file", "method", "Q [" + length.name + "]", "friction at rest [" + force.name + "]",
       "c [" + damping.name + "]", "zeta [53]"},
      {Align::left, Align::left, Align::right, Align::right, Align::right, Align::right});
  const auto row = [&](const DecaySummary& s, const char* method, const Damping& d) {
    table.add({s.file, method, in(length, d.coulomb_length, 5),
               in(force, d.coulomb_length * s.stiffness), in(damping, d.viscous),
               fmt::format("{:.4f}", d.ratio)});
  };
  for (const DecaySummary& s : found.records) {
    if (s.printed) row(s, "two points, [45] as printed", *s.printed);
    if (s.exact) row(s, "two points, exact", *s.exact);
    row(s, "all turns", s.all.damping);
    table.add({s.file, "trajectory, " + found.report.best().model,
               in(length, found.loss.coulomb_length, 5), in(force, s.friction),
               in(damping, found.loss.viscous), ""});
  }
  put(out, "\n{}", table.text());
  for (const DecaySummary& s : found.records)
    if (!s.exact) put(out, "no two points: {}\n", s.why_not);
}

void put_combinations(std::string& out, const JointResult& found) {
  TextTable table({"what the data determine, best first", "95 %"},
                  {TextTable::Align::left, TextTable::Align::right});
  for (const Combination& c : found.combinations)
    table.add({c.text, std::isfinite(c.relative_error)
                           ? fmt::format("+- {:.2g} %", 100 * c.relative_error)
                           : "undetermined"});
  put(out, "\n{}", table.text());
}

// Prints the share of the variance that each law explains, and its scores on the held-out rows.
void put_explained(std::string& out, const Report& report) {
  TextTable table({"model", "R2", "held out", "nrmse", "r"},
                  {Align::left, Align::right, Align::right, Align::right, Align::right});
  for (const Fit& f : report.fits) {
    if (!f.refused.empty()) continue;
    const Score unseen = f.held_out.value_or(Score{});
    table.add({f.model, fmt::format("{:.4f}", f.fit.explained), digits(unseen.explained, "{:.4f}"),
               digits(unseen.nrmse, "{:.4f}"), digits(unseen.correlation, "{:.4f}")});
  }
  put(out, "\n{}", table.text());
}

void put_stiffness(std::string& out, const PairResult& found, const config::UnitsToShow& chosen) {
  const char* unit = found.rotary ? "N m/rad" : "N/m";
  const units::ShownUnit shown = chosen.units.of(unit);
  const PairStiffness& s = found.stiffness;
  put(out, "\nstiffness, springs and trapped air together: {:.5g} +- {:.2g} {}", shown.of(s.value),
      shown.of(s.uncertainty), shown.name);
  if (std::isfinite(s.air)) put(out, ", {:.4g} {} by the air", shown.of(s.air), shown.name);
  put(out, "\n");
}

// Law and parameters of the trapped air.
void put_air(std::string& out, const PairResult& found) {
  if (!found.air) return;
  const PairAir& air = *found.air;
  const Fit& best = air.report.best();
  put(out, "\ntrapped air, {}: {}; {:.2f} % of {}\n", best.model, best.law, best.fit.rmse_percent,
      air.report.full_scale_is);
  TextTable table({"parameter", "value", "unit", "95 %"},
                  {Align::left, Align::right, Align::left, Align::left});
  for (const Estimate& e : best.parameters)
    table.add({e.name, fmt::format("{:.6g}", e.value), e.unit,
               !e.free                  ? e.known
               : e.at_bound             ? "at the bound of its range"
               : !std::isfinite(e.high) ? "not identifiable"
                                        : fmt::format("+- {:.2g}", 0.5 * (e.high - e.low))});
  put(out, "{}", table.text());
}

std::string percent(double share) { return digits(100 * share, "{:.2f} %"); }

// Returns the unit of a scale: the chosen one, else that of the known values.
std::string shown_scale(const Calibration& c, const std::string& display,
                        const config::UnitsToShow& chosen) {
  if (!chosen.is_requested) return scale_unit_for(c, display);
  const std::string unit = scale_unit(c);
  if (units::read_quantity_unit(unit)) return chosen.units.of(unit).name;
  const auto given = units::read_quantity_unit(display);
  return scale_unit_for(c, given ? chosen.units.of(given->stored).name : display);
}

// Table 4-1, with model, errors and noise of each sensor.
void put_table(std::string& out, const Calibration& c, const std::string& shown) {
  using enum TextTable::Align;
  const std::string unit = scale_unit(c);
  TextTable table({"sensor", "scale [" + shown + "]", "95 %", "at rest [V]", "model", "held out",
                   "linearity", "hysteresis", "noise [mV]", "step [mV]", "error from average"},
                  {left, right, right, right, left, right, right, right, right, right, right});
  const auto add = [&](const std::string& name, double sensitivity, auto... rest) {
    const double scale = config::convert(scale_of(c, sensitivity), unit, shown);
    table.add({name, digits(scale, "{:.5g}"), rest...});
  };
  for (const SensorResult& r : c.sensors) {
    const Fit& best = r.report.best();
    add(r.name, r.sensitivity,
        digits(config::convert(scale_uncertainty(c, r), unit, shown), "+- {:.2g}"),
        digits(r.at_rest, "{:.4f}"), best.model,
        best.held_out ? percent(best.held_out->rmse_percent / 100) : "-", percent(r.linearity),
        percent(r.hysteresis), digits(1000 * r.noise, "{:.2g}"), digits(1000 * r.step, "{:.3g}"),
        c.sensors.size() > 1 ? digits(100 * r.deviation, "{:+.1f} %") : "-");
  }
  if (c.sensors.size() > 1) add("average", c.average);
  put(out, "{}", table.text());
}

// --- tables before a fit, and plans ---

void put_files(std::string& out, const std::vector<RecognisedFile>& files, std::size_t width) {
  TextTable table({"file", "rows", "is", "columns"},
                  {TextTable::Align::left, TextTable::Align::right});
  for (const RecognisedFile& f : files) {
    std::string columns;
    for (const RecognisedColumn& c : f.columns)
      columns +=
          fmt::format("{}{} {} … {}", columns.empty() ? "" : ", ", c.name, c.lowest, c.highest);
    table.add(
        {f.file, std::to_string(f.rows),
         f.is_recording ? fmt::format("a recording, {:.3g} % settled", 100 * f.settled) : "a table",
         columns});
  }
  put(out, "{}\n", table.text_within(width));
}

void put_mounts(std::string& out, const std::vector<RecognisedMount>& mounts) {
  using enum TextTable::Align;
  TextTable table({"muscle [mm]", "mount [mm]", "points", "pressures", "from [kPa]", "to [kPa]",
                   "largest force [N]", "branches"},
                  {right, right, right, right, right, right, right, left});
  for (const RecognisedMount& m : mounts)
    table.add({m.rest_length > 0 ? fmt::format("{:.4g}", 1e3 * m.rest_length) : "?",
               fmt::format("{:.4g}", 1e3 * m.length),
               m.held_out > 0 ? fmt::format("{} + {} held out", m.points, m.held_out)
                              : std::to_string(m.points),
               std::to_string(m.pressures), fmt::format("{:.4g}", m.lowest / 1e3),
               fmt::format("{:.4g}", m.highest / 1e3), fmt::format("{:.4g}", m.strongest),
               m.branches.empty() ? "unknown" : m.branches});
  if (!table.empty()) put(out, "{}\n", table.text());
}

void put_noise(std::string& out, const ForceNoise& noise) {
  if (noise.readings == 0)
    put(out, "noise of force: unknown, as no reading is repeated\n\n");
  else
    put(out, "noise of force: {:.2g} N, {:.2g} % of the largest, from {} {}\n\n", noise.deviation,
        100 * noise.share, noise.readings, noise.from);
}

void put_checks(std::string& out, const std::vector<Check>& checks) {
  for (const Check& c : checks) {
    put(out, "{:<6}  {:<17}  {}\n", word(c.light), c.name, c.evidence);
    if (!c.advice.empty()) put(out, "{:27}{}\n", "", c.advice);
  }
}

void put_determined(std::string& out, const DeterminedLaw& law) {
  if (!law.refused.empty()) {
    put(out, "\nwhat a fit could determine: not evaluated, {}\n", law.refused);
    return;
  }
  TextTable table({"a fit could determine", "known", "to know more, measure"});
  for (const Determined& d : law.parameters) table.add({d.name, d.words, d.advice});
  put(out, "\n{}by the richest law, {}: {}\n", table.text(), law.model, law.law);
}

// Above 100 % nothing is known, and the number has no meaning.
std::string percent_or_more(double share) {
  return share > 1 ? "> 100 %" : fmt::format("{:.2g} %", 100 * share);
}

// Numbers in the units that were chosen; else in those of a ruler and a regulator.
struct PlanUnits {
  const TextOptions& how;

  Shown of(double si, const std::string& unit, const Shown& otherwise) const {
    return how.units.is_requested ? how.shown(si, unit) : otherwise;
  }
  Shown length(double x) const { return of(x, "m", {1e3 * x, "mm", 1e3}); }
  Shown pressure(double x) const { return of(x, "Pa gauge", {1e-3 * x, "kPa gauge", 1e-3}); }
  Shown force(double x) const { return of(x, "N", {x, "N", 1}); }
};

std::string text_of(const Shown& r) { return fmt::format("{:.4g} {}", r.number, r.unit); }

std::string numbers_of(const std::vector<double>& pressures, const PlanUnits& units) {
  std::vector<double> out;
  for (const double p : pressures) out.push_back(units.pressure(p).number);
  return fmt::format("{:.4g}", fmt::join(out, " "));
}

void put_mounts(std::string& out, const PlanFound& found, const PlanUnits& units) {
  using enum TextTable::Align;
  const std::string over = fmt::format("up and down over [{}]", units.pressure(0).unit);
  TextTable table({"mount", "length", over, "readings", "minutes", "error rms", "95 % at worst"},
                  {right, right, left, right, right, right, right});
  const MeasurementPlan& plan = found.plan;
  table.add({found.measured > 0 ? "before" : "none", "", "", std::to_string(found.measured), "0",
             percent_or_more(plan.before.rms), percent_or_more(plan.before.half_width)});
  double time = 0;
  for (std::size_t i = 0; i < plan.mounts.size(); ++i) {
    const PlannedMount& m = plan.mounts[i];
    time += m.time;
    table.add({std::to_string(i + 1), text_of(units.length(m.length)),
               numbers_of(m.pressures, units), std::to_string(m.readings()),
               fmt::format("{:.0f}", time / 60), percent_or_more(m.after.rms),
               percent_or_more(m.after.half_width)});
  }
  put(out, "{}", table.text());
}

void put_plan(std::string& out, const PlanFound& found, const PlanUnits& units) {
  const MeasurementPlan& plan = found.plan;
  const PlanRegion& r = plan.region;
  const bool worst = found.options.criterion == PlanCriterion::worst;
  put(out, "plan for {}\n", found.subject);
  put(out, "errors of the force in % of the largest, {}, over {:.4g} to {} and {:.4g} to {}\n\n",
      text_of(units.force(found.muscle.scales.full_scale)), units.length(r.shortest).number,
      text_of(units.length(r.longest)), units.pressure(r.lowest).number,
      text_of(units.pressure(r.highest)));
  put_mounts(out, found, units);
  if (plan.mounts.empty()) {
    put(out, "\nnothing more to measure: {} was wanted\n", percent_or_more(found.options.error));
    return;
  }
  const double after = plan.after().of(found.options.criterion);
  const double before = plan.before.of(found.options.criterion);
  put(out, "\n{} {} and {} readings in {:.0f} minutes: {}{} ({} wanted{}{})\n", plan.mounts.size(),
      plan.mounts.size() == 1 ? "mount" : "mounts", plan.readings(), plan.time() / 60,
      found.measured > 0 ? fmt::format("{} -> ", percent_or_more(before)) : "",
      percent_or_more(after), percent_or_more(found.options.error),
      worst ? ", 95 % at the worst place" : ", rms", plan.reached ? "" : "; not reached");
}

}  // namespace

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

void put_unseen(std::string& out, const Report& report) {
  put(out, "\nwhat this does not show:\n");
  for (const std::string& text : does_not_show(report)) put(out, "  {}\n", text);
}

void put_more(std::string& out, const DynamicFound& found, const TextOptions& how) {
  put_methods(out, found.result, how.units);
}

void put_more(std::string& out, const JointFound& found, const TextOptions&) {
  put_combinations(out, found.result);
}

void put_more(std::string& out, const PairFound& found, const TextOptions& how) {
  put_explained(out, found.result.report);
  put_stiffness(out, found.result, how.units);
  put_air(out, found.result);
}

void put_more(std::string& out, const RunFitFound& found, const TextOptions& how) {
  if (found.score.empty()) return;
  const config::UnitsToShow chosen = how.units;
  // Without a choice, the units of a protractor and a gauge.
  const auto shown = [&](const std::string& unit) {
    if (chosen.is_requested) return chosen.units.of(unit);
    if (unit == "Pa diff") return units::ShownUnit{"kPa", 1e-3};
    if (unit == "m") return units::ShownUnit{"mm", 1e3};
    if (unit == "N") return units::ShownUnit{"N", 1};
    return units::ShownUnit{unit == "rad" ? "deg" : "deg/s", 180 / std::numbers::pi};
  };
  TextTable table({"score", "", "rms", "", "nrmse", "r", "R2"},
                  {Align::left, Align::left, Align::right, Align::left, Align::right, Align::right,
                   Align::right});
  for (const Report& part : found.score) {
    const units::ShownUnit unit = shown(part.unit);
    const auto add = [&](const std::string& name, const Score& s) {
      table.add({part.quantity, name, fmt::format("{:.4g}", unit.of(s.rmse)), unit.name,
                 digits(s.nrmse, "{:.4f}"), digits(s.correlation, "{:.5f}"),
                 digits(s.explained, "{:.5f}")});
    };
    const auto& parts = part.errors[0].parts;
    for (const PartError& one : parts) add(one.name, one.score);
    if (parts.size() > 1) add(fmt::format("all {}", parts.size()), *part.best().held_out);
  }
  put(out, "\nopen loop, by the valve commands alone: {}\n{}", found.score[0].held_out_is,
      table.text());
}

void put_more(std::string& out, const GeometryFound& found, const TextOptions& how) {
  if (found.report) return;
  const config::UnitsToShow chosen = how.units;
  const std::string unit = chosen.is_requested ? chosen.units.of("m").name : "mm";
  put(out, "thread_length  {}  [17]\nturns          {}  [18]\nshortest       {}  [5], [6]\n",
      config::format_quantity(found.braid.thread_length, "m", unit),
      config::format_number(found.braid.turns),
      config::format_quantity(actuator::shortest_length(found.braid), "m", unit));
}

void put_more(std::string& out, const SensorFound& found, const TextOptions& how) {
  const Calibration& c = found.calibration;
  if (c.sensors.size() == 1) put(out, "\n");
  put_table(out, c, shown_scale(c, found.display, how.units));
}

void put_more(std::string& out, const Checkup& found, const TextOptions& how) {
  put_files(out, found.recognised.files, how.width);
  put_mounts(out, found.recognised.mounts);
  put_noise(out, found.recognised.noise);
  put_checks(out, found.checks);
  put_determined(out, found.determined);
}

void put_more(std::string& out, const ScaleFound& found, const TextOptions&) {
  const actuator::Prediction& p = found.actuator.prediction;
  put(out, "a muscle of {:.4g} mm, like that of {:.4g} mm\n", 1e3 * p.rest_length,
      1e3 * found.from);
  put(out, "largest force  {:.4g} N at {:.4g} mm and {:.4g} kPa gauge\n", found.largest,
      1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (found.corrected_by != 1)
    put(out, "its reading    the law times {:.4f}\n", found.corrected_by);
  else
    put(out, "one reading    reading=\"{:.4g} mm, {:.4g} kPa gauge, FORCE\" corrects it most\n",
        1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (p.inside_95 > 0)
    put(out, "68 % within    {:.3g} N\n95 % within    {:.3g} N of the law\n",
        actuator::widest_inside_68(p), actuator::widest_inside_95(p));
}

void put_more(std::string& out, const PlanFound& found, const TextOptions& how) {
  put_plan(out, found, {how});
}

TextOptions::Shown TextOptions::shown(double number, const std::string& unit) const {
  const auto held = units.is_requested ? units::read_quantity_unit(unit, atmosphere) : std::nullopt;
  if (!held) return {number, unit, 1};
  const units::ShownUnit to =
      units.units.of(held->stored, units::ShownUnits::unknown_size, atmosphere);
  return {to.of(held->unit.back(number)), to.name, to.scale / held->unit.scale};
}

}  // namespace sinew::identify
