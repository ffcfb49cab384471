// cli/option_groups.h - options that several commands share: units, how a table is read, the
// settings of a method.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.h"
#include "sinew/config/node.h"
#include "sinew/config/setting_rows.h"
#include "sinew/config/shown_units.h"
#include "sinew/identify/task/settings.h"
#include "sinew/recording/mapping.h"

namespace sinew::cli {

// --- --units of every command that prints numbers ---

// Adds `--units`; `of` ends its line of help: "of the tables; --json is in SI". Unknown units are
// wrong usage.
void add_units(CLI::App& sub, std::string& units, const std::string& of);

// Returns the units that were chosen: by the option, by SINEW_UNITS, by the run (null: none) and by
// the user's settings.
config::UnitsToShow chosen_units(const std::string& option, units::UnitSet otherwise,
                                 const config::Node* run = nullptr);

// Returns the same for a run that is kept, by its resolved.toml, where it exists.
config::UnitsToShow chosen_units(const std::string& option, units::UnitSet otherwise,
                                 const std::filesystem::path& resolved);

// Adds `--machine` of commands that read a recorded run.
void add_machine(CLI::App& sub, std::string& machine);

// --- how `sinew import` and the methods of `sinew identify` read a table ---

struct TableOptions {
  std::vector<std::string> maps, units;  // "force=F_N"
  std::vector<std::string> where;        // "phase=fill"
  std::vector<std::string> values;       // "pressure=2 bar gauge"
  std::vector<std::string> offsets;      // "length=200 mm"
  std::string columns;                   // "force [N],pressure [kPa gauge]"
  std::string rate;                      // "100 Hz"
};

// The heading of these options in a command's help, which names them; `sinew help tables` describes
// them.
inline constexpr const char* table_heading = "How a table is read";

// `Settings` is recording::TableSettings or identify::Source.
template <class Settings>
void add_table_options(CLI::App& sub, TableOptions& options, Settings& settings);

// Return the names and values of texts "name=value". A unit or a value has no "=", a column's name
// may have some: then the last one separates. Throws config::Error for any other text.
enum class Equals { first, last };
using Pairs = std::vector<std::pair<std::string, std::string>>;
Pairs pairs_of(const char* option, const std::vector<std::string>& texts,
               Equals separator = Equals::first, const char* expected = "name=value");

// --- files that are written ---

// Writes a file of this name, if it is not empty, and prints a note.
void write_output(const std::string& file, const std::string& text, bool quiet);

// --- the settings of a method as options ---

// Adds an option for each row. A visitor of config/setting_rows.h.
class SettingOptions : public config::RowVisitor<SettingOptions> {
 public:
  using Row = config::Setting;
  explicit SettingOptions(CLI::App& sub) : sub_(sub) {}

  void row(const Row& row, std::string& value);
  void row(const Row& row, int& value) { add(row, value)->capture_default_str(); }
  void row(const Row& row, double& value) { add(row, value)->capture_default_str(); }
  void row(const Row& row, bool& value);
  void row(const Row& row, std::vector<std::string>& value);
  void row(const Row& row, identify::HeldOut& value);

 private:
  static std::string names_of(const Row& row);
  static std::string help_of(const Row& row);  // "FILE: robot file"

  template <class Value>
  CLI::Option* add(const Row& row, Value& value) {
    return sub_.add_option(names_of(row), value, help_of(row));
  }

  CLI::App& sub_;
};

}  // namespace sinew::cli
