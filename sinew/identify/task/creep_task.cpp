#include "sinew/identify/task/methods.h"

#include <algorithm>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"

namespace sinew::identify {

CreepResult find(const SourceList& sources, const CreepSettings& settings) {
  return identify_creep(times_averaged(read_measured(only_of(sources), creep_columns()), 20000),
                        settings.tried);
}

Json to_json(const CreepResult& found) {
  Json out = to_json(found.report);
  out["creep"] = {{"share", found.creep.share}, {"time_s", found.creep.time}};
  const bool tried = std::ranges::any_of(found.report.fits, [](const Fit& fit) {
    return std::ranges::find(fit.parameters, "half_width", &Estimate::name) != fit.parameters.end();
  });
  if (tried) out["hysteresis"] = {{"half_width_Pa", found.hysteresis.half_width}};
  return out;
}

}  // namespace sinew::identify
