// tune/figure.h - what is asked of a run's summary: figures to report, conditions to hold.
//
//   joints.hip.tracking_rms_rad [deg]              reported in degrees
//   joints.hip.tracking_rms_rad < 5 deg            holds or not
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/summary.h"
#include "sinew/config/reported.h"
#include "sinew/units/constants.h"
#include "sinew/units/shown.h"

namespace sinew::tune {

struct Figure {
  std::string key;     // of summary.json
  std::string unit;    // to be shown in; "1": none
  bool named = false;  // somebody wrote the unit

  // "joints.hip.tracking_rms [deg]": the unit that ends the key is the summary's own.
  std::string heading() const;
  // Empty where the summary has no such key. SI has the fewest digits that read back to the same
  // bits, any other unit has nine.
  std::string cell(const analysis::Summary&, double atmosphere = units::atmosphere) const;
};

// "key", "key [unit]", several with commas. Throws config::Error that begins with `setting`.
std::vector<Figure> parse_figures(std::string_view text, std::string_view setting = "report");

// Shows the figures that name no unit in those of `units`.
void show_in(const units::ShownUnits& units, std::vector<Figure>& figures);

// Returns the figures that sources report of an experiment, each key once, in the source's unit.
std::vector<Figure> reported_figures(const std::vector<config::Reported>& reported,
                                     double atmosphere = units::atmosphere);

// A bound for a figure of a run.
struct Condition {
  // Says on which side of the limit the figure has to be.
  enum class Is { below, at_most, above, at_least };

  std::string key;
  Is is = Is::below;
  double limit = 0;  // SI
  std::string text;  // as written

  // False too where the summary has no such key.
  bool holds(const analysis::Summary&) const;
};

// "key < value unit"; also <=, >, >=. Throws config::Error that begins with `setting`.
Condition parse_condition(std::string_view text, std::string_view setting = "where");

// The key as the summary could have meant it: empty where it has it, or where nothing is near.
std::string nearest_key(std::string_view key, const analysis::Summary&);

}  // namespace sinew::tune
