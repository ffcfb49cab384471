#include "sinew/identify/task/methods.h"

#include <algorithm>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"

namespace sinew::identify {

CreepFound find(const SourceList& sources, const CreepSettings& settings) {
  return CreepFound(identify_creep(
      times_averaged(read_measured(only_of(sources), creep_columns()), 20000), settings.tried));
}

}  // namespace sinew::identify
