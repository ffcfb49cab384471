// experiment/hose_of.h - from a file's table of a hose to the law that the air goes by.
#pragma once

#include "sinew/gas/hose.h"
#include "sinew/robot/robot.h"

namespace sinew::experiment {

inline gas::Hose hose_of(const robot::Hose& h) {
  using Law = robot::Hose::Law;
  gas::Hose out{.sonic_conductance = h.sonic_conductance,
                .critical_pressure_ratio = h.critical_pressure_ratio,
                .length = h.length,
                .inner_diameter = h.inner_diameter,
                .volume = h.volume};
  if (h.law == Law::iso6358) out.law = gas::Hose::Law::iso6358;
  if (h.law == Law::pipe) out.law = gas::Hose::Law::pipe;
  return out;
}

}  // namespace sinew::experiment
