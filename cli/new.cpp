// cli/new.cpp - `sinew new`: a commented file to begin with.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/files/new_file.h"

namespace sinew::cli {

namespace {

struct NewCommandOptions {
  std::string kind, name;
  files::NewOptions how;
};

// What is done with the new file, as a shell takes it.
std::vector<std::string> next_commands(const NewCommandOptions& options,
                                       const std::string& written) {
  const std::string file = written.find(' ') == written.npos ? written : "\"" + written + "\"";
  const std::string &kind = options.kind, &name = options.name;
  std::vector<std::string> out{"sinew check " + file};
  if (kind == "robot")
    out.push_back(fmt::format("sinew new experiment {}-moves --of {}", name, file));
  if (kind == "actuator")
    out.push_back(fmt::format("sinew identify static FORCES.csv --actuator {}", file));
  if (kind == "experiment" || kind == "rig") out.push_back("sinew run " + file);
  if (kind == "experiment")
    out.push_back(fmt::format("sinew new plan {}-gains --of {}", name, file));
  if (kind == "plan") out.push_back(fmt::format("sinew sweep {} -o {}.csv", file, name));
  if (kind == "tuning") out.push_back(fmt::format("sinew tune {} -o {}.csv", file, name));
  if (kind == "mapping")
    out.push_back(
        fmt::format("sinew import RECORDING.csv --mapping {} --experiment EXPERIMENT.toml", file));
  return out;
}

ExitCode write(const NewCommandOptions& options) {
  const files::NewFiles made = files::write_new(options.kind, options.name, options.how);
  for (const std::string& file : made.files) fmt::print("{}\n", file);
  for (const std::string& problem : made.problems) error(problem);
  const Messages messages(false);
  if (!made.problems.empty()) {
    messages.note("written, but it needs these changes");
    return failed;
  }
  messages.note("valid as written; its comments say what each table is for. Next:");
  for (const std::string& command : next_commands(options, made.files[0]))
    messages.note("  " + command);
  return ok;
}

}  // namespace

void add_new(CLI::App& app, Action& action) {
  auto options = std::make_shared<NewCommandOptions>();
  CLI::App& sub = subcommand(app, "new", "a commented file to begin with, valid as written",
                             "sinew new robot my-arm --metric");
  std::vector<std::string> kinds;
  for (const std::string_view kind : files::new_kinds()) kinds.emplace_back(kind);
  sub.add_option("KIND", options->kind, "what it describes")->required()->check(one_of(kinds));
  sub.add_option("NAME", options->name,
                 "its name; a robot and a rig become a folder NAME, any other a file NAME.toml")
      ->required();
  sub.add_option("-o,--output", options->how.folder,
                 "folder in which it is written; else this one");
  sub.add_option(
      "--of", options->how.of,
      "experiment: the robot's file; plan and tuning: the experiment's; else one that comes with "
      "Sinew");
  sub.add_option("--actuator", options->how.actuator,
                 "robot: the file of its muscles, as sinew identify static writes it");
  sub.add_flag("--metric", options->how.metric,
               "mm, N and bar; else in, lbf and psi, as in the thesis");
  sub.callback([=, &action] { action = [=] { return write(*options); }; });
}

}  // namespace sinew::cli
