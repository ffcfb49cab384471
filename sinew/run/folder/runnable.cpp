#include "sinew/run/folder/runnable.h"

#include "sinew/analysis/record/machine.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/logged.h"

namespace sinew::run {

experiment::Experiment runnable(const std::string& path, const std::vector<std::string>& sets,
                                bool allow_unreachable) {
  const config::Node root = config::compose(path, sets);
  experiment::Experiment e = buildable(root, path);
  if (!allow_unreachable) refuse_unreachable(e);
  (void)analysis::read_machine(root);  // an experiment that cannot be summarised is not run
  (void)logged_topics(e);
  return e;
}

}  // namespace sinew::run
