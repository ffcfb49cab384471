#include "sinew/identify/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/check/curves.h"
#include "sinew/identify/check/label.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

// --- curves of the mounts compared with each other, and the amount of data ---

namespace {

double strongest(const std::vector<ForceCurve>& curves) {
  double out = 0;
  for (const ForceCurve& c : curves)
    out = std::max(out, *std::max_element(c.force.begin(), c.force.end()));
  return out;
}

// Comparison of two curves at their common pressures: their number, the number at which the second
// pulls more or less by at least a given force, and the mean difference.
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

// Checks that a muscle pulls less where it is shorter, at every pressure.
Check mounts_in_order(const std::vector<ForceCurve>& curves) {
  const double least = 0.02 * strongest(curves);
  Check worst{"mounts in order", TrafficLight::grey,
              "Not checked: no two mounts of a muscle have pressures in common.",
              "Measure every mount at the same pressures."};
  for (std::size_t i = 0; i + 1 < curves.size(); ++i) {
    const ForceCurve &a = curves[i], &b = curves[i + 1];
    if (a.rest_length != b.rest_length || a.branch != b.branch) continue;
    const Between d = between(a, b, least);
    if (d.shared > 0 && worst.light == TrafficLight::grey)
      worst = {"mounts in order", TrafficLight::green,
               "At every pressure a longer mount pulls more.", ""};
    if (d.below == 0) continue;
    const bool swapped = 2 * d.below > d.shared;
    if (worst.light == TrafficLight::red) continue;
    worst = {"mounts in order", swapped ? TrafficLight::red : TrafficLight::yellow,
             fmt::format("The mount of {:.4g} mm pulls less than that of {:.4g} mm at {} of {} "
                         "pressures.",
                         1e3 * b.length, 1e3 * a.length, d.below, d.shared),
             "Check whether the lengths of the two are exchanged, or the columns of force and "
             "pressure, or their muscles differ."};
  }
  return worst;
}

// Checks the contraction at the shortest length at which the muscle still pulls with 5 % of its
// largest force. The tension of [22] ends at a contraction of 1 - 1/(sqrt 3 cos(theta)), which is
// below 0.423 for every angle theta of a braid.
Check contraction(const std::vector<ForceCurve>& curves) {
  std::map<double, std::pair<double, double>> pulling;  // shortest and longest of each muscle [m]
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
    return {"contraction", TrafficLight::red, text,
            "No braid contracts by that much: give muscles of different lengths a rest_length "
            "column, and check the unit of the lengths."};
  if (most > 0.36)
    return {"contraction", TrafficLight::yellow, text, "Check the lengths and the rest length."};
  return {"contraction", TrafficLight::green, text, ""};
}

// Checks that venting pulls more than filling at the same pressure.
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
    return {"branches", TrafficLight::red,
            fmt::format("Rows called vent pull {:.3g} N less than those called fill; friction of "
                        "the braid does the opposite.",
                        -difference / pairs),
            "The words of the branch column are exchanged."};
  double gap = 0, force = 0;
  for (const ForceCurve& c : curves)
    for (std::size_t i = 0; i < c.gap.size(); ++i)
      if (c.gap[i] > 0 && c.force[i] > 0) gap += c.gap[i], force += c.force[i];
  if (pairs == 0 && force == 0)
    return {"branches", TrafficLight::grey,
            "Not checked: no reading is repeated, and no length was measured on both branches.",
            "Read some points twice, or measure on the way up and down."};
  // If both branches are given, readings differ by noise alone.
  const double usual = pairs > 0 ? 0.15 : 0.03;
  if (gap > usual * force)
    return {"branches", TrafficLight::yellow,
            fmt::format("Readings of one length, pressure and branch are {:.2g} % apart.",
                        100 * gap / force),
            pairs > 0
                ? "Check whether all of them are of one muscle, and of the branch that is given."
                : "Add a column branch with fill or vent in each row."};
  return {
      "branches", TrafficLight::green,
      force > 0 ? "Readings of one branch agree." : "Rows called vent pull no less than others.",
      ""};
}

// Checks that readings of equal length, pressure and branch do not contradict each other: then all
// later ones pull more than the earlier ones, or all of them less, as of another muscle.
Check one_muscle(const StaticData& data) {
  constexpr double small = 0.02, large = 0.05;  // shares of the largest force
  constexpr std::size_t enough = 6;
  constexpr auto name = "one muscle";
  double strongest = 0;
  for (const StaticPoint& p : data.points) strongest = std::max(strongest, p.force);
  std::vector<double> later;  // later less earlier reading, where they differ
  std::size_t settings = 0;
  for (const RepeatedReading& r : repeated_readings(data.points)) {
    ++settings;
    if (std::abs(r.last - r.first) > small * strongest) later.push_back(r.last - r.first);
  }
  if (settings < enough)
    return {
        name, TrafficLight::grey,
        fmt::format("Not checked: {} of the readings {} repeated at an equal length, pressure "
                    "and branch, so nothing shows whether all are of one muscle.",
                    settings == 0 ? "none" : std::to_string(settings), settings < 2 ? "is" : "are"),
        "Read some points twice, on the way up and down."};
  const auto more =
      static_cast<std::size_t>(std::ranges::count_if(later, [](double d) { return d > 0; }));
  double sum = 0;
  for (const double d : later) sum += std::abs(d) / static_cast<double>(later.size());
  const bool is_one_sided = 10 * std::max(more, later.size() - more) >= 9 * later.size();
  if (later.size() < enough || 2 * later.size() < settings || !is_one_sided ||
      sum < large * strongest)
    return {name, TrafficLight::green,
            fmt::format("{} readings are repeated, and do not contradict each other.", settings),
            ""};
  return {name, TrafficLight::yellow,
          fmt::format("At {} of {} equal lengths, pressures and branches the later reading is {} "
                      "than the earlier one, by {:.2g} % of the largest force: two muscles, or one "
                      "that changed.",
                      std::max(more, later.size() - more), settings,
                      2 * more > later.size() ? "larger" : "smaller", 100 * sum / strongest),
          "Check whether all rows are of one muscle; give each its own file, or its rows by "
          "where=\"COLUMN=WORD\"."};
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
    return {"clipped sensor", TrafficLight::red,
            fmt::format("In {} of {} curves the force stays at its highest value while the "
                        "pressure rises.",
                        flat, told),
            "The sensor or its converter is at its end: leave those rows out."};
  if (told == 0)
    return {"clipped sensor", TrafficLight::grey,
            "Not checked: no curve has four pressures and a fifth of the largest force.",
            "Measure at least four pressures at the longest mount."};
  return {"clipped sensor", TrafficLight::green, "The force rises up to the highest pressure.", ""};
}

// Returns the number of pressures on the branch that has most.
std::size_t pressures_of(const std::vector<StaticPoint>& points) {
  int most = 0;
  for (const Branch branch : {Branch::vent, Branch::unknown, Branch::fill}) {
    std::vector<StaticPoint> own;
    std::ranges::copy_if(points, std::back_inserter(own),
                         [=](const StaticPoint& p) { return p.branch == branch; });
    if (!own.empty()) most = std::max(most, count_of(pressure_groups(own)));
  }
  return static_cast<std::size_t>(most);
}

Check count(const char* name, std::size_t n, std::size_t red, std::size_t yellow,
            const char* advice) {
  const TrafficLight light = n < red      ? TrafficLight::red
                             : n < yellow ? TrafficLight::yellow
                                          : TrafficLight::green;
  std::string_view one = name;  // "lengths"
  one.remove_suffix(1);
  const std::string text =
      n == 1 ? fmt::format("There is one {} only.", one) : fmt::format("There are {} {}.", n, name);
  return {name, light, text, light == TrafficLight::green ? "" : advice,
          light == TrafficLight::yellow};
}

void add_curve_checks(const StaticData& data, std::vector<Check>& out) {
  const std::vector<ForceCurve> curves = curves_of(data.points);
  out.push_back(mounts_in_order(curves));
  out.push_back(contraction(curves));
  out.push_back(branches(curves));
  out.push_back(one_muscle(data));
  out.push_back(curves_rise(curves));
}

void add_reach_checks(const StaticData& data, bool braid_is_known, std::vector<Check>& out) {
  std::vector<StaticPoint> fitted;
  for (const StaticPoint& p : data.points)
    if (p.fitted) fitted.push_back(p);
  if (fitted.empty()) return;
  const bool fill = has_branch(fitted, Branch::fill), vent = has_branch(fitted, Branch::vent);
  const auto lengths = static_cast<std::size_t>(count_of(length_groups(fitted)));
  out.push_back(
      count("lengths", lengths, braid_is_known ? 1 : 2, 3,
            "Measure more mounts: five separate the braid from the bladder. With one alone "
            "actuator=FILE has to give the braid's geometry."));
  out.push_back(
      count("pressures", pressures_of(fitted), 3, 5, "Measure more pressures: ten are good."));
  if (fill && vent)
    out.push_back({"both ways", TrafficLight::green, "It was filled and vented.", ""});
  else
    out.push_back({"both ways", TrafficLight::yellow,
                   fill   ? "It was only filled."
                   : vent ? "It was only vented."
                          : "No column states whether it was filled or vented.",
                   "The hysteresis stays unknown; measure on the way up and down.", true});
}

// --- units, signs, zeros and lengths ---

constexpr double highest_pressure = 1.2e6;  // pneumatic muscles are limited to 0.6 to 1 MPa [Pa]
constexpr double low_pressure = 1.5e5;      // 20 psi; few muscles are measured below [Pa]
constexpr double newtons_per_lbf = 4.448222;
constexpr double ambient = 101325;    // [Pa]
constexpr double braid_factor = 8.2;  // a - b in check.h, for a braid at 25 degrees [-]

// Extremes of the points.
constexpr double vented_below = 0.03;  // share of the largest pressure

struct Reach {
  double lowest = 1e300, top = -1e300, weakest = 1e300, strongest = -1e300, shortest = 1e300,
         longest = 0;
};

Reach reach_of(const StaticData& data) {
  Reach r;
  for (const StaticPoint& p : data.points) {
    r.lowest = std::min(r.lowest, p.pressure);
    r.top = std::max(r.top, p.pressure);
    r.weakest = std::min(r.weakest, p.force);
    r.strongest = std::max(r.strongest, p.force);
    r.shortest = std::min(r.shortest, p.length);
    r.longest = std::max(r.longest, p.length);
  }
  return r;
}

Check pressure_unit(const Reach& r) {
  const double kpa = r.top / 1e3;
  if (r.top > highest_pressure)
    return {"pressure unit", TrafficLight::red,
            fmt::format("The pressure goes up to {:.4g} kPa; pneumatic muscles are used up to "
                        "1000 kPa, and {:.4g} psi is that number.",
                        kpa, kpa / 6.894757),
            "If the numbers are kPa, try units.COLUMN=\"kPa gauge\"."};
  if (r.lowest < -2e4)
    return {"pressure unit", TrafficLight::red,
            fmt::format("The gauge pressure goes down to {:.4g} kPa, which no muscle holds.",
                        r.lowest / 1e3),
            "If a column is gauge and is called abs, try units.COLUMN=\"kPa gauge\"."};
  if (r.top < low_pressure)
    return {"pressure unit", TrafficLight::yellow,
            fmt::format("The pressure only goes up to {:.4g} kPa; {:.3g} psi would be {:.4g} kPa.",
                        kpa, kpa, kpa * 6.894757),
            "If the numbers are psi, try units.COLUMN=\"psi gauge\"."};
  return {"pressure unit", TrafficLight::green,
          fmt::format("The pressure goes up to {:.4g} kPa.", kpa), ""};
}

// Start of the force at the longest mount.
struct ForceStart {
  double length = 0;          // length of that mount [m]
  double threshold = -1e300;  // gauge pressure at which the straight part starts; very low: unknown
  double first = 0;           // force at its lowest pressure [N]
};

ForceStart start_of(const StaticData& data) {
  ForceStart out;
  for (const ForceCurve& c : curves_of(data.points))
    if (const auto start = threshold_of(c); start && c.length >= out.length) {
      out.length = c.length;
      out.threshold = std::max(out.threshold, *start);
      out.first = std::max(out.first, c.force.front());
    }
  return out;
}

// Checks for absolute pressures: readings, and the force, then begin at the atmosphere. Forces that
// are already large at the lowest pressure, or a mount that is shorter than at rest, do not show
// where the force of a muscle at rest begins.
Check gauge_or_absolute(const StaticData& data, const Reach& r) {
  constexpr auto name = "gauge or absolute";
  const ForceStart start = start_of(data);
  double rest = 0;
  for (const StaticPoint& p : data.points) rest = std::max(rest, p.rest_length);
  if (r.lowest < 0.8 * ambient)
    return {name, TrafficLight::green,
            fmt::format("The lowest pressure is {:.4g} kPa, as of a gauge.", r.lowest / 1e3), ""};
  const double share = start.first / std::max(1e-9, r.strongest);
  const bool begins_low = start.threshold < 0.85 * ambient;
  if (start.threshold >= 0 && begins_low && share < 0.15)
    return {name, TrafficLight::green,
            "The force begins below the pressure of the atmosphere, as with a gauge.", ""};
  if (begins_low || (share > 0.02 && start.length < 0.98 * rest))
    return {
        name, TrafficLight::grey,
        fmt::format("Not checked: the pressure never falls below {:.4g} kPa, and where the force "
                    "begins is not to be seen.",
                    r.lowest / 1e3),
        "Read the force at the lowest pressures, too, or once with the muscle vented."};
  const bool sure =
      share <= 0.02 && std::abs(r.lowest - ambient) < 5e3 && rest > 0 && start.length > 0.98 * rest;
  return {name, sure ? TrafficLight::red : TrafficLight::yellow,
          fmt::format("The pressure never falls below {:.4g} kPa, and the force begins at {:.4g} "
                      "kPa: none is below the atmosphere, 101 kPa.",
                      r.lowest / 1e3, start.threshold / 1e3),
          "If the column is absolute, try units.COLUMN=\"kPa abs\"."};
}

Check sign_of_force(const StaticData& data, const Reach& r) {
  std::size_t negative = 0;
  for (const StaticPoint& p : data.points) negative += p.force < 0;
  if (r.strongest <= 0 || -r.weakest > 0.5 * r.strongest)
    return {"sign of force", TrafficLight::red,
            fmt::format("{} of {} forces are negative, down to {:.4g} N; a muscle pulls, and its "
                        "tension is positive.",
                        negative, data.points.size(), r.weakest),
            "Turn the sign of the force column."};
  return {"sign of force", TrafficLight::green, "The muscle pulls.", ""};
}

// Mean forces of a mount without pressure, and of another, longer one of the same muscle.
struct ZerosOfMounts {
  double shorter = 0, shorter_force = 0, longer = 0, longer_force = 0;  // [m], [N]

  double drop() const { return shorter_force - longer_force; }
};

// Returns the two mounts whose force without pressure falls most with the length. A passive muscle
// pulls more the longer it is held, so such a fall shows a change of the cell's zero.
ZerosOfMounts largest_drop(const StaticData& data, const Reach& r) {
  struct Mean {
    double sum = 0, n = 0;
  };
  std::map<std::pair<double, double>, Mean> mounts;  // by rest length and length
  for (const StaticPoint& p : data.points) {
    if (!(p.pressure < vented_below * r.top)) continue;
    Mean& mean = mounts[{p.rest_length, p.length}];
    mean.sum += p.force, mean.n += 1;
  }
  ZerosOfMounts out;
  for (const auto& [shorter, a] : mounts)
    for (const auto& [longer, b] : mounts) {
      if (shorter.first != longer.first || !(shorter.second < longer.second)) continue;
      const ZerosOfMounts one{shorter.second, a.sum / a.n, longer.second, b.sum / b.n};
      if (one.drop() > out.drop()) out = one;
    }
  return out;
}

// Checks the zero: at the lowest pressure a muscle hardly pulls, so a force there is an offset.
Check zero_of_force(const StaticData& data, const Reach& r, double taken_off) {
  if (std::abs(taken_off) > 0.02 * (r.strongest - r.weakest))
    return {
        "zero of force", TrafficLight::yellow,
        fmt::format("The force cell read {:.4g} N where the muscle is slack; that is taken off.",
                    taken_off),
        "Zero the cell before a measurement, and check whether it drifts.", true};
  double sum = 0, n = 0;
  for (const StaticPoint& p : data.points)
    if (p.pressure < vented_below * r.top) sum += p.force, n += 1;
  if (n == 0)
    return {"zero of force", TrafficLight::grey,
            "Not checked: no reading without pressure, and none of a slack muscle, shows what the "
            "cell reads without force.",
            "Read the force once with the muscle vented and slack."};
  const double zero = sum / n, share = std::abs(zero) / std::max(1e-9, r.strongest - r.weakest);
  const std::string text = fmt::format(
      "Without pressure the force is {:.4g} N, {:.2g} % of its "
      "range.",
      zero, 100 * share);
  if (share > 0.2)
    return {"zero of force", TrafficLight::red, text,
            "Take the zero off; counts of a converter are no newtons."};
  if (share > 0.02) return {"zero of force", TrafficLight::yellow, text, "Take the zero off."};
  const ZerosOfMounts zeros = largest_drop(data, r);
  if (zeros.drop() > 0.02 * (r.strongest - r.weakest))
    return {"zero of force", TrafficLight::yellow,
            fmt::format(
                "Without pressure the force is {:.4g} N at {:.4g} mm and {:.4g} N at {:.4g} "
                "mm; a muscle pulls no less where it is longer, so the cell's zero changed.",
                zeros.shorter_force, 1e3 * zeros.shorter, zeros.longer_force, 1e3 * zeros.longer),
            "Take each mount's own force without pressure off its readings."};
  return {"zero of force", TrafficLight::green, text, ""};
}

// Compares the force of the longest mount at the highest pressure with the ideal law at full
// length.
Check cross_section(const Reach& r, double diameter) {
  const double implied = std::sqrt(4 * std::max(0.0, r.strongest) /
                                   (std::numbers::pi * std::max(1.0, r.top)) / braid_factor);
  const std::string text = fmt::format(
      "{:.4g} N at {:.4g} kPa is what a braid of {:.3g} mm diameter pulls at 25 "
      "degrees",
      r.strongest, r.top / 1e3, 1e3 * implied);
  constexpr auto advice =
      "Check the units of force and pressure: 1 lbf is 4.448 N, and counts are "
      "no newtons.";
  if (diameter > 0) {
    const double ratio = std::pow(implied / diameter, 2);
    const std::string against = fmt::format(
        "{}; that of {:.3g} mm would pull {:.3g} times as much.", text, 1e3 * diameter, 1 / ratio);
    if (ratio > 2.5 || ratio < 0.33) return {"force unit", TrafficLight::red, against, advice};
    if (ratio > 1.8 || ratio < 0.5) return {"force unit", TrafficLight::yellow, against, advice};
    return {"force unit", TrafficLight::green, against, ""};
  }
  if (implied < 0.002 || implied > 0.09)
    return {"force unit", TrafficLight::red, text + ".", advice};
  // Only the diameter distinguishes a thick muscle in lbf from a thin one in N: see check.h.
  return {"force unit", TrafficLight::yellow,
          fmt::format("{}, of {:.3g} mm if the numbers are lbf; nothing here decides which.", text,
                      1e3 * implied * std::sqrt(newtons_per_lbf)),
          "Give the muscle's diameter, diameter=LENGTH, and it is compared.", true};
}

Check length_unit(const Reach& r, double diameter) {
  double d = diameter;
  if (!(d > 0))
    d = std::sqrt(4 * std::max(0.0, r.strongest) / (std::numbers::pi * std::max(1.0, r.top)) /
                  braid_factor);
  const double slender = r.longest / std::max(1e-4, d);
  const std::string text = fmt::format(
      "A muscle of {:.4g} mm with about {:.3g} mm diameter is "
      "{:.3g} times as long as it is wide.",
      1e3 * r.longest, 1e3 * d, slender);
  constexpr auto advice = "Check the unit of the lengths: try units.COLUMN=mm.";
  if (slender < 2.5) return {"length unit", TrafficLight::red, text, advice};
  if (slender > 100) return {"length unit", TrafficLight::yellow, text, advice};
  return {"length unit", TrafficLight::green, text, ""};
}

Check rest_length(const StaticData& data) {
  double most = 0, length = 0, rest = 0;
  for (const StaticPoint& p : data.points)
    if (p.rest_length > 0 && p.length / p.rest_length > most)
      most = p.length / p.rest_length, length = p.length, rest = p.rest_length;
  if (most == 0)
    return {"rest length", TrafficLight::yellow,
            "No rest length is given; the longest length is taken for it.",
            "Measure it, and give it as rest_length, a setting or a column.", true};
  const std::string text = fmt::format(
      "The longest mount, {:.4g} mm, is {:.4g} % of the rest "
      "length, {:.4g} mm.",
      1e3 * length, 100 * most, 1e3 * rest);
  // Makers permit a stretch of 3 % in a frame.
  if (most > 1.03)
    return {
        "rest length", TrafficLight::red, text,
        "No muscle is stretched by more than 3 %: measure its rest length again, and check whether "
        "all lengths are of this muscle."};
  if (most > 1.005)
    return {"rest length", TrafficLight::yellow, text,
            "Where it was not stretched so far, measure the rest length again.", true};
  return {"rest length", TrafficLight::green, text, ""};
}

void add_unit_checks(const StaticData& data, double diameter, double zero,
                     std::vector<Check>& out) {
  const Reach r = reach_of(data);
  out.push_back(pressure_unit(r));
  out.push_back(gauge_or_absolute(data, r));
  out.push_back(sign_of_force(data, r));
  out.push_back(zero_of_force(data, r, zero));
  out.push_back(cross_section(r, diameter));
  out.push_back(length_unit(r, diameter));
  out.push_back(rest_length(data));
}

// --- tables ---

// Checks for a file that is given twice under different names: it has the same readings.
Check repeated(const std::vector<CheckedTable>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Measured &a = tables[i].table, &b = tables[k].table;
      const bool force = a.has("force") && b.has("force") && a["force"] == b["force"];
      if (force && a["pressure"] == b["pressure"])
        return {"files differ", TrafficLight::red,
                fmt::format("{} has the readings of {}.", a.file, b.file),
                "Give each recording once, under its own length."};
    }
  return {"files differ", TrafficLight::green, "No file repeats another.", ""};
}

// Checks for forces in whole numbers, which are converter counts.
Check whole_numbers(const std::vector<CheckedTable>& tables) {
  std::set<double> seen;
  for (const CheckedTable& t : tables)
    if (t.table.has("force"))
      for (const double f : t.table["force"]) {
        if (f != std::round(f))
          return {"counts", TrafficLight::green, "The forces are no counts of a converter.", ""};
        seen.insert(f);
      }
  if (seen.empty()) return {"counts", TrafficLight::green, "The forces are those of loads.", ""};
  if (seen.size() < 20 || *seen.rbegin() < 1000)
    return {
        "counts", TrafficLight::grey,
        "Not checked: too few different forces to distinguish counts of a converter from newtons.",
        "If they are counts, `sinew identify sensor` makes newtons of them."};
  return {"counts", TrafficLight::yellow,
          fmt::format("All forces are whole numbers, up to {:.5g}.", *seen.rbegin()),
          "If they are counts, `sinew identify sensor` makes newtons of them."};
}

std::string all_words(const Check& check) {
  return fmt::format("{}: {}{}{}", check.name, check.evidence, check.advice.empty() ? "" : " ",
                     check.advice);
}

}  // namespace

void CheckInput::add(CheckedTable table) {
  const double force = add_points(table.table, table.known, data).force;
  if (std::abs(force) > std::abs(zero)) zero = force;
  tables.push_back(std::move(table));
}

void CheckInput::add_or_report(CheckedTable table) try {
  add(table);
} catch (const Refusal& refusal) {
  unreadable.push_back(
      {"readable", TrafficLight::red, refusal.what(), "Nothing can be fitted to it.", false});
  tables.push_back(std::move(table));
}

std::vector<Check> check_static(const CheckInput& input) {
  std::vector<Check> out = input.unreadable;
  const StaticData& data = input.data;
  if (out.empty())
    out.push_back({"readable", TrafficLight::green,
                   fmt::format("{} points; files: {}.", data.points.size(), input.tables.size()),
                   ""});
  for (const std::string& warning : data.warnings)
    out.push_back({"recording", TrafficLight::yellow, warning,
                   "Examine the beginning of the recording.", true});
  out.push_back(repeated(input.tables));
  out.push_back(whole_numbers(input.tables));
  if (data.points.empty()) return out;
  add_unit_checks(data, input.diameter, input.zero, out);
  add_curve_checks(data, out);
  add_reach_checks(data, input.braid.has_value(), out);
  if (!has_red(out)) add_label_checks(data, input.atmosphere, out);
  return out;
}

std::string_view word(TrafficLight light) {
  constexpr std::string_view words[] = {"green", "grey", "yellow", "red"};
  return words[static_cast<std::size_t>(light)];
}

bool has_red(const std::vector<Check>& checks) {
  return std::ranges::any_of(checks, [](const Check& c) { return c.light == TrafficLight::red; });
}

void apply_checks(const std::vector<Check>& checks, bool anyway,
                  std::vector<std::string>& warnings) {
  std::string reds;
  int count = 0;
  for (const Check& c : checks)
    if (c.light == TrafficLight::red) {
      reds += all_words(c) + "\n";
      ++count;
    }
  if (count > 0 && !anyway)
    throw Refusal(reds +
                  fmt::format("check: found {} red, above; expected what a fit can be right "
                              "about; try what is advised there, or anyway=true to fit it as "
                              "it is",
                              count));
  for (const Check& c : checks)
    if (c.light == TrafficLight::red || (c.light == TrafficLight::yellow && !c.shown_by_fit))
      warnings.push_back(all_words(c));
}

}  // namespace sinew::identify
