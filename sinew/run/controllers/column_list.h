// run/controllers/column_list.h - list of columns, as columns.cpp and true_columns.cpp build it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sinew/robot/legs.h"
#include "sinew/run/controllers/columns.h"

namespace sinew::run {

// A list to which columns are appended.
class Columns {
 public:
  // Adds a column of one field.
  template <class Value>
  void scalar(std::string name, std::string unit, std::string description, Value value) {
    list.push_back({{std::move(name), std::move(description), {{"value", std::move(unit)}}},
                    [value](const Snapshot& m, double* out) { *out = value(m); }});
  }

  // Adds a column of the fields x and y.
  template <class Value>
  void vector(std::string name, std::string unit, std::string description, Value value) {
    list.push_back({{std::move(name), std::move(description), {{"x", unit}, {"y", unit}}},
                    [value](const Snapshot& m, double* out) { value(m, out[0], out[1]); }});
  }

  std::vector<Column> list;
};

// A leg and its number, as needed by its columns.
struct LegAt {
  std::size_t leg = 0;
  robot::LegParts parts;

  // Returns the leg's topic of that name.
  std::string topic(const std::string& name) const { return robot::topic_of_leg(parts.name, name); }
};

// Returns the legs in the robot's order.
inline std::vector<LegAt> legs_at(const robot::Robot& robot) {
  std::vector<LegAt> out;
  for (robot::LegParts& parts : robot::legs_of(robot))
    out.push_back({out.size(), std::move(parts)});
  return out;
}

// Returns whether the cylinder moves the body up and down.
inline bool moves(const robot::Cylinder& c) {
  return c.present && c.mode != robot::Cylinder::Mode::locked;
}

// Add the columns of a simulation only: the topics under /true.
void true_columns(const experiment::Experiment& e, Columns& out);
void true_fault_columns(const experiment::Experiment& e, Columns& out);

// Adds all columns of a stand.
void stand_columns(const experiment::Experiment& e, Columns& out);

}  // namespace sinew::run
