// config/user_settings.h - what a person wants everywhere: ~/.config/sinew/settings.toml.
//
//   format = "sinew.settings/1"
//   units  = "metric,pressure=kPa gauge"     in which numbers are shown
//
// The file needs not be there. Nothing of it changes what is computed or written to a log.
#pragma once

#include <string>

#include "sinew/config/diagnostics.h"
#include "sinew/config/shown_units.h"

namespace sinew::config {

struct UserSettings {
  std::string units;  // as units/shown.h reads it; empty: not said
  Location units_at;  // of that key
};

// The keys of settings.toml.
template <class Visitor>
void fields(Visitor& v, UserSettings& settings) {
  v.text({.name = "units",
          .optional = true,
          .doc = "in which numbers are shown: si, thesis, metric, or metric,length=cm"},
         settings.units);
  complain_of_units(v, settings.units);
}

// Returns the place of the file: below XDG_CONFIG_HOME, or else below .config in the home folder.
// Empty where there is neither.
std::string user_settings_path();

// Reads a file of that kind. Throws Error with all that is wrong.
UserSettings read_user_settings(const std::string& path);

// Reads the person's own file; a file that is not there says nothing.
UserSettings user_settings();

}  // namespace sinew::config
