// Fits all models of a filling, chooses one, and determines C/V without V.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/valve/added_volume.h"
#include "sinew/identify/valve/fill.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

// Returns whether a parameter belongs to this record, not to the valve and its chamber.
bool of_the_record(std::string_view name) {
  return name == "start_pressure" || name == "opening_instant";
}

// Scores the model on another record: model values are kept, start pressure and opening instant are
// fitted.
Score score_other(const FillModel& model, const Curve& other, const ValveOptions& options,
                  const Solution& found) {
  const std::vector<FreeValue> free = free_values(model, other, options);
  std::vector<double> values;
  std::vector<Parameter> record;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Parameter& p = free[i].parameter;
    values.push_back(of_the_record(p.name) ? p.start : found[p.name].value);
    if (!of_the_record(p.name)) continue;
    record.push_back(p);
    index.push_back(i);
  }
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < p.size(); ++i) values[index[i]] = p[i];
    if (!predict_fill(model, other, options, free, values, r)) return false;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= other.pressure[i];
    return true;
  };
  return score(least_squares(residuals, other.time.size(), record).residuals, other.range());
}

// Notes pairs of the valve's parameters that the curve hardly separates.
void add_correlation_notes(const Solution& s, Fit& fit) {
  const std::size_t n = s.estimates.size();
  const auto cov = [&](std::size_t i, std::size_t k) { return s.covariance[i * n + k]; };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      if (of_the_record(s.estimates[i].name) || of_the_record(s.estimates[k].name)) continue;
      const double r = cov(i, k) / std::sqrt(cov(i, i) * cov(k, k));
      if (std::isfinite(r) && std::abs(r) > 0.95)
        fit.notes.push_back(fmt::format("{} and {} can hardly be separated: correlation {:.3f}",
                                        s.estimates[i].name, s.estimates[k].name, r));
    }
  for (const std::string& direction : s.undetermined)
    fit.notes.push_back("the curve does not determine " + direction);
}

// Adds notes to the fit of a model, and its score on another record, if not null.
void complete(const FillModel& model, const Curve* other, const ValveOptions& options, Fit& fit) {
  if (!fit.refused.empty()) return;
  const Solution& s = fit.refit->solution;
  fit.parameters.front().identifiable &= half_of(fit.parameters.front()) <= well_known;
  add_correlation_notes(s, fit);
  if (!other) return;
  try {
    fit.held_out = score_other(model, *other, options, s);
  } catch (const Refusal& refusal) {
    fit.refused = refusal.what();
  }
}

// Adds conductance or volume, from C/V and the other of the two.
void divide(const FillModel& model, const ValveOptions& options, Fit& fit) {
  Estimate& k = fit.parameters.front();
  if (options.volume) {
    const Estimate c = scaled(k, "sonic_conductance", "m3/(s Pa)", *options.volume);
    if (model.flow == gas::Flow::Law::iso6358)
      k = c;
    else
      k = scaled(c, "area", "m2", gas::effective_area_of(1.0, options.air));
  } else if (options.conductance) {
    Estimate v = k;
    v.name = "volume";
    v.unit = "m3";
    v.value = *options.conductance / k.value;
    v.standard_error = k.standard_error * v.value / k.value;
    if (v.profile) std::ranges::reverse(v.profile->error);
    v.low = *options.conductance / k.high;
    v.high = k.low > 0 ? *options.conductance / k.low : unbounded;
    k = v;
  }
}

// Notes the exponent from the variant with a free one, if the chosen model has it fixed.
void add_exponent_note(Report& report) {
  const std::span<const FillModel> models = fill_models();
  const FillModel& chosen = models[report.chosen];
  if (chosen.exponent == 0 || !report.fits[report.chosen].refused.empty()) return;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const FillModel& m = models[i];
    if (m.shape != chosen.shape || m.flow != chosen.flow || m.exponent != 0 || m.leak) continue;
    if (const Estimate* e = report.fits[i].estimate("polytropic_exponent"))
      report.fits[report.chosen].notes.push_back(
          fmt::format("polytropic_exponent is {:g} by the model; fitted it is {:.3f}{}",
                      chosen.exponent, e->value,
                      e->at_bound ? ", the bound of its range"
                                  : fmt::format(" +- {:.2g}", 0.5 * (e->high - e->low))));
  }
}

// Adds notes to the report. `alone`: C/V by the chosen model, not widened to other models.
void describe(const Curve& c, const ValveOptions& options, const Estimate& alone,
              ValveResult& out) {
  Report& r = out.report;
  r.notes.insert(r.notes.end(), c.notes.begin(), c.notes.end());
  if (!options.port)
    r.notes.push_back(fmt::format(
        "the pressure on the valve's other side is fitted as a constant, {}; a supply that droops "
        "or an unknown zero of the sensor has the effect of another b or n",
        c.fills() ? "for a supply" : "for a room"));
  if (options.volume) r.notes.emplace_back("the volume is taken as exact");
  const Estimate& k = r.best().parameters.front();
  if (!options.volume && !options.conductance && !options.per_volume) {
    const std::vector<std::string> ways = ways_to_separate(half_of(alone), half_of(k));
    r.notes.insert(r.notes.end(), ways.begin(), ways.end());
    out.refused = fmt::format(
        "sonic conductance: found C/V = {} alone; expected the volume too: one curve does "
        "not separate C from V; try volume=\"0.5 L\", conductance=C in place of the volume, "
        "added_volume=\"0 L,0.5 L\" with a second file, or per_volume=true where C/V is enough",
        units::format_quantity(k.value, "1/(s Pa)", "1/(s bar)", 4));
  }
  if (half_of(k) <= well_known) return;
  out.refused += fmt::format(
      "{}{}: found an interval of +- {:.0f} %; expected at most +- {:.0f} %; try {}{}a rigid "
      "chamber "
      "near the valve, less noise",
      out.refused.empty() ? "" : "\n", k.name, 100 * half_of(k), 100 * well_known,
      options.port ? "" : "port=PRESSURE on the valve's other side, ",
      options.exponent ? "" : "exponent=N where it is known (1 in a chamber full of wire wool), ");
}

}  // namespace

void refuse_unsettled(const Measured& data, const Curve& c, const ValveOptions& options) {
  if (c.settled || options.port) return;
  throw Refusal(data.file + ": pressure",
                fmt::format("one that still moves at the end, at {}",
                            units::format_quantity(c.pressure.back(), "Pa abs", "kPa abs", 4)),
                "one that settles at the pressure on the valve's other side",
                "a longer record, or port=PRESSURE");
}

void refuse_poor_fit(const Measured& data, const Report& report, double worst) {
  if (report.best().fit.rmse_percent <= worst) return;
  throw Refusal(
      data.file,
      fmt::format("{:.2g} % of the range left by the best model, {}",
                  report.best().fit.rmse_percent, report.best().model),
      fmt::format("at most {:g} %: one valve, one constant port pressure, one chamber behind it",
                  worst),
      "a rigid chamber near the valve, the pressure of the supply recorded with it");
}

ValveResult identify_fill(const Measured& data, const ValveOptions& options,
                          const Measured* other) {
  const Curve c = curve_of(data);
  std::optional<Curve> unseen;
  if (other) unseen = curve_of(*other);
  refuse_unsettled(data, c, options);

  ValveResult out = before(options);
  Report& report = out.report;
  report = fill_contest(c, options, fill_models(), other != nullptr);
  report.set_subject(
      fmt::format("{} of a chamber through a valve", c.fills() ? "filling" : "venting"), "pressure",
      "Pa diff", "the pressure's range");
  report.not_shown = {"the flow in the other direction, and how fast the valve switches"};
  report.held_out_is = other ? other->file + ", with its own start and opening instant"
                             : "every second tenth of the way, 10 to 20 % up to 70 to 80 %";
  for (std::size_t i = 0; i < report.fits.size(); ++i)
    complete(fill_models()[i], unseen ? &*unseen : nullptr, options, report.fits[i]);
  const std::vector<FillSquares> squares = squares_of(report);
  reach_for_fixed(squares, report);
  refuse_undetermined_models(report, options.worst_fit);
  report.rows = {
      .x = "time", .x_unit = "s", .unit = "Pa abs", .at = c.time, .measured = c.pressure};
  conclude(report, 0.1, unresolved_error);
  const Estimate alone = report.best().parameters.front();
  if (const std::string names = reach_over_models(squares, 1, report); !names.empty())
    report.fits[report.chosen].notes.push_back(
        "the curve does not distinguish the chamber from others, and the interval of C/V covers "
        "them: " +
        names);
  for (std::size_t i = 0; i < report.fits.size(); ++i)
    if (report.fits[i].refused.empty()) divide(fill_models()[i], options, report.fits[i]);
  refuse_poor_fit(data, report, options.worst_fit);
  add_exponent_note(report);
  if (options.volume)
    replace_flow(fill_models()[report.chosen].flow,
                 "sinew identify valve " + data.file + ", model " + report.best().model, out);
  describe(c, options, alone, out);
  return out;
}

}  // namespace sinew::identify
