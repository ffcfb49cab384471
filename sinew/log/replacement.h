// log/replacement.h - a file that takes the place of an older one only when it is whole.
//
//   Replacement file("table.csv");
//   file.write(text);
//   file.commit();
//
// It is written to `.table.csv.sinew` beside, synced, and renamed: whatever happens meanwhile,
// under its name stands the old file or the new one. A symbolic link stays, what it leads to is
// replaced. What is no file - a pipe, a terminal, /dev/stdout - is written directly.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sinew/log/error.h"

namespace sinew::log {

class Replacement {
 public:
  // Later: whoever renames the folder syncs it.
  enum class Sync { now, later };

  // hidden: `.table.csv.sinew`, a name of our own; what a killed process left there is written
  // anew. kept: `table.csv.part`, which stays without commit(); what stands there already is
  // refused.
  enum class Part { hidden, kept };

  // Throws Error where it cannot be written, or where another process is writing it.
  explicit Replacement(const std::filesystem::path& file, Sync sync = Sync::now,
                       Part part = Part::hidden);

  // Without commit() the old file stands, and nothing else; but for a part that is kept.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  // Throws Error, for instance where the disk is full. Every call reaches the file at once.
  void write(std::string_view bytes);

  // The new file is whole. Throws Error; then the old one stands, but for a disk that fails at the
  // last moment: then it is the new one.
  void commit();

  // Where the bytes stand until then; `file` where it is no file.
  const std::filesystem::path& part() const { return part_; }

 private:
  void open_part();
  void show_part(const std::filesystem::path& name);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_;    // as it was named
  std::filesystem::path target_;  // what a link leads to; empty: written directly
  std::filesystem::path part_;
  Sync sync_;
  int fd_ = -1;
  bool kept_ = false;
};

// The name under which a file of this name is written until it is whole.
std::string hidden_name(std::string_view name);

// Throws Error where `file` + ".part" stands, which Part::kept would refuse.
void require_free_part(const std::filesystem::path& file);

// Is it a pipe, a device or one of this process's own descriptors, so that there is no old file?
bool is_written_directly(const std::filesystem::path& file);

// Puts on the disk what stands in a folder's list of names. Returns an errno, or 0.
int sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace sinew::log
