// tune/sweep.h - many runs of one experiment as one table.
//
//   Sweep s{.experiment = "experiments/leg-in-air.toml",
//           .axes   = {parse_axis("joint.hip.angle_gain=0.02:0.1:5 %/count")},
//           .report = parse_figures("joints.hip.tracking_rms_rad [deg]")};
//   sweep(s, {.threads = 2, .row = [](const Row& r) {...}});
//
// The axis `experiment` takes files beside the experiment's own, `robot` takes robots.
// Each point of the grid is a run of its own; of a sample, each of its points with each of the
// grid. Rows come in the grid's order, the grid counting faster than the sample, and are the same
// for any number of threads. A run that cannot be, or that ends early, is a row that says so.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/tune/axis.h"
#include "sinew/tune/figure.h"
#include "sinew/tune/sample.h"

namespace sinew::tune {

// Instead of a run per point: the largest value of one more key for which all conditions hold.
struct Search {
  Axis axis;  // its values are tried from the first on
  std::vector<Condition> where;
  int halvings = 6;  // of the interval that is found
};

struct Sweep {
  std::string experiment;         // its file
  std::vector<std::string> sets;  // key=value, for every run
  std::optional<Sample> sample;
  std::vector<Axis> axes;
  std::vector<Figure> report;
  std::optional<Search> largest;
  bool allow_unreachable = false;
};

struct Row {
  std::size_t point = 0;           // of the sweep
  std::vector<std::string> cells;  // as many as headings(); empty: does not apply
  bool ok = false;                 // what the last cell, the status, says
  std::vector<std::string> lacks;  // of keys(), what the summary of its run does not have
  bool stop_reached = false;       // by the trolley: its figures are up to there
};

struct Options {
  int threads = 1;
  int lanes = 8;  // runs side by side in each thread, at most; the rows are the same
  const std::atomic<bool>* stop = nullptr;        // true: runs that began are the last
  std::atomic<std::int64_t>* progress = nullptr;  // points that are done
  std::function<void(const Row&)> row = {};       // called in the grid's order, one at a time; must
                                                  // not throw
};

// "joint.hip.angle_gain [%/count]", the reported figures, "status". A search has its largest value
// and the number of its runs besides.
std::vector<std::string> headings(const Sweep&);

inline constexpr std::size_t most_points = 1'000'000;  // each keeps a row of the table in memory

std::size_t points(const Sweep&);

// Returns the keys of a summary that the sweep reports or has conditions on, each once.
std::vector<std::string> keys(const Sweep&);

// Throws config::Error for an experiment that is wrong as it stands, and for keys and units of the
// axes that it does not know, and for more than most_points. Runs nothing.
void check(const Sweep&);

// Checks, then runs. Throws after the first point for a key that the summary lacks and that looks
// like a typing error. Returns the rows that are done.
std::vector<Row> sweep(const Sweep&, const Options&);

// One run: what `sinew run` would say of it.
struct Ran {
  std::string status = "ok";
  analysis::Summary summary;  // empty where the status is another
  double atmosphere = units::atmosphere;

  bool ok() const { return status == "ok"; }
};
Ran run_once(const std::string& file, const std::vector<std::string>& sets,
             bool allow_unreachable = false);

}  // namespace sinew::tune
