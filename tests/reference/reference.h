// tests/reference/reference.h - data/reference.json, and the leg that must have its numbers.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::reference {

using nlohmann::json;
using units::inch;
using units::pound_force;

inline const json& reference() {
  static const json data =
      json::parse(std::ifstream(sinew::test::source_dir() + "/data/reference.json"));
  return data;
}

inline double printed(const std::string& name) { return reference()["constants"][name]["value"]; }
inline double si(const std::string& name) { return reference()["constants"][name]["si"]; }

inline experiment::Experiment load(const std::string& name, std::vector<std::string> sets = {}) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

inline const experiment::Experiment& leg() {
  static const experiment::Experiment e = load("walk-test-1");
  return e;
}

inline const experiment::Experiment& as_printed() {
  static const experiment::Experiment e =
      load("walk-test-1",
           {"robot=\"" + sinew::test::source_dir() + "/robots/leg-as-printed/robot.toml\""});
  return e;
}

inline const robot::Sensor& sensor(const robot::Robot& r, const std::string& name) {
  return r.sensors.at(static_cast<std::size_t>(robot::find_sensor(r, name)));
}

}  // namespace sinew::reference
