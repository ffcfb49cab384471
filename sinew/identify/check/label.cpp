#include "sinew/identify/check/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/check/label_fit.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

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
  bool fill = false, vent = false;
  for (const StaticPoint& p : points) {
    fill |= p.branch == Branch::fill;
    vent |= p.branch == Branch::vent;
  }
  if (fill && vent) law.push_back(half_width);
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

Points of_muscle(const Points& points, double rest_length) {
  Points out;
  for (const StaticPoint& p : points)
    if (p.rest_length == rest_length) out.push_back(p);
  return out;
}

std::set<double> mounts_of_muscle(const Points& points) {
  std::set<double> out;
  for (const StaticPoint& p : points) out.insert(p.length);
  return out;
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
  std::set<double> muscles;
  for (const StaticPoint& p : points) muscles.insert(p.rest_length);
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
    const double longest = std::ranges::max(points, {}, &StaticPoint::length).length;
    for (StaticPoint& p : points) p.rest_length = longest;
  }
  const std::vector<Doubt> make = doubts_of_make(points, atmosphere);
  std::set<double> muscles;
  for (const StaticPoint& p : points) muscles.insert(p.rest_length);
  int checked = make.empty() ? 0 : 1;
  bool named = false;
  for (const double m : muscles) {
    const Points mine = of_muscle(points, m);
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
