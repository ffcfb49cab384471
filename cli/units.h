// cli/units.h - `--units` of every command that shows numbers, and in whose units it shows them.
#pragma once

#include <filesystem>
#include <string>

#include "cli/command.h"
#include "sinew/config/node.h"
#include "sinew/config/shown_units.h"

namespace sinew::cli {

// Adds `--units`; `of` ends its line of help: "of the tables; --json is in SI". Wrong words are
// wrong usage.
CLI::Option* add_units(CLI::App& sub, std::string& units, const std::string& of);

// What was said about units: by the option, by SINEW_UNITS, by the run (null: none) and by the
// person's settings.
config::UnitsToShow units_asked(const std::string& option, units::UnitSet otherwise,
                                const config::Node* run = nullptr);

// The same of a run that is kept, by its resolved.toml, where there is one.
config::UnitsToShow units_asked(const std::string& option, units::UnitSet otherwise,
                                const std::filesystem::path& resolved);

// Returns the units of that, for a command which always has some.
inline units::ShownUnits units_for(const std::string& option, units::UnitSet otherwise,
                                   const config::Node* run = nullptr) {
  return units_asked(option, otherwise, run).units;
}

// A number that is told in some unit, as it is shown.
struct Retold {
  double number;
  std::string unit;  // its name; "1": none
  double scale;      // what differences of it are multiplied with
};

// Returns it in the units that were asked for; as it is told where nobody did, or where there is no
// unit for it to be shown in. Gauges count from the `room` [Pa].
Retold retold(double number, const std::string& unit, const config::UnitsToShow& asked,
              double room);

}  // namespace sinew::cli
