// tune/figure.h - figures of a run's summary: values to report and conditions.
//
//   joints.hip.tracking_rms_rad [deg]              reported in degrees
//   joints.hip.tracking_rms_rad < 5 deg            true or false
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/summary.h"
#include "sinew/config/reported.h"
#include "sinew/units/constants.h"
#include "sinew/units/shown.h"

namespace sinew::tune {

struct Figure {
  std::string key;                 // a key of summary.json
  std::string unit;                // unit in which it is shown; "1": no unit
  bool named = false;              // whether the unit was given explicitly
  std::string setting = "report";  // the setting with its text, for messages (place_of)

  // Returns "joints.hip.tracking_rms [deg]", without the unit of the summary that ends the key.
  std::string heading() const;
  // Returns the value as text; empty if the summary has no such key. SI values have the fewest
  // digits that preserve every bit, other units nine digits.
  std::string cell(const analysis::Summary&, double atmosphere = units::atmosphere) const;
};

// Parses "key", "key [unit]", or several with commas. Throws config::Error that begins with
// `setting`.
std::vector<Figure> parse_figures(std::string_view text, std::string_view setting = "report");

// Sets the unit of each figure without an explicit unit to that of `units`.
void show_in(const units::ShownUnits& units, std::vector<Figure>& figures);

// Returns the figures that an experiment's sources report, each key once, in the source's unit.
std::vector<Figure> reported_figures(const std::vector<config::Reported>& reported,
                                     double atmosphere = units::atmosphere);

// A condition on a figure of a run.
struct Condition {
  // The required relation of the figure to the limit.
  enum class Is { below, at_most, above, at_least };

  std::string key;
  Is is = Is::below;
  double limit = 0;               // SI
  std::string text;               // as written
  std::string setting = "where";  // as that of a figure

  // Returns whether the condition holds; false if the summary has no such key.
  bool holds(const analysis::Summary&) const;
};

// Parses "key < value unit"; also <=, >, >=. Throws config::Error that begins with `setting`.
Condition parse_condition(std::string_view text, std::string_view setting = "where");

}  // namespace sinew::tune
