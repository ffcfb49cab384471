// config/user_settings.h - settings of the user for all commands: ~/.config/sinew/settings.toml.
//
//   format = "sinew.settings/1"
//   units  = "metric,pressure=kPa gauge"     units in which numbers are shown
//
// The file is optional. It never affects what is computed or written to a log.
#pragma once

#include <string>

#include "sinew/config/diagnostics.h"
#include "sinew/config/shown_units.h"

namespace sinew::config {

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
