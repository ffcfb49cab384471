// tune/optimizer/tuned_text.h - what a tuning found, for people and for programs.
#pragma once

#include <string>

#include "sinew/tune/optimizer/optimize.h"
#include "sinew/units/shown.h"

namespace sinew::tune {

// The units in which a table is shown, and whether they stand above those that the file names.
struct TableUnits {
  units::ShownUnits units;
  bool of_all = false;  // also of goals, limits and keys for which the file names a unit
};

// Returns the best candidate of one goal beside what the experiment has, or the front of several:
// a column for each candidate. Where nothing is feasible, the candidate that is closest to it.
// Without `shown` the units are those of the file, and SI where it names none.
std::string text_of(const Tuning& tuning, const Tuned& tuned, const TableUnits* shown = nullptr);

// Returns the same as JSON, format sinew.tuned/1, with every candidate of the front.
std::string json_of(const Tuning& tuning, const Tuned& tuned);

// Returns the headings and rows of all candidates: number, generation, feasible, violation, holds,
// then the tuned keys, goals and limits.
std::vector<std::string> candidate_headings(const Tuning& tuning);
std::vector<std::string> candidate_cells(const Candidate& candidate);

}  // namespace sinew::tune
