// analysis/record/derived.h - what 6.3 plots and a log does not hold, as series beside the recorded
// ones.
//
//   /foot/position       x, y of the ankle about the first joint, of the measured angles [61], [62]
//   /foot/force          x, y on the foot by the ground, of the measured torques [75]
//   /joint/<j>/torque    of the measured tensions; > 0 raises the angle
//   /joint/<j>/error     measured - desired angle
//   /joint/<j>/oscillation   the same without its mean over 0.21 s about each sample
//   /muscle/<m>/passive     share of the period in which neither valve is open, as commanded
//   /trolley/position, /trolley/velocity      of /foot/force and drag, integrated as in 6.3; the
//                        force counts until the foot is unloaded
//   /trolley/by_plan/position, /trolley/by_plan/velocity   the same, the force counting in the
//                        plan's stance alone, which ends earlier
//   /true/joint/<j>/stiffness   of the true lengths and pressures
//   /true/foot/slip      velocity of the foot's lowest point along the ground
//
// Formulas: docs/reference/analysis.md. A series is absent where the table lacks what it needs: a
// hardware log gives all but those under /true. All series stand at the times of the plan's
// samples; other topics are held from one of their samples to the next. Where a reading is not a
// number the result is not a number.
#pragma once

#include "sinew/analysis/record/machine.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Returns the derived series of a log.
signals::Table derive(const signals::Table&, const Machine&);

}  // namespace sinew::analysis
