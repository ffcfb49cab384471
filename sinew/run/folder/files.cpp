#include "sinew/run/folder/files.h"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "sinew/log/file.h"
#include "sinew/units/shell.h"

namespace sinew::run {

namespace fs = std::filesystem;

namespace {

// Returns whether the text begins with the mark. Blanks are skipped where the mark has none.
bool begins_with(std::string_view text, std::string_view mark) {
  std::size_t found = 0;
  for (const char c : text) {
    if (found == mark.size()) break;
    const bool is_blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (is_blank && mark[found] != c) continue;
    if (c != mark[found]) return false;
    ++found;
  }
  return found == mark.size();
}

bool has_mark(std::string_view text, const FileKind& kind) {
  using At = FileKind::At;
  if (kind.mark.empty()) return true;
  if (kind.at == At::start) return begins_with(text, kind.mark);
  if (kind.at != At::anywhere) text = text.substr(0, text.find_first_of("\r\n"));
  if (kind.at == At::end_of_first_line) return text.ends_with(kind.mark);
  for (std::size_t at = text.find(kind.mark[0]); at != text.npos;
       at = text.find(kind.mark[0], at + 1))
    if (begins_with(text.substr(at), kind.mark)) return true;
  return false;
}

}  // namespace

bool is_of_kind(const fs::path& file, const FileKind& kind) {
  return fs::file_size(file) == 0 || has_mark(log::Mapping(file).bytes(), kind);
}

void refuse_to_overwrite(const fs::path& file, bool force, const FileKind& kind,
                         const std::vector<fs::path>& inputs) {
  if (fs::is_directory(file))
    refuse(file, "a folder", "the name of a file", "a name inside that folder");
  if (log::is_written_directly(file) || !fs::exists(file)) return;
  std::error_code none;
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, none))
      refuse(file, "what this command reads", "a name for what it writes", "another name");
  if (!is_of_kind(file, kind))
    refuse(file, fmt::format("something that is no {}", kind.what),
           fmt::format("an unused name, or that of {}", kind.name), std::string(kind.otherwise));
  if (!force) refuse(file, "a file", "an unused name", "another one, or force=true to replace it");
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return fs::equivalent(a, b, none) ||
         fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

void refuse_same_files(const std::vector<std::pair<std::string_view, fs::path>>& files) {
  for (auto a = files.begin(); a != files.end(); ++a)
    for (auto b = files.begin(); b != a; ++b)
      if (!a->second.empty() && !b->second.empty() && !log::is_written_directly(a->second) &&
          is_same_file(a->second, b->second))
        config::fail(
            {std::string(a->first), 0, 0}, "",
            fmt::format("{}, the file of {} too", config::in_quotes(a->second.string()), b->first),
            "a file of its own", "another name");
}

void require_folder_of(const fs::path& file) {
  const fs::path folder = log::followed(file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder))
    refuse(file, "no folder " + folder.string(), "one that exists",
           "mkdir -p " + units::shell_word(folder.string()));
  const bool direct = log::is_written_directly(file);
  if (!direct && ::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    throw log::Error(file, "cannot be written: " + log::system_error_text(errno),
                     "choose a folder that exists and that you may write to");
}

void write_file(const fs::path& file, std::string_view text, log::Replacement::Sync sync) {
  require_folder_of(file);
  std::fflush(stdout);  // it may be /dev/stdout
  log::Replacement out(file, sync);
  out.write(text);
  out.commit();
}

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
