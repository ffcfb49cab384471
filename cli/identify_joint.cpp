// cli/identify_joint.cpp - `sinew identify joint`: force law and moment arm without a length rig.
#include <fmt/format.h>

#include <cmath>

#include "cli/identify.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/task/joint_task.h"
#include "sinew/identify/task/tables.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using identify::JointResult;

struct IdentifyJointOptions {
  DataOptions data;
  ResultOptions result;
  identify::JointSettings settings;
  std::string actuator_out, hold_out;
};

void print_combinations(const JointResult& found) {
  report::TextTable table({"what the data tell apart, best first", "95 %"},
                          {report::TextTable::Align::left, report::TextTable::Align::right});
  for (const identify::Combination& c : found.combinations)
    table.add({c.text, std::isfinite(c.relative_error)
                           ? fmt::format("+- {:.2g} %", 100 * c.relative_error)
                           : "not at all"});
  fmt::print("\n{}", table.text());
}

ExitCode run_joint(const IdentifyJointOptions& options) {
  check_result_options(options.result);
  identify::JointSettings settings = options.settings;
  if (!settings.base.empty() && options.result.out.empty())
    config::fail({"--base", 0, 0}, "", "no --out", "a file in which to name the base");
  ResultOptions actuator_result = options.result;
  actuator_result.out = options.actuator_out;
  actuator_result.no_report = true;
  check_result_options(actuator_result);

  const std::vector<identify::Source> sources = sources_of(options.data, {options.hold_out});
  if (!options.hold_out.empty())
    settings.held_out = identify::beside(sources, "hold_out", options.hold_out);
  const auto find = [&](host::Tally& tried) {
    settings.tried = &tried;
    return identify::find_joint(sources, settings);
  };
  const identify::JointFound found =
      watched(identify::joint_models().size(), options.result.quiet, find);
  write_parameter_file(found.actuator_file, actuator_result);
  tell(found.result.report, found.file(options.result.out), options.data, options.result,
       to_json(found));
  if (!options.result.json) print_combinations(found.result);
  return ok;
}

void add_load_options(Command sub, identify::JointSettings& o) {
  sub.add_option("--load", o.load, "mass at the lever, where no column torque or load has it");
  sub.add_option("--lever", o.lever, "from the joint to the load").show_default();
  sub.add_option("--down", o.down, "angle at which the lever points straight down").show_default();
  sub.add_option("--limb", o.limb, "mass of the limb itself").show_default();
  sub.add_option("--limb-lever", o.limb_lever, "from the joint to the limb's center of mass")
      .show_default();
}

void add_known_options(Command sub, identify::JointSettings& o) {
  sub.add_option("--moment-arm", o.moment_arm, "is known, at the rest angle");
  sub.add_option("--flexor-length", o.flexor_length, "is known, at the rest angle");
  sub.add_option("--extensor-length", o.extensor_length, "is known, at the rest angle");
  sub.add_flag("--keep-force", o.keep_force, "the effectiveness of the actuator's file is right");
  sub.add_flag("--torque-bias", o.torque_bias,
               "the torque of each file has a zero of its own, which is to be found");
  sub.add_flag("--torque-gain", o.torque_gain,
               "and a gain in that of the first file; with --keep-force the first has one, too");
  sub.add_flag("--moving", o.moving,
               "the joint moves, over a column time: its dry friction and damping, and how far the "
               "torque comes behind");
}

}  // namespace

void add_identify_joint(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyJointOptions>();
  Command sub = identify.subcommand(
      "joint", "force law and moment arm from joint angle, pressures and a known load",
      "sinew identify joint knee.csv --actuator robots/leg/actuator.toml --load \"5 lb\" --lever "
      "\"6 in\" --rest-angle \"310 deg\" --joint knee --base robots/leg/robot.toml -o mine.toml");
  add_data_options(sub, options->data);
  sub.add_option("--actuator", options->settings.actuator, "file with the braid; a start")
      .required();
  sub.add_option("--name", options->settings.name, "which actuator, where the file has several");
  sub.add_option("--count", options->settings.count, "actuators in parallel in a muscle")
      .is_between(1, 100)
      .show_default();
  sub.add_option("--flexion", options->settings.names.flexion,
                 "what a shorter flexor does to the angle")
      .is_one_of({"raises angle", "lowers angle"})
      .show_default();
  sub.add_option("--rest-angle", options->settings.rest_angle,
                 "at which the muscles' lengths are told")
      .show_default();
  add_load_options(sub, options->settings);
  add_known_options(sub, options->settings);
  sub.add_option("--hold-out", options->hold_out,
                 "a file that scores the models and is not fitted; absent: every third row");
  sub.add_option("--model", options->settings.model, "only this one")
      .is_one_of(identify::joint_models());
  sub.add_option("--joint", options->settings.names.joint, "its name in the robot's file")
      .show_default();
  sub.add_option("--flexor", options->settings.names.flexor,
                 "the muscle's name; absent: <joint>_flexor");
  sub.add_option("--extensor", options->settings.names.extensor,
                 "the muscle's name; absent: <joint>_extensor");
  sub.add_option("--base", options->settings.base,
                 "robot whose joint it is, named in the file of --out");
  sub.add_option("--actuator-out", options->actuator_out, "the actuator's file to write");
  add_wish_options(sub, options->settings.wishes);
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    if (options->settings.keep_force && options->settings.model.ends_with("pressure"))
      refuse("--model", options->settings.model + " with --keep-force", "round or hinge beside it");
    action = [options] { return run_joint(*options); };
  });
}

}  // namespace sinew::cli
