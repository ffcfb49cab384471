#include "sinew/config/text_file.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

std::string read_text_file(const std::string& path, const std::string& expected) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    fail({path, 0, 0}, "", "a folder", expected, "one of the files in it");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (file) content << file.rdbuf();
  if (!file) fail({path, 0, 0}, "", "no readable file", expected);
  return content.str();
}

}  // namespace sinew::config
