#include "sinew/experiment/rig/fault_parts.h"

namespace sinew::rig {

std::vector<experiment::FaultPart> fault_parts(const Experiment& e) {
  using Kind = experiment::FaultPart::Kind;
  std::vector<experiment::FaultPart> out;
  if (e.charge.mode == plant::Charge::Mode::regulated) return out;
  if (!(e.element.cylinder.bore > 0)) out.push_back({e.element.name, Kind::muscle, 0});
  if (e.charge.mode == plant::Charge::Mode::valves) {
    const auto add = [&](const char* which, const std::string& valve, int index) {
      if (!valve.empty())
        out.push_back({e.element.name + which, experiment::kind_of_valve(e.valves, valve), index});
    };
    add(".inlet", e.element.inlet, 0);
    add(".exhaust", e.element.exhaust, 1);
    out.push_back({"supply", Kind::supply, 0});
  }
  for (const plant::Transducer& t : e.sensors) out.push_back({t.name, Kind::transducer, 0});
  return out;
}

}  // namespace sinew::rig
