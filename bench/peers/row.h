// bench/peers/row.h - one comparison of the table, and what it is made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/peers/measure.h"

namespace sinew::bench {

// How exact a side was: its error against its own limit, or what it came to.
struct Accuracy {
  std::string of, what;  // "sinew", "pressure against steps an eighth as long"
  double value = 0;
  std::string unit;
};

struct Row {
  enum class Better { more, less };

  std::string name;                  // "walk/mujoco"; the part before the slash is the file's
  std::string what;                  // what is compared, in a sentence
  Better better = Better::more;      // is the figure better the greater it is?
  std::optional<double> goal;        // of its median
  std::string unit = "times";        // of the figure
  std::vector<double> figures;       // by round: ratios of each pair of turns, or times [unit]
  std::string per;                   // what one unit of the work is: "walk"
  std::vector<double> ours, theirs;  // by round, for one unit [s]
  std::vector<Accuracy> accuracy;
  std::string missing;  // why there are no figures; empty: there are

  bool measured() const { return !figures.empty(); }
  Spread figure() const { return spread(figures); }  // where it is measured
  bool met() const {                                 // the goal
    if (!measured() || !goal) return false;
    return better == Better::more ? figure().median >= *goal : figure().median <= *goal;
  }
};

// How much is done.
struct Effort {
  int rounds = 7;       // of a pass
  std::string program;  // path of the program `sinew`; empty: rows that need it are missing
};

// A row of how many times as long as we the others take.
Row times_faster(Row row, const Turns& turns);
// A row of how many times as long as they we take.
Row times_slower(Row row, const Turns& turns);
// A row without numbers, because something is not there.
Row not_measured(Row row, const std::string& why);

// Adds another pass's rounds to the same rows.
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
