// Checks units, signs, zeros and lengths by the size of what was read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/identify/check/curves.h"
#include "sinew/identify/check/plausible.h"

namespace sinew::identify {

namespace {

constexpr double highest_pressure = 1.2e6;  // pneumatic muscles end at 0.6 to 1 MPa [Pa]
constexpr double low_pressure = 1.5e5;      // 20 psi; few muscles are measured below [Pa]
constexpr double newtons_per_lbf = 4.448222;
constexpr double ambient = 101325;    // [Pa]
constexpr double braid_factor = 8.2;  // a - b in check.h, of a braid at 25 degrees [-]

// Extremes of the points.
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
    return {"pressure unit", Light::red,
            fmt::format("The pressure goes up to {:.4g} kPa; pneumatic muscles are used up to "
                        "1000 kPa, and {:.4g} psi is that number.",
                        kpa, kpa / 6.894757),
            "If the numbers are kPa, try units.COLUMN=\"kPa gauge\"."};
  if (r.lowest < -2e4)
    return {"pressure unit", Light::red,
            fmt::format("The gauge pressure goes down to {:.4g} kPa, which no muscle holds.",
                        r.lowest / 1e3),
            "If a column is gauge and is called abs, try units.COLUMN=\"kPa gauge\"."};
  if (r.top < low_pressure)
    return {"pressure unit", Light::yellow,
            fmt::format("The pressure only goes up to {:.4g} kPa; {:.3g} psi would be {:.4g} kPa.",
                        kpa, kpa, kpa * 6.894757),
            "If the numbers are psi, try units.COLUMN=\"psi gauge\"."};
  return {"pressure unit", Light::green, fmt::format("The pressure goes up to {:.4g} kPa.", kpa),
          ""};
}

// Absolute readings begin at the atmosphere, and so does the force.
Check gauge_or_absolute(const StaticData& data, const Reach& r) {
  double longest = 0, threshold = -1e300, first = 0, rest = 0;
  for (const StaticPoint& p : data.points) rest = std::max(rest, p.rest_length);
  for (const ForceCurve& c : curves_of(data.points))
    if (const auto start = threshold_of(c); start && c.length >= longest) {
      longest = c.length;
      threshold = std::max(threshold, *start);
      first = std::max(first, c.force.front());
    }
  if (r.lowest >= 0.8 * ambient && threshold < 0 && first <= 0.02 * r.strongest)
    return {
        "gauge or absolute", Light::grey,
        fmt::format("Not checked: the pressure never falls below {:.4g} kPa, and where the force "
                    "begins is not to be seen.",
                    r.lowest / 1e3),
        "Read the force at the lowest pressures, too."};
  if (r.lowest < 0.8 * ambient || threshold < 0.85 * ambient || first > 0.02 * r.strongest)
    return {"gauge or absolute", Light::green,
            r.lowest < 0.8 * ambient
                ? fmt::format("The lowest pressure is {:.4g} kPa, as of a gauge.", r.lowest / 1e3)
                : std::string(
                      "The force begins below the pressure of the atmosphere, as with a gauge."),
            ""};
  const bool sure = std::abs(r.lowest - ambient) < 5e3 && rest > 0 && longest > 0.98 * rest;
  return {"gauge or absolute", sure ? Light::red : Light::yellow,
          fmt::format("The pressure never falls below {:.4g} kPa, and the force begins at {:.4g} "
                      "kPa: both stand at the atmosphere, 101 kPa.",
                      r.lowest / 1e3, threshold / 1e3),
          "If the column is absolute, try units.COLUMN=\"kPa abs\"."};
}

Check sign_of_force(const StaticData& data, const Reach& r) {
  std::size_t negative = 0;
  for (const StaticPoint& p : data.points) negative += p.force < 0;
  if (r.strongest <= 0 || -r.weakest > 0.5 * r.strongest)
    return {"sign of force", Light::red,
            fmt::format("{} of {} forces are negative, down to {:.4g} N; a muscle pulls, and its "
                        "tension is positive.",
                        negative, data.points.size(), r.weakest),
            "Turn the sign of the force column."};
  return {"sign of force", Light::green, "The muscle pulls.", ""};
}

// A muscle hardly pulls at the lowest pressure: a force there is a zero that was not taken off.
Check zero_of_force(const StaticData& data, const Reach& r, double taken_off) {
  if (std::abs(taken_off) > 0.02 * (r.strongest - r.weakest))
    return {
        "zero of force", Light::yellow,
        fmt::format("The force cell read {:.4g} N where the muscle is slack; that is taken off.",
                    taken_off),
        "Zero the cell before a measurement, and look whether it drifts.", true};
  double sum = 0, n = 0;
  for (const StaticPoint& p : data.points)
    if (p.pressure < 0.03 * r.top) sum += p.force, n += 1;
  if (n == 0)
    return {"zero of force", Light::grey,
            "Not checked: no reading without pressure, and none of a slack muscle, shows what the "
            "cell reads without force.",
            "Read the force once with the muscle vented and slack."};
  const double zero = sum / n, share = std::abs(zero) / std::max(1e-9, r.strongest - r.weakest);
  const std::string text = fmt::format(
      "Without pressure the force is {:.4g} N, {:.2g} % of its "
      "range.",
      zero, 100 * share);
  if (share > 0.2)
    return {"zero of force", Light::red, text,
            "Take the zero off; counts of a converter are no newtons."};
  if (share > 0.02) return {"zero of force", Light::yellow, text, "Take the zero off."};
  return {"zero of force", Light::green, text, ""};
}

// The force of the longest mount at the highest pressure against the ideal law at full length.
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
    if (ratio > 2.5 || ratio < 0.33) return {"force unit", Light::red, against, advice};
    if (ratio > 1.8 || ratio < 0.5) return {"force unit", Light::yellow, against, advice};
    return {"force unit", Light::green, against, ""};
  }
  if (implied < 0.002 || implied > 0.09) return {"force unit", Light::red, text + ".", advice};
  // Nothing but the diameter tells a thick muscle in lbf from a thin one in N: see check.h.
  return {"force unit", Light::yellow,
          fmt::format("{}, of {:.3g} mm if the numbers are lbf; nothing here tells which.", text,
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
  if (slender < 2.5) return {"length unit", Light::red, text, advice};
  if (slender > 100) return {"length unit", Light::yellow, text, advice};
  return {"length unit", Light::green, text, ""};
}

Check rest_length(const StaticData& data) {
  double most = 0, length = 0, rest = 0;
  for (const StaticPoint& p : data.points)
    if (p.rest_length > 0 && p.length / p.rest_length > most)
      most = p.length / p.rest_length, length = p.length, rest = p.rest_length;
  if (most == 0)
    return {"rest length", Light::yellow,
            "No rest length is given; the longest length is taken for it.",
            "Measure it, and give it as rest_length, a setting or a column.", true};
  const std::string text = fmt::format(
      "The longest mount, {:.4g} mm, is {:.4g} % of the rest "
      "length, {:.4g} mm.",
      1e3 * length, 100 * most, 1e3 * rest);
  // Makers let their muscles be stretched by 3 % in a frame.
  if (most > 1.03)
    return {
        "rest length", Light::red, text,
        "No muscle is stretched by more than 3 %: measure its rest length again, and look whether "
        "all lengths are of this muscle."};
  if (most > 1.005)
    return {"rest length", Light::yellow, text,
            "Where it was not stretched so far, measure the rest length again.", true};
  return {"rest length", Light::green, text, ""};
}

}  // namespace

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

}  // namespace sinew::identify
