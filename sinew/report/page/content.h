// report/page/content.h - the parts of a page's JSON, and the columns that they refer to.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/shown_units.h"
#include "sinew/report/page/blob.h"
#include "sinew/report/page/charts.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/scene.h"
#include "sinew/report/page/stand.h"

namespace sinew::report {

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
