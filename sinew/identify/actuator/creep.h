// identify/actuator/creep.h - creep and dry friction together, from force at one length while a
// muscle is filled, held and vented.
//
//   F = F_p (max(P_e - P_0, 0) + sum chi_i max(P_late - P_0, 0))     P_late' = (P_e - P_late)/t_i
//   P_e = play of half-width w behind p: |p - P_e| <= w, and P_e moves only where p drags it
//
//   p      gauge pressure [Pa]     P_e  effective pressure [Pa]   F_p  slope at this length [N/Pa]
//   chi_i  share that comes late   t_i  its time constant [s]     P_0  threshold [Pa]    w  [Pa]
//
// The laws of actuator/creep.h and actuator/hysteresis.h with a static law that is a straight line
// over pressure, F_p and P_0 of this length. Each looks like the other where there is only a part
// of the data: after a fill creep lifts the force, and friction holds it down; the vent parts them,
// as friction then holds it up at once and creep only for a while. So they are searched together.
// While the pressure still moves, a slow creep and a threshold that is a little off look alike: the
// report says how much of the growth a law without creep explains.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

// Returns the columns that are read: time, force, pressure.
std::span<const Wanted> creep_columns();

// Holds the creep and the friction that were found, and how well they fit.
struct CreepResult {
  Report report;
  actuator::Creep creep;            // of the chosen model
  actuator::Hysteresis hysteresis;  // its half_width alone; 0: the chosen model has none
};

// Tries none, one and two elements of creep; of a recording that is filled and vented each without
// and with friction. To choose, ten stretches of time are left out by turns. Samples at which the
// pressure moves (static_settled.h) are followed and not fitted. `done` counts the models that have
// been tried. Throws Refusal for fewer than 12 rows.
CreepResult identify_creep(const Measured& data, host::Tally* done = nullptr);

// Returns the names of the models, the simplest first.
std::vector<std::string> creep_models();

}  // namespace sinew::identify
