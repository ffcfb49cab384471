// Checks how the curves of the mounts lie to each other, and counts what they can tell.
#include "sinew/identify/check/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/check/curves.h"

namespace sinew::identify {

namespace {

double strongest(const std::vector<ForceCurve>& curves) {
  double out = 0;
  for (const ForceCurve& c : curves)
    out = std::max(out, *std::max_element(c.force.begin(), c.force.end()));
  return out;
}

// Two curves at the pressures that they share: how many there are, at how many the second pulls
// more or less by at least a given force, and the mean of second minus first.
struct Between {
  int shared = 0, above = 0, below = 0;
  double mean = 0;  // second minus first [N]
};

Between between(const ForceCurve& first, const ForceCurve& second, double least) {
  Between out;
  for (std::size_t i = 0; i < first.pressure.size(); ++i) {
    const auto other = force_at(second, first.pressure[i]);
    if (!other || std::max(*other, first.force[i]) < 3 * least) continue;
    ++out.shared;
    out.above += *other - first.force[i] > least;
    out.below += *other - first.force[i] < -least;
    out.mean += *other - first.force[i];
  }
  if (out.shared > 0) out.mean /= out.shared;
  return out;
}

// A muscle pulls less where it is shorter, at every pressure.
Check mounts_in_order(const std::vector<ForceCurve>& curves) {
  const double least = 0.02 * strongest(curves);
  Check worst{"mounts in order", Light::grey,
              "Not checked: no two mounts of a muscle have pressures in common.",
              "Measure every mount at the same pressures."};
  for (std::size_t i = 0; i + 1 < curves.size(); ++i) {
    const ForceCurve &a = curves[i], &b = curves[i + 1];
    if (a.rest_length != b.rest_length || a.branch != b.branch) continue;
    const Between d = between(a, b, least);
    if (d.shared > 0 && worst.light == Light::grey)
      worst = {"mounts in order", Light::green, "At every pressure a longer mount pulls more.", ""};
    if (d.below == 0) continue;
    const bool swapped = 2 * d.below > d.shared;
    if (worst.light == Light::red) continue;
    worst = {"mounts in order", swapped ? Light::red : Light::yellow,
             fmt::format("The mount of {:.4g} mm pulls less than that of {:.4g} mm at {} of {} "
                         "pressures.",
                         1e3 * b.length, 1e3 * a.length, d.below, d.shared),
             "Look whether the lengths of the two are exchanged, or the columns of force and "
             "pressure, or their muscles differ."};
  }
  return worst;
}

// The shortest length at which it still pulls with 5 % of its largest force says how far it
// contracts. The tension of [22] ends at a contraction of 1 - 1/(sqrt 3 cos(theta)), which is below
// 0.423 for every angle theta of a braid.
Check contraction(const std::vector<ForceCurve>& curves) {
  std::map<double, std::pair<double, double>> pulling;  // of each muscle: shortest, longest [m]
  const double least = 0.05 * strongest(curves);
  for (const ForceCurve& c : curves) {
    auto& [shortest, longest] = pulling.try_emplace(c.rest_length, 1e300, 0.0).first->second;
    longest = std::max(longest, c.length);
    if (*std::max_element(c.force.begin(), c.force.end()) > least)
      shortest = std::min(shortest, c.length);
  }
  double most = 0;
  for (const auto& [rest, ends] : pulling)
    if (ends.first < 1e300) most = std::max(most, 1 - ends.first / std::max(rest, ends.second));
  const std::string text =
      fmt::format("The muscle still pulls when it is {:.3g} % shorter than at rest.", 100 * most);
  if (most > 0.42)
    return {"contraction", Light::red, text,
            "No braid contracts by that much: give muscles of different lengths a rest_length "
            "column, and check the unit of the lengths."};
  if (most > 0.36)
    return {"contraction", Light::yellow, text, "Check the lengths and the rest length."};
  return {"contraction", Light::green, text, ""};
}

// Venting pulls more than filling did at the same pressure.
Check branches(const std::vector<ForceCurve>& curves) {
  double difference = 0;
  int pairs = 0;
  for (const ForceCurve& a : curves)
    for (const ForceCurve& b : curves)
      if (a.branch == Branch::vent && b.branch == Branch::fill && a.length == b.length &&
          a.rest_length == b.rest_length) {
        const Between d = between(b, a, 0.005 * strongest(curves));
        if (d.shared == 0) continue;
        difference += d.mean;
        ++pairs;
      }
  if (pairs > 0 && difference / pairs < -0.005 * strongest(curves))
    return {"branches", Light::red,
            fmt::format("Rows called vent pull {:.3g} N less than those called fill; friction of "
                        "the braid does the opposite.",
                        -difference / pairs),
            "The words of the branch column are exchanged."};
  double gap = 0, force = 0;
  for (const ForceCurve& c : curves)
    for (std::size_t i = 0; i < c.gap.size(); ++i)
      if (c.gap[i] > 0 && c.force[i] > 0) gap += c.gap[i], force += c.force[i];
  if (pairs == 0 && force == 0)
    return {"branches", Light::grey,
            "Not checked: no reading is repeated, and no length was measured on both branches.",
            "Read some points twice, or measure on the way up and down."};
  // Where both branches are told, readings are apart by their noise alone.
  const double usual = pairs > 0 ? 0.15 : 0.03;
  if (gap > usual * force)
    return {"branches", Light::yellow,
            fmt::format("Readings of one length, pressure and branch are {:.2g} % apart.",
                        100 * gap / force),
            pairs > 0
                ? "Look whether all of them are of one muscle, and of the branch that is told."
                : "Say in a column branch which rows are fill and which are vent."};
  return {
      "branches", Light::green,
      force > 0 ? "Readings of one branch agree." : "Rows called vent pull no less than others.",
      ""};
}

Check curves_rise(const std::vector<ForceCurve>& curves) {
  const double most = strongest(curves);
  int flat = 0, told = 0;
  for (const ForceCurve& c : curves) {
    const double high = *std::max_element(c.force.begin(), c.force.end());
    if (c.force.size() < 4 || high < 0.2 * most) continue;
    ++told;
    std::size_t ends = 0;
    for (const double f : c.force) ends += f > 0.998 * high;
    flat += ends >= 3 && 4 * ends >= c.force.size();
  }
  if (flat > 0)
    return {"clipped sensor", Light::red,
            fmt::format("In {} of {} curves the force stays at its highest value while the "
                        "pressure rises.",
                        flat, told),
            "The sensor or its converter is at its end: leave those rows out."};
  if (told == 0)
    return {"clipped sensor", Light::grey,
            "Not checked: no curve has four pressures and a fifth of the largest force.",
            "Measure at least four pressures at the longest mount."};
  return {"clipped sensor", Light::green, "The force rises up to the highest pressure.", ""};
}

auto is_of(Branch branch) {
  return [=](const StaticPoint& p) { return p.branch == branch; };
}

// How many pressures there are on the way up or down, whichever has more.
std::size_t pressures_of(const std::vector<StaticPoint>& points) {
  int most = 0;
  for (const Branch branch : {Branch::vent, Branch::unknown, Branch::fill}) {
    std::vector<StaticPoint> own;
    std::ranges::copy_if(points, std::back_inserter(own), is_of(branch));
    if (!own.empty()) most = std::max(most, count_of(pressure_groups(own)));
  }
  return static_cast<std::size_t>(most);
}

Check count(const char* name, std::size_t n, std::size_t red, std::size_t yellow,
            const char* advice) {
  const Light light = n < red ? Light::red : n < yellow ? Light::yellow : Light::green;
  std::string_view one = name;  // "lengths"
  one.remove_suffix(1);
  const std::string text =
      n == 1 ? fmt::format("There is one {} only.", one) : fmt::format("There are {} {}.", n, name);
  return {name, light, text, light == Light::green ? "" : advice, light == Light::yellow};
}

}  // namespace

void add_curve_checks(const StaticData& data, std::vector<Check>& out) {
  const std::vector<ForceCurve> curves = curves_of(data.points);
  out.push_back(mounts_in_order(curves));
  out.push_back(contraction(curves));
  out.push_back(branches(curves));
  out.push_back(curves_rise(curves));
}

void add_reach_checks(const StaticData& data, bool braid_is_known, std::vector<Check>& out) {
  std::vector<StaticPoint> fitted;
  for (const StaticPoint& p : data.points)
    if (p.fitted) fitted.push_back(p);
  if (fitted.empty()) return;
  const bool fill = std::ranges::any_of(fitted, is_of(Branch::fill)),
             vent = std::ranges::any_of(fitted, is_of(Branch::vent));
  const auto lengths = static_cast<std::size_t>(count_of(length_groups(fitted)));
  out.push_back(count("lengths", lengths, braid_is_known ? 1 : 2, 3,
                      "Measure more mounts: five tell the braid from the bladder. With one alone "
                      "actuator=FILE has to give the braid's geometry."));
  out.push_back(
      count("pressures", pressures_of(fitted), 3, 5, "Measure more pressures: ten are good."));
  if (fill && vent)
    out.push_back({"both ways", Light::green, "It was filled and vented.", ""});
  else
    out.push_back({"both ways", Light::yellow,
                   fill   ? "It was only filled."
                   : vent ? "It was only vented."
                          : "No column says whether it was filled or vented.",
                   "The hysteresis stays unknown; measure on the way up and down.", true});
}

}  // namespace sinew::identify
