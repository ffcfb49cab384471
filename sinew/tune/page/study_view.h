// tune/page/study_view.h - a study's file as what a page shows: columns, each with its role, and
// rows.
//
//   const std::string html = study_page(study_view("study.db"));
//
// A study may be a sweep, whose rows are runs, or a tuning, whose rows are candidates. The page
// computes nothing that a run would say: its cells are those of the file, to the letter.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// A column of a study's page.
struct StudyColumn {
  // Says what it is to the study.
  enum class Role { parameter, objective, constraint, figure, other };

  std::string heading;  // "joint.hip.angle_gain [%/count]"
  bool number = true;   // its cells are numbers, or empty
  Role role = Role::other;
  bool maximize = false;  // of an objective
  bool set = false;       // a run of the row has it as key=value; every parameter is
};

struct StudyRow {
  std::vector<std::string> cells;  // as many as there are columns; empty: does not apply
  std::size_t number = 0;          // of the point, or of the candidate
  bool ok = false;                 // has figures
  int generation = -1;             // -1: there are none
  double violation = 0;            // how far it is beyond its limits; 0: feasible

  bool operator==(const StudyRow&) const = default;
};

struct StudyView {
  std::string title;
  std::string kind;        // "sweep", "tune"
  std::string experiment;  // its file, as it was named
  std::string file;        // of the study
  std::vector<StudyColumn> columns;
  std::vector<StudyRow> rows;
  std::size_t expected = 0;  // rows, when all are there
  std::string asked;         // what was asked for, a fact a line
  std::string version;
  std::vector<std::string> sets = {};  // key=value of every run
  bool allow_unreachable = false;      // of every run
  std::vector<Case> cases = {};        // a tuning's, each with its experiment and all its sets
};

// A file of SQLite, or one that is called so. Whether it holds a study is seen when it is read.
bool is_study(const std::filesystem::path& file);

// Reads a study; it may be written meanwhile. Throws as read_results() does.
StudyView study_view(const std::filesystem::path& file);

// Returns what runs a row again: the experiment's file and its key=value. Throws config::Error for
// a row that is not there.
struct StudyRun {
  std::string experiment;
  std::vector<std::string> sets;
  bool allow_unreachable = false;
};
StudyRun run_of(const StudyView& study, std::size_t number);

// JSON of format sinew.study_page/1, without its page. `rows`: those alone, as a page that is open
// is told of them.
std::string study_json(const StudyView& study);
std::string rows_json(const std::vector<StudyRow>& rows);

// Where a page is served from while its study grows.
struct StudyServer {
  // Of each study, changes of rows that the page has: it asks for "rows/<known>", of the second
  // study for "b/rows/<known>".
  std::vector<std::size_t> known;
};

// Returns the whole page, of one study or of two beside each other; of files, as study_view() reads
// them. Throws std::runtime_error where the program was built without its pages.
std::string study_page(const StudyView& study);
std::string study_page(const std::vector<StudyView>& studies);
std::string study_page_of(const std::vector<std::filesystem::path>& files);
std::string study_page(const std::vector<StudyView>& studies, const StudyServer& server);

}  // namespace sinew::tune
