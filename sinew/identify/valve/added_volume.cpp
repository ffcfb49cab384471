#include "sinew/identify/valve/added_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"
#include "sinew/identify/valve/fill.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

constexpr double least_difference = 0.02;  // share of the larger added volume
constexpr double far_worse = 2;  // times the sum of squares of the best law, for each curve

// Returns whether the parameter belongs to one curve, not to valve and chamber.
bool is_of_one_fill(std::string_view name) {
  return name == "start_pressure" || name == "opening_instant" || name == "port_pressure";
}

// A curve, with the indices of its parameters in the joint problem.
struct JointCurve {
  const Curve* curve;
  double added = 0;
  std::vector<FreeValue> free;     // the first is C/V
  std::vector<std::size_t> place;  // index of each in the joint parameters; unused for C/V
};

// All curves, fitted together with one model.
class JointFill {
 public:
  // `separate` are the fits of the single curves.
  JointFill(const FillModel& model, const ValveOptions& options, std::span<const AddedFill> fills,
            std::span<const Curve> curves, std::span<const Fit> separate)
      : model_(model), options_(options) {
    std::vector<double> inverse, added;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      curves_.push_back({&curves[i], fills[i].added, free_values(model, curves[i], options), {}});
      inverse.push_back(1 / separate[i].parameters.front().value);
      added.push_back(fills[i].added);
    }
    // The straight line of 1/k over dV: 1/k = (V + dV)/C.
    const StraightLine line = line_through(added, inverse);
    const double conductance = line.xx / line.xy, volume = line.y * line.xx / line.xy - line.x;
    const double most = *std::ranges::max_element(added);
    if (!(conductance > 0))
      throw Refusal("added_volume", "a chamber that fills no slower with more volume joined to it",
                    "one that does", "the volumes, they may be exchanged between the files");
    const double start = std::max(volume, 1e-3 * most), c = conductance;
    parameters_ = {{"sonic_conductance", "m3/(s Pa)", c, 1e-2 * c, 100 * c, c},
                   {"volume", "m3", start, 1e-6 * most, 1e3 * (start + most), start}};
    for (std::size_t i = 0; i < curves_.size(); ++i) place(curves_[i], separate[i]);
  }

  const std::vector<Parameter>& parameters() const { return parameters_; }

  bool operator()(std::span<const double> p, std::span<double> pressure) const {
    std::size_t at = 0;
    for (const JointCurve& c : curves_) {
      std::vector<double> values{p[0] / (p[1] + c.added)};
      for (std::size_t i = 1; i < c.free.size(); ++i) values.push_back(p[c.place[i]]);
      const std::size_t rows = c.curve->time.size();
      if (!predict_fill(model_, *c.curve, options_, c.free, values, pressure.subspan(at, rows)))
        return false;
      at += rows;
    }
    return true;
  }

 private:
  // Adds a curve's own parameters; shared ones are added with the first curve's values.
  void place(JointCurve& c, const Fit& separate) {
    const bool first = &c == &curves_.front();
    for (std::size_t i = 0; i < c.free.size(); ++i) {
      Parameter p = c.free[i].parameter;
      c.place.push_back(0);
      if (i == 0) continue;
      const auto known = std::ranges::find(parameters_, p.name, &Parameter::name);
      if (!first && !is_of_one_fill(p.name) && known != parameters_.end()) {
        c.place.back() = static_cast<std::size_t>(known - parameters_.begin());
        continue;
      }
      p.start = std::clamp(separate.parameters[i].value, p.low, p.high);
      if (is_of_one_fill(p.name)) p.name += fmt::format("_{}", &c - curves_.data() + 1);
      c.place.back() = parameters_.size();
      parameters_.push_back(p);
    }
  }

  const FillModel& model_;
  const ValveOptions& options_;
  std::vector<JointCurve> curves_;
  std::vector<Parameter> parameters_;
};

// Fits of a model to the single curves; `refused` if one of them is.
struct SeparateFits {
  std::vector<Fit> curves;
  std::string refused;
  double squares = 0;

  // Returns the root mean square score over curves, each in % of its own range.
  Score score() const {
    Score out;
    double sum = 0;
    for (const Fit& fit : curves) {
      const Score& s = *fit.held_out;
      out.points += s.points;
      sum += s.rmse_percent * s.rmse_percent / static_cast<double>(curves.size());
      out.max_percent = std::max(out.max_percent, s.max_percent);
      out.rmse = std::max(out.rmse, s.rmse);
      out.max = std::max(out.max, s.max);
    }
    out.rmse_percent = std::sqrt(sum);
    return out;
  }
};

// Returns the separate fits of each model.
std::vector<SeparateFits> fit_separately(std::span<const Curve> curves, const ValveOptions& options,
                                         std::span<const FillModel> models) {
  std::vector<SeparateFits> out(models.size());
  for (const Curve& c : curves) {
    const Report report = fill_contest(c, options, models);
    const std::vector<FillSquares> squares = squares_of(report);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].curves.push_back(report.fits[i]);
      out[i].squares += squares[i].found;
      if (out[i].refused.empty()) out[i].refused = report.fits[i].refused;
    }
  }
  return out;
}

// Refuses laws whose single fits are far worse than those of another, to save their joint fits.
void leave_out_far_worse(std::vector<SeparateFits>& separate) {
  double least = unbounded;
  for (const SeparateFits& a : separate)
    if (a.refused.empty()) least = std::min(least, a.squares);
  for (SeparateFits& a : separate)
    if (a.refused.empty() && a.squares > far_worse * least)
      a.refused = fmt::format("leaves {:.2g} times what the best law leaves of each curve",
                              std::sqrt(a.squares / least));
}

Candidate joined(const FillModel& model, std::span<const AddedFill> fills,
                 std::span<const Curve> curves, const SeparateFits& separate,
                 const ValveOptions& options) {
  Candidate out{.model = std::string(model.name),
                .law = std::string(model.law),
                .source = std::string(model.source),
                .options = fill_options,
                .may_be_at_bounds = true,
                .refused = separate.refused};
  if (!out.refused.empty()) return out;
  try {
    const JointFill fill(model, options, fills, curves, separate.curves);
    out.parameters = fill.parameters();
    out.predict = fill;
  } catch (const Refusal& refusal) {
    out.refused = refusal.what();
  }
  out.finish = [](const FitProblem&, std::span<const Solution>, Solution& s) {
    for (const Estimate& e : std::span(s.estimates).first(2))
      if (e.at_bound || !std::isfinite(e.high))
        throw Refusal(e.name, "nothing in the curves that determines it", "an interval",
                      "a larger added volume");
  };
  return out;
}

void set_separated(const FillModel& model, const ValveOptions& options, const std::string& source,
                   ValveResult& out) {
  Fit& fit = out.report.fits[out.report.chosen];
  for (Estimate& e : fit.parameters)
    if (e.name == "sonic_conductance" && model.flow != gas::Flow::Law::iso6358)
      e = scaled(e, "area", "m2", gas::effective_area_of(1.0, options.air));
  replace_flow(model.flow, source, out);
  for (const Estimate& e : std::span(fit.parameters).first(2))
    if (half_of(e) > well_known)
      out.refused += fmt::format(
          "{}{}: found an interval of +- {:.0f} %; expected at most +- {:.0f} %; try a larger "
          "added volume, {}{}less noise",
          out.refused.empty() ? "" : "\n", e.name, 100 * half_of(e), 100 * well_known,
          options.port ? "" : "port=PRESSURE on the valve's other side, ",
          options.exponent ? "" : "exponent=N where it is known, ");
}

void refuse_same_volumes(std::span<const AddedFill> fills) {
  const auto [least, most] = std::ranges::minmax_element(fills, {}, &AddedFill::added);
  if (fills.size() >= 2 && most->added - least->added > least_difference * most->added) return;
  throw Refusal(
      "added_volume",
      fills.size() < 2 ? "one filling"
                       : fmt::format("{} fillings with the same volume joined, {}", fills.size(),
                                     units::format_quantity(most->added, "m3", "L", 4)),
      "two at least, with different ones: 1/k = (V + added)/C", "added_volume=\"0 L,0.5 L\"");
}

}  // namespace

Separation expected_separation(double half, double ratio) {
  // 1/k_1 = 1 and 1/k_2 = 1 + ratio, in units of V/C, with relative uncertainties `half`.
  const double second = 1 + ratio;
  return {half * std::sqrt(1 + second * second) / ratio, half * std::sqrt(2.0) * second / ratio};
}

std::vector<AddedFill> fills_by_column(const Measured& data) {
  if (!data.has("added_volume"))
    throw Refusal(data.file, "no column added_volume", "one, or the volume of this file",
                  "names.added_volume=NAME, or added_volume=\"0 L,0.5 L\"");
  std::vector<double> values = data["added_volume"];
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<AddedFill> out;
  for (const double value : values) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < data.rows(); ++i)
      if (data["added_volume"][i] == value) rows.push_back(i);
    out.push_back({data.subset(rows), value});
  }
  return out;
}

void fit_added(std::span<const AddedFill> fills, std::span<const Curve> curves,
               const ValveOptions& options, Report& report, std::span<const FillModel> models) {
  std::vector<SeparateFits> separate = fit_separately(curves, options, models);
  leave_out_far_worse(separate);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < separate.size(); ++i)
    candidates.push_back(joined(models[i], fills, curves, separate[i], options));
  Trial trial;
  for (const Curve& c : curves)
    trial.measured.insert(trial.measured.end(), c.pressure.begin(), c.pressure.end());
  fit_candidates(std::move(candidates), trial, report);
  for (std::size_t i = 0; i < separate.size(); ++i)
    if (report.fits[i].refused.empty()) report.fits[i].held_out = separate[i].score();
}

ValveResult identify_added(std::span<const AddedFill> fills, const ValveOptions& options) {
  refuse_same_volumes(fills);
  std::vector<Curve> curves;
  ValveResult out = before(options);
  Report& report = out.report;
  report.set_subject(
      fmt::format("{} fillings of a chamber with known volumes joined to it", fills.size()),
      "pressure", "Pa diff", "the pressure's largest range");
  report.held_out_is = "every second tenth of the way of each curve, by a fit to that curve alone";
  report.not_shown = {"the flow in the other direction, and how fast the valve switches"};
  report.rows = {.x = "time", .x_unit = "s", .unit = "Pa abs"};
  for (const AddedFill& fill : fills) {
    const Curve& c = curves.emplace_back(curve_of(fill.data));
    refuse_unsettled(fill.data, c, options);
    report.full_scale = std::max(report.full_scale, c.range());
    report.notes.insert(report.notes.end(), c.notes.begin(), c.notes.end());
    report.rows.add(c.time, c.pressure,
                    units::format_quantity(fill.added, "m3", "L", 4) + " joined");
  }
  fit_added(fills, curves, options, report);
  const std::vector<FillSquares> squares = squares_of(report);
  conclude(report, 0.1, unresolved_error);
  refuse_poor_fit(fills.front().data, report, options.worst_fit);
  if (const std::string names = reach_over_models(squares, 2, report); !names.empty())
    report.fits[report.chosen].notes.push_back(
        "the curves do not distinguish the chamber from others, whose values the intervals "
        "cover: " +
        names);
  report.notes.emplace_back("the volumes that were joined are taken as exact");
  set_separated(fill_models()[report.chosen], options,
                "sinew identify valve " + fills.front().data.file + " and others", out);
  return out;
}

std::vector<std::string> ways_to_separate(double half, double over_models) {
  const auto percent = [](double share) { return fmt::format("{:.2g} %", 100 * share); };
  const Separation equal = expected_separation(half, 1), fifth = expected_separation(half, 0.2);
  std::vector<std::string> out;
  out.push_back(fmt::format(
      "C and V apart: fill once more with a known volume joined, added_volume=\"0 L,0.5 L\" with "
      "both files. As these data are, with as much volume again C would be known to +- {} and V to "
      "+- {}, with a fifth as much to +- {} and +- {}.",
      percent(equal.conductance), percent(equal.volume), percent(fifth.conductance),
      percent(fifth.volume)));
  const double water = std::hypot(half, 0.005), meter = std::hypot(half, 0.02);
  out.push_back(fmt::format(
      "Or weigh the chamber full of water, to 0.5 %: volume=V gives C to +- {}. Or a flow meter at "
      "one choked flow, to 2 %: conductance=C gives V to +- {}.",
      percent(water), percent(meter)));
  if (over_models > 1.5 * half)
    out.push_back(fmt::format(
        "What the chamber may be otherwise, an exponent above all, leaves C/V open by +- {} "
        "in addition. It moves both fillings alike: it stays in C, and not in a volume from two "
        "fillings.",
        percent(over_models)));
  return out;
}

}  // namespace sinew::identify
