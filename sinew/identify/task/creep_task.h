// identify/task/creep_task.h - `sinew identify creep`: creep and dry friction from fill, hold and
// vent.
#pragma once

#include <vector>

#include "sinew/identify/actuator/creep.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// It has no settings.
struct CreepSettings {
  host::Tally* tried = nullptr;  // counts laws that have been tried; null: nothing
};

template <class Visitor>
void fields(Visitor& v, CreepSettings&) {
  v.method({"creep",
            "creep and dry friction from force at one length while the muscle is filled, held and "
            "vented; they belong into an actuator's [creep] and [hysteresis]",
            Tables::needed, creep_models().size()});
}

// Throws config::Error and Refusal.
CreepResult find_creep(const std::vector<Source>& sources, const CreepSettings& settings = {});

// Returns the report with the shares, times [s] and half-width [Pa], as `--json` prints it.
Json to_json(const CreepResult& found);

}  // namespace sinew::identify
