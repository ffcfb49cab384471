// recording/assemble.h - assembly of recordings into one channel table, by a mapping and the
// channels of a machine.
//
// Several recordings are either aligned in time or concatenated. Time 0 of the table is the first
// sample. If the recording's clock begins between 0 and 1 s, it is taken for the clock of a run and
// is kept.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/channel_names.h"
#include "sinew/recording/mapping.h"
#include "sinew/recording/recorded.h"
#include "sinew/signals/table.h"
#include "sinew/units/constants.h"

namespace sinew::recording {

// Controls how several recordings are combined.
struct Joining {
  bool at_end = false;                        // true: concatenated in time; false: aligned in time
  std::map<std::string, std::string> shifts;  // file -> "0.12 s", added to its times
  double atmosphere = units::atmosphere;      // between gauge and absolute pressures [Pa]
  double pulse_period = 0.01;                 // period of the valves' pulses [s]
};

// Summarizes the import of one file.
struct ImportSummary {
  std::string file, kind;
  std::string started;              // wall-clock time of its start; empty: unknown
  std::size_t rows = 0;             // rows of its longest clock
  std::size_t values = 0;           // values written to the table
  std::size_t left_out = 0;         // values that are not finite or lie before time 0
  std::vector<std::string> unused;  // columns without a channel
};

// Holds the assembled table, the mapping that was used and notes for the user.
struct AssembledRecording {
  signals::Table table;  // in the order of the machine's channels, then /recorded/…
  Mapping used;          // has every column with a channel, also those that need no row
  std::vector<ImportSummary> files;
  std::string started;  // wall-clock time of the table's time 0; empty: unknown
  std::vector<std::string> notes;
};

// Assembles the recordings; `topics` are the machine's. Throws config::Error with all faults: an
// unknown column or channel, a unit that is missing or of another dimension, a channel found in two
// files.
AssembledRecording assemble(const std::vector<Recorded>& files, const Mapping& mapping,
                            std::span<const signals::Topic> topics, const Joining& joining = {});

}  // namespace sinew::recording
