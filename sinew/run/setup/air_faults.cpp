#include "sinew/run/setup/air_faults.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "sinew/actuator/braid.h"
#include "sinew/experiment/fault_parts.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::run {

using experiment::Experiment;

namespace {

using What = experiment::Fault::What;

// Returns a tenth of the cross-section of one actuator at its mount length: a tear that the braid
// holds together, a guess  [m^2].
double tear_of(const Experiment& e, const robot::Muscle& m) {
  const actuator::Actuator a = robot::actuator_of(m, e.actuators);
  const double d = actuator::diameter(a.braid, m.mount_length - a.caps.length);
  return 0.1 * (0.25 * std::numbers::pi * d * d);
}

double or_none(double x) { return std::isfinite(x) ? x : 0.0; }

air::AirFault air_fault(const Experiment& e, const experiment::Fault& f,
                        const experiment::FaultPart& part) {
  using To = air::AirFault::What;
  air::AirFault out{.of = part.index,
                    .begin = f.at,
                    .end = end_of(f),
                    .share = f.share,
                    .leak = {.area = or_none(f.area), .conductance = f.conductance}};
  if (f.what == What::stuck_shut) out.what = To::stuck_shut;
  if (f.what == What::leaking)
    out.what = part.kind == experiment::FaultPart::Kind::valve ? To::seat_leak : To::hole;
  if (f.what == What::blocked) out.what = To::blocked;
  if (f.what == What::failed) {
    out.what = To::supply;
    out.pressure = std::isfinite(f.pressure) ? f.pressure : e.air.atmosphere;
  }
  if (f.what == What::ruptured) {
    out.what = To::hole;
    if (!(f.area > 0))
      out.leak.area = tear_of(e, e.robot.muscles[static_cast<std::size_t>(part.index)]);
  }
  return out;
}

}  // namespace

void check_air_faults(const Experiment& e, std::vector<robot::Contradiction>& out) {
  constexpr std::size_t most = air::FaultSchedule::capacity;
  const auto of_air = static_cast<std::size_t>(std::ranges::count_if(
      e.faults, [](const experiment::Fault& f) { return !is_of_sensor(f.what); }));
  if (of_air > most)
    out.push_back({"fault", std::to_string(of_air) + " faults of the air",
                   "at most " + std::to_string(most), "fewer"});
}

std::vector<air::AirFault> air_faults(const Experiment& e) {
  const std::vector<experiment::FaultPart> parts = fault_parts(e);
  std::vector<air::AirFault> out;
  for (const experiment::Fault& f : e.faults)
    if (const auto part = part_of(f, parts); part && !is_of_sensor(f.what))
      out.push_back(air_fault(e, f, *part));
  return out;
}

}  // namespace sinew::run
