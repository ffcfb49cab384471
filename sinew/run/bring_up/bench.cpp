#include <fmt/format.h>

#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/bring_up/bring_up.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/output_folder.h"

namespace sinew::run {

namespace fs = std::filesystem;

namespace {

// Returns a table of the joints: their rest angles, at which the sensors' rest counts are taken, or
// a stiffness of 0 for each driven joint.
config::Node joints_of(const robot::Robot& robot, std::string_view key, bool angles) {
  config::Node out = config::make_table(key);
  for (const robot::Joint& j : robot.joints)
    if (angles)
      out.put(config::make_text(j.name, fmt::format("{} rad", j.rest_angle)));
    else if (j.kind == robot::Joint::Kind::driven)
      out.put(config::make_text(j.name, "0 N m/rad"));
  return out;
}

}  // namespace

experiment::Experiment bench_of(const std::string& robot, const fs::path& folder,
                                const std::vector<std::string>& sets) {
  config::Node root = config::parse_text(
      "format = \"sinew.experiment/2\"\n"
      "title = \"The robot hangs empty and does nothing\"\n"
      "[sequence]\nphases = [\"rest\"]\n"
      "[phase.rest]\nsource = \"sinew bring-up\"\nduration = \"1 s\"\n",
      "bench.toml");
  const robot::Robot machine = experiment::load_machine_file(robot).experiment.robot;
  config::Node start = config::make_table("start"), control = config::make_table("control");
  start.put(config::make_text("pressure", "0 psi gauge"));
  start.put(config::make_text("settle", "1 s"));
  start.put(joints_of(machine, "joint_angles", true));
  control.put(joints_of(machine, "stiffness", false));
  if (machine.ground.present) {
    config::Node ground = config::make_table("ground");
    ground.put(config::make_flag("present", false));
    root.put(std::move(ground));
  }
  root.put(std::move(start));
  root.put(std::move(control));
  const fs::path there = fs::weakly_canonical(fs::absolute(folder));
  root.put(
      config::make_text("robot", fs::weakly_canonical(robot).lexically_relative(there).string()));
  make_folders(there);
  write_file(there / "bench.toml", config::to_toml(root));
  return experiment::load((there / "bench.toml").string(), sets);
}

}  // namespace sinew::run
