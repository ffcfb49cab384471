// recording/matlab.h - a MAT file of MATLAB or GNU Octave as columns.
//
// A vector is a column; a matrix gives one column for each of its own, `angle(1)`, `angle(2)`;
// fields of structs are `log.angle`. The times are the vector `time`, `t` or `tout` in the same
// struct or in an enclosing one; values of the same count belong to it. This covers Simulink's
// "structure with time", whose signals are named by their labels, and a timeseries converted to a
// struct.
//
// Levels 4, 5 and 7.3 are read by libmatio, which is in a module of its own (module/matlab.h).
#pragma once

#include <string>
#include <string_view>

#include "sinew/recording/mapping.h"
#include "sinew/recording/recorded.h"

namespace sinew::recording {

// Returns whether a file with these first bytes is a MAT file of level 5 or 7.3.
bool is_matlab(std::string_view bytes);

// Reads a MAT file. Throws config::Error if the file is not a MAT file, is cut off or has no times,
// and if the program was built without libmatio.
Recorded read_matlab(const std::string& path, const ClockMapping& clock);

}  // namespace sinew::recording
