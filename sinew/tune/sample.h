// tune/sample.h - points between bounds, in place of a grid.
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
  // How values lie in between: evenly, evenly in the logarithm, or as whole numbers.
  enum class Scale { linear, log, whole };

  Axis axis;  // its values are both ends
  Scale scale = Scale::linear;

  // Returns the value at a share of the range, 0 to below 1.
  Value at(double share) const;

  // Returns the share whose value is the number; of a whole number, the middle of its shares. It
  // lies outside of 0 to 1 where the number is beyond an end.
  double share_of(double number) const;
};

// Throws config::Error that begins with `setting`.
Range parse_range(std::string_view text, std::string_view setting = "range");

struct Sample {
  // random  independent of each other
  // latin   Latin hypercube (McKay, Beckman, Conover 1979): of n equal parts of each range every
  //         part has one point
  // sobol   Sobol's sequence with the direction numbers of Joe and Kuo (2008), its digits shifted
  //         by the seed: of 2^m points each of 2^m equal parts of a range has one, and pairs of
  //         ranges are filled as evenly; an integral's error falls nearly with 1/n
  //
  // The first points of `random` and `sobol` stay what they are when more are asked for.
  enum class Kind { random, latin, sobol };

  Kind kind = Kind::sobol;
  std::vector<Range> ranges;
  std::size_t points = 0;
  std::uint64_t seed = 1;
  std::vector<double> given;  // shares in place of drawn ones; empty: none
  bool handed = false;  // the shares are given by whoever hands out the points, some at a time
};

inline constexpr std::size_t most_ranges = 1000;

// Returns the shares of all points, d for each. The same on every machine.
std::vector<double> shares(const Sample& sample);

// Returns those of Sobol's sequence alone.
std::vector<double> sobol_shares(std::size_t ranges, std::size_t points, std::uint64_t seed);

}  // namespace sinew::tune
