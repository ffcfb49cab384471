#include "sinew/run/setup/buildable.h"

#include "sinew/config/compose.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/experiment/check.h"
#include "sinew/run/setup/air_faults.h"
#include "sinew/run/setup/check_motion.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/setup/stand_setup.h"

namespace sinew::run {

using experiment::Experiment;

void refuse_unbuildable(const Experiment& e) {
  std::vector<robot::Contradiction> wrong;
  if (!e.stand) wrong = control::misfits(installation(e));
  check_air_faults(e.faults, wrong);
  if (e.stand) {
    check_stand_setup(e, wrong);
    return refuse(wrong, e);
  }
  if (wrong.empty()) check_motion(e, wrong);
  refuse(wrong, e);
}

void refuse_unbuildable(const experiment::MachineFile& file) {
  if (file.kind == "experiment") return refuse_unbuildable(file.experiment);
  if (file.kind == "robot")
    refuse(control::misfits(installation(file.experiment)), file.experiment);
}

Experiment buildable(const std::string& path, const std::vector<std::string>& sets) {
  return buildable(config::compose(path, sets), path);
}

Experiment buildable(const config::Node& root, const std::string& path) {
  Experiment e = experiment::load(root, path);
  refuse_unbuildable(e);
  return e;
}

Experiment buildable_robot(const config::Node& root, const std::string& path) {
  Experiment e = buildable(root, path);
  if (e.stand)
    config::fail({path, 0, 0}, "", "an experiment on a test stand", "one of a robot",
                 "sinew list experiments");
  return e;
}

}  // namespace sinew::run
