#include "sinew/run/folder/runnable.h"

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/stand.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/logged.h"
#include "sinew/run/stand/faulty_setup.h"
#include "sinew/run/stand/run.h"

namespace sinew::run {

experiment::Experiment runnable(const std::string& path, const std::vector<std::string>& sets,
                                bool allow_unreachable) {
  const config::Node root = config::compose(path, sets);
  experiment::Experiment e = buildable(root, path);
  if (!allow_unreachable) refuse_unreachable(e);
  (void)analysis::read_machine(root);  // what cannot be summed up is not run
  (void)logged_topics(e);
  return e;
}

rig::Experiment runnable_on_stand(const std::string& path, const std::vector<std::string>& sets) {
  const config::Node root = config::compose(path, sets);
  rig::Experiment e = rig::load(root, path);
  refuse_too_many_faults(e);
  (void)analysis::read_stand(root);
  (void)logged_topics(e);
  return e;
}

bool is_on_stand(const std::string& path) {
  return config::format_kind(config::parse_file(path)) == "rig";
}

}  // namespace sinew::run
