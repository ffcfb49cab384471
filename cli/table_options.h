// cli/table_options.h - the options about how a table is read, which `sinew import` and the methods
// of `sinew identify` share. Their help names them; `sinew help tables` describes them.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "sinew/recording/mapping.h"

namespace sinew::cli {

struct TableOptions {
  std::vector<std::string> maps, units;  // "force=F_N"
  std::vector<std::string> where;        // "phase=fill"
  std::vector<std::string> values;       // "pressure=2 bar gauge"
  std::vector<std::string> offsets;      // "length=200 mm"
  std::string columns;                   // "force [N],pressure [kPa gauge]"
  std::string rate;                      // "100 Hz"
  recording::TableSettings settings;     // without its columns
};

// The heading of these options in a command's help.
inline constexpr const char* table_heading = "How a table is read";

void add_table_options(CLI::App& sub, TableOptions& options);

}  // namespace sinew::cli
