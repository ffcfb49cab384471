// recording/mapping.h - mapping of a recording's columns to channels of a machine: the channel and
// unit of each column, and the recording's clock. Stored in a file of format sinew.mapping/1:
//
//   format = "sinew.mapping/1"
//
//   [clock]
//   column = "Zeit"
//   unit = "ms"
//
//   [[column]]
//   name = "Winkel"
//   channel = "/joint/elbow/angle"
//   unit = "deg"
//   scale = -1        # the encoder counts the other way round
//   offset = "90 deg"
//
//   value = scale x number [unit] + offset
//
// A column whose name identifies its channel needs no row: a channel's own name, or `elbow_angle`.
#pragma once

#include <string>
#include <vector>

namespace sinew::recording {

// Format of a text table, where the file does not show it; values as in source.h.
struct TableSettings {
  std::string encoding, decimal, thousands, dates;
  bool spread_times = false;
  bool drop_incomplete = false;      // leave out rows without a time
  std::vector<std::string> columns;  // the header, for a file that has none
  int part = 0;  // index of the recording in the file; 0: the only one; not stored
};

// Range of a clock's scale, and its reason.
inline constexpr double least_clock_scale = 0.5, most_clock_scale = 2;
inline constexpr const char* clock_scale_why = "a clock that errs by more has another unit";

// Source and scale of a recording's times.
struct ClockMapping {
  std::string column;  // with the times; empty: the only likely column
  std::string unit;    // unit of its numbers; empty: as in the file
  std::string rate;    // "100 Hz", in place of a column
  double scale = 1;    // seconds of a true clock per second of this one
  std::string start;   // the time that becomes the log's time 0; empty: the first
};

// Takes only rows in which the column has one of these values: "fill" or "100, 200".
struct WhereMapping {
  std::string column, values;
};

// Meaning of one column.
struct ColumnMapping {
  std::string name;     // in the file
  std::string channel;  // channel of the machine: "/joint/elbow/angle", "/foot/position.x"
  std::string unit;     // unit of the file's numbers; empty: as in its header
  double scale = 1;
  std::string offset;  // added after the scale, "90 deg"; empty: nothing
};

// Contents of a file of format sinew.mapping/1.
struct Mapping {
  TableSettings table;
  ClockMapping clock;
  std::vector<WhereMapping> where;
  std::vector<ColumnMapping> columns;
  bool keep_others = false;  // keep columns without a channel as /recorded/<name>
};

// Reads such a file. Throws config::Error with all faults.
Mapping load_mapping(const std::string& path);

// Returns the text of such a file, with a comment on each part in use.
std::string text_of(const Mapping& mapping);

// Returns `first` with the settings of `second` added; those of `second` replace those of `first`.
Mapping merged(Mapping first, const Mapping& second);

// Set one property of a column or a channel and keep its other properties. The channel `time` is
// the clock.
void map_channel(Mapping& mapping, const std::string& channel, const std::string& column);
void map_unit(Mapping& mapping, const std::string& column, const std::string& unit);
void map_scale(Mapping& mapping, const std::string& column, double scale);
void map_offset(Mapping& mapping, const std::string& column, const std::string& offset);
void map_where(Mapping& mapping, const std::string& column, const std::string& values);

// Throws config::Error for a column that two channels use with two units, a channel with two
// columns, and numbers out of range.
void check_mapping(const Mapping& mapping, const std::string& file);

}  // namespace sinew::recording
