// thesis/out_dat/out_dat.h - out.dat, the log of the thesis's controller (B.1).
//
//   mode timer pot[0] fi[0] ee[0] fe[0] ei[0]
//        thetades[1] pot[1] gage[0] gage[1] stiffdes[1] stiffness[1] fi[1] ee[1] fe[1] ei[1]
//        thetades[2] pot[2] gage[2] gage[3] …
//
// One line per period of the gait controller in the sequence; the heading above is one line too.
// `mode` is swing, plant or stance, for our swing, foot_plant and propulsion; any other phase has
// its own name. `timer` counts periods since the start of the phase. pot and gage are converter
// counts, thetades the desired counts, stiffdes and stiffness are in lbf in/rad; fi, ee, fe, ei are
// duties in %: flexor or extensor, inlet or exhaust. Joint 0 is the cylinder, whose duties are 0 if
// it is locked. Joints with muscles follow in the robot's order.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/table.h"

namespace sinew::thesis {

// Returns whether a file begins like such a log.
bool is_out_dat(const std::filesystem::path& file);

// Returns the log. Throws config::Error if the robot or the table lacks data for a column.
std::string write_out_dat(const signals::Table& table, const experiment::Experiment& experiment);

// Returns the channels in such a log, converted with the experiment's scales, from time 0; there is
// no channel under /true, and no valve edges, foot or settling. The duties of joint 0 have no
// channel. Desired angles are whole counts. Throws config::Error with all problems of the file.
signals::Table parse_out_dat(std::string_view text, const std::string& name,
                             const experiment::Experiment& experiment);

// Returns the bytes that the thesis's controller writes to the two valve ports (B.1) as CSV: time
// [s] and the byte of each port [1], with a row for each change. A board with more valve bits has
// more ports; several boards follow one after the other, with a column for their number.
std::string write_ports(const signals::Table& table, const experiment::Experiment& experiment);

}  // namespace sinew::thesis
