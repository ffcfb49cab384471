// run/folder/files.h - atomic writing of files and of the files of a folder, protection of other
// programs' files, and refusal of paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/log/replacement.h"

namespace sinew::run {

// Kind of file that a command writes. `force` replaces files of this kind only: files of another
// kind were made by the user or by another program.
struct FileKind {
  // Place of the mark in the file.
  enum class At { anywhere, start, first_line, end_of_first_line };

  std::string_view what, name;  // "page of `sinew identify`", "such a page"
  std::string_view mark;        // text that each such file has; empty: any text. Blanks of the
                                // file are skipped where the mark has none
  At at = At::anywhere;
  std::string_view otherwise = "another one";  // advice if the file is of another kind
};

// Kind of an FMU, which the program and the Python package write.
inline constexpr FileKind fmu_kind{"FMU", "an FMU", "modelDescription.xml"};

// Returns whether the file has the mark, or is empty.
bool is_of_kind(const std::filesystem::path& file, const FileKind& kind);

// Throws config::Error if the file exists and is not of this kind, if it is one of `inputs`, or if
// it exists and `force` is false. Pipes and devices are always accepted.
void refuse_to_overwrite(const std::filesystem::path& file, bool force, const FileKind& kind,
                         const std::vector<std::filesystem::path>& inputs = {});

// Returns whether both paths are those of one file, which need not exist.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// Throws config::Error if two of the files that a command writes are the same. `files` are options
// with their files, of which empty ones are left out.
void refuse_same_files(
    const std::vector<std::pair<std::string_view, std::filesystem::path>>& files);

// Throws config::Error if the folder that is to contain the file is missing, and log::Error if it
// may not be written to.
void require_folder_of(const std::filesystem::path& file);

// Writes the file completely and then replaces an older one. Throws config::Error or log::Error;
// the older file is then unchanged.
void write_file(const std::filesystem::path& file, std::string_view text,
                log::Replacement::Sync sync = log::Replacement::Sync::now);

// Refusal of a path by the sources of this folder. A setting of the caller is named as a key with
// its value: force=true.

// Throws a config::Error that begins with the path.
[[noreturn]] inline void refuse(const std::filesystem::path& where, std::string found,
                                std::string expected, std::string try_this = "") {
  config::fail({where.string(), 0, 0}, "", std::move(found), std::move(expected),
               std::move(try_this));
}

// A folder whose files are replaced together: an older result remains until the new one is
// complete, and only one process writes at a time.
//
// The new files are written into a folder within it, the stage. When they are complete, the stage
// is renamed to `.finished`, and its files are moved to their places one by one. A process that is
// killed meanwhile leaves `.finished`; the next process that opens the folder, to read or to write,
// completes the move.

// Creates a folder with its parents, if it does not exist. Throws config::Error if it cannot be
// created.
void make_folders(const std::filesystem::path& folder);

// Returns the names of the files and folders in a folder, sorted. Throws config::Error.
std::vector<std::string> names_in(const std::filesystem::path& folder);

// A folder for results, locked while this object exists.
class OutputFolder {
 public:
  // Creates the folder if it is missing, and locks it for the lifetime of this object. Throws
  // config::Error if it cannot be created, or if another process has locked it, with the process's
  // number.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;

  // Return the folder itself, and the folder to write to: the stage if there is one.
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& work() const { return stage_.empty() ? path_ : stage_; }
  bool staged() const { return !stage_.empty(); }

  // Creates a folder within it, which must be missing or empty, as the stage. Throws config::Error.
  void stage(const std::string& name);

  // Syncs the written files. Moves those of a stage into the folder, where they replace
  // files of the same names, removes `replaced`, names within the folder, and removes the stage. If
  // it throws config::Error, either the old files are unchanged or the next process that opens the
  // folder completes the move.
  void commit(const std::vector<std::string>& replaced);

 private:
  std::filesystem::path path_, stage_;
  int fd_ = -1;
};

// Completes a move of files that was interrupted by the end of its process; changes nothing else.
// To be called before reading from a folder. Throws config::Error.
void finish_replacing(const std::filesystem::path& folder);

}  // namespace sinew::run
