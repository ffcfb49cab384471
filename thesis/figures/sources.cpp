#include <filesystem>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {

std::string Sources::path(const std::string& file) const {
  return (std::filesystem::path(root) / file).string();
}

Sources sources(const std::string& root) {
  Sources out{.root = root};
  const std::string valves = out.path("robots/leg/valves.toml");
  if (!std::filesystem::exists(valves))
    config::fail({valves, 0, 0}, "", "no such file",
                 "the project's folder, with robots/ and experiments/", "root=DIR");
  out.actuator = experiment::load_machine_file(out.path("robots/leg-as-printed/actuator.toml"))
                     .experiment.actuators.at(0);
  out.actuator.effectiveness.argument = actuator::Effectiveness::Argument::gauge;
  out.actuator.effectiveness.scale = 1;
  const auto valve = [&](const std::string& file, const std::string& name) {
    return config::named(experiment::load_machine_file(file).experiment.valves, name, file,
                         "valve");
  };
  out.chapter3 = valve(valves, "758");
  out.inlet = valve(out.path("robots/leg/valves-at-the-bench.toml"), "inlet");
  out.exhaust = valve(out.path("robots/leg/valves-at-the-bench.toml"), "exhaust");
  return out;
}

}  // namespace sinew::thesis
