// tune/optimizer/tuned_text.h - results of a tuning, as text and as JSON.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/tune/optimizer/optimize.h"
#include "sinew/units/shown.h"

namespace sinew::tune {

// The units of a table, and whether they override those in the file.
struct TableUnits {
  units::ShownUnits units;
  bool of_all = false;  // also for goals, limits and keys whose unit is in the file
};

// Returns a table with a column for each candidate: the best one for a single goal, next to the
// experiment as it is, or the front for several. If none is feasible, it shows the candidate with
// the smallest violation. Without `shown` the units are those of the file, or SI.
std::string text_of(const Tuning& tuning, const Tuned& tuned, const TableUnits* shown = nullptr);

// Returns the same as JSON, format sinew.tuned/1, with every candidate of the front.
std::string json_of(const Tuning& tuning, const Tuned& tuned);

// Return the headings and a row of a table of candidates: number, generation, feasible, violation,
// holds, then the tuned keys, goals and limits.
std::vector<std::string> candidate_headings(const Tuning& tuning);
std::vector<std::string> candidate_cells(const Candidate& candidate);

// --- a candidate as an experiment of its own ---

// Throws config::Error that begins with "candidate" if no result of this tuning has a candidate of
// this number, or of -1 a single best one.
void require_candidate(const Tuning& tuning, int number);

// Returns the candidate of this number, or of -1 the only best one. Throws config::Error that
// begins with "candidate".
const Candidate& candidate_of(const Tuned& tuned, int number);

// Returns the text of an experiment file for the path `file`: the tuning's experiment with the
// candidate's values, their source and the goals reached. Its paths are relative to the folder of
// `file`. Throws config::Error if the tuning's experiment cannot be read.
std::string experiment_of(const Tuning& tuning, const Candidate& candidate,
                          const std::filesystem::path& file);

}  // namespace sinew::tune
