#include "sinew/analysis/record/legs.h"

#include "sinew/robot/legs.h"

namespace sinew::analysis {

std::vector<MachineLeg> legs_of(const Machine& machine) {
  std::vector<MachineLeg> out;
  for (std::size_t l = 0; l < machine.robot.legs.size(); ++l) {
    out.push_back({machine.robot.legs[l].name, machine});
    out.back().machine.robot = robot::only_leg(machine.robot, l);
    out.back().machine.robot.cylinder.present = false;  // the body's, whose air is no leg's
  }
  return out;
}

}  // namespace sinew::analysis
