// tune/sample.h - samples of points between bounds, as an alternative to a grid.
//
//   joint.hip.angle_gain=0.02:0.4 %/count       evenly between both
//   joint.hip.angle_gain=0.02:0.4 %/count log   evenly in its logarithm
//   seed=1:1000 whole                           whole numbers, both ends included
//
// Symbols: n points, d ranges, shares u in [0, 1) of each range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sinew/tune/axis.h"

namespace sinew::tune {

// A range of values of a key, from one to another.
struct Range {
  // Distribution of values: evenly, evenly in the logarithm, or as whole numbers.
  enum class Scale { linear, log, whole };

  Axis axis;  // its values are the two ends
  Scale scale = Scale::linear;

  // Returns the value at a share of the range, from 0 to below 1.
  Value at(double share) const;

  // Returns the share of a number; of a whole number, the middle of its shares. It is outside 0 ...
  // 1 if the number is beyond an end.
  double share_of(double number) const;
};

// Throws config::Error that begins with `setting`.
Range parse_range(std::string_view text, std::string_view setting = "range");

struct Sample {
  // random  independent of each other
  // latin   Latin hypercube (McKay, Beckman, Conover 1979): each of n equal parts of every range
  //         has one point
  // sobol   Sobol's sequence with the direction numbers of Joe and Kuo (2008), its digits shifted
  //         by the seed: each of 2^m equal parts of a range has one of 2^m points, and pairs of
  //         ranges are filled as evenly; an integral's error decreases nearly as 1/n
  //
  // The first points of `random` and `sobol` do not depend on the number of points.
  enum class Kind { random, latin, sobol };

  Kind kind = Kind::sobol;
  std::vector<Range> ranges;
  std::size_t points = 0;
  std::uint64_t seed = 1;
  std::vector<double> given;  // shares that replace drawn ones; may be empty
  bool given_later = false;   // the caller assigns `given` in portions, as points are handed out
};

inline constexpr std::size_t most_ranges = 1000;

// Returns the shares of all points, d for each. They are the same on every computer.
std::vector<double> shares(const Sample& sample);

// Returns the shares of Sobol's sequence alone.
std::vector<double> sobol_shares(std::size_t ranges, std::size_t points, std::uint64_t seed);

}  // namespace sinew::tune
