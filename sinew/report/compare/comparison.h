// report/compare/comparison.h - comparison of several runs, which `sinew compare` prints and shows
// as a page.
//
//   Comparison c = compare(std::move(runs), Align::start);
//   fill(comparison_template(), content(c))     the page
//
// All runs are compared with the first one; channels by the differences of their samples
// (analysis/verdict/compare.h). A run may be of a machine, of hardware or of the test stand. Only
// channels that the first run and another one have are compared.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/align/align.h"
#include "sinew/analysis/verdict/compare.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/node.h"
#include "sinew/json/json.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/plot.h"
#include "sinew/report/page/scene.h"
#include "sinew/report/page/stand.h"
#include "sinew/signals/table.h"
#include "sinew/units/shown.h"

namespace sinew::report {

// Alignment of the times: by the start of each run, by the start of its sequence, by an event or by
// the greatest correlation (analysis/align/align.h).
enum class Align { start, sequence, event, correlation };
// Returns its name.
std::string_view to_text(Align align);

// Options of the alignment of runs with the first one.
struct AlignOptions {
  // Aligns runs in this way, without a correction of the clocks' rates.
  AlignOptions(Align how = Align::start) : by(how) {}

  Align by;
  std::string event;  // "/joint/elbow/angle > 10 deg"; empty: the most certain first motion
  std::vector<std::string> channels;  // to be correlated; empty: chosen
  bool fit_clock = false;             // fit the rate of each run's clock
  double largest_shift =
      std::numeric_limits<double>::infinity();  // largest shift of the search [s]
};

// A recorded run with its name in the comparison.
struct NamedRun {
  std::string label;      // name in the comparison
  signals::Table logged;  // recorded channels
  config::Node resolved;  // resolved.toml
};

// A run as one of several.
struct ComparedRun {
  std::string label;
  std::string title, reproduces, robot, seed, version;
  double atmosphere = 0;  // [Pa]
  double shift = 0;       // subtracted from its times [s]
  // Result of the alignment, with the clock's rate, which is also removed from its times. Empty for
  // the first run, and for runs aligned by start or sequence without a fit of the clock.
  std::optional<analysis::Alignment> alignment;
  double first = 0, last = 0;      // aligned times [s]
  signals::Table logged, derived;  // at the aligned times
  signals::Table drawn;            // series of the drawings
  std::vector<Plot> panels;
  std::vector<Plot> charts;  // charts of the test stand
  Scene scene;               // drawing of the machine; empty for a stand, or without angles
  Stand stand;               // drawing of the stand; empty for a machine
  Json phases;               // (content.h)
  analysis::Summary summary;
  std::vector<analysis::Verdict> verdicts;
  std::vector<Parameter> parameters;

  // Returns "agrees (fitted)" for a key; empty if it is not reported or cannot be judged.
  std::string verdict_of(const std::string& key) const;
};

// A channel of the first run that another one has too.
struct ChannelRow {
  Channel channel;
  std::string unit;
  std::vector<std::optional<analysis::Difference>> differences;  // per run; empty for the first
};

struct Comparison {
  Align align = Align::start;
  bool clocks_fitted = false;
  std::vector<ComparedRun> runs;
  std::vector<analysis::FigureRow> figures;  // every key
  std::vector<ParameterRow> parameters;      // those that differ
  std::vector<ChannelRow> channels;          // recorded, then derived
};

// Compares two runs or more. Throws config::Error for a resolved.toml that cannot be read, for runs
// without a common channel, and with the reason if a run cannot be aligned with the first one.
Comparison compare(std::vector<NamedRun> runs, const AlignOptions& options);

// Leaves only the channels of these topics.
void keep(Comparison& comparison, const std::vector<std::string>& topics);

// Returns the comparison without samples as JSON: "format": "sinew.comparison/1", SI, null for
// missing values.
std::string to_json(const Comparison& comparison);

// Returns the differences of each run from the first one as CSV in SI, without valves: a row per
// time at which any channel's samples meet, a column per run and channel, "B /joint/hip/angle
// [rad]", empty if that channel has no value.
std::string residuals_csv(const Comparison& comparison);

// Returns the content for page.h's fill(), with the page of web/src/compare.html.
Content content(const Comparison& comparison);

// Returns the page, initially in `units`. Throws std::runtime_error with instructions if the
// program was built without its page.
std::string page(const Comparison& comparison, const units::ShownUnits& units = {});

// Format of the text tables.
struct ComparisonText {
  units::ShownUnits units = units::UnitSet::thesis;  // units of the tables
  bool all = false;                                  // include equal rows
  std::size_t width = 0;                             // letters of a line; 0: any
  std::string see_all = {};                          // hint shown where a table is cut
  std::string fit_clock = "clock=fit";               // option that removes a clock's rate
  bool color = false;  // verdicts that changed are red, by the escapes of a terminal
};

// Returns tables of the runs, and of figures, parameters and channels that differ.
std::string text_of(const Comparison& comparison, const ComparisonText& how);

}  // namespace sinew::report
