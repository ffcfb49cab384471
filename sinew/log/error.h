// log/error.h - what a log file's reader and writer throw: which file, what happened, what to do.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace sinew::log {

class Error : public std::runtime_error {
 public:
  // what() is "file: reason; advice".
  Error(const std::filesystem::path& file, const std::string& reason, const std::string& advice)
      : std::runtime_error(file.string() + ": " + reason + "; " + advice) {}
};

}  // namespace sinew::log
