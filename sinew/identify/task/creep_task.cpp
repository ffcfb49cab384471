#include "sinew/identify/task/methods.h"

#include <algorithm>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"

namespace sinew::identify {

CreepFound find(const SourceList& sources, const CreepSettings& settings) {
  CreepFound out(identify_creep(
      times_averaged(read_measured(only_of(sources), creep_columns()), 20000), settings.tried));
  const CreepResult& result = out.result;
  out.json["creep"] = {{"share", result.creep.share}, {"time_s", result.creep.time}};
  const bool tried = std::ranges::any_of(
      result.report.fits, [](const Fit& fit) { return fit.estimate("half_width") != nullptr; });
  if (tried) out.json["hysteresis"] = {{"half_width_Pa", result.hysteresis.half_width}};
  return out;
}

}  // namespace sinew::identify
