#include "sinew/identify/valve/added_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/quantity.h"
#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/valve/fill.h"
#include "sinew/identify/valve/fill_trust.h"

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
  Curve curve;
  double added = 0;
  std::vector<FreeValue> free;     // the first is C/V
  std::vector<std::size_t> place;  // index of each in the joint parameters; unused for C/V
};

// Straight line of 1/k over dV: 1/k = (V + dV)/C.
struct ChamberLine {
  double conductance = 0, volume = 0;
};
ChamberLine chamber_line(std::span<const double> inverse, std::span<const double> added) {
  const auto n = static_cast<double>(inverse.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    x += added[i] / n;
    y += inverse[i] / n;
  }
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    xx += (added[i] - x) * (added[i] - x);
    xy += (added[i] - x) * (inverse[i] - y);
  }
  return {xx / xy, y * xx / xy - x};
}

// All curves, fitted together with one model.
class JointFill {
 public:
  JointFill(const FillModel& model, const ValveOptions& options, std::vector<JointCurve> curves,
            std::span<const FittedFill> separate)
      : model_(model), options_(options), curves_(std::move(curves)) {
    std::vector<double> inverse, added;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      inverse.push_back(1 / separate[i].fit.parameters.front().value);
      added.push_back(curves_[i].added);
    }
    const ChamberLine line = chamber_line(inverse, added);
    const double most = *std::ranges::max_element(added);
    if (!(line.conductance > 0))
      throw Refusal("added_volume", "a chamber that fills no slower with more volume joined to it",
                    "one that does", "the volumes, they may be exchanged between the files");
    const double start = std::max(line.volume, 1e-3 * most), c = line.conductance;
    parameters_ = {{"sonic_conductance", "m3/(s Pa)", c, 1e-2 * c, 100 * c, c},
                   {"volume", "m3", start, 1e-6 * most, 1e3 * (start + most), start}};
    for (std::size_t i = 0; i < curves_.size(); ++i) place(curves_[i], separate[i]);
  }

  std::size_t count() const {
    std::size_t out = 0;
    for (const JointCurve& c : curves_) out += c.curve.time.size();
    return out;
  }

  Refit solve() const {
    FitProblem of{.count = count(),
                  .parameters = parameters_,
                  .options = {.correlated = true,
                              .most_steps = 60,
                              .widest_interval = well_known,
                              .difference = 1e-3},
                  .constraints = {}};
    of.residuals = [own = *this](std::span<const double> p, std::span<double> r) {
      std::size_t at = 0;
      for (const JointCurve& c : own.curves_) {
        const std::size_t rows = c.curve.time.size();
        if (!own.fill(c, p, r.subspan(at, rows))) return false;
        for (std::size_t i = 0; i < rows; ++i) r[at + i] -= c.curve.pressure[i];
        at += rows;
      }
      return true;
    };
    Solution s = least_squares(of.residuals, of.count, of.parameters, of.options);
    return {std::move(of), std::move(s)};
  }

 private:
  // Adds a curve's own parameters; shared ones are added with the first curve's values.
  void place(JointCurve& c, const FittedFill& separate) {
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
      p.start = std::clamp(separate.fit.parameters[i].value, p.low, p.high);
      if (is_of_one_fill(p.name)) p.name += fmt::format("_{}", &c - curves_.data() + 1);
      c.place.back() = parameters_.size();
      parameters_.push_back(p);
    }
  }

  bool fill(const JointCurve& c, std::span<const double> p, std::span<double> pressure) const {
    std::vector<double> values{p[0] / (p[1] + c.added)};
    for (std::size_t i = 1; i < c.free.size(); ++i) values.push_back(p[c.place[i]]);
    const FillCase one = fill_case(model_, c.curve, options_, c.free, values);
    const Opening opening{one.opening, true};
    return simulate(one.chamber, options_.air, {&opening, 1}, c.curve.time, pressure);
  }

  const FillModel& model_;
  const ValveOptions& options_;
  std::vector<JointCurve> curves_;
  std::vector<Parameter> parameters_;
};

// Returns the root mean square score over curves, each in % of its own range.
Score score_over(std::span<const FittedFill> separate) {
  Score out;
  double sum = 0;
  for (const FittedFill& t : separate) {
    const Score& s = *t.fit.held_out;
    out.points += s.points;
    sum += s.rmse_percent * s.rmse_percent / static_cast<double>(separate.size());
    out.max_percent = std::max(out.max_percent, s.max_percent);
    out.rmse = std::max(out.rmse, s.rmse);
    out.max = std::max(out.max, s.max);
  }
  out.rmse_percent = std::sqrt(sum);
  return out;
}

// Fits of the single curves; `refused` if one of them is.
struct SeparateFits {
  std::vector<FittedFill> curves;
  std::string refused;
  double squares = 0;
};

SeparateFits fit_separately(const FillModel& model, std::span<const Curve> curves,
                            const ValveOptions& options) {
  SeparateFits out;
  for (const Curve& c : curves) {
    out.curves.push_back(try_fill(model, c, options, nullptr));
    out.refused = out.curves.back().fit.refused;
    out.squares += out.curves.back().squares;
    if (!out.refused.empty()) break;
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

FittedFill fit_joined(const FillModel& model, std::span<const AddedFill> fills,
                      std::span<const Curve> curves, const SeparateFits& separate,
                      const ValveOptions& options, double range) {
  FittedFill out;
  out.fit = {.model = std::string(model.name),
             .law = std::string(model.law),
             .source = std::string(model.source),
             .refused = separate.refused};
  if (!separate.refused.empty()) return out;
  std::vector<JointCurve> joined;
  for (std::size_t i = 0; i < curves.size(); ++i)
    joined.push_back({curves[i], fills[i].added, free_values(model, curves[i], options), {}});
  try {
    out.fit.refit = std::make_shared<Refit>(
        JointFill(model, options, std::move(joined), separate.curves).solve());
    const Solution& s = out.fit.refit->solution;
    for (const double r : s.residuals) out.squares += r * r;
    const double t = t_quantile(std::max(1, s.freedom));
    out.acceptable = out.squares * (1 + t * t * s.inflation / std::max(1, s.freedom));
    out.fit.parameters = s.estimates;
    for (const Estimate& e : std::span(s.estimates).first(2))
      if (e.at_bound || !std::isfinite(e.high))
        throw Refusal(e.name, "nothing in the curves that determines it", "an interval",
                      "a larger added volume");
    out.fit.fit = score(s.residuals, range);
    out.fit.residuals = s.residuals;
    out.fit.held_out = score_over(separate.curves);
  } catch (const Refusal& refusal) {
    out.fit.refused = refusal.what();
  }
  return out;
}

// Widens both intervals to those of every model that the curves cannot distinguish from the best.
void reach_over(std::span<const FittedFill> tried, Report& report) {
  double acceptable = tried[report.chosen].squares;
  const FittedFill* best = nullptr;
  for (const FittedFill& t : tried)
    if (t.fit.refused.empty() && (!best || t.squares < best->squares)) best = &t;
  if (best) acceptable = std::max(acceptable, best->acceptable);
  Fit& chosen = report.fits[report.chosen];
  std::string names;
  for (const FittedFill& t : tried) {
    if (!t.fit.refused.empty() || t.squares > acceptable || t.fit.model == chosen.model) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      Estimate& e = chosen.parameters[i];
      e.low = std::min(e.low, t.fit.parameters[i].low);
      e.high = std::max(e.high, t.fit.parameters[i].high);
      e.standard_error = std::max(e.standard_error, 0.25 * (e.high - e.low));
      e.identifiable &= half_of(e) <= well_known;
    }
    names += (names.empty() ? "" : ", ") + t.fit.model;
  }
  if (!names.empty())
    chosen.notes.push_back(
        "the curves do not distinguish the chamber from others, whose values the intervals "
        "cover: " +
        names);
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
                                     config::format_quantity(most->added, "m3", "L", 4)),
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

FittedFill try_added(const FillModel& model, std::span<const AddedFill> fills,
                     const ValveOptions& options) {
  std::vector<Curve> curves;
  double range = 0;
  for (const AddedFill& fill : fills)
    range = std::max(range, curves.emplace_back(curve_of(fill.data)).range());
  return fit_joined(model, fills, curves, fit_separately(model, curves, options), options, range);
}

ValveResult identify_added(std::span<const AddedFill> fills, const ValveOptions& options) {
  refuse_same_volumes(fills);
  std::vector<Curve> curves;
  ValveResult out = before(options);
  Report& report = out.report;
  report.subject =
      fmt::format("{} fillings of a chamber with known volumes joined to it", fills.size());
  report.quantity = "pressure";
  report.unit = "Pa diff";
  report.full_scale_is = "the pressure's largest range";
  report.held_out_is = "every second tenth of the way of each curve, by a fit to that curve alone";
  report.not_shown = {"the flow in the other direction, and how fast the valve switches"};
  report.rows = {.x = "time", .x_unit = "s", .unit = "Pa abs"};
  for (const AddedFill& fill : fills) {
    const Curve& c = curves.emplace_back(curve_of(fill.data));
    refuse_unsettled(fill.data, c, options);
    report.full_scale = std::max(report.full_scale, c.range());
    report.notes.insert(report.notes.end(), c.notes.begin(), c.notes.end());
    report.rows.at.insert(report.rows.at.end(), c.time.begin(), c.time.end());
    report.rows.measured.insert(report.rows.measured.end(), c.pressure.begin(), c.pressure.end());
    report.rows.group.insert(report.rows.group.end(), c.time.size(),
                             config::format_quantity(fill.added, "m3", "L", 4) + " joined");
  }
  std::vector<SeparateFits> separate;
  for (const FillModel& model : fill_models())
    separate.push_back(fit_separately(model, curves, options));
  leave_out_far_worse(separate);
  std::vector<FittedFill> tried;
  for (std::size_t i = 0; i < separate.size(); ++i)
    tried.push_back(
        fit_joined(fill_models()[i], fills, curves, separate[i], options, report.full_scale));
  for (const FittedFill& t : tried) report.fits.push_back(t.fit);
  conclude(report);
  refuse_poor_fit(fills.front().data, report, options.worst_fit);
  reach_over(tried, report);
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
