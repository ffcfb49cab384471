// live/text.h - the text that replies are made of.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace sinew::live {

// The type of a reply that is told in words.
inline constexpr const char* plain = "text/plain; charset=utf-8";

// Returns a file's text as it is, nothing where it cannot be read.
inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace sinew::live
