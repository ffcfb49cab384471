// recording/clock_settings.h - what is to be known about a recording's clock before it is read.
#pragma once

#include <string>

namespace sinew::recording {

// Says where the times are.
struct ClockSettings {
  std::string column;  // with the times; empty: `time`, or what else is clearly meant
  std::string unit;    // of its numbers; empty: the file's, or else s
  std::string rate;    // "100 Hz", in place of a column; empty: there is one
};

// Seconds of one step of the clock's unit; `file` is for the message. Throws config::Error where it
// is no unit of time.
double seconds_per_unit(const std::string& unit, const std::string& file);

}  // namespace sinew::recording
