// bench/peers/row.h - one comparison of the table, and its measurements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/peers/measure.h"

namespace sinew::bench {

// Accuracy of a side: its error relative to its own limit, or its result.
struct Accuracy {
  std::string of, what;  // "sinew", "pressure against steps an eighth as long"
  double value = 0;
  std::string unit;
};

struct Row {
  enum class Better { more, less };

  std::string name;                  // "walk/mujoco"; the part before the slash is the file's
  std::string what;                  // what is compared, in a sentence
  Better better = Better::more;      // whether a larger or a smaller figure is better
  std::optional<double> goal;        // of its median
  std::string unit = "times";        // of the figure
  std::vector<double> figures;       // by round: ratios of each pair of turns, or times [unit]
  std::string per;                   // unit of the work: "walk"
  std::vector<double> ours, theirs;  // by round, for one unit [s]
  std::vector<Accuracy> accuracy;
  std::string missing;  // reason why figures are missing; empty if they exist

  bool measured() const { return !figures.empty(); }
  Spread figure() const { return spread(figures); }  // requires figures
  bool met() const {                                 // the goal
    if (!measured() || !goal) return false;
    return better == Better::more ? figure().median >= *goal : figure().median <= *goal;
  }
};

// Extent of the measurements.
struct Effort {
  int rounds = 7;       // of a pass
  std::string program;  // path of the program `sinew`; if empty, rows that need it are missing
};

// Returns a row with the ratio of their time to ours.
Row times_faster(Row row, const Turns& turns);
// Returns a row with the ratio of our time to theirs.
Row times_slower(Row row, const Turns& turns);
// Returns a row without figures, with the reason.
Row not_measured(Row row, const std::string& why);

// Appends the rounds of another pass to the same rows.
void add(std::vector<Row>& rows, const std::vector<Row>& pass);

// Returns the rows of one part of the table.
using Part = std::vector<Row> (*)(const Effort& effort);
std::vector<Row> actuator_rows(const Effort& effort);
std::vector<Row> body_rows(const Effort& effort);
std::vector<Row> walk_rows(const Effort& effort);
std::vector<Row> stand_rows(const Effort& effort);
std::vector<Row> thread_rows(const Effort& effort);
std::vector<Row> cost_rows(const Effort& effort);
std::vector<Row> program_rows(const Effort& effort);

}  // namespace sinew::bench
