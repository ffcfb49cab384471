#include "cli/units.h"

#include <fmt/format.h>

namespace sinew::cli {

CLI::Option* add_units(CLI::App& sub, std::string& units, const std::string& of) {
  return sub
      .add_option("--units", units, "si, thesis, metric, or with choices, metric,length=cm: " + of)
      ->transform(passes([](const std::string& text) {
        const units::ShownUnitsReading read = units::read_shown_units(text);
        return read.ok() ? std::string()
                         : fmt::format("found {}; expected {}; try {}", read.found, read.expected,
                                       read.try_this);
      }));
}

config::UnitsToShow units_asked(const std::string& option, units::UnitSet otherwise,
                                const config::Node* run) {
  return config::units_to_show({.now = option, .now_is = "--units", .run = run}, otherwise);
}

config::UnitsToShow units_asked(const std::string& option, units::UnitSet otherwise,
                                const std::filesystem::path& resolved) {
  if (!std::filesystem::exists(resolved)) return units_asked(option, otherwise);
  const config::Node run = config::parse_file(resolved.string());
  return units_asked(option, otherwise, &run);
}

Retold retold(double number, const std::string& unit, const config::UnitsToShow& asked,
              double room) {
  const auto told = asked.asked ? units::told_unit(unit, room) : std::nullopt;
  if (!told) return {number, unit, 1};
  const units::ShownUnit to = asked.units.of(told->held, units::ShownUnits::not_known, room);
  return {to.of(told->unit.back(number)), to.name, to.scale / told->unit.scale};
}

}  // namespace sinew::cli
