// tune/results/request.h - text of a study's request: two studies are the same if their texts are
// equal.
//
// The text contains everything that a row's cells depend on: the version of Sinew; every value, in
// SI, of the experiment, its robot and the files that an axis names; and what is varied, sampled,
// searched and reported. Paths and comments of the files are not part of the text.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// A column of a study's table.
struct Column {
  // parameter     varied by a sweep, or chosen by a tuner
  // circumstance  a condition for which a parameter must be suited: a seed, a case, a draw of
  //               uncertain values
  // figure        a reported figure of a run
  // maximize, minimize, limit  a figure used by a tuner
  enum class Role { parameter, circumstance, figure, maximize, minimize, limit, other };

  std::string heading;
  bool number = true;  // its cells are numbers, or empty
  Role role = Role::other;
};
// Names of the roles in the study's file.
inline constexpr std::array<std::string_view, 7> role_names = {
    "parameter", "circumstance", "figure", "maximize", "minimize", "limit", "other"};

struct StudyRequest {
  std::string text;             // one fact per line
  std::vector<Column> columns;  // columns of the table
  std::size_t points = 0;       // not part of a tuning's text, since a tuning may be extended
  std::string experiment;       // the file, as it was given
  std::vector<std::string> sets = {};      // key=value, for every run; the text has the resulting
                                           // values
  std::string title = {};                  // title of the study
  std::vector<Case> cases = {};            // cases of each candidate; the text has their values
  std::vector<Column> of_candidates = {};  // a tuning's; empty: a sweep
};

// Throws config::Error for a faulty experiment.
StudyRequest request_of(const Sweep& sweep);

// Returns sixteen hexadecimal digits that identify the text.
std::string hash_of(const StudyRequest& request);

// The first fact in which two texts differ, with its table in the file: `"[trolley] drag = 1 N"`;
// "nothing" for a text that ends before. For equal texts both are the same.
struct Difference {
  std::string first, second;
};
Difference difference(const std::string& first, const std::string& second);

// Throws config::Error that begins with the file if it holds another study than requested, or
// one of another version of Sinew.
void require_same(const std::filesystem::path& file, const StudyRequest& held,
                  const StudyRequest& request);

}  // namespace sinew::tune
