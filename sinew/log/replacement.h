// log/replacement.h - file that replaces an older one only once it is complete.
//
//   Replacement file("table.csv");
//   file.write(text);
//   file.commit();
//
// It is written to `.table.csv.sinew` in the same folder, synced and renamed: at any time the path
// holds either the old or the new file. A symbolic link is kept and its target replaced. A pipe, a
// terminal or /dev/stdout is written directly.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sinew/log/file.h"

namespace sinew::log {

class Replacement {
 public:
  // later: the caller renames and syncs the folder.
  enum class Sync { now, later };

  // hidden: `.table.csv.sinew`, a private name; the remains of a killed process are overwritten.
  // kept: `table.csv.part`, which stays without commit(); an existing one is refused.
  enum class Part { hidden, kept };

  // Throws Error if the file cannot be written or is being written by another process.
  explicit Replacement(const std::filesystem::path& file, Sync sync = Sync::now,
                       Part part = Part::hidden);

  // Without commit() leaves only the old file, and a part if it is kept.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  // Writes to the file immediately. Throws Error, for instance if the disk is full.
  void write(std::string_view bytes);

  // Completes the file. Throws Error on failure; the old file then remains, unless the disk failed
  // during the last step, after the new file had replaced it.
  void commit();

  // Returns the path of the bytes until commit(); `file` if it is written directly.
  const std::filesystem::path& part() const { return part_; }

 private:
  void open_part();
  void show_part(const std::filesystem::path& name);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_;    // as given
  std::filesystem::path target_;  // final target of a link; empty: written directly
  std::filesystem::path part_;
  Sync sync_;
  int fd_ = -1;
  bool kept_ = false;
};

// Returns the path to which symbolic links lead, also if there is no file yet.
std::filesystem::path followed(std::filesystem::path file);

// Returns the name under which a file is written until it is complete.
std::string hidden_name(std::string_view name);

// Throws Error if `file` + ".part" exists, which Part::kept would refuse.
void require_free_part(const std::filesystem::path& file);

// Returns whether the file is a pipe, a device or an open descriptor of this process, and so has no
// old content.
bool is_written_directly(const std::filesystem::path& file);

// Flushes the directory entries of a folder to the disk. Returns an errno, or 0.
int sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace sinew::log
