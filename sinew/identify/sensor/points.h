// identify/sensor/points.h - properties of a sensor from its readings at known values, before a
// law is fitted: steps, noise, limits and hysteresis.
//
// Pure functions of rows in the order of measurement; `known` and `output` in any unit, results in
// the output's. NaN: not determined by the readings.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sinew::identify {

// Rows at one known value, approached from one side.
struct Point {
  double known = 0, output = 0;  // means
  int direction = 0;             // +1: reached from below, -1: from above
  std::size_t level = 0;         // index of the known value in ascending order
  std::vector<std::size_t> rows;
};

// Returns the points in ascending order of the known value, the ones from below first. Values
// within 1e-6 of their range are equal.
std::vector<Point> points_of(std::span<const double> known, std::span<const double> output);

// Returns the number of different known values.
std::size_t level_count(std::span<const Point> points);

// Returns the step of the readings: all differ by whole multiples of that step. Equally spaced
// known values give such multiples too, so the step must be less than half their distance, or be
// confirmed by many readings.
double step_of(std::span<const Point> points, std::span<const double> output);

// Returns the standard deviation of repeated readings at a point, less the contribution of the
// steps, step^2/12.
double noise_of(std::span<const Point> points, std::span<const double> output, double step);

// Largest difference between the two directions at one known value, and the part that noise
// alone may explain (three standard errors).
struct Hysteresis {
  double largest, by_noise;
};
Hysteresis hysteresis_of(std::span<const Point> points, double noise);

// Rows at a limit of the sensor or its converter. Readings at or beyond `top` are at the limit.
// So are equal readings at the largest or smallest value if they should differ according to the
// other points, and one at or below 0 if it should be below 0.
struct Ends {
  std::vector<std::size_t> at_top, at_bottom;  // rows
  double top, bottom;                          // readings at the limits
};
Ends ends_of(std::span<const Point> points, std::span<const double> output, double step,
             double top);

}  // namespace sinew::identify
