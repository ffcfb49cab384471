// report/compare/comparison.h - runs beside each other: what `sinew compare` prints and shows as a
// page.
//
//   Comparison c = compare(std::move(runs), Align::start);
//   fill(comparison_template(), content(c))     the page
//
// All runs are held against the first one. Of a channel: how far the samples are apart
// (analysis/verdict/compare.h). A run may be of a machine, of hardware or of the test stand; what
// is compared is what the first one and another have.
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/align/align.h"
#include "sinew/analysis/verdict/compare.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/node.h"
#include "sinew/report/page/charts.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/scene.h"
#include "sinew/report/page/stand.h"
#include "sinew/signals/table.h"
#include "sinew/units/shown.h"

namespace sinew::report {

// Zero of the times: the start of each run, or its sequence's start, aligned with the
// first one's; or both aligned by an event or by the greatest correlation (analysis/align/align.h).
enum class Align { start, sequence, event, correlation };
// Returns it in words.
std::string_view to_text(Align align);

// Alignment of runs with the first one.
struct AlignWish {
  // Aligns runs in this way; clocks are taken as they are.
  AlignWish(Align how = Align::start) : by(how) {}

  Align by;
  std::string event;                  // "/joint/elbow/angle > 10 deg"; empty: the surest motion
  std::vector<std::string> channels;  // that are correlated; empty: chosen
  bool fit_clock = false;             // the rate of each run's clock too
  double most_shift = std::numeric_limits<double>::infinity();  // that is looked for [s]
};

// A run as it was recorded.
struct RecordedRun {
  std::string label;      // as it is told from the others
  signals::Table logged;  // what was logged
  config::Node resolved;  // resolved.toml
};

// A run as one of several.
struct ComparedRun {
  std::string label;
  std::string title, reproduces, robot, seed, version;
  double atmosphere = 0;  // [Pa]
  double shift = 0;       // by which its times were moved back [s]
  // How that was found, and its clock's rate, which is taken out of its times as well. The first
  // run has none, nor have runs that count from their own start or sequence.
  std::optional<analysis::Alignment> alignment;
  double first = 0, last = 0;      // times, after that [s]
  signals::Table logged, derived;  // at those times
  signals::Table drawn;            // what charts hold beside them
  std::vector<Panel> panels;
  std::vector<Chart> charts;  // of the test stand
  Scene scene;                // the machine as a drawing; empty of a stand, or without angles
  Stand stand;                // the stand as a drawing; empty of a machine
  std::string phases;         // JSON, as content.h has it
  analysis::Summary summary;
  std::vector<analysis::Verdict> verdicts;
  std::vector<Parameter> parameters;

  // "agrees (fitted)". Empty where nothing is reported of the key, or nothing that could be judged.
  std::string verdict_of(const std::string& key) const;
};

// A channel of the first run that another one has too.
struct ChannelRow {
  Channel channel;
  std::string unit;
  std::vector<std::optional<analysis::Difference>> differences;  // per run; the first has none
};

struct Comparison {
  Align align = Align::start;
  bool clocks_fitted = false;
  std::vector<ComparedRun> runs;
  std::vector<analysis::FigureRow> figures;  // every key
  std::vector<ParameterRow> parameters;      // that differ
  std::vector<ChannelRow> channels;          // recorded, then derived
};

// Two runs or more. Throws config::Error for a resolved.toml that cannot be read, for runs without
// a common channel, and where a run cannot be aligned with the first one as it is wished, saying
// why.
Comparison compare(std::vector<RecordedRun> runs, const AlignWish& wish);

// Leaves only the channels of these topics.
void keep(Comparison& comparison, const std::set<std::string>& topics);

// All of it but the samples, as JSON: "format": "sinew.comparison/1", SI, null for what is not
// there.
std::string to_json(const Comparison& comparison);

// Returns what each run differs by from the first one, as CSV: a row per time at which any
// channel's samples meet, a column per run and channel, "B /joint/hip/angle [rad]", empty where
// that one has none; no valves. SI.
std::string residuals_csv(const Comparison& comparison);

// For page.h's fill(), with the page of web/src/compare.html.
Content content(const Comparison& comparison);

// Throws std::runtime_error, with what to do, where the program was built without its page.
// It begins in `units`.
std::string page(const Comparison& comparison, const units::ShownUnits& units = {});

}  // namespace sinew::report
