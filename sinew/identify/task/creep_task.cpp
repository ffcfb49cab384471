#include "sinew/identify/task/creep_task.h"

#include <nlohmann/json.hpp>

#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/task/tables.h"

namespace sinew::identify {

CreepResult find_creep(const std::vector<Source>& sources) {
  return identify_creep(read_measured(only_of(sources), creep_columns()));
}

nlohmann::ordered_json to_json(const CreepResult& found) {
  nlohmann::ordered_json out = to_json(found.report);
  out["creep"] = {{"share", found.creep.share}, {"time_s", found.creep.time}};
  out["hysteresis"] = {{"half_width_Pa", found.hysteresis.half_width}};
  return out;
}

}  // namespace sinew::identify
