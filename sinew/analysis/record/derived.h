// analysis/record/derived.h - series computed from those of a log, for the plots of 6.3.
//
//   /foot/position       x, y of the ankle about the first joint, from the measured angles [61],
//                        [62]
//   /foot/force          x, y of the ground's force on the foot, from the measured torques [75]
//   /joint/<j>/torque    from the measured tensions; > 0 raises the angle
//   /joint/<j>/error     measured - desired angle
//   /joint/<j>/oscillation   the error without its mean over 0.21 s about each sample
//   /muscle/<m>/passive     share of the period in which neither valve is open, as commanded
//   /trolley/position, /trolley/velocity      from /foot/force and drag, integrated as in 6.3; the
//                        force counts until the foot is unloaded
//   /trolley/by_plan/position, /trolley/by_plan/velocity   the same, but the force counts only in
//                        the plan's stance, which ends earlier
//   /true/joint/<j>/stiffness   from the true lengths and pressures
//   /true/foot/slip      velocity of the foot's lowest point along the ground
//
// Formulas: docs/reference/analysis.md. A series is absent if the table lacks its inputs: a
// hardware log gives all but those under /true. All series have the times of the plan's samples;
// other topics are held from one of their samples to the next. NaN inputs give NaN.
#pragma once

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Returns the derived series, or those of `wanted` alone; an empty table for a test stand. The
// topics that they are computed from are added to `read`.
signals::Table derive(const signals::Table&, const Machine&, const TopicNames* wanted = nullptr,
                      TopicNames* read = nullptr);

}  // namespace sinew::analysis
