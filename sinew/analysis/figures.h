// analysis/figures.h - the parts of a summary, in its order. Each adds the figures that the record
// has the channels for.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/summary.h"

namespace sinew::analysis {

// Value of a figure that exists but does not apply to the run.
inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

struct Figures {
  const Machine& machine;
  const Record& record;  // the log and the series that derive() computes from it
  Summary& summary;
  const std::vector<std::string>* keys = nullptr;  // those that are wanted; nullptr: all
  std::string prefix = "";                         // start of the leg's keys, "legs.left."
  mutable std::map<std::string, double> delivered_duties = {};  // cache, by muscle and valve [-]

  // Returns whether any key that begins so is wanted.
  bool wants(std::string_view part) const {
    return !keys || std::ranges::any_of(*keys, [&](std::string_view key) {
      return key.starts_with(prefix) && key.substr(prefix.size()).starts_with(part);
    });
  }
  // Adds a figure if it is wanted; value() computes it.
  template <std::invocable Value>
  void add(const std::string& key, const Value& value) {
    if (wants(key)) summary.add(key, value());
  }
  // Adds a statistic of a topic, or of a computed column, unless the topic is missing.
  template <class Statistic>
  void add(const std::string& key, Statistic statistic, const std::string& topic,
           const Column& seconds, std::string_view field = "value") {
    if (wants(key)) add(key, statistic, record.column(topic, field), seconds);
  }
  template <class Statistic>
  void add(const std::string& key, Statistic statistic, const Column& column,
           const Column& seconds) {
    if (wants(key)) summary.add(key, column.empty() ? no_figure : statistic(column, seconds));
  }
};

// Steps and distance of the sequence, by which amounts are divided to give rates.
struct Extent {
  double steps = 0;             // complete steps
  double distance = no_figure;  // true distance of the trolley over the sequence [m]
};
Extent extent_of(const Figures&);

// Adds an amount of the sequence per step and per metre of the trolley's true distance.
void add_rates(Figures&, double amount, const std::string& per_step, const std::string& per_metre);

// Return the share of the sequence in which a muscle is passive [-], 6.3: by the commanded duties,
// and by the times that its valves were really open.
double passiveness(const Figures&, const robot::Muscle&);
double delivered_passiveness(const Figures&, const robot::Muscle&);

// Adds the smallest passiveness of a joint's muscles, or of all muscles, in both ways.
void add_smallest_passiveness(Figures&, const std::string& key, const std::string& joint = "");

// Adds a muscle's cycles of contraction and pressure, and the share of its life that they used.
void add_wear(Figures&, std::size_t muscle);

// Returns the air that entered the cylinder between two rows  [kg]; 0 without a cylinder.
double cylinder_air(const Figures&, std::size_t first, std::size_t last);

// Each adds its part of the summary, as far as the log has the channels for it.
void add_run(Figures&);
void add_trolley(Figures&);
void add_joints(Figures&);
void add_muscles(Figures&);
void add_foot(Figures&);
void add_ground_reaction(Figures&);
void add_air(Figures&);
void add_valves(Figures&);
void add_air_balance(Figures&);
void add_machine(Figures&);
void add_sole(Figures&);  // the discs of a leg's foot
// Add the figures of the phases, and the counts of the supervisor that guards the controller.
void add_phases(Figures&);
void add_supervision(Figures&);

// Adds all figures of a run of a test stand.
void add_stand(Figures&);

// Adds all of these for a whole run, those of a robot's legs from the log and the derived series.
// The topics that the legs' figures read are added to `read`.
void add_figures(Figures&, const signals::Table& table, const signals::Table& derived,
                 TopicNames* read = nullptr);

// Adds legs.<name>.* of each leg: joints, muscles, passiveness, foot, ground reaction, air and
// phases as those of a machine with one leg, and the load of its foot. The topics that are read are
// added to `read`.
void add_legs(Figures& figures, const signals::Table& table, const signals::Table& derived,
              TopicNames* read = nullptr);

}  // namespace sinew::analysis
