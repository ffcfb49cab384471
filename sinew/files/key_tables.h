// files/key_tables.h - visits the field tables of each kind of file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/shown_units.h"
#include "sinew/control/gait/plan.h"
#include "sinew/experiment/experiment.fields.h"
#include "sinew/experiment/imported.fields.h"
#include "sinew/recording/mapping.fields.h"
#include "sinew/tune/optimizer/tuning.fields.h"
#include "sinew/tune/study.fields.h"

namespace sinew::files {

// Visits the robot's own tables, without those of actuators, valves and wiring, which have files.
template <class Visitor>
void robot_tables(Visitor& v) {
  experiment::Experiment e;
  robot::fields(v, e.robot);
  experiment::air_of_machine(v, e);
  experiment::pulses_of_machine(v, e);
}

// Visits the keys of an experiment that describe its run, on a test stand or with a robot. Names of
// joints that are keys are represented by one joint, <name>.
template <class Visitor>
void experiment_tables(Visitor& v, bool on_stand) {
  experiment::Experiment e;
  if (on_stand) e.stand.emplace();
  e.plan.joints = {{.name = "<name>"}};
  experiment::run_fields(v, e);
  if (on_stand) experiment::air_of_machine(v, e);
  std::vector<experiment::ImportedFile> imported;
  experiment::fields(v, imported);
}

// Visits the tables that only this kind of file has.
template <class Visitor>
void visit_tables(Visitor& v, std::string_view kind) {
  if (kind == "robot") return robot_tables(v);
  if (kind == "experiment" || kind == "rig") return experiment_tables(v, kind == "rig");
  if (kind == "actuator") {
    std::vector<actuator::Actuator> actuators;
    return actuator::fields(v, actuators);
  }
  if (kind == "valves") {
    std::vector<gas::Valve> valves;
    return gas::fields(v, valves);
  }
  if (kind == "wiring") {
    robot::Wiring wiring;
    return robot::fields(v, wiring);
  }
  if (kind == "plan") {
    tune::Study study;
    return tune::fields(v, study);
  }
  if (kind == "tuning") {
    tune::TuningFile tuning;
    return tune::fields(v, tuning);
  }
  if (kind == "mapping") {
    recording::Mapping mapping;
    return recording::fields(v, mapping);
  }
  if (kind == "settings") {
    config::UserSettings settings;
    return config::fields(v, settings);
  }
}

}  // namespace sinew::files
