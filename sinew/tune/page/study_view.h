// tune/page/study_view.h - view of a study's file for a page: columns with their roles, and rows.
//
//   const std::string html = study_page(study_view("study.db"));
//
// A study may be a sweep, whose rows are runs, or a tuning, whose rows are candidates. The page
// calculates no results: its cells are those of the file, unchanged.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// A column of a study's page.
struct StudyColumn {
  // The role of the column in the study.
  enum class Role { parameter, objective, constraint, figure, other };

  std::string heading;  // "joint.hip.angle_gain [%/count]"
  bool number = true;   // its cells are numbers, or empty
  Role role = Role::other;
  bool maximize = false;  // for an objective
  bool set = false;       // it is a key=value of the row's run, as every parameter is
};

struct StudyRow {
  std::vector<std::string> cells;  // as many as there are columns; empty: does not apply
  std::size_t number = 0;          // number of the point or the candidate
  bool ok = false;                 // has figures
  int generation = -1;             // -1: no generations
  double violation = 0;            // distance beyond its limits; 0: feasible

  bool operator==(const StudyRow&) const = default;
};

struct StudyView {
  std::string title;
  std::string kind;        // "sweep", "tune"
  std::string experiment;  // its file, as it was given
  std::string file;        // file of the study
  std::vector<StudyColumn> columns;
  std::vector<StudyRow> rows;
  std::size_t expected = 0;  // number of rows of the complete study
  std::string request;       // the request, one fact per line
  std::string version;
  std::vector<std::string> sets = {};  // key=value, for every run
  bool allow_unreachable = false;      // for every run
  std::vector<Case> cases = {};        // a tuning's cases, each with its experiment and all its
                                       // sets
};

// Returns whether the file is an SQLite file, or has the name of one. Its contents are checked when
// it is read.
bool is_study(const std::filesystem::path& file);

// Reads a study, which may be written meanwhile. Throws like read_results().
StudyView study_view(const std::filesystem::path& file);

// Experiment file and settings that repeat a row. run_of() throws config::Error if the row does not
// exist.
struct StudyRun {
  std::string experiment;
  std::vector<std::string> sets;
  bool allow_unreachable = false;
};
StudyRun run_of(const StudyView& study, std::size_t number);

// Return JSON of format sinew.study_page/1, without its page. `rows` selects the rows that are sent
// to an open page.
std::string study_json(const StudyView& study);
std::string rows_json(const std::vector<StudyRow>& rows);

// State of a page that is served while its study grows.
struct StudyServer {
  // One per study: number of row changes that the page has received. It requests "rows/<known>",
  // for the second study "b/rows/<known>".
  std::vector<std::size_t> known;
};

// Return the whole page, of one study or of two side by side; of files, as study_view() reads them.
// Throw std::runtime_error if the program was built without its pages.
std::string study_page(const StudyView& study);
std::string study_page(const std::vector<StudyView>& studies);
std::string study_page_of(const std::vector<std::filesystem::path>& files);
std::string study_page(const std::vector<StudyView>& studies, const StudyServer& server);

}  // namespace sinew::tune
