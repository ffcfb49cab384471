// cli/identify_static.cpp - `sinew identify static`: the static law of an actuator.
#include <fmt/format.h>

#include <filesystem>

#include "cli/identify.h"
#include "cli/terminal.h"
#include "sinew/identify/task/static_task.h"

namespace sinew::cli {

namespace {

struct IdentifyStaticOptions {
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

// Writes the file of a muscle beside that of the first one.
void write_muscle(const identify::StaticMuscle& muscle, const std::string& text,
                  const ResultOptions& result) {
  if (result.out.empty()) return;
  ResultOptions other = result;
  other.no_report = true;
  other.out = file_of_muscle(result.out, muscle);
  check_result_options(other);
  write_parameter_file(text, other);
}

ExitCode run_static(const IdentifyStaticOptions& options) {
  const auto find = [&](host::Tally& tried) {
    identify::StaticSettings settings = options.settings;
    settings.tried = &tried;
    return identify::find_static(sources_of(options.data, {settings.hold_out}), settings);
  };
  const identify::StaticFound found =
      watched(identify::static_models().size(), options.result.quiet, find);

  // Others of its make, each in a file of its own, before what is printed: a reader that ends early
  // ends the program.
  for (std::size_t i = 1; i < found.files.size(); ++i)
    write_muscle(found.result.muscles[i], found.files[i], options.result);
  for (std::size_t i = 0; i < found.predicted.size(); ++i)
    write_muscle(found.predicted[i], found.predicted_files[i], options.result);
  tell(found.result.report, found.files[0], options.data, options.result);
  return ok;
}

}  // namespace

void add_rest_length(Command sub, std::string& rest_length) {
  sub.add_option("--rest-length", rest_length,
                 "of the muscle without pressure and load; without it the longest length");
}

void add_static_data_options(Command sub, identify::StaticSettings& settings) {
  add_rest_length(sub, settings.rest_length);
  sub.add_option("--actuator", settings.actuator, "a file whose braid is taken as known");
  sub.add_option("--branch", settings.branch,
                 "the points that are fitted: of filling, of venting, or both")
      .is_one_of({"fill", "vent", "both"})
      .show_default();
  sub.add_option("--fit-where", settings.fit_where,
                 "NAME=VALUE,...: only such rows are fitted, the others held out; may be repeated")
      .takes_one();
  sub.add_option("--hold-out", settings.hold_out,
                 "pressure (every second), length or muscle (each once) or another FILE, to score "
                 "what was not seen");
  sub.add_option("--diameter", settings.diameter,
                 "of the muscle without pressure and load, to compare its force with");
}

void add_identify_static(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyStaticOptions>();
  Command sub = identify.subcommand(
      "static", "the static law of an actuator from force, length and pressure",
      "sinew identify static map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
      "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\" -o my-actuator.toml");
  add_data_options(sub, options->data);
  add_static_data_options(sub, options->settings);
  sub.add_flag("--anyway", options->settings.anyway,
               "fit where a check is red, too; see `sinew identify check`");
  sub.add_option(
         "--predict", options->settings.predict,
         "rest_length=LENGTH: also a muscle that nobody measured, in a file of its own; may "
         "be repeated")
      .takes_one();
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
