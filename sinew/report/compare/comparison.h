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

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sinew/analysis/verdict/compare.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/node.h"
#include "sinew/report/page/charts.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/parameters.h"
#include "sinew/signals/table.h"

namespace sinew::report {

// Where times are counted from: the start of each run, or its sequence's start, laid on the first
// one's.
enum class Align { start, sequence };

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
  double atmosphere = 0;           // [Pa]
  double shift = 0;                // by which its times were moved back [s]
  double first = 0, last = 0;      // times, after that [s]
  signals::Table logged, derived;  // at those times
  signals::Table drawn;            // what charts hold beside them
  std::vector<Panel> panels;
  std::vector<Chart> charts;  // of the test stand
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
  std::vector<ComparedRun> runs;
  std::vector<analysis::FigureRow> figures;  // every key
  std::vector<ParameterRow> parameters;      // that differ
  std::vector<ChannelRow> channels;          // recorded, then derived
};

// Two runs or more. Throws config::Error for a resolved.toml that cannot be read, for runs without
// a common channel, and where a run has no sequence to be aligned by.
Comparison compare(std::vector<RecordedRun> runs, Align align);

// Leaves only the channels of these topics.
void keep(Comparison& comparison, const std::set<std::string>& topics);

// All of it but the samples, as JSON: "format": "sinew.comparison/1", SI, null for what is not
// there.
std::string to_json(const Comparison& comparison);

// For page.h's fill(), with the page of web/src/compare.html.
Content content(const Comparison& comparison);

// Throws std::runtime_error, with what to do, where the program was built without its page.
std::string page(const Comparison& comparison);

}  // namespace sinew::report
