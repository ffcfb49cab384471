#include "sinew/identify/task/tables.h"

#include <algorithm>
#include <filesystem>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"

namespace sinew::identify {

std::vector<Source> sources_of(const std::vector<std::string>& files, const Source& how) {
  std::vector<Source> out;
  for (const std::string& file : files) {
    if (std::ranges::count(files, file) > 1)
      config::fail({"data", 0, 0}, "", file + " twice", "each file once");
    out.push_back(how);
    out.back().path = file;
  }
  return out;
}

const Source& only_of(const std::vector<Source>& sources) {
  if (sources.size() != 1)
    config::fail({"data", 0, 0}, "", std::to_string(sources.size()) + " files", "one");
  return sources.front();
}

void refuse_fitted(const std::vector<Source>& sources, std::string_view setting,
                   const std::string& file) {
  std::error_code none;  // files that are not there are told elsewhere
  for (const Source& source : sources)
    if (!source.text && std::filesystem::equivalent(file, source.path, none))
      config::fail({std::string(setting), 0, 0}, "", config::in_quotes(file),
                   "another file than those that are fitted");
}

Source beside(const std::vector<Source>& sources, std::string_view setting,
              const std::string& file) {
  refuse_fitted(sources, setting, file);
  Source out = sources.front();
  out.path = file;
  out.text.reset();
  return out;
}

double atmosphere_setting(const std::string& text) {
  return config::quantity_setting("atmosphere", text + " abs", "Pa abs", units::atmosphere,
                                  config::air_pressure);
}

}  // namespace sinew::identify
