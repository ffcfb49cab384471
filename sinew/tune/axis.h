// tune/axis.h - one key of an experiment and the values that it takes.
//
//   joint.hip.angle_gain=0.02,0.035,0.05 %/count     a list; the last unit is everybody's
//   joint.hip.angle_gain=0.02:0.1:5 %/count          from : to : how many, both ends included
//   low_level.duty_rounding=none,truncate sum        words
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::tune {

struct Value {
  std::string text;              // as --set takes it, "0.035 %/count"
  std::string cell;              // as a table shows it, "0.035"
  std::optional<double> number;  // in the axis's unit; none: words
};

struct Axis {
  std::string key;
  std::string unit;  // as written; empty: none
  std::vector<Value> values;

  std::string heading() const;          // "joint.hip.angle_gain [%/count]"
  Value at(double number) const;        // in the axis's unit
  std::string set(const Value&) const;  // "joint.hip.angle_gain=0.035 %/count"
};

// Throws config::Error that begins with `setting`.
Axis parse_axis(std::string_view text, std::string_view setting = "vary");

// Parses "KEY=from:to unit": an axis of these two values. Throws config::Error that begins with
// `setting`; `example` is what it suggests.
Axis parse_ends(std::string_view text, std::string_view setting, const std::string& example);

// seed = 1 … n: the experiment's noise.
Axis seeds(int n);

// Parts of a list at its commas, those in brackets and quotes apart; without the blanks around.
std::vector<std::string_view> list_of(std::string_view text);

// Returns the text without the blanks around it.
std::string_view trimmed(std::string_view text);

// All combinations of the axes' values, the last axis counting fastest.
class Grid {
 public:
  // `axes` outlive the grid.
  explicit Grid(const std::vector<Axis>& axes) : axes_(&axes) {}

  std::size_t size() const;  // 1 without axes
  // Returns the values of a point, one of each axis.
  std::vector<const Value*> point(std::size_t index) const;

 private:
  const std::vector<Axis>* axes_;
};

}  // namespace sinew::tune
