// tune/results/asked.h - what a study asks for, as text: two studies are one where it is the same.
//
// It holds everything that a row's cells depend on: the version of Sinew, every value of the
// experiment and its robot in SI, and of the files that an axis names, then what is varied,
// sampled, searched and reported. Where the files stand and what comments they have is no part of
// it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// A column of a study's table.
struct Column {
  // parameter     a sweep varies it, a tuner chooses it
  // circumstance  a parameter has to serve in it: a seed, a case, a draw of what is not known
  // figure        a run's, that was asked for
  // maximize, minimize, limit  a figure that a tuner goes by
  enum class Role { parameter, circumstance, figure, maximize, minimize, limit, other };

  std::string heading;
  bool number = true;  // its cells are numbers, or empty
  Role role = Role::other;
};
// Returns the word that the study's file has for it.
const char* to_text(Column::Role role);

struct Asked {
  std::string text;  // a fact a line
  std::vector<Column> columns;
  std::size_t points = 0;  // no part of the text of a tuning, which may be asked to go on
  std::string experiment;  // the file, as it was named
  std::vector<std::string> sets = {};  // key=value, for every run; the text has what they lead to
  std::string title = {};
  std::vector<Case> cases = {};            // of each candidate; the text has what they lead to
  std::vector<Column> of_candidates = {};  // a tuning's; empty: a sweep
};

// Throws config::Error for an experiment that is wrong.
Asked asked_of(const Sweep& sweep);

// Sixteen hexadecimal digits that stand for the text.
std::string hash_of(const Asked& asked);

// Returns the first fact in which two differ, with the table of the file it stands in: `"[trolley]
// drag = 1 N"`; of a text that ends before it "nothing". Both are the same for the same texts.
struct Difference {
  std::string first, second;
};
Difference difference(const std::string& first, const std::string& second);

// Throws config::Error that begins with the file where what it holds is another study than is asked
// for, or was run by another version of Sinew.
void require_same(const std::filesystem::path& file, const Asked& held, const Asked& asked);

}  // namespace sinew::tune
