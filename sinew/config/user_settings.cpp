#include "sinew/config/user_settings.h"

#include <cstdlib>
#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/reader.h"

namespace sinew::config {

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
