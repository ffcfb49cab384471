// report/page/content.h - the parts of a page's JSON, the columns that they refer to, and the
// bytes that hold the columns' samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/shown_units.h"
#include "sinew/report/page/channels.h"
#include "sinew/report/page/charts.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/scene.h"
#include "sinew/report/page/stand.h"

namespace sinew::report {

// A run's samples as one text that a page can hold: base64 of zlib of columns.
//
// Inside: for every clock its times as int32 ticks of 100 us, each less the one before it; then for
// every column its values as float32. Each of these arrays stands byte by byte: the lowest bytes of
// all its numbers, then the next ones, since bytes of one rank are alike and shrink better. A time
// between ticks is rounded to the next one.
//
// Of a clock with more samples than a screen can show the page gets two of every few: of a column
// that is drawn as a line the least value and the greatest one, in the order in which they come, so
// that no peak is lost; of one that belongs to a pose the values of the first sample and of the
// middle one, so that a pose is one that was.
class Blob {
 public:
  static constexpr std::size_t most = 65536;  // samples of a clock

  // Says what a column is for: a curve, or a machine that is drawn.
  enum class As { line, pose };

  // Position of its column; that of the first time, where it was added before.
  int add(const Samples& samples, As as = As::line);

  // Samples that two stand for, of the clock with the most; 0 where all of them are there.
  std::size_t thinned() const;

  struct Layout {
    std::vector<std::size_t> clocks;  // samples of each
    std::vector<int> columns;         // the clock of each
  };
  // Returns where each column stands in the text; and the text.
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

// Returns bytes as letters that any text can hold.
std::string to_base64(std::string_view bytes);

// Numbers of columns in place of channels: each is added to the blob when it is first asked for.
class Columns {
 public:
  static constexpr int none = -1;

  // Both outlive it.
  Columns(const Channels& channels, Blob& blob) : channels_(channels), blob_(blob) {}
  // Returns the number of the channel's column, added where it is new; `none` where there are no
  // samples.
  int of(const Channel& channel, Blob::As as) {
    const Samples samples = channels_.find(channel);
    if (!samples) return none;
    const int column = blob_.add(samples, as);
    if (column == static_cast<int>(list_.size())) list_.push_back({channel, as});
    return column;
  }
  // Of each column, by its number.
  struct Asked {
    Channel channel;
    Blob::As as = Blob::As::line;
  };
  const std::vector<Asked>& list() const { return list_; }

 private:
  const Channels& channels_;
  Blob& blob_;
  std::vector<Asked> list_;
};

// Each as JSON; a channel is the number of its column, or null.
std::string to_json(const std::vector<Panel>& panels, Columns& columns);
std::string to_json(const Scene& scene, Columns& columns);  // null: an empty one
std::string to_json(const Stand& stand, Columns& columns);  // null: an empty one
std::string to_json(const std::vector<Chart>& charts, Columns& columns);
std::string to_json(const std::vector<Parameter>& parameters);
std::string to_json(const std::vector<analysis::Warning>& warnings);
std::string to_json(const std::vector<analysis::MachineFault>& faults, double end);  // of the run
std::string to_json(const std::vector<analysis::Verdict>& verdicts);
std::string to_json(const Blob::Layout& layout);
std::string to_json(const std::string& text);
std::string to_json(double number);

// A member of an object and its new JSON; an empty one removes it. phases/stretches is the member
// `stretches` of the member `phases`.
struct ChangedMember {
  std::string name, json;
};
// Returns the object with these members changed.
std::string with_members(const std::string& object, const std::vector<ChangedMember>& members);

// Without the stretches where there are more than a screen can show.
std::string phases_of(const analysis::Record& record, const analysis::Machine& machine);

inline constexpr std::size_t most_stretches = 4000;

// Returns the table of units that a page carries, so that its switch shows numbers in any set, and
// in the reader's own:
//
//   {"start": "metric", "sets": [{"name": "si", "title": "SI", "about": "…", "units":
//      {"m": {"label": "m", "scale": 1}, "Pa": {"label": "psi gauge", "scale": …, "gauge": true},
//       "kg": {"label": "g", "scale": 1000, "large": {"label": "kg", "scale": 1}}, …}}, …]}
//
// shown = (value + offset) * scale, and less the room's pressure where it says gauge. `large` is
// the unit in which a single number stands from 1000 of the usual one on. The three sets are always
// there; one with choices is a fourth, "own".
std::string units_json(const units::ShownUnits& start);

// Returns it for a page of which nobody asked for anything but what the environment and the
// person's settings say.
std::string units_json();

}  // namespace sinew::report
