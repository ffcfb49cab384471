// tune/optimizer/tuned_text.h - what a tuning found, for people and for programs.
#pragma once

#include <string>

#include "sinew/tune/optimizer/optimize.h"

namespace sinew::tune {

// Returns the best candidate of one goal beside what the experiment has, or the front of several:
// a column for each candidate. Where nothing is feasible, the candidate that is closest to it.
std::string text_of(const Tuning& tuning, const Tuned& tuned);

// Returns the same as JSON, format sinew.tuned/1, with every candidate of the front.
std::string json_of(const Tuning& tuning, const Tuned& tuned);

// Returns the headings and rows of all candidates: number, generation, feasible, violation, holds,
// then the tuned keys, goals and limits.
std::vector<std::string> candidate_headings(const Tuning& tuning);
std::vector<std::string> candidate_cells(const Candidate& candidate);

}  // namespace sinew::tune
