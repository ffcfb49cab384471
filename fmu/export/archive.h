// fmu/export/archive.h - creation of a zip archive. Equal files give equal bytes, as the archive
// has no dates.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::fmu {

// File in the archive.
struct ArchiveFile {
  std::string name;  // including folders: "resources/model.txt"
  std::string bytes;
};

// Returns the archive's bytes. Throws std::runtime_error on failure.
std::string archive_of(const std::vector<ArchiveFile>& files);

}  // namespace sinew::fmu
