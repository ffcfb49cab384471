// config/shown_units.h - choice of the units in which numbers are shown, by precedence.
//
//   strongest   an option of the program, an argument of Python
//               SINEW_UNITS          environment variable, for a session or a script
//               page.units           of the run's experiment
//               settings.toml        of the user (UserSettings below)
//   weakest     the caller's default
//
// Each is a set of units, "metric", optionally with choices for single quantities, or only such
// choices, "pressure=kPa gauge", which leave other quantities to the weaker levels.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/units/constants.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"
#include "sinew/units/shown.h"

namespace sinew::config {

// Name of the environment variable.
inline constexpr const char* units_variable = "SINEW_UNITS";

// Requested units besides the environment and the user's settings.
struct UnitsRequest {
  std::string now;               // strongest level; empty: not given
  std::string now_is = "units";  // its name in messages
  const Node* run = nullptr;     // an experiment's tree, or a run's resolved.toml; null: none
};

// Resulting units.
struct UnitsToShow {
  units::ShownUnits units;
  bool is_requested = false;  // whether any level gave units, so that `units` is not the default

  // Returns the units if any level gave them; else null.
  const units::ShownUnits* requested() const { return is_requested ? &units : nullptr; }
};

// Returns the units in which to show numbers. Throws Error with the place of an invalid text.
UnitsToShow units_to_show(const UnitsRequest& request, const units::ShownUnits& otherwise = {});

// Options for printing a result.
struct TextOptions {
  UnitsToShow units = {};                 // chosen ones; else each number has the result's own
  double atmosphere = units::atmosphere;  // reference of gauges [Pa]
  std::size_t width = 0;                  // letters in a line; 0: any number

  // A number in the unit in which it is shown.
  struct Shown {
    double number;
    std::string unit;  // "1": none
    double scale;      // factor of differences
  };

  // Returns the number in the chosen unit; unchanged where none was chosen or none exists.
  Shown shown(double number, const std::string& unit) const;
};

// Reads a text as units::read_shown_units does; throws Error that begins with `where` and `key`.
units::ShownUnits parse_shown_units(std::string_view text, const Location& where,
                                    const std::string& key, const units::ShownUnits& below = {});

// Display settings of a run: the table [page] of an experiment.
struct PageTable {
  std::string units;  // empty: the user's own
};

// Adds a problem to the visitor if `text`, the key `units` of its table, is invalid.
template <class Visitor>
void report_wrong_units(Visitor& v, const std::string& text) {
  if (text.empty()) return;
  if (const auto m = units::read_shown_units(text).mistake)
    units::report_conflict(v, "units", m->found, m->expected, m->try_this);
}

// Visits the keys of [page].
template <class Visitor>
void fields(Visitor& v, PageTable& page) {
  v.text({.name = "units",
          .optional = true,
          .doc = "units of its numbers: si, thesis, metric, or metric,length=cm; the log is in SI"},
         page.units);
  report_wrong_units(v, page.units);
}

// Settings of the user for all commands: ~/.config/sinew/settings.toml.
//
//   format = "sinew.settings/1"
//   units  = "metric,pressure=kPa gauge"     units in which numbers are shown
//
// The file is optional. It never affects what is computed or written to a log.

struct UserSettings {
  std::string units;  // in the syntax of units/shown.h; empty: not given
  Location units_at;  // place of that key
};

// Visits the keys of settings.toml.
template <class Visitor>
void fields(Visitor& v, UserSettings& settings) {
  v.text({.name = "units",
          .optional = true,
          .doc = "units of displayed numbers: si, thesis, metric, or metric,length=cm"},
         settings.units);
  report_wrong_units(v, settings.units);
}

// Returns the path of the file, in XDG_CONFIG_HOME or else in .config of the home folder. Empty if
// neither exists.
std::string user_settings_path();

// Reads such a file. Throws Error with all faults.
UserSettings read_user_settings(const std::string& path);

// Reads the user's own file; returns empty settings if it does not exist.
UserSettings user_settings();

}  // namespace sinew::config
