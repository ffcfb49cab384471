// cli/identify_joint.cpp - `sinew identify joint`: force law and moment arm without a length rig.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/robot_over.h"
#include "sinew/identify/joint/joint_file.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using identify::JointResult;

struct Options {
  DataOptions data;
  ResultOptions result;
  std::string actuator, actuator_name, actuator_out, base, model, hold_out;
  std::string rest = "0 rad";
  identify::JointNames names{.flexor = "", .extensor = ""};
  std::string load, lever = "0 m", down = "270 deg", limb = "0 kg", limb_lever = "0 m";
  std::string moment_arm, flexor_length, extensor_length;
  bool keep_force = false;
  int count = 1;
};

identify::JointSetup setup_of(const Options& options, const actuator::Actuator& a,
                              double atmosphere) {
  const auto value = [&](std::string_view option, const std::string& text, std::string_view unit,
                         const Range& range) {
    return text.empty() ? identify::to_be_found : argument(option, text, unit, atmosphere, range);
  };
  constexpr double turns = 4 * std::numbers::pi;
  constexpr Range angle{-turns, turns, "two turns; a joint makes less than one"};
  constexpr Range mass = from_zero(1e6, "of what hangs on a joint");
  constexpr Range lever = from_zero(1000, "from the joint's axis");
  constexpr Range size = above_zero(1000, "of a robot");
  identify::JointSetup s{.actuator = a, .count = options.count, .atmosphere = atmosphere};
  s.gravity = units::standard_gravity;
  s.flexion_raises = options.names.flexion == "raises angle";
  s.rest_angle = value("--rest-angle", options.rest, "rad", angle);
  s.load = value("--load", options.load, "kg", mass);
  s.lever = value("--lever", options.lever, "m", lever);
  s.down = value("--down", options.down, "rad", angle);
  s.limb = value("--limb", options.limb, "kg", mass);
  s.limb_lever = value("--limb-lever", options.limb_lever, "m", lever);
  s.moment_arm = value("--moment-arm", options.moment_arm, "m", size);
  s.flexor_length = value("--flexor-length", options.flexor_length, "m", size);
  s.extensor_length = value("--extensor-length", options.extensor_length, "m", size);
  s.keep_force = options.keep_force;
  return s;
}

void print_combinations(const JointResult& found) {
  report::TextTable table({"what the data tell apart, best first", "95 %"},
                          {report::TextTable::Align::left, report::TextTable::Align::right});
  for (const identify::Combination& c : found.combinations)
    table.add({c.text, std::isfinite(c.relative_error)
                           ? fmt::format("+- {:.2g} %", 100 * c.relative_error)
                           : "not at all"});
  fmt::print("\n{}", table.text());
}

ExitCode run_joint(const Options& options) {
  check_result_options(options.result);
  if (!options.base.empty() && options.result.out.empty())
    config::fail({"--base", 0, 0}, "", "no --out", "a file in which to name the base");
  ResultOptions actuator_result = options.result;
  actuator_result.out = options.actuator_out;
  actuator_result.no_report = true;
  check_result_options(actuator_result);

  const std::vector<identify::Source> sources = sources_of(options.data);
  if (sources.size() != 1)
    config::fail({"data", 0, 0}, "", fmt::format("{} files", sources.size()), "one");
  const experiment::MachineFile start = experiment::load_machine_file(options.actuator);
  const actuator::Actuator& a =
      config::named(start.experiment.actuators, options.actuator_name, "--name", "actuator");
  const identify::JointSetup setup = setup_of(options, a, sources[0].atmosphere);

  std::optional<identify::Measured> held_out;
  if (!options.hold_out.empty()) {
    refuse_data_file("--hold-out", options.hold_out, options.data);
    identify::Source other = sources[0];
    other.path = options.hold_out;
    held_out = identify::read_measured(other, identify::joint_columns());
  }
  const JointResult found =
      identify::identify_joint(identify::read_measured(sources[0], identify::joint_columns()),
                               held_out, setup, options.model);
  const std::string source =
      fmt::format("sinew identify joint {}: {}", sources[0].path, found.report.best().model);
  const config::Node robot = identify::robot_over(options.base, options.result.out);
  tell(found.report, identify::joint_file(found, setup, options.names, source, robot), options.data,
       options.result, identify::describe(found));
  if (!options.result.json) print_combinations(found);
  write_parameter_file(identify::effectiveness_file(start.experiment.origins, options.actuator, a,
                                                    found, options.keep_force, source),
                       actuator_result);
  return ok;
}

void add_load_options(Command sub, Options& o) {
  sub.add_option("--load", o.load, "mass at the lever, where no column torque or load has it");
  sub.add_option("--lever", o.lever, "from the joint to the load").show_default();
  sub.add_option("--down", o.down, "angle at which the lever points straight down").show_default();
  sub.add_option("--limb", o.limb, "mass of the limb itself").show_default();
  sub.add_option("--limb-lever", o.limb_lever, "from the joint to the limb's center of mass")
      .show_default();
}

void add_known_options(Command sub, Options& o) {
  sub.add_option("--moment-arm", o.moment_arm, "is known, at the rest angle");
  sub.add_option("--flexor-length", o.flexor_length, "is known, at the rest angle");
  sub.add_option("--extensor-length", o.extensor_length, "is known, at the rest angle");
  sub.add_flag("--keep-force", o.keep_force, "the effectiveness of the actuator's file is right");
}

}  // namespace

void add_identify_joint(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "joint", "force law and moment arm from joint angle, pressures and a known load",
      "sinew identify joint knee.csv --actuator robots/leg/actuator.toml --load \"5 lb\" --lever "
      "\"6 in\" --rest-angle \"310 deg\" --joint knee --base robots/leg/robot.toml -o mine.toml");
  add_data_options(sub, options->data);
  sub.add_option("--actuator", options->actuator, "file with the braid; a start").required();
  sub.add_option("--name", options->actuator_name, "which actuator, where the file has several");
  sub.add_option("--count", options->count, "actuators in parallel in a muscle")
      .is_between(1, 100)
      .show_default();
  sub.add_option("--flexion", options->names.flexion, "what a shorter flexor does to the angle")
      .is_one_of({"raises angle", "lowers angle"})
      .show_default();
  sub.add_option("--rest-angle", options->rest, "at which the muscles' lengths are told")
      .show_default();
  add_load_options(sub, *options);
  add_known_options(sub, *options);
  sub.add_option("--hold-out", options->hold_out,
                 "a file that scores the models and is not fitted; absent: every third row");
  sub.add_option("--model", options->model, "only this one").is_one_of(identify::joint_models());
  sub.add_option("--joint", options->names.joint, "its name in the robot's file").show_default();
  sub.add_option("--flexor", options->names.flexor, "the muscle's name; absent: <joint>_flexor");
  sub.add_option("--extensor", options->names.extensor,
                 "the muscle's name; absent: <joint>_extensor");
  sub.add_option("--base", options->base, "robot whose joint it is, named in the file of --out");
  sub.add_option("--actuator-out", options->actuator_out, "the actuator's file to write");
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    if (options->names.flexor.empty()) options->names.flexor = options->names.joint + "_flexor";
    if (options->names.extensor.empty())
      options->names.extensor = options->names.joint + "_extensor";
    if (options->keep_force && options->model.ends_with("pressure"))
      refuse("--model", "with --keep-force round or hinge");
    action = [options] { return run_joint(*options); };
  });
}

}  // namespace sinew::cli
