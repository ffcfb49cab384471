// tune/axis.h - one key of an experiment and its values in a sweep.
//
//   joint.hip.angle_gain=0.02,0.035,0.05 %/count     a list; the last unit applies to all
//   joint.hip.angle_gain=0.02:0.1:5 %/count          from : to : count, both ends included
//   low_level.duty_rounding=none,truncate sum        words
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/units/letters.h"

namespace sinew::tune {

struct Value {
  std::string text;              // as in --set, "0.035 %/count"
  std::string cell;              // as in a table, "0.035"
  std::optional<double> number;  // in the axis's unit; empty: a word
};

struct Axis {
  std::string key;
  std::string unit;  // as written; may be empty
  std::vector<Value> values;
  std::string setting = "vary";  // the setting with its text, for messages (place_of)

  std::string heading() const;          // "joint.hip.angle_gain [%/count]"
  Value at(double number) const;        // in the axis's unit
  std::string set(const Value&) const;  // "joint.hip.angle_gain=0.035 %/count"
};

// Throws config::Error that begins with `setting`.
Axis parse_axis(std::string_view text, std::string_view setting = "vary");

// Parses "KEY=from:to unit" into an axis of these two values. Throws config::Error that begins with
// `setting` and suggests `example`.
Axis parse_ends(std::string_view text, std::string_view setting, const std::string& example);

// Returns the axis seed = 1 … n, for the experiment's noise.
Axis seeds(int n, std::string setting = "seeds");

// Splits a list at its commas, except those within brackets and quotes; trims its parts.
std::vector<std::string_view> list_of(std::string_view text);

using units::trimmed;

// Places of the values in a plan or a tuning, by key and text: {"vary", "seed=1,2"}.
using Places = std::map<std::pair<std::string, std::string>, config::Location>;
Places places_of(const config::Node& root);

// Returns "plan.toml:7:9: vary", or "vary" for a value that is not in the file: the setting of a
// command or a program.
std::string place_of(const Places& places, const std::string& key, const std::string& text);

// All combinations of the axes' values; the last axis varies fastest.
class Grid {
 public:
  // `axes` must outlive the grid.
  explicit Grid(const std::vector<Axis>& axes) : axes_(&axes) {}

  std::size_t size() const;  // 1 without axes
  // Returns the values of a point, one per axis.
  std::vector<const Value*> point(std::size_t index) const;

 private:
  const std::vector<Axis>* axes_;
};

// Throws config::Error about `text`, the value of `setting`, with what is expected and an example.
[[noreturn]] inline void refuse(std::string_view setting, std::string_view text,
                                std::string expected, std::string try_this = "") {
  config::fail({std::string(setting), 0, 0}, "", config::in_quotes(text), std::move(expected),
               std::move(try_this));
}

}  // namespace sinew::tune
