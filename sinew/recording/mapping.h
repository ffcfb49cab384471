// recording/mapping.h - what the columns of somebody's recording mean to a machine of ours: which
// channel each is, in which unit, and how its clock runs. A file of format sinew.mapping/1 keeps
// it:
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
// A column whose name says it by itself needs no row: a channel's own name, or `elbow_angle`.
#pragma once

#include <string>
#include <vector>

namespace sinew::recording {

// How a table of text is written, where it does not show it; the words are those of source.h.
struct TableSettings {
  std::string encoding, decimal, thousands, dates;
  bool spread_times = false;
  bool drop_incomplete = false;      // leave out rows without a time
  std::vector<std::string> columns;  // the header, for a file that has none
  int part = 0;  // of several recordings in the file; 0: there is but one; not in a mapping's file
};

// How the recording tells time.
struct ClockMapping {
  std::string column;  // with the times; empty: the one that is clearly meant
  std::string unit;    // of its numbers; empty: as the file says
  std::string rate;    // "100 Hz", in place of a column
  double scale = 1;    // seconds of a true clock per second of this one
  std::string start;   // of its times, the one that becomes the log's time 0; empty: the first
};

// Only rows in which the column has one of these values, "fill" or "100, 200", are taken.
struct WhereMapping {
  std::string column, values;
};

// Tells what one column means.
struct ColumnMapping {
  std::string name;     // the file's
  std::string channel;  // ours: "/joint/elbow/angle", "/foot/position.x"
  std::string unit;     // of the file's numbers; empty: as its header says
  double scale = 1;
  std::string offset;  // added after the scale, "90 deg"; empty: nothing
};

// All that a file of format sinew.mapping/1 says.
struct Mapping {
  TableSettings table;
  ClockMapping clock;
  std::vector<WhereMapping> where;
  std::vector<ColumnMapping> columns;
  bool keep_others = false;  // keep columns without a channel as /recorded/<name>
};

// Reads such a file. Throws config::Error with everything that is wrong.
Mapping load_mapping(const std::string& path);

// Returns the text of such a file, with a comment on each part that is there.
std::string text_of(const Mapping& mapping);

// Returns `first` with what `second` says besides and in its place: its words are the later ones.
Mapping merged(Mapping first, const Mapping& second);

// Say one thing of a column or a channel; what was said of it before stands otherwise. The channel
// `time` is the clock.
void map_channel(Mapping& mapping, const std::string& channel, const std::string& column);
void map_unit(Mapping& mapping, const std::string& column, const std::string& unit);
void map_scale(Mapping& mapping, const std::string& column, double scale);
void map_offset(Mapping& mapping, const std::string& column, const std::string& offset);
void map_where(Mapping& mapping, const std::string& column, const std::string& values);

// Throws config::Error for a column that two channels want in two units, a channel that has two
// columns, and numbers that cannot be.
void check_mapping(const Mapping& mapping, const std::string& file);

}  // namespace sinew::recording
