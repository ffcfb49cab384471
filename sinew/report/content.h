// report/content.h - the parts of a page's JSON, and the columns that they refer to.
#pragma once

#include <nlohmann/json.hpp>

#include "sinew/analysis/machine.h"
#include "sinew/analysis/record.h"
#include "sinew/analysis/summary.h"
#include "sinew/analysis/warnings.h"
#include "sinew/report/blob.h"
#include "sinew/report/panels.h"
#include "sinew/report/parameters.h"
#include "sinew/report/scene.h"

namespace sinew::report {

using Json = nlohmann::ordered_json;  // keys stay in the order in which they come

// Numbers of columns in place of channels: each is added to the blob when it is first asked for.
class Columns {
 public:
  Columns(const Channels& channels, Blob& blob) : channels_(channels), blob_(blob) {}
  Json of(const Channel& channel) {  // null: none
    const Samples samples = channels_.find(channel);
    return samples ? Json(blob_.add(samples)) : Json();
  }

 private:
  const Channels& channels_;
  Blob& blob_;
};

Json to_json(const std::vector<Panel>& panels, Columns& columns);
Json to_json(const Scene& scene, Columns& columns);
Json to_json(const std::vector<Parameter>& parameters);
Json to_json(const std::vector<analysis::Warning>& warnings);
Json to_json(const std::vector<analysis::Verdict>& verdicts);
Json phases_of(const analysis::Record& record, const analysis::Machine& machine);

}  // namespace sinew::report
