// report/figures/test_figure.h - a figure with two plots, for tests.
#pragma once

#include <cmath>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report::test {

inline const double nan = std::nan("");

// Returns a figure with curves of several kinds; one has a gap, and one has other times.
inline Figure walk() {
  const std::vector<double> t{0, 0.1, 0.2, 0.3};
  Plot angles{.name = "angles", .x = {"time", "s"}, .y = {"joint angle", "deg"}};
  angles.curves = {{.label = "hip", .xs = t, .ys = {1, 1.0 / 3, nan, 4}, .color = 0},
                   {.label = "hip desired",
                    .xs = t,
                    .ys = {1, 2, 3, 4},
                    .kind = Curve::Kind::desired,
                    .color = 0}};
  Plot force{.name = "force", .x = {"time", "s"}, .y = {"force", "N"}};
  force.curves = {{.xs = t, .ys = {0, -5, 5, 0}},
                  {.label = "hung, on the stand",
                   .xs = {0, 0.3},
                   .ys = {1, 2},
                   .kind = Curve::Kind::synthetic,
                   .style = Curve::Style::points}};
  return {.name = "walk", .title = "Walk", .caption = "A walk", .plots = {angles, force}};
}

}  // namespace sinew::report::test
