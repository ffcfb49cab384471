// report/page/content.h - parts of a page's JSON, the columns that they refer to, and the encoded
// samples of the columns; and the picture of a run in a list.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/node.h"
#include "sinew/config/shown_units.h"
#include "sinew/json/json.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/plot.h"
#include "sinew/report/page/scene.h"
#include "sinew/report/page/stand.h"

namespace sinew::report {

// A run's samples as one text within a page: base64 of zlib of columns.
//
// The columns are, for every clock, its times as int32 ticks of 100 us, each less the one before
// it; then for every column its values as float32. Each of these arrays is split into planes: the
// lowest bytes of all its numbers, then the next ones, which compresses better. A time between
// ticks is rounded to the nearest one.
//
// A clock with more samples than a screen can show is thinned: every group of samples is replaced
// by two. For a column drawn as a line these are the least and the greatest value in the order of
// time, so that no peak is lost; for a column of a pose they are the first and the middle sample,
// so that the columns of a pose belong to one sample.
class Blob {
 public:
  static constexpr std::size_t most = 65536;  // samples of a clock

  // The use of a column: a curve, or a machine that is drawn.
  enum class As { line, pose };

  // Adds a column, unless it was added before. Returns its index.
  int add(const Samples& samples, As as = As::line);

  // Returns the size of a thinned group, of the clock with the most samples; 0 if none is thinned.
  std::size_t thinned() const;

  struct Layout {
    std::vector<std::size_t> clocks;  // samples of each
    std::vector<int> columns;         // the clock of each
  };
  // Return the layout of the columns in the text, and the text.
  Layout layout() const;
  std::string base64() const;

 private:
  int clock_of(const signals::Times& time_ns);

  std::vector<const signals::Times*> clocks_;
  struct Column {
    int clock = 0;
    const signals::Column* values = nullptr;
    As as = As::line;
  };
  std::vector<Column> columns_;
  std::map<std::pair<const void*, As>, int> known_;  // columns by their values
};

// Encodes bytes in base64.
std::string to_base64(std::string_view bytes);

// Maps channels to column indices: a channel is added to the blob when it is first requested.
class Columns {
 public:
  static constexpr int none = -1;

  // Both must outlive this.
  Columns(const Channels& channels, Blob& blob) : channels_(channels), blob_(blob) {}
  // Returns the index of the channel's column, adding it if it is new; `none` if it has no samples.
  int of(const Channel& channel, Blob::As as) {
    const Samples samples = channels_.find(channel);
    if (!samples) return none;
    const int column = blob_.add(samples, as);
    if (column == static_cast<int>(list_.size())) list_.push_back({channel, as});
    return column;
  }
  // Channel and use of each column, by its index.
  struct Request {
    Channel channel;
    Blob::As as = Blob::As::line;
  };
  const std::vector<Request>& list() const { return list_; }

 private:
  const Channels& channels_;
  Blob& blob_;
  std::vector<Request> list_;
};

// The drawing of a run's machine, and all channels of the run: recorded, derived, drawn.
struct Drawing {
  // The tables must outlive this object.
  Drawing(const signals::Table& logged, const signals::Table& derived,
          const analysis::Machine& machine, const analysis::Record& record);
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  signals::Table drawn;
  Channels channels;
  Scene scene;  // empty for a stand
  Stand stand;  // empty for a robot
};

// Returns the panels of the channels over time, without empty ones. Channels that no panel has come
// last, by unit. Setpoints are of kind desired; lines that would repeat another one are hidden.
std::vector<Plot> panels(const Channels& channels, const analysis::Machine& machine);

// Return JSON; a channel is the index of its column, or null.
Json panels_json(const std::vector<Plot>& panels, Columns& columns);  // over time
Json charts_json(const std::vector<Plot>& charts, Columns& columns);
Json to_json(const Scene& scene, Columns& columns);  // null if it is empty
Json to_json(const Stand& stand, Columns& columns);  // null if it is empty
Json to_json(const std::vector<Parameter>& parameters);
Json to_json(const std::vector<analysis::Warning>& warnings);
// `end` is that of the run [s].
Json to_json(const std::vector<analysis::MachineFault>& faults, double end);
Json to_json(const std::vector<analysis::Verdict>& verdicts);
Json to_json(const Blob::Layout& layout);

// Returns the phases of a run as JSON, without the stretches if there are more than a screen can
// show.
Json phases_of(const analysis::Record& record, const analysis::Machine& machine);

inline constexpr std::size_t most_stretches = 4000;

// Returns the table of units of a page, from which its switch shows numbers in any set, and in a
// custom one:
//
//   {"start": "metric", "sets": [{"name": "si", "title": "SI", "about": "…", "units":
//      {"m": {"label": "m", "scale": 1}, "Pa": {"label": "psi gauge", "scale": …, "gauge": true},
//       "kg": {"label": "g", "scale": 1000, "large": {"label": "kg", "scale": 1}}, …}}, …]}
//
// shown = (value + offset) * scale, less the room's pressure for a gauge unit. `large` is the unit
// for single numbers from 1000 of the usual one on. The three sets are always present; one with
// choices is a fourth, "own".
std::string units_json(const units::ShownUnits& start);

// Returns the table that starts with the units of the environment and the user's settings.
std::string units_json();

// Returns the machine of a run in its initial pose, as web/src/run_list.js draws it, as JSON:
// {"scene", "atmosphere", "samples", "data"}, the scene with one sample (content.h), null if it has
// no links; {"stand": true} for a test stand; {} if the file does not describe a machine.
std::string picture(const config::Node& resolved);

}  // namespace sinew::report
