// cli/files.cpp - commands about files and their keys: new, list, keys, show, check and migrate.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/files/check.h"
#include "sinew/files/key_text.h"
#include "sinew/files/keys.h"
#include "sinew/files/list.h"
#include "sinew/files/migrate.h"
#include "sinew/files/new_file.h"
#include "sinew/files/values.h"
#include "sinew/json/json.h"
#include "sinew/units/shell.h"

namespace sinew::cli {

namespace {

// --- new ---

struct NewCommandOptions {
  std::string kind, name;
  files::NewOptions how;
};

// Commands that use a new file of this kind; an empty one: of any kind.
struct NextCommand {
  std::string_view kind, command;
};
constexpr NextCommand next_commands[] = {
    {"", "sinew check {file}"},
    {"robot", "sinew new experiment {name}-moves --of {file}"},
    {"actuator", "sinew identify static FORCES.csv --actuator {file}"},
    {"experiment", "sinew run {file}"},
    {"rig", "sinew run {file}"},
    {"experiment", "sinew new plan {name}-gains --of {file}"},
    {"plan", "sinew sweep {file} -o {name}.csv"},
    {"tuning", "sinew tune {file} -o {name}.csv"},
    {"mapping", "sinew import RECORDING.csv --mapping {file} --experiment EXPERIMENT.toml"},
};

ExitCode write(const NewCommandOptions& options) {
  const files::NewFiles made = files::write_new(options.kind, options.name, options.how);
  for (const std::string& file : made.files) fmt::print("{}\n", file);
  for (const std::string& problem : made.problems) error(problem);
  const Messages messages(false);
  if (!made.problems.empty()) {
    messages.note("written, but it needs these changes");
    return failed;
  }
  messages.note("valid as written; its comments describe each table. Next:");
  const std::string file = units::shell_word(made.files[0]);
  for (const auto& [kind, command] : next_commands)
    if (kind.empty() || kind == options.kind)
      messages.note("  " + fmt::format(fmt::runtime(command), fmt::arg("file", file),
                                       fmt::arg("name", units::shell_word(options.name))));
  return ok;
}

// --- list ---

struct ListOptions {
  std::string kind;
  bool json = false;
};

ExitCode list(const ListOptions& options) {
  const files::Listing listing = files::list(options.kind);
  fmt::print("{}", options.json ? files::json_of(listing) : files::text_of(listing, options.kind));
  const Messages messages(false);
  if (listing.shipped_from.empty())
    messages.warning(
        "found none of the files that come with Sinew; set SINEW_SHARE=FOLDER in the environment "
        "to "
        "their folder");
  if (listing.cut) messages.warning("this folder has too much below it; not all was read");
  return ok;
}

// --- keys ---

struct KeysOptions {
  std::vector<std::string> words;
  std::string kind, schema;
  bool json = false, page = false;
};

ExitCode keys(const KeysOptions& options) {
  if (options.page) {
    fmt::print("{}", files::page_of_keys());
  } else if (!options.schema.empty()) {
    fmt::print("{}", files::schema_of(options.schema));
  } else if (options.words.empty() && options.kind.empty() && !options.json) {
    fmt::print("{}", files::overview_of_keys(width_of_output()));
  } else {
    const std::vector<files::Key> found = files::find_keys(options.words, options.kind);
    if (options.json)
      fmt::print("{}\n", Json::parse(files::json_of(found)).text(2));
    else
      fmt::print("{}", files::text_of(found, width_of_output()));
  }
  return ok;
}

// --- show ---

struct ShowOptions {
  std::string file;
  std::vector<std::string> keys;
  std::vector<std::string> sets;
  std::string units;
  bool json = false;
};

ExitCode show(const ShowOptions& options) {
  const files::Values values = files::values(options.file, options.sets, options.keys);
  const config::UnitsToShow chosen = chosen_units(options.units, units::UnitSet::si, &values.in_si);
  if (options.json)
    fmt::print("{}\n", Json::parse(files::json_of(values)).text(2));
  else
    fmt::print("{}", files::text_of(values, chosen.requested()));
  return ok;
}

// --- check ---

struct CheckOptions {
  std::vector<std::string> files;
  bool json = false;
};

ExitCode check_all(const CheckOptions& options) {
  std::vector<files::Finding> findings;
  for (const std::string& file : options.files) {
    findings.push_back(files::check(file));
    if (!options.json) fmt::print("{}", files::text_of(findings.back()));
  }
  if (options.json) fmt::print("{}", files::json_of(findings));
  const auto is_good = [](const files::Finding& finding) { return finding.problems.empty(); };
  return std::ranges::all_of(findings, is_good) ? ok : failed;
}

// --- migrate ---

struct MigrateCommandOptions {
  std::vector<std::string> files;
  files::MigrateOptions how;
  bool json = false;
};

// One file's failure does not keep the others from being migrated.
ExitCode migrate_all(const MigrateCommandOptions& options) {
  bool good = true;
  Json report = Json::array();
  for (const std::string& file : options.files) {
    try {
      const files::Migration done = files::migrate(file, options.how);
      report.push_back(files::json_of(done));
      if (!options.json) fmt::print("{}", files::text_of(done));
    } catch (const std::exception& e) {
      good = false;
      report.push_back({{"file", file}, {"problem", e.what()}});
      error(e.what());
    }
  }
  if (options.json) fmt::print("{}\n", report.text(2));
  if (!options.how.write) Messages(false).note("nothing was written");
  return good ? ok : failed;
}

}  // namespace

void add_new(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "new", "Create a commented file to begin with, valid as written",
                             "sinew new robot my-arm --metric");
  NewCommandOptions& options = runs(sub, action, write);
  const std::vector<std::string> kinds(files::new_kinds().begin(), files::new_kinds().end());
  sub.add_option("KIND", options.kind, "kind of file")->required()->check(one_of(kinds));
  sub.add_option("NAME", options.name,
                 "name; a robot and a rig become a folder NAME, any other a file NAME.toml")
      ->required();
  sub.add_option("-o,--output", options.how.folder, "DIR: folder to write to; default: this one");
  sub.add_option("--of", options.how.of,
                 "FILE: robot of an experiment, experiment of a plan or tuning; default: Sinew's");
  sub.add_option("--actuator", options.how.actuator,
                 "FILE: actuator file of a robot's muscles, as sinew identify static writes it");
  sub.add_flag("--metric", options.how.metric, "write mm, N and bar; default: in, lbf and psi");
}

void add_list(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "list", "List robots, experiments and more, of Sinew and of this folder",
                 "sinew list experiments");
  ListOptions& options = runs(sub, action, list);
  const std::vector<std::string> kinds(files::listed_kinds().begin(), files::listed_kinds().end());
  sub.add_option("KIND", options.kind, "kind to list; default: all of them")->check(one_of(kinds));
  sub.add_flag("--json", options.json, "print the result as JSON");
}

void add_keys(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "keys", "Search keys of all files: unit, range, default, meaning",
                             "sinew keys damping\n  sinew keys joint.hip.damping");
  KeysOptions& options = runs(sub, action, keys);
  sub.add_option("WORD", options.words,
                 "key, beginning of a key, or words of its description; default: an overview");
  CLI::Option* kind = sub.add_option("--kind", options.kind, "search only this kind of file")
                          ->check(one_of(files::key_kinds()));
  CLI::Option* json = sub.add_flag("--json", options.json, "print the result as JSON");
  std::vector<std::string> with_schema = files::key_kinds();
  std::erase(with_schema, "any");  // the schema of each kind has what all kinds have
  CLI::Option* schema = sub.add_option("--schema", options.schema,
                                       "print a JSON schema of this kind of file, for an editor")
                            ->check(one_of(with_schema));
  CLI::Option* page = sub.add_flag("--page", options.page,
                                   "print all keys as Markdown, as in docs/reference/keys.md");
  CLI::Option* words = sub.get_option("WORD");
  for (CLI::Option* other : {kind, json, words}) {
    schema->excludes(other);
    page->excludes(other);
  }
  page->excludes(schema);
}

void add_show(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "show", "Show the values of a file and where each one comes from",
                             "sinew show robots/leg/robot.toml joint.knee muscle.hip");
  ShowOptions& options = runs(sub, action, show);
  sub.add_option("FILE", options.file, "experiment, rig, robot, actuator, valves or wiring file")
      ->required();
  sub.add_option("KEY", options.keys, "keys to show, or their beginnings; default: all");
  add_sets(sub, options.sets);
  add_units(sub, options.units, "the column of converted values (default: si)");
  sub.add_flag("--json", options.json, "print the result as JSON");
}

void add_check(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "check", "Report all errors of files at once",
                             "sinew check robots/leg/*.toml robots/leg/predict.dat");
  CheckOptions& options = runs(sub, action, check_all);
  sub.add_option(
         "FILE", options.files,
         "experiment, rig, plan, tuning, robot, actuator, valves, wiring file, predict.dat, "
         "gain*.dat, or a run's folder or log")
      ->required();
  sub.add_flag("--json", options.json, "print the result as JSON");
}

void add_migrate(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "migrate", "Convert files of older formats; comments are kept",
                             "sinew migrate my-leg/*.toml --dry-run");
  MigrateCommandOptions& options = runs(sub, action, migrate_all);
  sub.add_option("FILE", options.files,
                 "experiment, rig, plan, tuning, robot, actuator, valves or wiring file")
      ->required();
  sub.add_option("-o,--output", options.how.folder,
                 "DIR: folder of the new files; default: in place of the old, kept as FILE.bak");
  sub.add_flag("!--dry-run", options.how.write, "print what would be changed and write nothing");
  sub.add_flag("--json", options.json, "print the result as JSON");
}

}  // namespace sinew::cli
