// identify/sensor/points.h - what the readings of one sensor at known values give away about it,
// before any law is fitted: its steps, its noise, where it ends, whether it goes back another way.
//
// Pure functions of rows in the order in which they were taken; `known` and `output` in any unit,
// results in the output's. NaN: the readings do not tell.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sinew::identify {

// Rows at one known value, from one side.
struct Point {
  double known = 0, output = 0;  // means
  int direction = 0;             // +1: reached from below, -1: from above
  std::size_t level = 0;         // index of the known value in ascending order
  std::vector<std::size_t> rows;
};

// In ascending order of the known value, from below first. Values closer than 1e-6 of their range
// are one.
std::vector<Point> points_of(std::span<const double> known, std::span<const double> output);

// Returns at how many different known values there are readings.
std::size_t level_count(std::span<const Point> points);

// Of the readings: all are whole multiples of it apart. Known values at equal distances make such
// multiples too; so it must be less than half their distance, or be shared by many of them.
double step_of(std::span<const Point> points, std::span<const double> output);

// Standard deviation of readings that were repeated at a point. What the steps add to it,
// step^2/12, is taken off.
double noise_of(std::span<const Point> points, std::span<const double> output, double step);

// Largest difference between the two ways at one known value, and the part of it that noise alone
// may make (three standard errors).
struct Hysteresis {
  double largest, by_noise;
};
Hysteresis hysteresis_of(std::span<const Point> points, double noise);

// Rows at an end of the sensor or its converter. Readings at or beyond `top` are at its end. So are
// equal readings at the largest or smallest value where the other points say that they should
// differ, and one at or below 0 if they say that it should lie below.
struct Ends {
  std::vector<std::size_t> at_top, at_bottom;  // rows
  double top, bottom;                          // the readings there
};
Ends ends_of(std::span<const Point> points, std::span<const double> output, double step,
             double top);

}  // namespace sinew::identify
