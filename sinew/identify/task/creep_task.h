// identify/task/creep_task.h - `sinew identify creep`: creep and dry friction from fill, hold and
// vent.
#pragma once

#include <vector>

#include "sinew/identify/actuator/creep.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// `tried` counts models that have been tried. Throws config::Error and Refusal.
CreepResult find_creep(const std::vector<Source>& sources, host::Tally* tried = nullptr);

// Returns the report with the shares, times [s] and half-width [Pa], as `--json` prints it.
Json to_json(const CreepResult& found);

}  // namespace sinew::identify
