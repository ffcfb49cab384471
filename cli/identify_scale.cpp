// cli/identify_scale.cpp - `sinew identify scale`: the actuator of a muscle that nobody measured.
#include <fmt/format.h>

#include "cli/identify.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "sinew/actuator/prediction.h"
#include "sinew/identify/task/scale_task.h"

namespace sinew::cli {

namespace {

struct IdentifyScaleOptions {
  identify::ScaleSettings settings;
  ResultOptions result;
};

void print_scaled(const identify::ScaleFound& found) {
  const actuator::Prediction& p = found.actuator.prediction;
  fmt::print("a muscle of {:.4g} mm, like that of {:.4g} mm\n", 1e3 * p.rest_length,
             1e3 * found.from);
  fmt::print("largest force  {:.4g} N at {:.4g} mm and {:.4g} kPa gauge\n", found.largest,
             1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (found.corrected_by != 1)
    fmt::print("its reading    the law times {:.4f}\n", found.corrected_by);
  if (p.inside_95 > 0)
    fmt::print("68 % within    {:.3g} N\n95 % within    {:.3g} N of the law\n",
               actuator::widest_inside_68(p), actuator::widest_inside_95(p));
}

ExitCode run_scale(const IdentifyScaleOptions& options) {
  check_result_options(options.result);
  const identify::ScaleFound found = identify::find_scaled(options.settings);
  write_parameter_file(found.file, options.result);
  if (options.result.json)
    fmt::print("{}\n", (identify::to_json(found)).text(2));
  else
    print_scaled(found);
  if (!(found.actuator.prediction.inside_95 > 0))
    Messages(options.result.quiet)
        .warning(
            "how far off it is is unknown: no muscle was left out when the file was made; fit "
            "muscles of two rest lengths at least");
  return ok;
}

}  // namespace

void add_identify_scale(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyScaleOptions>();
  Command sub = identify.subcommand(
      "scale", "a muscle of another rest length than those that were measured",
      "sinew identify scale my-actuator.toml --rest-length \"120 mm\" -o short.toml");
  identify::ScaleSettings& s = options->settings;
  sub.add_option("FILE", s.file, "an actuator that `identify static` wrote").required();
  sub.add_option("--rest-length", s.rest_length, "of the new muscle, without pressure and load")
      .required();
  sub.add_option("--actuator", s.actuator, "which one, where the file has several");
  sub.add_option("--reading", s.reading,
                 "one of the new muscle at rest, to correct the law: \"LENGTH, PRESSURE, FORCE\"");
  sub.add_option("--name", s.name, "of the new actuator; as in the file");
  sub.add_option("--atmosphere", s.atmosphere, "the pressure of the room").show_default();
  sub.add_option("-o,--out", options->result.out, "the new actuator's file");
  sub.add_flag("--force", options->result.force, "replace an old file");
  sub.add_flag("--json", options->result.json, "print it as JSON, in SI");
  sub.add_flag("--quiet", options->result.quiet, "only the result and errors");
  options->result.no_report = true;
  sub.callback([options, &action] { action = [options] { return run_scale(*options); }; });
}

}  // namespace sinew::cli
