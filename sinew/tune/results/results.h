// tune/results/results.h - the rows of one study in an SQLite file, each as soon as its run is
// done.
//
//   Results results("study.db", asked_of(sweep));
//   tune::sweep(sweep, {.done = [&](const Row& row) { results.add(row); }, .known =
//   results.rows()});
//
// Whoever writes it is one process; anybody may read meanwhile. A row is a transaction: killed at
// any moment, the process leaves every row that was added, and the next one goes on behind it.
// docs/reference/study-file.md has the tables.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/run/folder/notices.h"
#include "sinew/tune/results/asked.h"
#include "sinew/tune/results/database.h"

namespace sinew::tune {

inline constexpr int study_format = 3;             // of the tables
inline constexpr std::size_t most_columns = 1900;  // what a database of Debian's SQLite can show

// What the runs of a tuning's candidate say together.
struct CandidateRow {
  std::size_t number = 0, generation = 0;  // from 0
  bool feasible = false;                   // every limit holds, as often as it must
  double violation = 0;                    // how far it is from that; 0: feasible
  double holds = 0;                        // share of its runs in which every limit holds
  std::vector<std::string> cells;          // as many as Asked::of_candidates

  bool operator==(const CandidateRow&) const = default;
};

class Results {
 public:
  // Opens the file of this study, or makes it. Throws config::Error for a file that holds another
  // study, or one of another version; log::Error for one that is none, that cannot be written, or
  // that another process is writing.
  Results(const std::filesystem::path& file, const Asked& asked);

  // A file that it made and that has no row is removed.
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  // Returns the rows that are there, in the points' order. Throws log::Error.
  std::vector<Row> rows();

  // A failure is kept for throw_failure(). Returns false where there was one.
  bool add(const Row& row) noexcept;

  // Adds all of them, or none. Throws log::Error.
  void add_all(const std::vector<Row>& rows);

  // Adds those of a generation, or none; one that is there is written anew. Throws log::Error.
  void add_candidates(const std::vector<CandidateRow>& candidates);

  // A tuning may be asked for more generations than when it began. Throws log::Error.
  void expect(std::size_t points);

  // Throws log::Error where a row could not be written, or the file is no longer at its place.
  void throw_failure() const;

  // Returns where the study is kept.
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

// What a file holds.
struct HeldStudy {
  Asked asked;
  std::vector<Row> rows;                 // in the points' order
  std::vector<CandidateRow> candidates;  // of a tuning, in their order
};

// Throws as Results does, and log::Error for values that are not those of their checksum. Changes
// nothing; the file may be written meanwhile.
HeldStudy read_results(const std::filesystem::path& file);

// A sweep whose rows are kept as they come, and what is to be said of them.

// Opens the study's file and takes the rows of the options' share that are there, which are not run
// again. Says how many. Throws what Results throws.
void open_results(const Sweep& sweep, const std::filesystem::path& file, Options& options,
                  std::optional<Results>& results, const run::Notices& notices);

// Warns of rows, and refuses what is no whole table of so many points. `kept` is the file with the
// rows, empty where there is none; `goes_on` says that the same command runs the others. Throws
// std::runtime_error, or config::Error where a figure has no row.
void judge(const std::vector<Row>& rows, const Sweep& sweep, std::size_t points,
           const std::string& kept, bool goes_on, const run::Notices& notices);

// The files of one study's shares as one file.

// Holds what came of putting files of one study together.
struct Merged {
  std::size_t points = 0;  // of the study
  std::size_t there = 0;   // those with a row in `to`
  std::size_t added = 0;
};

// Adds the rows of all files to `to`, which is made where it is missing: all of them, or none where
// it throws. Throws config::Error for files of different studies, for a point of which two rows
// differ in anything, and where `to` is one of the files; what Results and read_results() throw
// besides.
Merged merge(const std::vector<std::filesystem::path>& from, const std::filesystem::path& to);

}  // namespace sinew::tune
