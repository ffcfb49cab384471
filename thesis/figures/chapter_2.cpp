// thesis/figures/chapter_2.cpp - figures computed from laws: 2-6, 2-11, 2-13. Those of the test
// stand are in chapter_2_stand.cpp.
#include "thesis/figures/thesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/units/constants.h"

namespace sinew::thesis {
namespace {

using enum config::StatementClass;

using report::Curve;
using units::inch, units::psi, units::pound_force;

// Returns 20 to 110 psi, the range of figure 2-6.
std::vector<double> gauge_pressures() {
  std::vector<double> out;
  for (int p = 20; p <= 110; p += 10) out.push_back(p);
  return out;
}

// Returns lengths [in] from L_min to beyond the figure's right end, including L_max.
std::vector<double> lengths(const actuator::Actuator& a, double longest) {
  const double shortest = actuator::shortest_length(a.braid) / inch;
  std::vector<double> out{shortest, a.long_end.length / inch};
  for (int i = 0; i <= std::lround(longest / 0.025); ++i)
    if (0.025 * i > shortest) out.push_back(0.025 * i);
  std::ranges::sort(out);
  return out;
}

// Returns y over length for each pressure.
template <class Law>
std::vector<Curve> family(const std::vector<double>& pressures, const std::vector<double>& length,
                          const std::string& source, Law law) {
  std::vector<Curve> out;
  for (const double p : pressures) {
    Curve c{.label = fmt::format("{:.0f} psi", p), .xs = length, .color = 0, .source = source};
    for (const double l : length) c.ys.push_back(law(l * inch, p * psi));
    out.push_back(std::move(c));
  }
  return out;
}

Exhibit figure_2_6(const Sources& from) {
  const actuator::Braid& braid = from.actuator.braid;
  const std::vector<double> length = lengths(from.actuator, 4.0);
  const auto force = family(
      gauge_pressures(), length, "[22], without effectiveness",
      [&](double l, double p) { return actuator::ideal_tension(braid, l, p) / pound_force; });
  const auto stiffness =
      family(gauge_pressures(), length, "[26], without effectiveness", [&](double l, double p) {
        return actuator::ideal_stiffness(braid, l, p) / (pound_force / inch);
      });
  Exhibit e{{.name = "2-6",
             .title = "Force and stiffness over length and pressure",
             .caption = "Ideal force [22] and stiffness at constant pressure [26] of the actuator "
                        "of 2.1 at gauge pressures of 20 to 110 psi, from the length at which "
                        "it stops pulling on.",
             .plots = {{.name = "force",
                        .x = {"length", "in"},
                        .y = {"force", "lbf", 0},
                        .curves = force,
                        .names = report::Plot::Names::ends},
                       {.name = "stiffness",
                        .x = {"length", "in"},
                        .y = {"stiffness", "lbf/in", 0},
                        .curves = stiffness,
                        .names = report::Plot::Names::ends}}},
            {}};

  double straightest = 1, bent = 0, uneven = 0;
  for (const Curve& c : force) straightest = std::min(straightest, report::bend(trace(c)));
  for (const Curve& c : stiffness) bent = std::max(bent, report::bend(trace(c)));
  // Stiffness over pressure, at the longest length.
  Curve over{.xs = gauge_pressures()};
  for (const Curve& c : stiffness) over.ys.push_back(c.ys.back());
  uneven = report::bend(trace(over));
  double at_shortest = 0, largest = 0;
  for (const Curve& c : force) {
    at_shortest = std::max(at_shortest, std::fabs(c.ys.front()));
    largest = std::max(largest, c.ys.back());
  }
  e.claims = {
      Section("2.2").number(
          by_construction, "Force is no straight line over length", "",
          "least distance of a curve from a straight line, of its range", 100 * straightest, "%",
          analysis::another(analysis::identity(100).highest, 100),
          "[22] is of second order in the length, for any numbers; no more than rounding "
          "would be a line"),
      Section("2.2").number(by_construction, "Force goes to zero at the greatest contraction", "0",
                            "largest force at b/sqrt(3)", at_shortest, "lbf",
                            analysis::identity(largest), "[22] with 3 L2 = b2"),
      Section("2.2").number(by_construction, "Stiffness rises linearly with length", "",
                            "largest distance of a curve from a straight line, of its range",
                            100 * bent, "%", analysis::identity(100), "[26]"),
      Section("2.2").number(by_construction, "Stiffness rises linearly with pressure", "",
                            "distance from a straight line over pressure at the longest length",
                            100 * uneven, "%", analysis::identity(100), "[26]")};
  return e;
}

Exhibit figure_2_13(const Sources& from) {
  const actuator::Actuator& a = from.actuator;
  const auto curves =
      family({20, 60, 100}, lengths(a, 4.0), "[31], [32] for the thesis's own actuator",
             [&](double l, double p) {
               return actuator::clamped_tension(a, l, 0, p, from.air.atmosphere) / pound_force;
             });
  Exhibit e{{.name = "2-13",
             .title = "The long end effect",
             .caption = "Force over length at constant pressure, beyond the greatest length "
                        "L_max at 3.918 in, where the threads themselves are stretched. Lines: "
                        "[31], [32]; points: our stand at 60 psi.",
             .plots = {{.x = {"length", "in"},
                        .y = {"force", "lbf", 0},
                        .curves = curves,
                        .names = report::Plot::Names::ends}},
             .missing = {{"Shadow Robot Company's data (1999)",
                          "of a larger actuator whose size is not given"}}},
            {}};
  const double end = a.long_end.length / inch;
  double least_ratio = 1e300;
  for (const Curve& c : curves) {
    const double before = report::line_of(report::part(trace(c), end - 0.1, end)).slope;
    const double beyond = report::line_of(report::part(trace(c), end, end + 0.1)).slope;
    least_ratio = std::min(least_ratio, beyond / before);
  }
  e.claims = {Section("2.3, [32]")
                  .number(put_in,
                          "Beyond the greatest length the threads stretch: a spring that is "
                          "very stiff compared with the actuator",
                          "", "least ratio of the slopes beyond and before L_max", least_ratio, "",
                          analysis::much_more(1),
                          "the stiffness of the threads, 500 lbf/in, is appendix A's"),
              report::not_applicable("2.3", "Data of Shadow Robot Company show the effect", "",
                                     "they are of a larger actuator whose size is not given; the "
                                     "thesis's actuator is drawn in its place")};
  return e;
}

}  // namespace

Exhibits chapter_2(const Sources& from) {
  Exhibits out{figure_2_6(from)};
  Exhibit last = figure_2_13(from);
  for (Exhibit& e : weights(from)) out.push_back(std::move(e));
  add_length_sweep(from, last);
  out.push_back(std::move(last));
  return out;
}

}  // namespace sinew::thesis
