// experiment/log_table.fields.h - the keys of [log].
#pragma once

#include "sinew/experiment/log_table.h"
#include "sinew/units/field.h"

namespace sinew::experiment {

template <class Visitor>
void fields(Visitor& v, Log& log) {
  v.flag({.name = "enabled", .optional = true, .doc = "false: only summary.json is left"},
         log.enabled);
  v.texts({.name = "channels", .optional = true, .doc = "topics; * stands for anything"},
          log.channels);
  v.number({.name = "period",
            .unit = "s",
            .min = 1e-4,
            .optional = true,
            .doc = "between samples, a multiple of 0.1 ms; edges are logged one by one"},
           log.period);
}

}  // namespace sinew::experiment
