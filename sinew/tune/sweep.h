// tune/sweep.h - many runs of one experiment as one table.
//
//   Sweep s{.experiment = "experiments/leg-in-air.toml",
//           .axes   = {parse_axis("joint.hip.angle_gain=0.02:0.1:5 %/count")},
//           .report = parse_figures("joints.hip.tracking_rms_rad [deg]")};
//   sweep(s, {.threads = 2, .row = [](const Row& r) {...}});
//
// The axis `experiment` takes files beside the experiment's own, `robot` takes robots.
// Each point of the grid is a run of its own; of a sample, each of its points with each case and
// each of the grid. Rows come in the grid's order, the grid counting faster than the sample, and
// are the same for any number of threads, shares and interruptions. A run that cannot be, or that
// ends early, is a row that says so.
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

#include "sinew/tune/axis.h"
#include "sinew/tune/figure.h"
#include "sinew/tune/sample.h"

namespace sinew::tune {

// Why a row's figures are what they are. The same words stand in a table's status,
// and in a study's file.

struct Ran;

struct Notes {
  std::vector<std::string> lacks;    // keys that the summary of its run does not have
  std::vector<std::string> differs;  // keys whose value differs from what a source reports
  bool stop_reached = false;         // by the trolley: distance and mean speed are up to there
  bool no_air = false;               // no muscle took any, whatever the plan commanded
  bool out_of_reach = false;         // the foot was: the nearest point was aimed at

  bool operator==(const Notes&) const = default;
};

// The keys that are missing, or differ, are some of `keys`. A run without figures has no notes.
Notes notes_of(const Ran& ran, const std::vector<std::string>& keys);

// "without foot.extension_time_s; reaches the end of the track; uses no air; aims out of reach;
// differs in trolley.distance_m": what applies of it, empty where nothing does.
std::string to_text(const Notes& notes);

// Returns `status`, or the notes in place of an "ok", or both.
std::string status_with(const Notes& notes, std::string_view status);

// Instead of a run per point: the largest value of one more key for which all conditions hold.
struct Search {
  Axis axis;  // its values are tried from the first on
  std::vector<Condition> where;
  int halvings = 6;  // of the interval that is found
};

// A circumstance in which each point is run: another experiment, other values, a fault.
struct Case {
  std::string name;
  std::string experiment;         // its file; empty: the sweep's own
  std::vector<std::string> sets;  // key=value, behind the sweep's own and before a point's
  double weight = 1;              // how much it counts where runs are averaged
};

struct Sweep {
  std::string experiment;         // its file
  std::vector<std::string> sets;  // key=value, for every run
  std::optional<Sample> sample;
  std::vector<Case> cases;  // each point with each of them; empty: the experiment as it is
  std::vector<Axis> axes;
  std::vector<Figure> report;
  std::optional<Search> largest;
  bool allow_unreachable = false;
};

// A row of a sweep's table.
struct Row {
  std::size_t point = 0;           // of the sweep
  std::vector<std::string> cells;  // as many as headings(); empty: does not apply
  bool ok = false;                 // has figures; else the last cell, the status, says why not
  Notes notes = {};
};

// A share of a sweep's points, those with numbers m = i - 1, i - 1 + n, i - 1 + 2 n, …: the same on
// every machine.
struct Share {
  std::size_t i = 1, n = 1;

  // Does the point belong to the share?
  bool has(std::size_t point) const { return point % n == i - 1; }
  std::size_t size(std::size_t points) const { return points / n + (points % n >= i ? 1 : 0); }
};

// "2/3". Throws config::Error that begins with "shard".
Share parse_share(std::string_view text);

// Both functions are called for one row at a time and must not throw.
struct Options {
  int threads = 1;
  int lanes = 8;  // runs side by side in each thread, at most; the rows are the same
  const std::atomic<bool>* stop = nullptr;        // true: runs that began are the last
  std::atomic<std::int64_t>* progress = nullptr;  // points that are done
  std::function<void(const Row&)> row = {};       // each of the table, in the points' order
  std::function<void(const Row&)> done = {};      // each that was run, as soon as it is there
  // In place of threads here: runs these points, hands back their rows in any order, and returns
  // when all are there or it was stopped.
  std::function<void(std::span<const std::size_t> points, const std::function<void(Row)>& done)>
      elsewhere = {};
  Share share = {};             // of the points: the table has no others
  bool checked = false;         // by an earlier sweep that differs in the sample's points alone
  std::vector<Row> known = {};  // of an earlier time: they are not run again
};

// Returns the file that a value of the axis `experiment` names, which stands beside the sweep's
// own.
std::string beside(const Sweep&, const std::string& file);

// "joint.hip.angle_gain [%/count]", the reported figures, "status". A search has its largest value
// and the number of its runs besides.
std::vector<std::string> headings(const Sweep&);

inline constexpr std::size_t most_points = 1'000'000;  // each keeps a row of the table in memory

// Returns how many points a sweep has.
std::size_t points(const Sweep&);

// Returns the keys of a summary that the sweep reports or has conditions on, each once.
std::vector<std::string> keys(const Sweep&);

// Throws config::Error for an experiment that is wrong as it stands, and for keys and units of the
// axes that it does not know, and for more than most_points. Runs nothing.
void check(const Sweep&);

// Checks, then runs. Throws after its first run for a key that the summary lacks and that looks
// like a typing error. Returns the rows that are there, the known ones too, in the points' order.
std::vector<Row> sweep(const Sweep&, const Options&);

// Runs points of a sweep by their number, for whoever hands them out: a row is the same wherever it
// was made.
class Runner {
 public:
  // Draws the values of all points.
  explicit Runner(const Sweep& sweep);
  ~Runner();

  // `done` is called for one row at a time, and must not throw.
  void run(std::span<const std::size_t> points, int threads,
           const std::function<void(Row)>& done) const;

 private:
  struct Drawn;
  std::unique_ptr<Drawn> drawn_;
};

// One run: what `sinew run` would say of it.
struct Ran {
  std::string status = "ok";
  analysis::Summary summary;  // empty where the status is another
  double atmosphere = units::atmosphere;
  bool no_air = false;               // no muscle took any, whatever was commanded
  std::vector<std::string> differs;  // keys of what is reported, where the verdict is "differs"

  // Are there figures?
  bool ok() const { return status == "ok"; }
};
// Runs an experiment's file with settings in place of its own. The status tells why there are no
// figures.
Ran run_once(const std::string& file, const std::vector<std::string>& sets,
             bool allow_unreachable = false);

// The largest value for which something holds, from below.
//
// Goes up along the given values to the first that does not hold, then halves the interval between
// it and the one before. What holds again further up is not looked for, so of something that is not
// monotone this is the end of the lowest part, as finely as the values see it.
struct Largest {
  enum class Is { never, between, to_the_end };  // not even the first; found; even the last holds

  Is is = Is::never;
  double value = 0;  // the largest that held; of no meaning for `never`
  double fails = 0;  // the smallest above it that did not; of no meaning for `to_the_end`
};

// `values` in the order in which they are tried. `holds(double) -> bool` is asked at most
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
