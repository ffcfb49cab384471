// log/error.h - exception of a log file's reader and writer: file, reason and advice.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace sinew::log {

class Error : public std::runtime_error {
 public:
  // Sets what() to "file: reason; advice".
  Error(const std::filesystem::path& file, const std::string& reason, const std::string& advice)
      : std::runtime_error(file.string() + ": " + reason + "; " + advice) {}
};

}  // namespace sinew::log
