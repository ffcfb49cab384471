#include "sinew/run/folder/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "sinew/run/folder/run_folder.h"
#include "sinew/units/shell.h"

namespace sinew::run {

namespace fs = std::filesystem;

namespace {

// Returns whether the file is a log, a parameter file or a file of a run, which no page, table or
// summary may replace.
bool is_of_another_kind(const fs::path& file, std::string_view own) {
  if (file.filename() == own || file.extension() == own) return false;
  return file.extension() == ".toml" || file.extension() == ".mcap" ||
         (file.filename() == summary_name && fs::exists(file.parent_path() / log_name));
}

}  // namespace

void refuse_to_overwrite(const fs::path& file, bool force, const std::vector<fs::path>& inputs,
                         std::string_view own) {
  if (fs::is_directory(file))
    refuse(file, "a folder", "the name of a file", "a name inside that folder");
  std::error_code none;
  const bool direct = log::is_written_directly(file);
  for (const fs::path& input : inputs)
    if (!direct && fs::equivalent(file, input, none))
      refuse(file, "what this command reads", "a name for what it writes", "another name");
  if (!direct && fs::exists(file) && is_of_another_kind(fs::weakly_canonical(file), own))
    refuse(file, "a file of another kind, which not even force=true replaces",
           "a name for what this command writes", "another name, or to remove it first");
  if (force || !fs::exists(file) || log::is_written_directly(file)) return;
  refuse(file, "a file", "an unused name", "another one, or force=true to replace it");
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

}  // namespace sinew::run
