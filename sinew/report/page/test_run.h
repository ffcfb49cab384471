// report/page/test_run.h - log of a walk by formulas, with every channel that a page can show.
#pragma once

#include <cmath>

#include "sinew/analysis/record/test_log.h"
#include "sinew/report/page/page.h"

namespace sinew::report::test {

// Returns a log with all topics of a run, filled with simple curves that are no physical motion.
inline signals::Table walking(const analysis::Machine& machine, int steps = 3) {
  using analysis::test::constant;
  analysis::test::Log log = analysis::test::walk(steps, 0.5, 0.2);
  const auto swing = [](double middle, double by) {
    return [=](double t) { return middle + by * std::sin(5 * t); };
  };
  for (const std::string prefix : {"/joint/", "/true/joint/", "/desired/joint/"}) {
    log.scalar(prefix + "hip/angle", swing(5.0, 0.3));
    log.scalar(prefix + "knee/angle", swing(5.3, -0.4));
  }
  log.scalar("/true/trolley/position", [](double t) { return 0.1 * t; });
  for (const robot::Muscle& m : machine.robot.muscles) {
    log.scalar("/muscle/" + m.name + "/tension", swing(20, 10));
    log.scalar("/true/muscle/" + m.name + "/pressure", swing(2e5, 5e4));
    log.pulses("/valve/" + m.name + "/inlet/open", 0.002, steps);
  }
  log.vector("/true/foot/force", constant(3), swing(20, 20));
  log.vector("/desired/foot/position", swing(0, 0.1), constant(-0.33));
  return log.table;
}

// Returns the machine of the walk, with braids, whose diameters are drawn.
inline analysis::Machine machine() {
  analysis::Machine m = analysis::test::walking_leg();
  m.actuators.front().braid = {.thread_length = 0.107, .turns = 1.5};
  return m;
}

// Returns the content of the page of a table.
inline Content content_of(const signals::Table& table, const config::Node& resolved,
                          const std::string& name) {
  const analysis::Analysis analysis(table, analysis::read_machine(resolved));
  return content({.analysis = analysis, .resolved = resolved, .name = name});
}

}  // namespace sinew::report::test
