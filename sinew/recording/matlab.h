// recording/matlab.h - a MAT file of MATLAB or GNU Octave as columns.
//
// A vector is a column, a matrix one for each of its columns, `angle(1)`, `angle(2)`; fields of
// structs are `log.angle`. The times are the vector `time`, `t` or `tout` beside them or further
// out; what has as many values belongs to it. So Simulink's "structure with time" comes in, whose
// signals are called by their labels, and a timeseries that was turned into a struct.
//
// Level 5 and 7.3 are read by libmatio in a module of its own (module/matlab.h), level 4 too.
#pragma once

#include <string>
#include <string_view>

#include "sinew/recording/clock.h"
#include "sinew/recording/recorded.h"

namespace sinew::recording {

// Do the first bytes of a file say that it is MATLAB's?
bool is_matlab(std::string_view bytes);

// Throws config::Error for a file that is none, or is cut off, or has no times, and where the
// program was built without libmatio.
Recorded read_matlab(const std::string& path, const ClockSettings& clock);

}  // namespace sinew::recording
