// analysis/figures.h - the parts of a summary, in its order. Each adds what the record allows.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/summary.h"

namespace sinew::analysis {

struct Figures {
  const Machine& machine;
  const Record& record;  // of the log and of what derive() makes of it
  Summary& summary;
  mutable std::map<std::string, double> delivered_duties = {};  // of valves, once asked for

  // Absent where the topic is: a statistic of no samples is not a number.
  template <class Statistic>
  void add(std::string key, Statistic statistic, const Column& column, const Column& seconds) {
    if (!column.empty()) summary.add(std::move(key), statistic(column, seconds));
  }
};

inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

// What is counted or used up, for rates over the sequence.
struct Extent {
  double steps = 0;             // complete ones; 0 where there is none
  double distance = no_figure;  // true, over the sequence [m]
};
Extent extent_of(const Figures&);

// An amount of the sequence, per step and per metre of the trolley's true way.
void add_rates(Figures&, double amount, const std::string& per_step, const std::string& per_metre);

// Of one muscle over the sequence: as commanded, and as its valves really stood open.
double passiveness(const Figures&, const robot::Muscle&);
double delivered_passiveness(const Figures&, const robot::Muscle&);

// That went into a cylinder between two rows  [kg]; 0 where there is none.
double cylinder_air(const Figures&, std::size_t first, std::size_t last);

// Each adds its part of the summary, as far as the log has what it takes.
void add_run(Figures&);
void add_trolley(Figures&);
void add_joints(Figures&);
void add_muscles(Figures&);
void add_passiveness(Figures&);
void add_foot(Figures&);
void add_ground_reaction(Figures&);
void add_air(Figures&);
void add_valves(Figures&);
void add_air_balance(Figures&);
void add_machine(Figures&);
void add_sole(Figures&);  // the discs of a leg's foot
// These add theirs too: of the phases, and of what stood before the controller.
void add_phases(Figures&);
void add_supervision(Figures&);

// Returns the figures of a run of a test stand, those that its log allows.
Summary summarize_stand(const signals::Table& table, const Machine& machine);

// Adds legs.<name>.* of each leg: joints, muscles, passiveness, foot, ground reaction, air and
// phases as those of a machine with one leg; and what its foot carries.
void add_legs(Figures& figures, const signals::Table& table, const signals::Table& derived);

}  // namespace sinew::analysis
