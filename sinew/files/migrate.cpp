#include "sinew/files/migrate.h"

#include <fmt/format.h>

#include <filesystem>

#include "sinew/config/gains.h"
#include "sinew/config/migrate.h"
#include "sinew/config/text_file.h"
#include "sinew/config/valve_timing.h"
#include "sinew/run/folder/files.h"

namespace sinew::files {

namespace {

namespace fs = std::filesystem;

std::string format_text(const std::string& kind, int number) {
  return number == 0 ? "" : fmt::format("sinew.{}/{}", kind, number);
}

std::string describe_edit(const config::Migrated::Edit& edit) {
  if (edit.was.empty()) return fmt::format("line {}: {} is added", edit.line, edit.is);
  return fmt::format("line {}: {} becomes {}", edit.line, edit.was, edit.is);
}

// Reports that a table of the thesis is not migrated. Throws config::Error if it cannot be read.
void keep_table(const fs::path& file, Migration& out) {
  if (file.filename().string().starts_with("gain")) {
    config::read_gains(file.string());
    out.reason = "gains in the format of the thesis, which files.gains reads";
  } else {
    config::read_valve_timing(file.string());
    out.reason = "table duty,close,open, which files.valve_timing reads";
  }
}

[[noreturn]] void refuse(const fs::path& taken, const std::string& try_this) {
  config::fail({taken.string(), 0, 0}, "", "an existing file", "an unused name", try_this);
}

// Chooses an unused path for the new file, and for the old one if it stays in its folder.
void choose_places(const fs::path& file, const MigrateOptions& options, Migration& out) {
  if (!options.folder.empty()) {
    if (fs::exists(options.folder) && !fs::is_directory(options.folder))
      config::fail({options.folder, 0, 0}, "", "a file", "a folder, or an unused name");
    const fs::path to = fs::path(options.folder) / file.filename();
    if (fs::exists(fs::symlink_status(to))) refuse(to, "an empty folder");
    out.written = to.string();
    return;
  }
  const fs::path kept = file.string() + ".bak";
  if (fs::exists(fs::symlink_status(kept)))
    refuse(kept, "to remove it, or another folder for the new file");
  out.written = file.string();
  out.kept = kept.string();
}

// Saves the old file before the new one replaces it.
void write(const std::string& old_text, const std::string& text, const Migration& m) {
  if (m.kept.empty()) {
    fs::create_directories(fs::path(m.written).parent_path());
  } else {
    run::write_file(m.kept, old_text);
    fs::permissions(m.kept, fs::status(m.file).permissions());
  }
  run::write_file(m.written, text);
}

}  // namespace

Migration migrate(const std::string& path, const MigrateOptions& options) {
  Migration out{.file = path, .is_dry = !options.write};
  const fs::path file(path);
  if (file.extension() == ".dat") {
    keep_table(file, out);
    return out;
  }
  const std::string old_text = config::read_text_file(path, "a TOML file");
  const config::Migrated migrated = config::migrated(old_text, path);
  out.was = format_text(migrated.was_kind, migrated.from);
  out.is = format_text(migrated.kind, migrated.to);
  if (migrated.edits.empty()) return out;
  for (const auto& edit : migrated.edits) out.changes.push_back(describe_edit(edit));
  choose_places(file, options, out);
  if (options.write) write(old_text, migrated.text, out);
  return out;
}

std::string text_of(const Migration& m) {
  std::string out;
  if (!m.reason.empty()) return fmt::format("{}: {}; unchanged\n", m.file, m.reason);
  if (m.changes.empty())
    return fmt::format("{}: {} has the newest format; unchanged\n", m.file, m.is);
  for (const std::string& change : m.changes) out += fmt::format("{}: {}\n", m.file, change);
  const std::string to = m.written == m.file ? "" : " in " + m.written;
  const std::string old =
      m.kept.empty() ? ""
                     : fmt::format("; the old one {} {}", m.is_dry ? "would be" : "is", m.kept);
  return out + fmt::format("{}: {}{}{}{}\n", m.file, m.is_dry ? "would be " : "is ", m.is,
                           m.is_dry ? to : " now" + to, old);
}

Json json_of(const Migration& m) {
  Json out{{"file", m.file}, {"was", m.was}, {"is", m.is}, {"changes", m.changes}};
  if (!m.written.empty() && !m.is_dry) out["written"] = m.written;
  if (!m.kept.empty() && !m.is_dry) out["kept"] = m.kept;
  if (!m.reason.empty()) out["reason"] = m.reason;
  return out;
}

}  // namespace sinew::files
