// cli/identify_static.cpp - `sinew identify static`: the static law of an actuator.
#include <fmt/format.h>

#include <filesystem>

#include "cli/identify.h"
#include "sinew/identify/task/static_task.h"

namespace sinew::cli {

namespace {

struct Options {
  DataOptions data;
  ResultOptions result;
  identify::StaticSettings settings;
};

std::string file_of_muscle(const std::string& out, const identify::StaticMuscle& muscle) {
  const std::filesystem::path path(out);
  return (path.parent_path() / fmt::format("{}-{:.0f}mm{}", path.stem().string(),
                                           1e3 * muscle.rest_length, path.extension().string()))
      .string();
}

ExitCode run_static(const Options& options) {
  const identify::StaticFound found =
      identify::find_static(sources_of(options.data), options.settings);
  tell(found.result.report, found.files[0], options.data, options.result);

  // Others of its make, each in a file of its own.
  for (std::size_t i = 1; i < found.files.size() && !options.result.out.empty(); ++i) {
    ResultOptions other = options.result;
    other.no_report = true;
    other.out = file_of_muscle(options.result.out, found.result.muscles[i]);
    check_result_options(other);
    write_parameter_file(found.files[i], other);
  }
  return ok;
}

}  // namespace

void add_identify_static(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "static", "the static law of an actuator from force, length and pressure",
      "sinew identify static map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
      "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\" -o my-actuator.toml");
  add_data_options(sub, options->data);
  add_length_options(sub, options->settings.rest_length, options->settings.lengths);
  sub.add_option("--actuator", options->settings.actuator, "a file whose braid is taken as known");
  sub.add_option("--branch", options->settings.branch, "fill, vent or both")
      .is_one_of({"fill", "vent", "both"})
      .show_default();
  sub.add_option("--fit-where", options->settings.fit_where,
                 "NAME=VALUE,...: only such rows are fitted, the others held out; may be repeated")
      .takes_one();
  sub.add_option("--hold-out", options->settings.hold_out,
                 "pressure (every second), length (each once) or another FILE, to score what was "
                 "not seen");
  sub.add_option("--model", options->settings.model, "this one alone");
  sub.add_option("--name", options->settings.name, "of the actuator").show_default();
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    action = [options] {
      check_result_options(options->result);
      return run_static(*options);
    };
  });
}

}  // namespace sinew::cli
