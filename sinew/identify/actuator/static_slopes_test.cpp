// The derivatives of every static law match differences of its force.
#include "sinew/identify/actuator/static_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::identify::static_slopes_test {
namespace {

const StaticScales scales{
    .rest_length = 0.25, .full_scale = 540, .top_pressure = 6e5, .atmosphere = 101325};
constexpr double labelled = 0.1;  // rest length of a muscle shorter than the reference [m]

double force(const StaticSetting& setting, double length, const StaticPoint& point) {
  return MuscleLaw(setting, scales, labelled).force(length, point);
}

// Returns a central difference; rounding and curvature leave errors of about 1e-9 of the scale.
double slope(double step, auto force_at) { return (force_at(step) - force_at(-step)) / (2 * step); }

// Compares within the error of a central difference: 2e-6 of the slope, and of the full scale per
// scale.
void expect_slope(double closed, double difference, double scale, std::string_view what) {
  EXPECT_NEAR(closed * scale, difference * scale,
              2e-6 * std::abs(difference * scale) + 2e-7 * scales.full_scale)
      << what;
}

TEST(StaticSlopes, AreTheDifferencesOfTheForceForEveryLaw) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  int compared = 0;
  for (const StaticModel& model : static_models())
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<FreeParameter> free_parameters = free_parameters_of(model, scales);
      free_parameters.push_back(FreeParameter::end_loss);
      free_parameters.insert(free_parameters.end(),
                             {FreeParameter::half_width, FreeParameter::width_per_pressure,
                              FreeParameter::width_per_tension});
      StaticSetting at = setting_of(scales);
      for (const FreeParameter free_parameter : free_parameters) {
        // Between the start and 3 scales beyond it, within the bounds.
        const Parameter p = parameter_of(free_parameter, scales);
        value_of(at, free_parameter) = std::clamp(p.start + 3 * (share(random) - 0.3) * p.scale,
                                                  p.low + 0.01 * p.scale, p.high);
      }
      at.rest_lengths = {{.labelled = labelled, .error = 0.003, .low = -0.01, .high = 0.01}};
      const StaticPoint point{.length = labelled * (0.75 + 0.25 * share(random)),
                              .pressure = scales.top_pressure * (0.25 + 0.75 * share(random)),
                              .branch = trial % 2 ? Branch::fill : Branch::vent};
      ForceSlopes slopes;
      MuscleLaw(at, scales, labelled)
          .write_slopes(point.length, point, force(at, point.length, point), slopes);
      for (const FreeParameter free_parameter : free_parameters) {
        const double scale = parameter_of(free_parameter, scales).scale;
        const double difference = slope(1e-5 * scale, [&](double step) {
          StaticSetting moved = at;
          value_of(moved, free_parameter) += step;
          return force(moved, point.length, point);
        });
        expect_slope(value_of(slopes.by_parameter, free_parameter), difference, scale,
                     std::string(model.name) + ": " + parameter_of(free_parameter, scales).name);
        ++compared;
      }
      expect_slope(slopes.by_length,
                   slope(1e-7, [&](double step) { return force(at, point.length + step, point); }),
                   0.02 * labelled, model.name);
      expect_slope(slopes.by_rest_length,
                   slope(1e-7,
                         [&](double step) {
                           StaticSetting moved = at;
                           moved.rest_lengths[0].error += step;
                           return force(moved, point.length, point);
                         }),
                   0.02 * labelled, model.name);
    }
  EXPECT_GT(compared, 2000);
}

}  // namespace
}  // namespace sinew::identify::static_slopes_test
