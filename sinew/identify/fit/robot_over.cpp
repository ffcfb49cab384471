#include "sinew/identify/fit/robot_over.h"

#include <filesystem>

#include "sinew/config/diagnostics.h"
#include "sinew/config/write/writer.h"

namespace sinew::identify {

config::Node robot_over(const std::string& base, const std::string& out) {
  namespace fs = std::filesystem;
  config::Node root = config::make_table("");
  root.put(config::make_text("format", "sinew.robot/1"));
  if (base.empty()) return root;
  if (!out.empty() && fs::exists(out) && fs::equivalent(base, out))
    config::fail({"base", 0, 0}, "", "the file that is to be written", "another one",
                 "another name for the parameter file");
  const fs::path folder = fs::absolute(out).parent_path();
  root.put(config::make_text("base", fs::absolute(base).lexically_relative(folder)));
  return root;
}

}  // namespace sinew::identify
