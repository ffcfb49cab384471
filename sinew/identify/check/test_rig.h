// identify/check/test_rig.h - simulated measurements for tests: mounts that are filled and vented,
// with the noise of a force cell.
#pragma once

#include <random>
#include <vector>

#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/test_muscle.h"

namespace sinew::identify {

// A muscle and its labels.
struct TestRig {
  StaticSetting setting = test_muscle();  // scaled from test_rest_length to rest_length
  double rest_length = test_rest_length;  // [m]
  double label = test_rest_length;  // labelled rest length, and label of its mount at rest [m]
  std::vector<double> contractions = {0, 0.02, 0.05, 0.09, 0.14};
  double noise = 1;  // [N]
  unsigned seed = 1;
  int runs = 1;
};

// Appends its points: 50 to 650 kPa, rising and falling.
inline void add_rig(const TestRig& rig, std::vector<StaticPoint>& out) {
  std::mt19937_64 random(rig.seed);
  std::normal_distribution<double> normal;
  const StaticScales scales{.rest_length = test_rest_length, .atmosphere = 101325};
  for (int run = 0; run < rig.runs; ++run)
    for (const Branch branch : {Branch::fill, Branch::vent})
      for (const double c : rig.contractions)
        for (double p = 5e4; p < 6.6e5; p += 5e4) {
          StaticPoint point{.length = rig.rest_length * (1 - c),
                            .pressure = p - 8e3 * static_cast<int>(branch),
                            .rest_length = rig.rest_length};
          point.force = predicted(rig.setting, scales, point) + rig.noise * normal(random);
          point.pressure = p;
          point.branch = branch;
          point.rest_length = rig.label;
          if (c == 0) point.length = rig.label;
          out.push_back(point);
        }
}

}  // namespace sinew::identify
