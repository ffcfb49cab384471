#include "sinew/identify/check/label.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_slopes.h"
#include "sinew/identify/check/curves.h"
#include "sinew/identify/contest/bounds.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

constexpr std::size_t most_pressures = 6;  // per curve
constexpr double slack_share = 0.02;    // share of a muscle's largest force; below it may be slack
constexpr double usual_misfit = 0.01;   // scatter that sets the weight of the priors
constexpr double far_misfit = 0.04;     // points beyond it have less weight
constexpr double gain_deviation = 0.1;  // prior deviation of g
constexpr double widest_shift = 0.1;    // share of the rest length

// Residuals over free parameters, shift and gains, in this order.
class LabelProblem {
 public:
  LabelProblem(const std::vector<StaticPoint>& points,
               const std::vector<FreeParameter>& free_parameters, double atmosphere,
               const std::optional<DoubtedLabel>& doubted)
      : points_(points), free_parameters_(free_parameters), doubted_(doubted) {
    scales_ = scales_of(points, atmosphere, {});
    for (const StaticPoint& p : points) {
      double& largest = full_[p.rest_length];
      largest = std::max(largest, p.force);
    }
    for (const FreeParameter free_parameter : free_parameters_)
      parameters_.push_back(parameter_of(free_parameter, scales_));
    if (doubted_) {
      const double l = doubted_->rest_length, most = widest_shift * l;
      parameters_.push_back(
          {.name = "shift", .unit = "m", .low = -most, .high = most, .scale = 0.01 * l});
    }
    if (full_.size() > 1)
      for (std::size_t i = 0; i < full_.size(); ++i)
        parameters_.push_back(
            {.name = "gain", .unit = "1", .low = -0.5, .high = 0.5, .scale = 0.01});
  }

  const std::vector<Parameter>& parameters() const { return parameters_; }
  std::size_t count() const { return points_.size() + parameters_.size(); }

  // Returns the start: the solution of the fit without shift.
  std::vector<std::vector<double>> starts(const LabelFit& from) const {
    std::vector<double> out = from.law;
    if (doubted_) out.push_back(0);
    out.insert(out.end(), from.gains.begin(), from.gains.end());
    return {out};
  }

  // Returns two starts, with braids of different angles.
  std::vector<std::vector<double>> starts() const {
    std::vector<std::vector<double>> out(2, starts_of(parameters_));
    out[1][0] *= 1.2;
    out[1][1] *= 0.8;
    return out;
  }

  // Writes the residuals and, unless `by` is empty, their derivatives.
  bool operator()(std::span<const double> values, std::span<double> r, std::span<double> by) const {
    std::ranges::fill(by, 0);
    StaticSetting setting = setting_of(scales_);
    for (std::size_t i = 0; i < free_parameters_.size(); ++i)
      value_of(setting, free_parameters_[i]) = values[i];
    const double shift = doubted_ ? values[free_parameters_.size()] : 0;
    ForceSlopes slopes;
    std::size_t at = 0, gain = free_parameters_.size() + (doubted_ ? 1 : 0);
    for (const auto& [rest, largest] : full_) {
      const bool mine = doubted_ && doubted_->rest_length == rest;
      const bool is_rest_doubted = mine && !doubted_->mount;
      const MuscleLaw law(setting, scales_, is_rest_doubted ? rest + shift : rest);
      const double factor = full_.size() > 1 ? 1 + values[gain] : 1;
      for (; at < points_.size() && points_[at].rest_length == rest; ++at) {
        const StaticPoint& point = points_[at];
        const bool moves = mine && at_rest(point.length, doubted_->mount.value_or(rest));
        const double length = point.length + (moves ? shift : 0);
        const double force = law.force(length, point);
        const bool counts = !(point.force < slack_share * largest) || factor * force > 0;
        r[at] = ((counts ? factor * force : 0.0) - point.force) / largest;
        if (by.empty() || !counts) continue;
        law.write_slopes(length, point, force, slopes);
        const auto column = [&](std::size_t k) -> double& { return by[k * r.size() + at]; };
        for (std::size_t k = 0; k < free_parameters_.size(); ++k)
          column(k) = factor * value_of(slopes.by_parameter, free_parameters_[k]) / largest;
        if (mine)
          column(free_parameters_.size()) =
              factor *
              ((is_rest_doubted ? slopes.by_rest_length : 0) + (moves ? slopes.by_length : 0)) /
              largest;
        if (full_.size() > 1) column(gain) = force / largest;
      }
      gain += full_.size() > 1 ? 1 : 0;
    }
    add_priors(values, r, by);
    return std::ranges::all_of(r, [](double x) { return std::isfinite(x); });
  }

 private:
  void add_priors(std::span<const double> values, std::span<double> r, std::span<double> by) const {
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      std::optional<Prior> prior;
      if (parameters_[i].name == "gain") prior = Prior{0, gain_deviation};
      if (i < free_parameters_.size()) prior = prior_of(free_parameters_[i], scales_);
      const std::size_t row = points_.size() + i;
      r[row] = prior ? usual_misfit * prior->away(values[i]) / prior->deviation : 0;
      if (prior && !by.empty())
        by[i * r.size() + row] = usual_misfit / prior->deviation_at(values[i]);
    }
  }

  const std::vector<StaticPoint>& points_;  // sorted by rest length
  std::vector<FreeParameter> free_parameters_;
  std::optional<DoubtedLabel> doubted_;
  StaticScales scales_;
  std::map<double, double> full_;  // largest force of each muscle [N]
  std::vector<Parameter> parameters_;
};

LabelFit solved_labels(const LabelProblem& problem, const std::vector<std::vector<double>>& starts,
                       std::size_t points, std::size_t free_parameters, bool doubted) {
  const FitProblem search{.residuals = [&](std::span<const double> p,
                                           std::span<double> r) { return problem(p, r, {}); },
                          .count = problem.count(),
                          .parameters = problem.parameters(),
                          .options = {.outlier = far_misfit,
                                      .correlated = true,
                                      .most_steps = 60,
                                      .slopes = std::cref(problem)}};
  const std::vector<Solution> all = solutions_from(starts, search);
  const Solution& found = best_of(all, search.options);
  LabelFit out;
  double square = 0;
  for (std::size_t i = 0; i < points; ++i) square += found.residuals[i] * found.residuals[i];
  out.rms = std::sqrt(square / static_cast<double>(points));
  const auto middle = found.values.begin() + static_cast<std::ptrdiff_t>(free_parameters);
  out.law.assign(found.values.begin(), middle);
  out.gains.assign(middle + (doubted ? 1 : 0), found.values.end());
  if (!doubted) return out;
  const Estimate& e = found.estimates[free_parameters];
  out.shift = e.value;
  out.error = e.at_bound ? unbounded : e.standard_error;
  return out;
}

}  // namespace

std::vector<StaticPoint> few_points(const std::vector<StaticPoint>& points) {
  std::vector<StaticPoint> out;
  for (const ForceCurve& c : curves_of(points)) {
    const std::size_t n = c.pressure.size(), take = std::min(n, most_pressures);
    for (std::size_t k = 0; k < take; ++k) {
      const std::size_t i = take > 1 ? k * (n - 1) / (take - 1) : 0;
      out.push_back({.length = c.length,
                     .pressure = c.pressure[i],
                     .force = c.force[i],
                     .rest_length = c.rest_length,
                     .branch = c.branch});
    }
  }
  return out;
}

LabelFit fit_labels(const std::vector<StaticPoint>& points,
                    const std::vector<FreeParameter>& free_parameters, double atmosphere) {
  const LabelProblem problem(points, free_parameters, atmosphere, {});
  return solved_labels(problem, problem.starts(), points.size(), free_parameters.size(), false);
}

LabelFit fit_labels(const std::vector<StaticPoint>& points,
                    const std::vector<FreeParameter>& free_parameters, double atmosphere,
                    const DoubtedLabel& doubted, const LabelFit& from) {
  const LabelProblem problem(points, free_parameters, atmosphere, doubted);
  return solved_labels(problem, problem.starts(from), points.size(), free_parameters.size(), true);
}

// --- checks ---

namespace {

using enum FreeParameter;
using Points = std::vector<StaticPoint>;

constexpr double least_shift = 0.01;    // share of the rest length; less is reading error
constexpr double own_explains = 0.35;   // reduction of the squared misfit, within a muscle
constexpr double make_supports = 0.25;  // among muscles, if the muscle's own mounts agree
constexpr double make_explains = 0.5;   // among muscles otherwise
constexpr double mount_explains = 0.6;  // one mount among four or more
constexpr double least_misfit = 0.002;  // share of the largest force; correct labels leave as much
constexpr std::size_t fewest_points = 15, most_mounts = 12;  // for a check of mounts

// Laws without the parameters for branches and for several muscles.
const std::vector<FreeParameter> label_laws[] = {
    {thread_length, turns, threshold, stiffness, saturating_tension, saturation_length},
    {thread_length, turns, threshold, eff_linear, stiffness, saturating_tension, saturation_length},
    {thread_length, turns, threshold, stiffness, saturating_tension, saturation_length, series},
};

// Misfit with a label and with its length fitted instead, each for the best of the laws.
struct Doubt {
  DoubtedLabel label;
  double as_labelled = 0, doubted = 0;  // rms misfits as shares of the force [-]
  double shift = 0, error = 0;          // [m]

  double explained() const { return 1 - std::pow(doubted / as_labelled, 2); }
  double labelled() const { return label.mount.value_or(label.rest_length); }

  bool is_significant(double least) const {
    return as_labelled > least_misfit && explained() > least && std::abs(shift) > 2 * error &&
           std::abs(shift) > least_shift * label.rest_length;
  }
  std::string words() const {
    return fmt::format("{:.4g} +- {:.2g} mm", 1e3 * (labelled() + shift), 2e3 * error);
  }
};

std::vector<FreeParameter> law_for(std::vector<FreeParameter> law, const Points& points) {
  if (has_branch(points, Branch::fill) && has_branch(points, Branch::vent))
    law.push_back(half_width);
  if (points.front().rest_length != points.back().rest_length) law.push_back(end_loss);
  return law;
}

// Points of one or several muscles, fitted without doubting a label.
struct FitAsLabelled {
  Points points;
  double atmosphere = 0;       // [Pa]
  std::vector<LabelFit> fits;  // one for each law
  double rms = 1e300;          // best law

  FitAsLabelled(Points all, double outside) : points(std::move(all)), atmosphere(outside) {
    for (const std::vector<FreeParameter>& law : label_laws) {
      fits.push_back(fit_labels(points, law_for(law, points), atmosphere));
      rms = std::min(rms, fits.back().rms);
    }
  }
};

// Fits a label's length. The shift is the mean over the laws that fit about as well as the best
// one; their disagreement is a part of its error.
Doubt fit_label(const FitAsLabelled& all, const DoubtedLabel& label) {
  std::vector<LabelFit> fits;
  double best = 1e300;
  for (std::size_t i = 0; i < all.fits.size(); ++i) {
    fits.push_back(fit_labels(all.points, law_for(label_laws[i], all.points), all.atmosphere, label,
                              all.fits[i]));
    best = std::min(best, fits.back().rms);
  }
  Doubt out{.label = label, .as_labelled = all.rms, .doubted = best};
  double low = 1e300, high = -1e300, n = 0;
  for (const LabelFit& f : fits) {
    if (f.rms > 1.1 * best) continue;
    out.shift += f.shift;
    out.error = std::max(out.error, f.error);
    low = std::min(low, f.shift);
    high = std::max(high, f.shift);
    n += 1;
  }
  out.shift /= n;
  out.error = std::hypot(out.error, 0.5 * (high - low));
  return out;
}

std::set<double> mounts_of_muscle(const Points& points) {
  const std::vector<double> lengths = values_of(points, &StaticPoint::length);
  return {lengths.begin(), lengths.end()};
}

// Returns whether a muscle's own mounts can check its rest length: at least three, the longest of
// them at rest.
bool can_check_rest_length(const Points& own) {
  const std::set<double> mounts = mounts_of_muscle(own);
  const double rest = own.front().rest_length;
  return rest > 0 && mounts.size() >= 3 && own.size() >= fewest_points &&
         at_rest(*mounts.rbegin(), rest);
}

// Returns the other mounts whose error alone would explain as much.
std::string others_that_explain(const FitAsLabelled& own, const Doubt& doubt) {
  std::string out;
  const std::set<double> mounts = mounts_of_muscle(own.points);
  for (const double mount : mounts) {
    if (mount == *mounts.rbegin()) continue;
    const Doubt other = fit_label(own, {.rest_length = doubt.label.rest_length, .mount = mount});
    if (other.doubted < 1.15 * doubt.doubted)
      out += fmt::format("{}that of {:.4g} mm is {}", out.empty() ? "" : ", or ", 1e3 * mount,
                         other.words());
  }
  return out;
}

Check suspicion_of(const Doubt* own, const Doubt* make, const std::string& others) {
  const double label = (own ? own : make)->label.rest_length;
  std::string text = fmt::format("The muscle labelled {:.4g} mm behaves like ", 1e3 * label);
  if (own)
    text += fmt::format(
        "{}: so its mount at rest goes with its others, and what they leave falls from {:.2g} to "
        "{:.2g} % of the largest force",
        own->words(), 100 * own->as_labelled, 100 * own->doubted);
  if (own && make) text += "; among the muscles of its make it behaves like ";
  if (make)
    text += fmt::format("{}: what all leave falls from {:.2g} to {:.2g} %", make->words(),
                        100 * make->as_labelled, 100 * make->doubted);
  std::string advice = "Measure its length without pressure and load again.";
  if (!others.empty()) advice += " Or its rest length is right, and " + others + ".";
  return {"labels", TrafficLight::yellow, text + ".", advice};
}

// Returns whether each mount of a muscle can be checked: enough points for a law, and few enough
// mounts that one of them matters.
bool can_check_mounts(const Points& own) {
  const std::size_t mounts = mounts_of_muscle(own).size();
  return mounts >= 4 && mounts <= most_mounts && own.size() >= fewest_points;
}

// Returns a check of the mount that with another length fits the others best, if it explains more
// than the doubted rest length and clearly more than any other mount. An end mount is not reported:
// there the law is more likely wrong.
std::optional<Check> mount_off(const FitAsLabelled& own, const Doubt* rest) {
  if (!can_check_mounts(own.points) || own.rms < least_misfit) return {};
  const std::set<double> mounts = mounts_of_muscle(own.points);
  std::vector<Doubt> doubts;
  for (const double mount : mounts)
    doubts.push_back(
        fit_label(own, {.rest_length = own.points.front().rest_length, .mount = mount}));
  std::ranges::sort(doubts, {}, &Doubt::doubted);
  const Doubt& best = doubts[0];
  const bool at_end = best.labelled() == *mounts.begin() || best.labelled() == *mounts.rbegin();
  if (at_end || !best.is_significant(mount_explains) || best.doubted > 0.75 * doubts[1].doubted)
    return {};
  if (rest && best.doubted > 0.75 * rest->doubted) return {};
  return Check{
      "labels", TrafficLight::yellow,
      fmt::format("The mount labelled {:.4g} mm behaves like {} among the others of its "
                  "muscle: what they leave falls from {:.2g} to {:.2g} % of the largest "
                  "force.",
                  1e3 * best.labelled(), best.words(), 100 * best.as_labelled, 100 * best.doubted),
      "Measure that length again."};
}

// Fits the rest length of each muscle, as if the others of its make were right.
std::vector<Doubt> doubts_of_make(const Points& points, double atmosphere) {
  const std::set<double> muscles = muscles_in(points);
  std::vector<Doubt> out;
  if (muscles.size() < 3 || *muscles.begin() <= 0) return out;
  const FitAsLabelled all(points, atmosphere);
  for (const double m : muscles) out.push_back(fit_label(all, {.rest_length = m}));
  return out;
}

// Returns a check that lists the muscles each of which alone would explain the misfit.
Check one_of_them(const std::vector<const Doubt*>& doubts) {
  std::string text = "The muscles do not follow one law. ";
  for (std::size_t i = 0; i < doubts.size(); ++i)
    text +=
        fmt::format("{} labelled {:.4g} mm behaves like {}", i ? ", or the one" : "Either the one",
                    1e3 * doubts[i]->label.rest_length, doubts[i]->words());
  return {"labels", TrafficLight::yellow, text + ".",
          "Measure the lengths of these muscles without pressure and load again."};
}

// Adds the check of muscles against each other, used if no muscle's own mounts gave a suspicion.
void add_make(const std::vector<Doubt>& make, bool checked, std::vector<Check>& out) {
  std::vector<const Doubt*> likely;
  bool sure = false;
  for (const Doubt& d : make) {
    if (d.is_significant(make_supports)) likely.push_back(&d);
    sure = sure || d.is_significant(make_explains);
  }
  if (sure && likely.size() == 1) {
    out.push_back(suspicion_of(nullptr, likely[0], ""));
  } else if (sure) {
    out.push_back(one_of_them(likely));
  } else if (checked) {
    out.push_back(
        {"labels", TrafficLight::green, "The lengths of the mounts go with each other.", ""});
  } else {
    out.push_back(
        {"labels", TrafficLight::grey,
         "Not checked: it takes four to twelve mounts, and 15 readings, to show which length is "
         "wrong.",
         "Measure more mounts or pressures; of a sweep, give some of its lengths."});
  }
}

}  // namespace

void add_label_checks(const StaticData& data, double atmosphere, std::vector<Check>& out) try {
  Points points = few_points(data.points);
  if (points.empty()) return;
  const bool has_label = points.front().rest_length > 0;
  if (!has_label) {  // the longest mount is used, as in a fit
    const double longest = largest(values_of(points, &StaticPoint::length));
    for (StaticPoint& p : points) p.rest_length = longest;
  }
  const std::vector<Doubt> make = doubts_of_make(points, atmosphere);
  int checked = make.empty() ? 0 : 1;
  bool named = false;
  for (const double m : muscles_in(points)) {
    const Points mine = points_of(points, m);
    const bool check_rest = has_label && can_check_rest_length(mine);
    if (!check_rest && !can_check_mounts(mine)) continue;
    checked += can_check_mounts(mine) ? 1 : 0;
    const FitAsLabelled own(mine, atmosphere);
    std::optional<Doubt> doubt;
    if (check_rest) doubt = fit_label(own, {.rest_length = m});
    const bool is_significant = doubt && doubt->is_significant(own_explains);
    if (const auto mount = mount_off(own, is_significant ? &*doubt : nullptr)) {
      out.push_back(*mount);
      named = true;
      continue;
    }
    if (!is_significant) continue;
    const auto same = std::ranges::find_if(make, [&](const Doubt& d) {
      return d.label.rest_length == m && d.is_significant(make_supports) &&
             d.shift * doubt->shift > 0;
    });
    out.push_back(suspicion_of(&*doubt, same == make.end() ? nullptr : &*same,
                               others_that_explain(own, *doubt)));
    named = true;
  }
  if (named) return;
  add_make(make, checked > 0, out);
} catch (const Refusal& refusal) {
  out.push_back({"labels", TrafficLight::grey, std::string("Not checked: ") + refusal.what(),
                 "Measure more mounts and pressures."});
}

}  // namespace sinew::identify
