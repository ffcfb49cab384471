#include "sinew/run/setup/air_faults.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "sinew/actuator/braid.h"
#include "sinew/experiment/faults.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::run {

using experiment::Experiment;

namespace {

using What = experiment::Fault::What;

double or_none(double x) { return std::isfinite(x) ? x : 0.0; }

air::AirFault air_fault(const experiment::Fault& f, const experiment::FaultPart& part,
                        const FaultyAir& air) {
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
    out.pressure = std::isfinite(f.pressure) ? f.pressure : air.atmosphere;
  }
  if (f.what == What::ruptured) {
    out.what = To::hole;
    if (!(f.area > 0)) out.leak.area = air.tear(part.index);
  }
  return out;
}

}  // namespace

double tear_area(const actuator::Actuator& a, double length) {
  const double d = actuator::diameter(a.braid, length - a.caps.length);
  return 0.1 * (0.25 * std::numbers::pi * d * d);
}

void check_air_faults(std::span<const experiment::Fault> faults,
                      std::vector<robot::Contradiction>& out) {
  constexpr std::size_t most = air::FaultSchedule::capacity;
  const auto of_air = static_cast<std::size_t>(std::ranges::count_if(
      faults, [](const experiment::Fault& f) { return !is_of_sensor(f.what); }));
  if (of_air > most)
    out.push_back({"fault", std::to_string(of_air) + " faults of the air",
                   "at most " + std::to_string(most), "fewer"});
}

std::vector<air::AirFault> air_faults(std::span<const experiment::Fault> faults,
                                      const FaultyAir& air) {
  std::vector<air::AirFault> out;
  for (const experiment::Fault& f : faults)
    if (const auto part = part_of(f, air.parts); part && !is_of_sensor(f.what))
      out.push_back(air_fault(f, *part, air));
  return out;
}

std::vector<air::AirFault> air_faults(const Experiment& e) {
  const auto tear = [&](int muscle) {
    const robot::Muscle& m = e.robot.muscles[static_cast<std::size_t>(muscle)];
    return tear_area(robot::actuator_of(m, e.actuators), m.mount_length);
  };
  return air_faults(e.faults,
                    {.parts = fault_parts(e), .atmosphere = e.air.atmosphere, .tear = tear});
}

}  // namespace sinew::run
