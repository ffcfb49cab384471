// tune/results/results.h - SQLite file with the rows of one study, each of them stored as soon as
// its run is done.
//
//   Results results("study.db", request_of(sweep));
//   tune::sweep(sweep, {.done = [&](const Row& row) { results.add(row); },
//                       .known = results.rows()});
//
// A single process writes the file; others may read it meanwhile. A row is a transaction: if the
// process is killed, all added rows remain, and the next process continues after them.
// docs/reference/study-file.md describes the tables.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/run/folder/notices.h"
#include "sinew/tune/results/database.h"
#include "sinew/tune/results/request.h"
#include "sinew/tune/table.h"

namespace sinew::tune {

inline constexpr int study_format = 3;             // version of the tables
inline constexpr std::size_t most_columns = 1900;  // limit of a view in Debian's SQLite

// The evaluation of a tuning's candidate.
struct CandidateRow {
  std::size_t number = 0, generation = 0;  // counted from 0
  bool feasible = false;                   // all limits hold for the required share of runs
  double violation = 0;                    // distance from it; 0: feasible
  double holds = 0;                        // share of its runs for which all limits hold
  std::vector<std::string> cells;          // as many as StudyRequest::of_candidates

  bool operator==(const CandidateRow&) const = default;
};

class Results {
 public:
  // Opens the file of this study, or creates it. Throws config::Error for a file with another study
  // or of another version; log::Error for a file that is no study, cannot be written, or is being
  // written by another process.
  Results(const std::filesystem::path& file, const StudyRequest& request);

  // Removes the file if it was created by this object and has no row.
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  // Returns the stored rows, in the points' order. Throws log::Error.
  std::vector<Row> rows();

  // Adds a row. Returns false after a failure, which is stored for throw_failure().
  bool add(const Row& row) noexcept;

  // Adds all rows, or none. Throws log::Error.
  void add_all(const std::vector<Row>& rows);

  // Adds all candidates of a generation, or none; replaces existing ones. Throws log::Error.
  void add_candidates(const std::vector<CandidateRow>& candidates);

  // Sets the number of points, which grows if a tuning is extended. Throws log::Error.
  void expect(std::size_t points);

  // Throws log::Error if a row could not be written, or if the file was moved or removed.
  void throw_failure() const;

  // Returns the study's file.
  const std::filesystem::path& file() const { return file_; }

 private:
  void insert(const Row& row);
  void require_place() const;
  void all_or_none(const std::function<void()>& write);

  std::filesystem::path file_;
  int lock_ = -1;
  bool made_ = false;
  std::optional<Database> database_;
  std::optional<Statement> insert_;
  std::exception_ptr failure_;
};

// The contents of a file.
struct StoredStudy {
  StudyRequest request;
  std::vector<Row> rows;                 // in the points' order
  std::vector<CandidateRow> candidates;  // those of a tuning, in their order
};

// Throws like Results, and log::Error if values do not match their checksum. Changes nothing; the
// file may be written meanwhile.
StoredStudy read_results(const std::filesystem::path& file);

// A sweep whose rows are stored at once, in a study's file and as a table.

// Options of a sweep with a file.
struct StoredSweepOptions {
  Options sweep;                           // `known`, `row` and `done` are not used
  TableFile* table = nullptr;              // takes all rows; null: none
  std::function<void()> ask_to_stop = {};  // called if a row cannot be written
  run::Notices notices = {};
};

// Runs the points of the share that the file lacks, and returns all rows of the share; an empty
// name stores none. The table is put in its place. Reports the number of stored rows, and warnings
// about rows. Throws std::runtime_error if points are missing, config::Error if no row has a
// figure, both with the name of what holds the rows; otherwise like sweep() and Results.
std::vector<Row> sweep_and_store(const Sweep& sweep, const std::filesystem::path& file,
                                 const StoredSweepOptions& options);

// Merging of the files of one study's shares.

// The result of a merge.
struct Merged {
  std::size_t points = 0;  // number of points of the study
  std::size_t there = 0;   // points that have a row in `to`
  std::size_t added = 0;
};

// Adds the rows of all files to `to`, which is created if it is missing: all of them, or none if it
// throws. Throws config::Error for files of different studies, for a point with two different rows,
// and if `to` is one of the files; otherwise like Results and read_results().
Merged merge(const std::vector<std::filesystem::path>& from, const std::filesystem::path& to);

}  // namespace sinew::tune
