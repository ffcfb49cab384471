#include "sinew/config/shown_units.h"

#include <cstdlib>
#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/reader.h"
#include "sinew/units/letters.h"

namespace sinew::config {

units::ShownUnits parse_shown_units(std::string_view text, const Location& where,
                                    const std::string& key, const units::ShownUnits& below) {
  units::ShownUnitsReading read = units::read_shown_units(text, below);
  if (read.mistake) fail(where, key, *read.mistake);
  return std::move(read.units);
}

UnitsToShow units_to_show(const UnitsRequest& request, const units::ShownUnits& otherwise) {
  UnitsToShow out{otherwise, false};
  const auto say = [&](std::string_view text, const Location& where, const std::string& key) {
    if (units::trimmed(text).empty()) return;
    out = {parse_shown_units(text, where, key, out.units), true};
  };
  const UserSettings own = user_settings();
  say(own.units, own.units_at, "units");
  if (request.run)
    if (const Node* node = value_at(*request.run, "page.units")) {
      const Node* value = node->is_value_table() ? node->find("value") : node;
      say(value->text, value->where, "page.units");
    }
  if (const char* variable = std::getenv(units_variable)) say(variable, {units_variable, 0, 0}, "");
  say(request.now, {request.now_is, 0, 0}, "");
  return out;
}

TextOptions::Shown TextOptions::shown(double number, const std::string& unit) const {
  const auto held = units.is_requested ? units::read_quantity_unit(unit, atmosphere) : std::nullopt;
  if (!held) return {number, unit, 1};
  const units::ShownUnit to =
      units.units.of(held->stored, units::ShownUnits::unknown_size, atmosphere);
  return {to.of(held->unit.back(number)), to.name, to.scale / held->unit.scale};
}

namespace fs = std::filesystem;

std::string user_settings_path() {
  // The XDG base directory specification ignores an empty or relative folder.
  fs::path folder;
  if (const char* named = std::getenv("XDG_CONFIG_HOME"); named && fs::path(named).is_absolute())
    folder = named;
  else if (const char* home = std::getenv("HOME"); home && *home)
    folder = fs::path(home) / ".config";
  return folder.empty() ? "" : (folder / "sinew" / "settings.toml").string();
}

UserSettings read_user_settings(const std::string& path) {
  const Node root = compose(path);
  if (format_kind(root) != "settings")
    fail({path, 0, 0}, "format", in_quotes(format_kind(root)), "\"sinew.settings/1\"");
  UserSettings out;
  Reader reader(root);
  std::string format;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  fields(reader, out);
  reader.finish();
  if (const Origin* origin = find_origin(reader.origins(), "units")) out.units_at = origin->where;
  return out;
}

UserSettings user_settings() {
  const std::string path = user_settings_path();
  std::error_code ignored;
  return path.empty() || !fs::exists(path, ignored) ? UserSettings{} : read_user_settings(path);
}

}  // namespace sinew::config
