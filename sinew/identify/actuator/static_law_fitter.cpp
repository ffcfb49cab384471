#include "sinew/identify/actuator/static_law_fitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sinew/actuator/prediction.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

using Points = std::vector<StaticPoint>;

constexpr int pressure_parts = 4;
constexpr double left_out_tolerance = 1e-6;  // for fits that are used in cross-validation only
constexpr double whole_tolerance = 1e-11;    // for the fit to all points

double mean_square(const std::vector<double>& residuals) {
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return residuals.empty() ? 0 : sum / static_cast<double>(residuals.size());
}

// Returns the mean square over points at which the muscle pulls; 0 if it pulls nowhere.
double mean_square_of_pull(const HeldOutErrors& errors) {
  std::vector<double> pull;
  for (std::size_t i = 0; i < errors.residuals.size(); ++i)
    if (std::isfinite(errors.widths[i])) pull.push_back(errors.residuals[i]);
  return mean_square(pull);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// Returns a part for each point: -1 for those at the end pressures, which are always fitted. With
// two pressures each is a part.
std::vector<int> interior_pressures(const Points& points) {
  std::vector<int> part = pressure_groups(points);
  const int last = *std::max_element(part.begin(), part.end());
  if (last == 1) return part;
  for (int& p : part) p = p == 0 || p == last ? -1 : p % pressure_parts;
  return part;
}

// One mounted length of one muscle.
struct Mount {
  double length = 0, rest_length = 0;
  int group = 0;
  bool at_end = false;  // the longest or the shortest of its muscle
  double away = 0;      // eps_d of static_spread.h without this mount [-]
};

std::vector<Mount> mounts_of(const Points& points, const std::vector<int>& group) {
  std::vector<Mount> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::ranges::find(out, group[i], &Mount::group) == out.end())
      out.push_back({points[i].length, points[i].rest_length, group[i]});
  for (Mount& m : out) {
    const auto beyond = [&](int sign) {
      return std::ranges::any_of(out, [&](const Mount& other) {
        return other.rest_length == m.rest_length && sign * (other.length - m.length) > 0;
      });
    };
    m.at_end = !beyond(1) || !beyond(-1);
    std::vector<double> others;
    for (const Mount& other : out)
      if (other.rest_length == m.rest_length && &other != &m) others.push_back(other.length);
    m.away = actuator::harmonic_distance(others, m.length) / m.rest_length;
  }
  return out;
}

// Returns a part for each point: 0 at the lowest pressure, 1 at the highest, -1 otherwise.
std::vector<int> end_pressures(const Points& points) {
  std::vector<int> part = pressure_groups(points);
  const int last = *std::max_element(part.begin(), part.end());
  for (int& p : part) p = p == 0 ? 0 : p == last ? 1 : -1;
  return part;
}

// Lengths that were left out one by one.
struct LeftOutLengths {
  HeldOutErrors all;
  // Lengths at which the muscle pulls, with the mean square of each.
  std::vector<LengthError> missed;
  std::string each;  // text of the error of each length
};

// Predicts each end length, or each length between, from all other lengths.
LeftOutLengths cross_lengths(const StaticLawFitter& model, const Points& points,
                             const StaticFit& whole, bool at_end, double full_scale) {
  const std::vector<int> group = length_groups(points);
  LeftOutLengths out;
  for (const Mount& mount : mounts_of(points, group)) {
    if (mount.at_end != at_end) continue;
    std::vector<int> mine(points.size(), 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (group[i] == mount.group) mine[i] = 0;
    const HeldOutErrors one = model.cross(points, mine, 1, whole);
    const Score s = score(one.residuals, full_scale);
    out.each += fmt::format("{}{:.4g} mm {:.2f}/{:.2f}", out.each.empty() ? "" : ", ",
                            1e3 * mount.length, s.rmse_percent, s.max_percent);
    out.all.add(one);
    if (const double square = mean_square_of_pull(one); square > 0)
      out.missed.push_back({square / (full_scale * full_scale), mount.away});
  }
  return out;
}

// Writes the errors of muscles that were left out.
void add_muscles(const std::vector<LeftOut>& muscles, StaticSpread& spread) {
  double square = 0;
  for (const LeftOut& m : muscles) {
    square += m.square / static_cast<double>(muscles.size());
    double next = std::numeric_limits<double>::infinity();
    for (const LeftOut& other : muscles)
      if (&other != &m)
        next = std::min(next, std::abs(std::log(other.rest_length / m.rest_length)));
    spread.other_reach = std::max(spread.other_reach, next);
  }
  spread.other_share_68 = other_68 * std::sqrt(square);
  spread.other_share_95 = other_95 * std::sqrt(square);
}

// Notes the errors on muscles that were left out. Returns the mean square, each muscle as a
// share of its own largest force [-].
double add_muscle_notes(const std::vector<LeftOut>& muscles, const std::set<double>& all,
                        Fit& fit) {
  for (const double muscle : all)
    if (all.size() > 1 &&
        std::ranges::find(muscles, muscle, &LeftOut::rest_length) == muscles.end())
      fit.notes.push_back(fmt::format(
          "the muscle of {:.4g} mm was not left out: the others alone are too few to fit it",
          1e3 * muscle));
  std::string each;
  double square = 0;
  for (const LeftOut& m : muscles) {
    each += fmt::format("{}{:.4g} mm {:.2f}/{:.2f}", each.empty() ? "" : ", ", 1e3 * m.rest_length,
                        m.score.rmse_percent, m.score.max_percent);
    square += std::pow(m.score.rmse_percent / 100, 2) / static_cast<double>(muscles.size());
  }
  if (!muscles.empty())
    fit.notes.push_back("muscles that it did not see, rmse/max % of their own largest force: " +
                        each);
  return square;
}

}  // namespace

StaticLawFitter::StaticLawFitter(const StaticModel& model, const StaticScales& scales,
                                 const Points& points)
    : model_(model), scales_(scales), free_parameters_(free_parameters_of(model, scales)) {
  const bool gives_way =
      std::ranges::find(free_parameters_, FreeParameter::series) != free_parameters_.end();
  if (muscles_in(points).size() > 1 && !gives_way)
    free_parameters_.push_back(FreeParameter::end_loss);
  if (has_branch(points, Branch::fill) && has_branch(points, Branch::vent))
    free_parameters_.insert(free_parameters_.end(),
                            {FreeParameter::half_width, FreeParameter::width_per_pressure,
                             FreeParameter::width_per_tension});
  if (count_of(length_groups(points)) > 1) return;
  if (!scales.braid)
    throw Refusal("lengths", "one length only", "several lengths, or a braid that is known",
                  "measure at other lengths, or actuator=FILE with the braid's geometry");
  for (const FreeParameter free_parameter : free_parameters_)
    if (needs_lengths(free_parameter))
      throw Refusal("lengths", "one length only", "several for this", "");
}

StaticFit StaticLawFitter::fit(const Points& points, const StaticFit* start) const {
  if (model_.name == "effectiveness-by-ratio") return fit_by_ratio(points, scales_);
  return fit_static(free_parameters_, points, scales_, start,
                    start ? left_out_tolerance : whole_tolerance);
}

HeldOutErrors StaticLawFitter::cross(const Points& points, const std::vector<int>& part, int parts,
                                     const StaticFit& whole) const {
  HeldOutErrors out;
  for (int k = 0; k < parts; ++k) {
    const StaticSplit s = split(points, [&](std::size_t i) { return part[i] != k; });
    if (s.held_out.empty()) continue;
    out.add(held_out_errors(fit(s.fitted, &whole), s.held_out));
  }
  return out;
}

LeftOut StaticLawFitter::leave_out(const Points& points, double muscle) const {
  const StaticSplit s =
      split(points, [&](std::size_t i) { return points[i].rest_length != muscle; });
  const StaticScales scales = scales_of(s.fitted, scales_.atmosphere, scales_.braid);
  const StaticLawFitter others(model_, scales, s.fitted);
  LeftOut left{.rest_length = muscle, .errors = held_out_errors(others.fit(s.fitted), s.held_out)};
  for (const StaticPoint& p : s.held_out) left.largest = std::max(left.largest, p.force);
  left.score = score(left.errors.residuals, left.largest);
  std::vector<double> shares;
  for (std::size_t i = 0; i < s.held_out.size(); ++i) {
    const double off = left.errors.residuals[i], force = s.held_out[i].force + off;
    if (std::isfinite(left.errors.widths[i]))
      shares.push_back(std::hypot(off, std::sqrt(s.held_out[i].variance)) /
                       std::hypot(left.largest, by_force * force));
  }
  left.square = mean_square(shares);
  return left;
}

std::vector<LeftOut> StaticLawFitter::leave_out_muscles(const Points& points) const {
  const std::set<double> muscles = muscles_in(points);
  std::vector<LeftOut> out;
  if (muscles.size() < 2) return out;
  for (const double muscle : muscles) {
    try {
      out.push_back(leave_out(points, muscle));
    } catch (const Refusal&) {
      continue;  // too few other points; cross_validate() notes it
    }
  }
  return out;
}

StaticSpread cross_validate(const StaticLawFitter& model, const Points& points,
                            const StaticFit& whole, const std::vector<LeftOut>& muscles,
                            double full_scale, Fit& fit) {
  const std::vector<int> part = interior_pressures(points);
  const int parts = 1 + *std::max_element(part.begin(), part.end());
  HeldOutErrors inside = model.cross(points, part, parts, whole);
  std::vector<double> squares;
  if (!inside.residuals.empty()) {
    squares.push_back(mean_square(inside.residuals));
    fit.notes.push_back(fmt::format("pressures between the ends that it did not see: {:.2f} % rmse",
                                    100 * std::sqrt(squares[0]) / full_scale));
  }

  StaticSpread out;
  out.inside = quantiles(inside);
  LeftOutLengths lengths = cross_lengths(model, points, whole, false, full_scale);
  const double of_pressures = mean_square_of_pull(inside) / (full_scale * full_scale);
  for (LengthError& m : lengths.missed) m.square -= of_pressures;
  add_between(lengths.missed, full_scale, out);
  if (!lengths.each.empty()) {
    fit.notes.push_back("lengths between the ends that it did not see, rmse/max %: " +
                        lengths.each);
    squares.push_back(mean_square(lengths.all.residuals));
    inside.add(lengths.all);
    if (squares.size() == 1) out.inside = quantiles(inside);  // one pressure only
  }
  const double of_muscles =
      add_muscle_notes(muscles, muscles_in(points), fit) * full_scale * full_scale;
  if (!muscles.empty()) squares.push_back(of_muscles);

  for (const double square : squares) fit.kinds.push_back(100 * std::sqrt(square) / full_scale);
  fit.cross_validated = score(inside.residuals, full_scale);
  fit.cross_validated->rmse = std::sqrt(mean(squares));
  fit.cross_validated->rmse_percent = 100 * fit.cross_validated->rmse / full_scale;
  add_muscles(muscles, out);

  if (count_of(length_groups(points)) < 3) return out;
  LeftOutLengths ends = cross_lengths(model, points, whole, true, full_scale);
  fit.extrapolated = score(ends.all.residuals, full_scale);
  fit.notes.push_back("lengths at the ends that it did not see, rmse/max %: " + ends.each);
  if (count_of(pressure_groups(points)) > 3)
    ends.all.add(model.cross(points, end_pressures(points), 2, whole));
  out.beyond = wider(out.inside, quantiles(ends.all));
  return out;
}

}  // namespace sinew::identify
