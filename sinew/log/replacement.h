// log/replacement.h - a file that takes the place of an older one only when it is whole.
//
//   Replacement file("table.csv");
//   file.write(text);
//   file.commit();
//
// It is written to `table.csv.part` beside, synced, and renamed: whatever happens meanwhile, under
// its name stands the old file or the new one. A symbolic link stays, what it leads to is replaced.
// What is no file - a pipe, a terminal, /dev/stdout - is written directly.
#pragma once

#include <filesystem>
#include <string_view>

#include "sinew/log/error.h"

namespace sinew::log {

class Replacement {
 public:
  // Later: whoever renames the folder syncs it.
  enum class Sync { now, later };

  // Throws Error where it cannot be written, or where another process is writing it.
  explicit Replacement(const std::filesystem::path& file, Sync sync = Sync::now);

  // Without commit() the old file stands, and nothing else; unless keep().
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  // Throws Error, for instance where the disk is full. Every call reaches the file at once.
  void write(std::string_view bytes);

  // The new file is whole. Throws Error; then the old one stands, but for a disk that fails at the
  // last moment: then it is the new one.
  void commit();

  // Leaves part() as it is where there is no commit().
  void keep() noexcept { kept_ = true; }

  // Where the bytes stand until then: `file` + ".part", or `file` where it is no file.
  const std::filesystem::path& part() const { return part_; }

 private:
  void open_part();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_;    // as it was named
  std::filesystem::path target_;  // what a link leads to; empty: written directly
  std::filesystem::path part_;
  Sync sync_;
  int fd_ = -1;
  bool kept_ = false;
};

// Is it a pipe, a device or one of this process's own descriptors, so that there is no old file?
bool is_written_directly(const std::filesystem::path& file);

// Puts on the disk what stands in a folder's list of names. Returns an errno, or 0.
int sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace sinew::log
