// live/text.h - the text that replies are made of.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
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

// Returns JSON in one line. Bytes that are no UTF-8 become the replacement character.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace sinew::live
