// thesis/figures/chapter_1.cpp - figure 1-1: force over length of a McKibben at 5 bar and of
// muscles of animals, both relative. The figure's own points are Klute et al.'s (1999) and are not
// printed; each curve is a published closed form.
//
//   frog    straight lines between the corners of Gordon, Huxley and Julian (1966), one sarcomere
//   rat     F = 1 - 6.25 (l - 1)^2                          Woittiez et al. (1984)
//   cat     F = exp(-|(l^beta - 1)/omega|^rho)              Brown, Cheng and Loeb (1999), slow
//   fibres:
//                                                           beta = 2.3, omega = 1.12, rho = 1.62
//   human   F = exp(-(l - 1)^2/0.45)                        Thelen (2003)
//
// l is the length relative to that of the greatest force; of a McKibben, to the longest at which
// its threads are not stretched. F is relative to the greatest force.
#include "thesis/figures/thesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sinew/actuator/tension.h"

namespace sinew::thesis {
namespace {

constexpr const char* similar = "within a fifth: our band, since similar is not quantified";

using enum config::StatementClass;

using report::Curve;

constexpr double five_bar = 5e5;  // gauge [Pa]

// Returns the tension of a frog's sarcomere, whose greatest force is at 2.125 um.
double frog(double relative_length) {
  struct Corner {
    double length, force;  // [um], [-]
  };
  constexpr std::array<Corner, 5> corners{
      {{1.27, 0}, {1.67, 0.84}, {2.0, 1}, {2.25, 1}, {3.65, 0}}};
  const double length = 2.125 * relative_length;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const auto &a = corners[i - 1], &b = corners[i];
    if (length >= a.length && length <= b.length)
      return a.force + (b.force - a.force) * (length - a.length) / (b.length - a.length);
  }
  return 0;
}

double rat(double l) { return std::max(0.0, 1 - 6.25 * (l - 1) * (l - 1)); }

double cat(double l) { return std::exp(-std::pow(std::fabs((std::pow(l, 2.3) - 1) / 1.12), 1.62)); }

double human(double l) { return std::exp(-(l - 1) * (l - 1) / 0.45); }

// Returns a curve of points from the shortest to the longest relative length.
template <class Law>
Curve curve(const std::string& label, const std::string& source, double shortest, double longest,
            Law law) {
  Curve out{.label = label, .source = source};
  constexpr int points = 120;
  for (int i = 0; i <= points; ++i) {
    out.xs.push_back(shortest + (longest - shortest) * i / points);
    out.ys.push_back(law(out.xs.back()));
  }
  return out;
}

// Returns the least distance of the McKibben from any of the muscles' curves, the largest over its
// lengths.
double farthest_from_muscles(const Curve& mckibben) {
  double farthest = 0;
  for (std::size_t i = 0; i < mckibben.xs.size(); ++i) {
    const double l = mckibben.xs[i], f = mckibben.ys[i];
    const double forces[] = {frog(l), rat(l), cat(l), human(l)};
    double nearest = 1;
    for (const double muscle : forces) nearest = std::min(nearest, std::fabs(f - muscle));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

}  // namespace

Exhibits chapter_1(const Sources& from) {
  const actuator::Actuator& a = from.actuator;
  const double longest = a.long_end.length, shortest = actuator::shortest_length(a.braid);
  const auto tension = [&](double l) {
    return actuator::clamped_tension(a, l * longest, 0, five_bar, from.air.atmosphere);
  };
  const double greatest = tension(1);
  const Curve mckibben =
      curve("McKibben, 5 bar", "[31] for the thesis's own actuator", shortest / longest, 1,
            [&](double l) { return tension(l) / greatest; });
  Exhibit e{{.name = "1-1",
             .title = "Force over length of muscles and of a McKibben",
             .caption = "Isometric force over length, both relative to where the force is "
                        "greatest, at full activation and at 5 bar. Muscles: published formulas; "
                        "McKibben: [31].",
             .plots = {{.x = {"relative length", "-", 0.5, 1.75},
                        .y = {"relative force", "-", 0},
                        .curves = {mckibben,
                                   curve("frog", "Gordon, Huxley and Julian (1966)", 1.27 / 2.125,
                                         3.65 / 2.125, frog),
                                   curve("rat", "Woittiez et al. (1984)", 0.6, 1.4, rat),
                                   curve("cat", "Brown, Cheng and Loeb (1999)", 0.4, 1.6, cat),
                                   curve("human", "Thelen (2003)", 0.4, 1.6, human)}}},
             .missing = {{"Klute et al.'s curves (1999)", "they are printed as a picture only"}}},
            {}};
  double least_rise = 1;
  for (std::size_t i = 1; i < mckibben.ys.size(); ++i)
    least_rise = std::min(least_rise, mckibben.ys[i] - mckibben.ys[i - 1]);
  const Section text("1.1");
  e.claims = {
      text.number(by_construction, "As of a muscle below its optimum, its force grows with length",
                  "", "least rise of the McKibben's force between points, of the greatest",
                  100 * least_rise, "%", analysis::at_least(0), "[22] rises from b/sqrt(3) on"),
      text.number(
          predicted, "Where it pulls no more is similar to skeletal muscle", "similar",
          "relative length without force, less a frog's, of the range in which a frog's pulls",
          100 * (shortest / longest - 1.27 / 2.125) / (1 - 1.27 / 2.125), "%",
          analysis::another(-20, 20), similar),
      text.number(predicted, "Force-length properties similar to skeletal muscle", "similar",
                  "largest distance from the nearest muscle at a length, of the greatest force",
                  100 * farthest_from_muscles(mckibben), "%", analysis::another(-20, 20), similar,
                  "a muscle's force is flat about its optimum, that of a braid falls from its "
                  "longest length on"),
      report::not_applicable("1.1", "Muscles of various animals (Klute et al. 1999)", "",
                             "their points are printed as a picture only; of insects we have no "
                             "closed form")};
  return {e};
}

}  // namespace sinew::thesis
