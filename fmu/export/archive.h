// fmu/export/archive.h - files as the bytes of a zip archive: the same files give the same bytes,
// since no dates are in it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::fmu {

// Holds a file of the archive.
struct ArchiveFile {
  std::string name;  // with folders: "resources/model.txt"
  std::string bytes;
};

// Throws std::runtime_error where the archive cannot be made.
std::string archive_of(const std::vector<ArchiveFile>& files);

}  // namespace sinew::fmu
