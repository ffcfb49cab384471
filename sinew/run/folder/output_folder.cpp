#include "sinew/run/folder/output_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "sinew/log/file.h"
#include "sinew/log/replacement.h"
#include "sinew/run/folder/files.h"

namespace sinew::run {

namespace fs = std::filesystem;

namespace {

constexpr const char* finished_name = ".finished";
constexpr const char* replaced_name = ".replaced";  // a file that lists names to be removed

void require(const fs::path& where, const std::error_code& problem) {
  if (problem) refuse(where, problem.message(), "a file that can be replaced", "another folder");
}

int open_folder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

// Removes a file within the folder, and its subfolder if it becomes empty.
void remove_within(const fs::path& folder, const fs::path& name) {
  for (const fs::path& part : name)
    if (part == ".." || part.has_root_path()) return;
  std::error_code problem, ignored;
  const fs::path file = folder / name;
  if (fs::is_directory(fs::symlink_status(file, ignored))) return;
  fs::remove(file, problem);
  require(file, problem);
  if (name.has_parent_path()) fs::remove(folder / name.parent_path(), ignored);  // if it is empty
}

// Moves the finished files to their places. A repeated call continues an interrupted one.
void move_into_place(const fs::path& folder) {
  const fs::path finished = folder / finished_name;
  std::error_code problem;
  std::ifstream replaced(finished / replaced_name);
  for (std::string name; std::getline(replaced, name);) remove_within(folder, name);
  for (const std::string& name : names_in(finished)) {
    if (name == replaced_name) continue;
    fs::rename(finished / name, folder / name, problem);
    require(folder / name, problem);
  }
  fs::remove(finished / replaced_name, problem);
  require(finished, problem);
  fs::remove(finished, problem);
  require(finished, problem);
  if (const int error = log::sync_folder(folder)) require(folder, {error, std::generic_category()});
}

void sync(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = fd >= 0 && ::fsync(fd) == 0 ? 0 : errno;
  if (fd >= 0) ::close(fd);
  require(file, {error, std::generic_category()});
}

bool has_line_end(const std::string& name) { return name.find('\n') != name.npos; }

}  // namespace

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem))
    names.push_back(entry.path().filename().string());
  require(folder, problem);
  std::ranges::sort(names);
  return names;
}

void make_folders(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) refuse(folder, problem.message(), "a folder that can be made", "another folder");
}

OutputFolder::OutputFolder(fs::path folder) : path_(std::move(folder)) {
  make_folders(path_);
  fd_ = open_folder(path_);
  if (fd_ < 0) refuse(path_, log::system_error_text(errno), "a folder that can be opened");
  const std::string holder = log::lock(fd_);
  if (holder.empty()) {
    try {
      if (fs::exists(path_ / finished_name)) move_into_place(path_);
    } catch (...) {
      ::close(fd_);
      throw;
    }
    return;
  }
  ::close(fd_);
  refuse(path_, holder + ", which is writing there", "a folder that no other program writes to",
         "another one, or to wait for it");
}

// An empty stage is removed.
OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (staged()) fs::remove(stage_, ignored);
  if (fd_ >= 0) ::close(fd_);
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)),
      stage_(std::move(other.stage_)),
      fd_(std::exchange(other.fd_, -1)) {}

void OutputFolder::stage(const std::string& name) {
  stage_ = path_ / name;
  make_folders(stage_);
}

void OutputFolder::commit(const std::vector<std::string>& replaced) {
  const std::vector<std::string> names = names_in(work());
  for (const std::string& name : names) sync(work() / name);
  if (!staged()) {
    const int error = log::sync_folder(path_);
    return require(path_, {error, std::generic_category()});
  }

  std::string gone;
  for (const std::string& name : replaced)
    if (!fs::exists(stage_ / name) && !has_line_end(name)) gone += name + "\n";
  for (const std::string& name : names)
    if (fs::is_directory(path_ / name))
      refuse(path_ / name, "a folder", "a file, or nothing", "another name for it");
  log::Replacement list(stage_ / replaced_name);
  list.write(gone);
  list.commit();

  // After this rename, the new files are the contents of the folder.
  std::error_code problem;
  fs::rename(stage_, path_ / finished_name, problem);
  require(stage_, problem);
  stage_.clear();
  const int error = log::sync_folder(path_);
  require(path_, {error, std::generic_category()});
  move_into_place(path_);
}

void finish_replacing(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder / finished_name, none)) return;
  const int fd = open_folder(folder);
  if (fd < 0) refuse(folder, log::system_error_text(errno), "a folder that can be opened");
  log::wait_for_lock(fd);
  try {
    if (fs::exists(folder / finished_name)) move_into_place(folder);
  } catch (...) {
    ::close(fd);
    throw;
  }
  ::close(fd);
}

}  // namespace sinew::run
