// identify/actuator/creep.h - creep and dry friction, fitted together to the force of a
// muscle that is filled, held and vented at one length.
//
//   F = F_p (max(P_e - P_0, 0) + sum chi_i max(P_late - P_0, 0))     P_late' = (P_e - P_late)/t_i
//   P_e = play of half-width w behind p: |p - P_e| <= w, and P_e moves only where p drags it
//
//   p      gauge pressure [Pa]     P_e  effective pressure [Pa]   F_p  slope at this length [N/Pa]
//   chi_i  share that comes late   t_i  its time constant [s]     P_0  threshold [Pa]    w  [Pa]
//
// These are the laws of actuator/creep.h and actuator/hysteresis.h, with a static law that is
// linear in pressure: F_p and P_0 of this length. Part of the data cannot separate the two effects:
// after a fill creep raises the force and friction holds it down. The vent separates them, because
// friction then raises the force at once and creep only for a while. Therefore both are fitted
// together. While the pressure still moves, a slow creep resembles a small error of the threshold:
// the report states how much of the growth a law without creep explains.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Returns the columns that are used: time, force, pressure.
std::span<const ColumnSpec> creep_columns();

// Creep and friction that were identified, and the quality of the fit.
struct CreepResult {
  Report report;
  actuator::Creep creep;            // the chosen model's
  actuator::Hysteresis hysteresis;  // half_width only; 0: the chosen model has no friction
};

// Fits no, one and two elements of creep; for a recording that is filled and vented, each with and
// without friction. The model is chosen by cross-validation over ten stretches of time. Samples
// at which the pressure moves (static_settled.h) drive the model and are not fitted. `done` counts
// the models that have been tried. Throws Refusal for fewer than 12 rows.
CreepResult identify_creep(const Measured& data, host::Tally* done = nullptr);

// Returns the names of the models, the simplest first.
std::vector<std::string> creep_models();

}  // namespace sinew::identify
