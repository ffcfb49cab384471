// identify/task/creep_task.h - `sinew identify creep`: shares and times of creep from a hold.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "sinew/identify/actuator/creep.h"

namespace sinew::identify {

// Throws config::Error and Refusal.
CreepResult find_creep(const std::vector<Source>& sources);

// Returns the report with the shares and times [s], as `--json` prints it.
nlohmann::ordered_json to_json(const CreepResult& found);

}  // namespace sinew::identify
