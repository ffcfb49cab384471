#include "sinew/run/stand/faulty_setup.h"

#include "sinew/experiment/rig/fault_parts.h"
#include "sinew/run/setup/air_faults.h"
#include "sinew/world/stand.h"

namespace sinew::rig {
namespace {

double length_at_start(const plant::StandSetup& s) {
  if (s.load.mode == plant::Load::Mode::driven) return s.load.length.at(0);
  return s.start.length > 0 ? s.start.length : plant::hanging_length(s);
}

}  // namespace

plant::StandSetup faulty_setup_of(const Experiment& e) {
  plant::StandSetup s = setup_of(e);
  const auto tear = [&](int) { return run::tear_of(s.muscle.actuator, length_at_start(s)); };
  s.faults = run::air_faults(
      e.faults, {.parts = fault_parts(e), .atmosphere = e.air.atmosphere, .tear = tear});
  return s;
}

void refuse_too_many_faults(const Experiment& e) {
  std::vector<robot::Contradiction> found;
  run::check_air_faults(e.faults, found);
  for (const robot::Contradiction& c : found)
    config::fail({e.path, 0, 0}, c.key, c.found, c.expected, c.try_this);
}

}  // namespace sinew::rig
