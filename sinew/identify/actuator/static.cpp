#include "sinew/identify/actuator/static.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_law_fitter.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/actuator/static_spread.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

// --- gross outliers ---

// A point that no law explains, and the force that the law of the other points has there.
struct Outlier {
  std::size_t point = 0;  // its index
  double law = 0;         // force of that law there [N]
  std::string why;        // probable cause
};

// Gross outliers, and the distance from the law beyond which a point is one [N].
struct Outliers {
  std::vector<Outlier> points;
  double limit = 0, scatter = 0;
};

// --- probable causes of a gross outlier ---

constexpr double near_scatters = 3, near_share = 0.01;  // share of the largest force
constexpr double other_mount = 0.004;  // share of the longest length; closer: same mount

// A possible error of a recorded value.
struct RecordingError {
  double factor;
  std::string_view words;
};

// The recorded force is the true one multiplied with this factor.
constexpr RecordingError force_errors[] = {
    {-1, "its sign is the other one"},
    {10, "ten times what the law has: a slipped decimal"},
    {0.1, "a tenth of what the law has: a slipped decimal"},
    {100, "a hundred times what the law has: a slipped decimal"},
    {0.01, "a hundredth of what the law has: a slipped decimal"},
    {2, "twice what the law has: counted double"},
    {0.5, "half of what the law has: counted for one of two"},
    {4.4482216, "4.45 times what the law has: N in place of lbf"},
    {1 / 4.4482216, "what the law has over 4.45: lbf in place of N"},
    {1 / 9.80665, "what the law has over 9.81: kg in place of N"}};

// The recorded pressure is the true one multiplied with this factor.
constexpr RecordingError pressure_errors[] = {
    {10, "as at a tenth of its pressure: a slipped decimal"},
    {0.1, "as at ten times its pressure: a slipped decimal"},
    {2, "as at half its pressure"},
    {0.5, "as at twice its pressure"},
    {6.894757, "as at its pressure over 6.89: kPa in place of psi"},
    {1 / 6.894757, "as at 6.89 times its pressure: psi in place of kPa"}};

// Finds the cause that explains a reading best.
class CauseSearch {
 public:
  // `within`: largest distance from the law that counts as explained [N].
  CauseSearch(const StaticFit& fit, double within) : fit_(fit), within_(within), least_(within) {}

  // Compares the law at the point `as` with a force [N], and keeps `words` if it is the nearest so
  // far.
  void compare(const StaticPoint& as, double force, std::string words) {
    const double law = predicted(fit_.setting, fit_.scales, as);
    if (law < 2 * within_) return;  // near zero force every cause fits
    const double off = std::abs(law - force);
    if (off > least_) return;
    least_ = off;
    words_ = std::move(words);
  }

  const std::string& words() const { return words_; }

 private:
  const StaticFit& fit_;
  double within_, least_;
  std::string words_;
};

// Returns the probable cause of an outlier in words. `fit` is the law of the other points,
// `points` are all points, `scatter` is the scatter of the points about the law [N].
std::string explanation_of(const StaticPoint& point, const StaticFit& fit,
                           std::span<const StaticPoint> points, double scatter) {
  const double within = std::max(near_scatters * scatter, near_share * fit.scales.full_scale);
  if (std::abs(point.force) < within)
    return "no force where the law pulls: slack, not connected, or not measured";
  CauseSearch search(fit, within);
  for (const RecordingError& cause : force_errors)
    search.compare(point, point.force / cause.factor, std::string(cause.words));
  for (const RecordingError& cause : pressure_errors) {
    StaticPoint as = point;
    as.pressure /= cause.factor;
    if (as.pressure < 1.5 * fit.scales.top_pressure)
      search.compare(as, point.force, std::string(cause.words));
  }
  const double longest = std::max(0.0, largest(values_of(points, &StaticPoint::length)));
  for (const StaticPoint& p : points_of(points, point.rest_length)) {
    if (std::abs(p.length - point.length) < other_mount * longest) continue;
    StaticPoint as = point;
    as.length = p.length;
    search.compare(as, point.force,
                   fmt::format("as at {:.4g} mm, another mount of these data", 1e3 * p.length));
  }
  return search.words().empty() ? "nothing in these data explains it" : search.words();
}

constexpr double scatters = 8, share_of_scale = 0.05, most_left_out = 0.1;

std::vector<double> distances(const StaticFit& fit, const std::vector<StaticPoint>& points) {
  std::vector<double> out = residuals_of(fit, points);
  for (double& r : out) r = std::abs(r);
  return out;
}

// Every other law is a special case of one of these, or similar to one (series).
constexpr std::string_view flexible_laws[] = {"wall",
                                              "taper",
                                              "elastic-linear",
                                              "elastic-cubic",
                                              "saturating-effectiveness",
                                              "saturating-end-caps"};

// A fitted law, and the distance of each point from it.
struct ClosestLaw {
  StaticFit fit;
  std::vector<double> distances;  // empty: no law could be fitted
};

// Returns the law with the smallest median distance, among the freest laws or among all others.
ClosestLaw closest_law_of(bool free, const std::vector<StaticPoint>& points,
                          const StaticScales& scales) {
  const bool several = muscles_in(points).size() > 1;
  ClosestLaw closest;
  for (const StaticModel& model : static_models()) {
    if (model.name == "effectiveness-by-ratio") continue;
    if ((std::ranges::find(flexible_laws, model.name) != std::end(flexible_laws)) != free) continue;
    std::vector<FreeParameter> free_parameters = free_parameters_of(model, scales);
    if (std::ranges::find(free_parameters, FreeParameter::series) != free_parameters.end())
      continue;
    if (several) free_parameters.push_back(FreeParameter::end_loss);
    try {
      const StaticFit fit = fit_static(free_parameters, points, scales, nullptr, 1e-7);
      const std::vector<double> d = distances(fit, points);
      if (closest.distances.empty() || median(d) < median(closest.distances)) closest = {fit, d};
    } catch (const Refusal&) {
      continue;  // too few points for this one
    }
  }
  return closest;
}

// Returns the closest of the freest laws, or of the simpler ones if the data are too few for those.
ClosestLaw closest_law(const std::vector<StaticPoint>& points, const StaticScales& scales) {
  const ClosestLaw free = closest_law_of(true, points, scales);
  return free.distances.empty() ? closest_law_of(false, points, scales) : free;
}

// Returns the 90th percentile of the forces, which single wild points do not change.
double common_force(const std::vector<StaticPoint>& points) {
  std::vector<double> forces = values_of(points, &StaticPoint::force);
  const auto at = forces.begin() + static_cast<std::ptrdiff_t>(forces.size() * 9 / 10);
  std::nth_element(forces.begin(), at, forces.end());
  return *at;
}

// Returns the points further from a law than 8 scatters and 5 % of the largest force. The law is
// the one of all models, fitted robustly, with the smallest median distance. Returns no points if
// they would be more than one in ten: then the law is wrong, not the points.
Outliers gross_outliers(const std::vector<StaticPoint>& points, const StaticScales& scales) {
  if (points.empty()) return {};
  StaticScales common = scales;
  common.full_scale = common_force(points);
  if (!(common.full_scale > 0)) return {};
  const auto [fit, d] = closest_law(points, common);
  Outliers out{.points = {}, .scatter = d.empty() ? 0 : 1.4826 * median(d)};
  out.limit = std::max(scatters * out.scatter, share_of_scale * common.full_scale);
  for (std::size_t i = 0; i < d.size(); ++i)
    if (d[i] > out.limit) out.points.push_back({.point = i, .law = 0, .why = ""});
  if (static_cast<double>(out.points.size()) > most_left_out * static_cast<double>(points.size()))
    return {};
  for (Outlier& o : out.points) {
    o.law = predicted(fit.setting, common, points[o.point]);
    o.why = explanation_of(points[o.point], fit, points, out.scatter);
  }
  return out;
}

using Points = std::vector<StaticPoint>;

// These parameters may be at a bound without disqualifying a law. Zero is a valid result for
// branches that coincide and for ends that take no length or do not give way. A thread at the
// shortest length of a braid still fits within the data; describe() notes it.
constexpr std::string_view may_be_at_bound[] = {"half_width",        "width_per_pressure",
                                                "width_per_tension", "end_loss",
                                                "thread_length",     "series_compliance"};

// Gives muscles without a rest length the longest length of the points.
void give_rest_length(Points& points, Report& report) {
  unite_labels(points);
  const std::set<double> muscles = muscles_in(points);
  if (muscles.contains(0.0) && muscles.size() > 1)
    throw Refusal("rest length", "points with and without one", "one for every file or row",
                  "rest_length=LENGTH, or a column rest_length");
  if (const double longest = give_longest(points); longest > 0)
    report.notes.push_back(fmt::format(
        "no rest length given: the longest, {:.4g} mm, is taken for it", 1e3 * longest));
}

// Throws Refusal if the tension falls as the pressure rises: such a law cannot be used elsewhere.
void refuse_falling(const StaticFit& fit) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const actuator::Effectiveness& e = fit.setting.actuator.effectiveness;
    const double p = fit.scales.top_pressure * i / 100;
    const double acting = std::max(0.0, p - e.threshold) * (e.c0 + p * (e.c1 + p * e.c2));
    if (acting < before)
      throw Refusal("effectiveness", "a tension that falls as pressure rises",
                    "one that grows with it", "");
    before = acting;
  }
}

// Notes the muscles whose fitted rest length differs from their label.
void add_label_notes(const StaticFit& fit, Fit& out) {
  for (const RestLengthError& r : fit.setting.rest_lengths) {
    const Estimate* e = rest_length_estimate(fit, r.labelled);
    if (!e) continue;
    const std::string muscle = fmt::format("the muscle labelled {:.4g} mm", 1e3 * r.labelled);
    if (e->at_bound)
      out.notes.push_back(
          muscle +
          fmt::format(" would be {} by more than {:.2g} mm than the others imply, the bound of "
                      "what is assumed: its label, or another's, is probably wrong",
                      r.error > 0 ? "longer" : "shorter", 1e3 * std::abs(r.error)));
    else if (std::abs(r.error) > 0.5 * (e->high - e->low))
      out.notes.push_back(
          muscle +
          fmt::format(" pulls as one of {:.4g} +- {:.2g} mm compared with the others, for its "
                      "label or for a law that is not quite theirs",
                      1e3 * (r.labelled + r.error), 500 * (e->high - e->low)));
  }
  if (rest_length_estimate(fit, fit.setting.rest_lengths.back().labelled))
    out.notes.push_back(fmt::format("parameters are those of a muscle of exactly {:.4g} mm",
                                    1e3 * fit.setting.rest_lengths.back().labelled));
}

void describe(const StaticFit& fit, Fit& out) {
  out.parameters = fit.solution.estimates;
  for (const FreeParameter free_parameter : fit.unknown)
    for (std::size_t i = 0; i < fit.free_parameters.size(); ++i)
      if (fit.free_parameters[i] == free_parameter)
        out.notes.push_back(
            fmt::format("{} is taken from other muscles: these data hardly determine it",
                        out.parameters[i].name));
  for (const Estimate& e : out.parameters)
    if (e.name == "thread_length" && e.at_bound)
      out.notes.push_back(
          "thread_length is at the shortest that a braid can have: the law holds for the "
          "lengths that were measured, and shows little of the air in the muscle");
  add_label_notes(fit, out);
  for (const std::string& direction : fit.solution.undetermined)
    out.notes.push_back("not determined: " + direction);
  if (fit.outliers > 0)
    out.notes.push_back(
        fmt::format("{} of {} points are beyond 4 times the scatter of {:.3g} N "
                    "and count less",
                    fit.outliers, fit.solution.residuals.size(), fit.scatter));
}

// Returns the score of what was held out: the points that were marked so, every second pressure, or
// each length or muscle in turn.
std::optional<Score> held_out(const StaticLawFitter& model, const StaticFit& fit,
                              const StaticSplit& s, const std::vector<LeftOut>& muscles,
                              HoldOut which, double full_scale) {
  if (which == HoldOut::length) {
    const std::vector<int> group = length_groups(s.fitted);
    return score(model.cross(s.fitted, group, count_of(group), fit).residuals, full_scale);
  }
  if (which == HoldOut::muscle) {
    std::vector<double> shares;
    for (const LeftOut& m : muscles) {
      for (const double r : m.errors.residuals) shares.push_back(r * full_scale / m.largest);
    }
    if (shares.empty()) return std::nullopt;
    return score(shares, full_scale);
  }
  if (s.held_out.empty()) return std::nullopt;
  return score(residuals_of(fit, s.held_out), full_scale);
}

struct Best {
  StaticFit fit;
  StaticSpread spread;
};

// Fits the law to the points, and predicts parts of them that it was not fitted to.
void try_model(const StaticModel& model, const StaticSplit& s, const StaticScales& scales,
               HoldOut hold_out, double full_scale, Best& found, Fit& out) {
  if (model.name == "effectiveness" && !scales.braid)
    throw Refusal("braid", "no geometry", "a braid that is known: here only its turns are", "");
  const StaticLawFitter tried(model, scales, s.fitted);
  const StaticFit fit = tried.fit(s.fitted);
  refuse_falling(fit);
  describe(fit, out);
  if (model.name != "effectiveness-by-ratio")
    out.refit = std::make_shared<Refit>(refit_of(fit, s.fitted));
  out.fit = score(residuals_of(fit, s.fitted), full_scale);
  out.residuals = residuals_of(fit, all_points(s));
  const std::vector<LeftOut> muscles = tried.leave_out_muscles(s.fitted);
  out.held_out = held_out(tried, fit, s, muscles, hold_out, full_scale);
  found = {fit, cross_validate(tried, s.fitted, fit, muscles, full_scale, out)};
  std::vector<std::string_view> allowed(std::begin(may_be_at_bound), std::end(may_be_at_bound));
  for (const Estimate& e : out.parameters)
    if (e.name.starts_with(rest_length_error)) allowed.push_back(e.name);
  keep_off_bounds(out, allowed);
}

// Fits all laws, or the one of the options. Returns the fit of each, in their order in the report.
std::vector<Best> try_all(const StaticSplit& s, const StaticScales& scales,
                          const StaticOptions& options, Report& report) {
  std::vector<Best> found(static_models().size());
  std::vector<Candidate> candidates;
  for (const StaticModel& model : static_models())
    if (options.model.empty() || model.name == options.model) {
      Best& best = found[candidates.size()];
      candidates.push_back({.model = std::string(model.name),
                            .law = std::string(model.law),
                            .source = std::string(model.source),
                            .may_be_at_bounds = true,
                            .fit = [&](Fit& out) {
                              try_model(model, s, scales, options.hold_out, report.full_scale, best,
                                        out);
                            }});
    }
  fit_candidates(std::move(candidates), {}, report, options.tried);
  return found;
}
// Returns the number of tests of a law's form over the length: lengths between the ends of each
// muscle, and whole muscles if there are several.
std::size_t tests_of_form(const Points& points) {
  const std::set<double> muscles = muscles_in(points);
  std::size_t out = muscles.size() > 1 ? muscles.size() : 0;
  for (const double muscle : muscles)
    out += std::max<std::size_t>(2, lengths_of(points, muscle).size()) - 2;
  return out;
}

// Gives laws without a bladder that saturates a reason not to be chosen, if a law with one may be
// chosen and fits about as well as the best. Returns whether there is one.
bool prefer_saturating(Report& report) {
  constexpr double as_well = 2;  // times the smallest error
  std::set<std::string_view> names;
  for (const StaticModel& model : static_models())
    if (std::ranges::find(model.free_parameters, FreeParameter::saturating_tension) !=
        model.free_parameters.end())
      names.insert(model.name);
  std::vector<Fit*> others;
  double smallest = std::numeric_limits<double>::infinity(), saturating = smallest;
  for (Fit& fit : report.fits) {
    if (!fit.refused.empty() || !fit.not_chosen.empty()) continue;
    const bool saturates = names.contains(fit.model);
    const double error = choice_error(report, fit);
    smallest = std::min(smallest, error);
    if (saturates)
      saturating = std::min(saturating, error);
    else
      others.push_back(&fit);
  }
  if (!(saturating <= as_well * smallest)) return false;
  for (Fit* fit : others) fit->not_chosen = "its form needs a test at two lengths between the ends";
  return true;
}

StaticSplit split_by(const Points& points, HoldOut hold_out, Report& report) {
  StaticSplit s = split(points, [&](std::size_t i) { return points[i].fitted; });
  if (!s.held_out.empty()) report.held_out_is = "rows that were not to be fitted";
  if (hold_out == HoldOut::length) {
    report.held_out_is = "each length once, all others fitted";
    if (count_of(length_groups(s.fitted)) < 3)
      throw Refusal("hold_out=length", "fewer than three lengths", "at least three", "");
  }
  if (hold_out == HoldOut::muscle) {
    report.held_out_is = "each muscle once, all others fitted, in % of its own largest force";
    if (muscles_in(s.fitted).size() < 2)
      throw Refusal("hold_out=muscle", "one muscle", "at least two rest lengths",
                    "a column rest_length, or files of several muscles");
  }
  if (hold_out == HoldOut::pressure) {
    const std::vector<int> group = pressure_groups(s.fitted);
    if (count_of(group) < 4)
      throw Refusal("hold_out=pressure", "fewer than four pressures", "at least four", "");
    const Points before = s.fitted;
    StaticSplit more = split(before, [&](std::size_t i) { return group[i] % 2 == 0; });
    s.fitted = more.fitted;
    s.held_out.insert(s.held_out.end(), more.held_out.begin(), more.held_out.end());
    report.held_out_is = "every second pressure";
  }
  return s;
}

// Removes the points that no law explains, so that they do not influence the choice.
StaticOmitted drop_gross_outliers(Points& points, const StaticOptions& options, Report& report) {
  const Outliers wild =
      gross_outliers(points, scales_of(points, options.atmosphere, options.braid));
  StaticOmitted out{
      .reason = "outlier",
      .criterion = fmt::format("further than {:.3g} N from the law that the others lie "
                               "on, which scatter by {:.2g} N",
                               wild.limit, wild.scatter),
      .count = wild.points.size()};
  if (wild.points.empty()) return out;
  std::string list;
  for (const Outlier& o : wild.points) {
    const StaticPoint& p = points[o.point];
    out.points.push_back(p);
    out.why.push_back(
        fmt::format("{:.4g} N where the law has {:.4g} N: {}", p.force, o.law, o.why));
    if (out.points.size() <= 5)
      list += fmt::format("{}at {:.4g} mm, {:.4g} kPa {}", list.empty() ? "" : "; ", 1e3 * p.length,
                          1e-3 * p.pressure, out.why.back());
  }
  report.warnings.push_back(
      fmt::format("{} of {} points left out, far from the law that the others lie on: {}{}",
                  out.count, points.size(), list, out.count > 5 ? "; …" : ""));
  for (auto o = wild.points.rbegin(); o != wild.points.rend(); ++o)
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(o->point));
  return out;
}

// Chooses the rest length of a muscle's file, between its label and the length that the fit
// found from the other muscles: the one with the smallest error on the muscle's rows at their
// labelled lengths, because a user of the file measures those. In the fit an error of the label
// also moves the mount at rest.
void set_file(const StaticFit& fit, const Points& points, StaticMuscle& muscle) {
  constexpr int steps = 20;
  const double whole = rest_length_of(fit.setting, muscle.rest_length) - muscle.rest_length;
  muscle.rms = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= (whole != 0 ? steps : 0); ++k) {
    StaticSetting setting = fit.setting;
    const double error = whole * k / steps;
    for (RestLengthError& label : setting.rest_lengths)
      if (label.labelled == muscle.rest_length) label.error = error;
    const actuator::Actuator a = scaled(setting, fit.scales, muscle.rest_length);
    std::vector<double> off, variances;
    for (const StaticPoint& p : points_of(points, muscle.rest_length)) {
      off.push_back(std::max(0.0, law_force(a, p.length, p, fit.scales.atmosphere)) - p.force);
      variances.push_back(p.variance);
    }
    const double rms = score(off, 1).rmse;
    if (!(rms < muscle.rms)) continue;
    muscle.rms = rms;
    muscle.actuator = a;
    muscle.file_length = muscle.rest_length + error;
    if (whole == 0) continue;
    const std::vector<double> errors = errors_of_readings(off, variances);
    muscle.half_68 = half_width_of(errors, 0.68);
    muscle.half_95 = half_width_of(errors, 0.95);
  }
}

std::vector<StaticMuscle> muscles_of(const StaticFit& fit, const Points& points) {
  std::vector<StaticMuscle> out;
  for (const StaticPoint& p : points) {
    if (out.empty() || out.back().rest_length != p.rest_length) {
      out.push_back({.rest_length = p.rest_length,
                     .lengths = lengths_of(points, p.rest_length),
                     .lowest = p.pressure,
                     .highest = p.pressure});
    }
    StaticMuscle& m = out.back();
    m.lowest = std::min(m.lowest, p.pressure);
    m.highest = std::max(m.highest, p.pressure);
  }
  for (StaticMuscle& m : out) set_file(fit, points, m);
  std::reverse(out.begin(), out.end());
  return out;
}

// Notes the files whose error on their own rows is clearly larger than the fit's, which moves the
// mount at rest.
void note_files(const StaticResult& found, Report& report) {
  constexpr double more = 1.25;
  for (const StaticMuscle& m : found.muscles) {
    const Points own = points_of(found.points, m.rest_length);
    const double full = largest(values_of(own, &StaticPoint::force));
    const Score fit = score(residuals_of(found.fit, own), full);
    if (!(100 * m.rms / full > more * fit.rmse_percent)) continue;
    report.notes.push_back(fmt::format(
        "the file of the muscle labelled {:.4g} mm has a rest length of {:.4g} mm and misses its "
        "own rows, at the lengths as labelled, by {:.2f} % rmse of its largest force",
        1e3 * m.rest_length, 1e3 * m.file_length, 100 * m.rms / full));
  }
}

// Notes the error of the common model on each muscle.
void note_muscles(const StaticFit& fit, const Points& points, Report& report) {
  const std::set<double> muscles = muscles_in(points);
  if (muscles.size() < 2) return;
  for (const double m : muscles) {
    const Points own = points_of(points, m);
    const double full = std::max(0.0, largest(values_of(own, &StaticPoint::force)));
    const Score s = score(residuals_of(fit, own), full);
    report.notes.push_back(fmt::format(
        "one model for all: the muscle of {:.4g} mm {:.2f} % rmse, {:.2f} % at most, of its own "
        "largest force",
        1e3 * m, s.rmse_percent, s.max_percent));
  }
}

// Gives the law the known volume of air, and reports it.
void set_air(const StaticOptions& options, StaticResult& out) {
  actuator::Actuator& a = out.fit.setting.actuator;
  const double rest = out.fit.scales.rest_length;
  out.air = air_by_force(a, rest);
  const double by_force = out.air.volume;
  const double known =
      options.volume > 0 ? options.volume : cylinder_volume(rest, options.diameter);
  if (!(known > 0)) {
    if (options.braid) return;  // the geometry determines it
    out.report.warnings.push_back(fmt::format(
        "the air at rest, {:.3g} cm3 by the force alone, is known from {:.3g} to {:.3g} cm3 only, "
        "and so are fill times and the use of air: state the diameter of the muscle at rest",
        1e6 * out.air.volume, 1e6 * out.air.low, 1e6 * out.air.high));
    return;
  }
  out.air = {.volume = known, .low = known, .high = known, .known = true};
  const double turns = a.braid.turns;
  out.air.kappa = give_volume(rest, known, options.braid.has_value(), a);
  std::string how;
  if (out.air.kappa != 1)
    how = fmt::format(", with {:.4g} turns in place of {:.4g} at the same forces", a.braid.turns,
                      turns);
  if (a.air.offset != 0)
    how += fmt::format(", {:.3g} cm3 {} than in the braid", 1e6 * std::abs(a.air.offset),
                       a.air.offset < 0 ? "less" : "more");
  out.report.notes.push_back(fmt::format(
      "the air at rest is {:.4g} cm3, {}; the force alone has {:.4g}{}", 1e6 * known,
      options.volume > 0 ? "as measured" : "of a cylinder of this diameter", 1e6 * by_force, how));
}

void check_model(const std::string& name) {
  if (name.empty()) return;
  std::string all;
  for (const StaticModel& m : static_models()) {
    if (m.name == name) return;
    all += (all.empty() ? "" : ", ") + std::string(m.name);
  }
  throw Refusal("model", "\"" + name + "\"", "one of " + all, "");
}

}  // namespace

StaticResult identify_static(const StaticData& data, const StaticOptions& options) {
  check_model(options.model);
  StaticResult out;
  Report& report = out.report;
  report.set_subject(options.subject, "force", "N", "the largest force");
  report.notes = data.notes;
  report.warnings = data.warnings;
  report.not_shown = {"how the muscle moves: losses in motion, creep and fatigue"};

  Points points = data.points;
  give_rest_length(points, report);
  sort_points(points);
  StaticSplit s = split_by(points, options.hold_out, report);
  std::vector<StaticOmitted> left_out = data.left_out;
  left_out.push_back(drop_gross_outliers(s.fitted, options, report));
  points = all_points(s);
  sort_points(points);
  report.full_scale = scales_of(points, options.atmosphere, options.braid).full_scale;
  const StaticScales scales = scales_of(s.fitted, options.atmosphere, options.braid);
  if (!(scales.full_scale > 0))
    throw Refusal("forces", "none above zero among what is to be fitted", "a muscle that pulls",
                  "the sign of the force");

  const std::vector<Best> found = try_all(s, scales, options, report);
  report.rows = rows_of(s);
  const std::size_t tests = tests_of_form(s.fitted);
  const bool is_prior = tests < 2 && prefer_saturating(report);
  conclude(report, is_prior && tests == 0 ? 0 : 0.1);
  if (is_prior)
    report.rule =
        "of the laws whose bladder saturates, because fewer than two lengths are between "
        "the ends, " +
        report.rule;
  if (options.model.empty())
    refuse_unexplained(
        report, 15,
        "names.COLUMN=NAME or units.NAME=UNIT: columns may be swapped or in other units");
  out.fit = found[report.chosen].fit;
  out.spread = found[report.chosen].spread;
  set_air(options, out);
  out.muscles = muscles_of(out.fit, s.fitted);
  out.points = s.fitted;
  note_muscles(out.fit, points, report);
  note_files(out, report);
  show_static(s, left_out, out);
  return out;
}

}  // namespace sinew::identify
