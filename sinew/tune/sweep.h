// tune/sweep.h - many runs of one experiment as one table.
//
//   Sweep s{.experiment = "experiments/leg-in-air.toml",
//           .axes   = {parse_axis("joint.hip.angle_gain=0.02:0.1:5 %/count")},
//           .report = parse_figures("joints.hip.tracking_rms_rad [deg]")};
//   sweep(s, {.threads = 2, .row = [](const Row& r) {...}});
//
// The axis `experiment` takes files in the experiment's own folder, `robot` takes robots. Each
// point of the grid is a run; with a sample, each of its points is combined with each case and each
// point of the grid. Rows are in the order of the points; the grid varies faster than the sample.
// They do not depend on the number of threads, on shares or interruptions. A run that is refused or
// ends early has a row with the reason.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/run/ensemble/many.h"
#include "sinew/tune/axis.h"
#include "sinew/tune/figure.h"
#include "sinew/tune/sample.h"

namespace sinew::tune {

using run::run_once;
using run::RunResult;

// Remarks about a row's figures. A table's status and a study's file use the same words.

struct Notes {
  std::vector<std::string> lacks;    // keys that the summary of the run lacks
  std::vector<std::string> differs;  // keys whose value differs from what a source reports
  bool stop_reached = false;         // the trolley reached its stop, where distance and mean speed
                                     // end
  bool no_air = false;               // no muscle took air, whatever the plan commanded
  bool out_of_reach = false;         // the foot path was out of reach; the nearest point was used

  bool operator==(const Notes&) const = default;
};

// Returns the remarks about the given keys. A run without figures has none.
Notes notes_of(const RunResult& result, const std::vector<std::string>& keys);

// Returns those that apply of "without foot.extension_time_s; reaches the end of the track; uses no
// air; aims out of reach; differs in trolley.distance_m"; empty if none does.
std::string to_text(const Notes& notes);

// Returns `status`, or the notes if it is "ok", or both.
std::string status_with(const Notes& notes, std::string_view status);

// Search that replaces the run of a point: the largest value of another key for which all
// conditions hold.
struct Search {
  Axis axis;  // its values are tried in order
  std::vector<Condition> where;
  int halvings = 6;  // number of halvings of the interval that was found
};

// A circumstance in which each point is run: another experiment, other values, a fault.
struct Case {
  std::string name;
  std::string experiment;         // its file; empty: the sweep's own
  std::vector<std::string> sets;  // key=value, after the sweep's own and before a point's
  double weight = 1;              // weight in averages over runs
};

struct Sweep {
  std::string experiment;         // its file
  std::vector<std::string> sets;  // key=value, for every run
  std::optional<Sample> sample;
  std::vector<Case> cases;  // combined with each point; empty: the experiment as it is
  std::vector<Axis> axes;
  std::vector<Figure> report;
  std::optional<Search> largest;
  bool allow_unreachable = false;
  Places places = {};  // places of a file's settings, for messages
};

// A row of a sweep's table.
struct Row {
  std::size_t point = 0;           // number in the sweep
  std::vector<std::string> cells;  // as many as headings(); empty: not applicable
  bool ok = false;                 // has figures; otherwise the last cell, the status, gives the
                                   // reason
  Notes notes = {};
};

// A share of a sweep's points: those with numbers m = i - 1, i - 1 + n, i - 1 + 2 n, … It is the
// same on every computer.
struct Share {
  std::size_t i = 1, n = 1;

  // Returns whether the point belongs to the share.
  bool has(std::size_t point) const { return point % n == i - 1; }
  std::size_t size(std::size_t points) const { return points / n + (points % n >= i ? 1 : 0); }
};

// Parses "2/3". Throws config::Error that begins with "shard".
Share parse_share(std::string_view text);

// `row` and `done` are called for one row at a time and must not throw.
struct Options {
  int threads = 1;
  int lanes = 8;            // runs in parallel per thread, at most; the rows are the same
  run::Device device = {};  // the processor or a card; the rows are the same
  std::function<void(const std::string&)> notice = {};  // takes a sentence about a card
  const std::atomic<bool>* stop = nullptr;              // true: no further runs are begun
  std::atomic<std::int64_t>* progress = nullptr;        // completed points
  std::function<void(const Row&)> row = {};   // called for each row of the table, in order
  std::function<void(const Row&)> done = {};  // called for each completed run, at once
  // Replaces the threads here: runs these points, passes their rows to `done` in any order and one
  // at a time, and returns when all are complete or it was stopped.
  std::function<void(std::span<const std::size_t> points, const std::function<void(Row)>& done)>
      dispatch = {};
  Share share = {};             // the table has only these points
  bool checked = false;         // checked by an earlier sweep that differs in the sample's points
                                // alone
  std::vector<Row> known = {};  // rows of an earlier sweep, which are not run again
  // Files that earlier sweeps of the same experiment, settings and keys have read; empty: none.
  std::shared_ptr<run::Ensembles> runs = {};
};

// Returns the path of the file that a value of the axis `experiment` names, in the folder of the
// sweep's own experiment.
std::string experiment_path(const Sweep&, const std::string& file);

// Returns "joint.hip.angle_gain [%/count]", the reported figures, "status". A search also has its
// largest value and the number of its runs.
std::vector<std::string> headings(const Sweep&);

inline constexpr std::size_t most_points = 1'000'000;  // a row of each is kept in memory

// Returns the number of points of a sweep.
std::size_t points(const Sweep&);

// Returns the keys of a summary that the sweep reports or has conditions on, each once.
std::vector<std::string> keys(const Sweep&);

// Returns empty ensembles for the runs of a sweep, for Options::runs.
std::shared_ptr<run::Ensembles> ensembles_of(const Sweep&);

// Throws config::Error if the experiment is faulty by itself, if an axis has an unknown key or
// unit, if no run can have a figure (analysis/absent.h), or if there are more than most_points.
// Runs nothing.
void check(const Sweep&);

// Checks and runs the sweep. Throws std::runtime_error for a card that cannot be used, and after
// its first run config::Error if the summary lacks a key that is probably misspelt. Returns the
// completed rows and the known ones, in the points' order.
//
// All runs of one call use the files as they were when the first of these runs read them, also if a
// file is edited meanwhile. This holds for the experiment, its base, the robot and the robot's
// files with their gains. It does not hold for a table of valve timing, which some runs read again,
// nor between processes of a dispatcher, nor between calls without the same Options::runs.
std::vector<Row> sweep(const Sweep&, const Options&);

// Runs points of a sweep by their number, for a dispatcher. A row does not depend on the
// process that makes it.
class Runner {
 public:
  // Draws the values of all points.
  explicit Runner(const Sweep& sweep);
  ~Runner();

  // `done` is called for one row at a time, and must not throw.
  void run(std::span<const std::size_t> points, int threads, const std::function<void(Row)>& done,
           const run::Device& device = {}) const;

 private:
  struct Drawn;
  std::unique_ptr<Drawn> drawn_;
};

// The largest value for which a condition holds, searched from below.
//
// The given values are tried up to the first for which it does not hold; then the interval between
// this value and the one before is halved. Higher values are not tried. If the condition is not
// monotone, the result is the end of its lowest part, to the resolution of the values.
struct Largest {
  enum class Is { never, between, to_the_end };  // not even for the first; found; even for the last

  Is is = Is::never;
  double value = 0;  // the largest value tried that holds; undefined for `never`
  double fails = 0;  // the smallest tried above it that does not; undefined for `to_the_end`
};

// `values` in the order in which they are tried. `holds(double) -> bool` is called at most
// values.size() + halvings times.
template <class Holds>
Largest largest(const std::vector<double>& values, int halvings, Holds holds) {
  std::size_t n = 0;
  while (n < values.size() && holds(values[n])) ++n;
  if (n == 0) return {};
  Largest out{Largest::Is::to_the_end, values[n - 1], 0};
  if (n == values.size()) return out;

  out.is = Largest::Is::between;
  out.fails = values[n];
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (out.value + out.fails);
    (holds(middle) ? out.value : out.fails) = middle;
  }
  return out;
}

}  // namespace sinew::tune
