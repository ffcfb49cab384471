// run/folder/output_folder.h - a folder whose files are replaced together: an older result stands
// until the new one is whole, and only one process writes there at a time.
//
// The new files are written into a folder within, the stage. When they are whole, the stage is
// renamed to `.finished`, and its files take their places one by one. A process that is killed in
// between leaves `.finished`; whoever comes next to the folder, to read or to write, does the rest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::run {

// Makes a folder with those above it; one that is there already is fine. Throws config::Error where
// it cannot be made.
void make_folders(const std::filesystem::path& folder);

class OutputFolder {
 public:
  // Makes it where it is missing, and locks it as long as this lives. Throws config::Error where it
  // cannot be made, or where another process holds it, with the process's number.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;

  // Return the folder itself, and where to write: the stage where there is one, else the folder.
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& work() const { return stage_.empty() ? path_ : stage_; }
  bool staged() const { return !stage_.empty(); }

  // Makes a folder within, which must not be there or be empty, the place where to write. Throws
  // config::Error.
  void stage(const std::string& name);

  // Syncs what was written. From a stage it takes the place of what has its names and of
  // `replaced`, files within the folder; then the stage is gone. Throws config::Error; then either
  // the old files stand, or the next process that comes to the folder does the rest.
  void commit(const std::vector<std::string>& replaced);

 private:
  std::filesystem::path path_, stage_;
  int fd_ = -1;
};

// Does the rest where a process was killed while its files took their places. For those who read
// from a folder; nothing else is touched. Throws config::Error.
void finish_replacing(const std::filesystem::path& folder);

}  // namespace sinew::run
