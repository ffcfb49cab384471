// cli/migrate.cpp - `sinew migrate`: files of older formats become files of today's.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/files/migrate.h"
#include "sinew/json/json.h"

namespace sinew::cli {

namespace {

struct MigrateCommandOptions {
  std::vector<std::string> files;
  files::MigrateOptions how;
  bool dry_run = false, json = false;
};

Json json_of(const files::Migration& m) {
  Json out{{"file", m.file}, {"was", m.was}, {"is", m.is}, {"changes", m.changes}};
  if (!m.written.empty()) out["written"] = m.written;
  if (!m.kept.empty()) out["kept"] = m.kept;
  if (!m.reason.empty()) out["reason"] = m.reason;
  return out;
}

// One file's failure does not keep the others from being migrated.
ExitCode migrate_all(const MigrateCommandOptions& options) {
  bool good = true;
  Json report = Json::array();
  for (const std::string& file : options.files) {
    try {
      const files::Migration done = files::migrate(file, options.how);
      report.push_back(json_of(done));
      if (!options.json) fmt::print("{}", files::text_of(done));
    } catch (const std::exception& e) {
      good = false;
      report.push_back({{"file", file}, {"problem", e.what()}});
      error(e.what());
    }
  }
  if (options.json) fmt::print("{}\n", report.text(2));
  if (options.dry_run) Messages(false).note("nothing was written");
  return good ? ok : failed;
}

}  // namespace

void add_migrate(CLI::App& app, Action& action) {
  auto options = std::make_shared<MigrateCommandOptions>();
  CLI::App& sub = subcommand(app, "migrate", "files of older formats in today's, comments kept",
                             "sinew migrate my-leg/*.toml --dry-run");
  sub.add_option("FILE", options->files,
                 "experiment, rig, plan, tuning, robot, actuator, valves or wiring file")
      ->required();
  sub.add_option("-o,--output", options->how.folder,
                 "folder of the new files; without it each takes the place of the old one, which "
                 "is kept as FILE.bak");
  sub.add_flag("--dry-run", options->dry_run, "says what would be changed and writes nothing");
  sub.add_flag("--json", options->json, "as JSON");
  sub.callback([=, &action] {
    options->how.write = !options->dry_run;
    action = [=] { return migrate_all(*options); };
  });
}

}  // namespace sinew::cli
