#include "sinew/tune/results/results.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>

#include "sinew/log/error.h"
#include "sinew/log/file.h"
#include "sinew/log/lock.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/refusal.h"
#include "sinew/tune/results/tables.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

std::vector<Row> rows_of(Database& database, const fs::path& file, const Asked& asked) {
  std::vector<Row> out;
  Statement select(database,
                   "SELECT point, ok, stop_reached, no_air, out_of_reach, lacks, differs, cells "
                   "FROM result ORDER BY point");
  while (select.step()) {
    Row row{.point = static_cast<std::size_t>(select.number(0)),
            .cells = texts_of(select.text(7), file),
            .ok = select.number(1) != 0};
    row.notes = {.lacks = texts_of(select.text(5), file),
                 .differs = texts_of(select.text(6), file),
                 .stop_reached = select.number(2) != 0,
                 .no_air = select.number(3) != 0,
                 .out_of_reach = select.number(4) != 0};
    if (row.point >= asked.points || row.cells.size() != asked.columns.size())
      throw log::Error(file, "is damaged: a row that the study cannot have",
                       "keep a copy, and choose another name");
    out.push_back(std::move(row));
  }
  return out;
}

std::vector<CandidateRow> candidates_of(Database& database, const fs::path& file,
                                        const Asked& asked) {
  std::vector<CandidateRow> out;
  if (asked.of_candidates.empty()) return out;
  Statement select(database,
                   "SELECT candidate, generation, feasible, violation, holds, cells "
                   "FROM candidate_result ORDER BY candidate");
  while (select.step())
    out.push_back({.number = static_cast<std::size_t>(select.number(0)),
                   .generation = static_cast<std::size_t>(select.number(1)),
                   .feasible = select.number(2) != 0,
                   .violation = select.real(3),
                   .holds = select.real(4),
                   .cells = texts_of(select.text(5), file)});
  return out;
}

// Locks the file until the descriptor is closed, and makes it where there is none.
int take(const fs::path& file, bool& made) {
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  const int error = errno;
  if (fd < 0)
    throw log::Error(file, "cannot be written: " + log::system_words(error),
                     "choose a folder that exists and that you may write to");
  struct stat info {};
  const bool regular = ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
  const std::string holder = regular ? log::lock(fd) : "";
  if (!regular || !holder.empty()) ::close(fd);
  if (!regular) run::refuse(file, "no file", "the name of a file");
  if (!holder.empty())
    throw log::Error(file, holder + " is writing it", "wait for it, or choose another name");
  made = info.st_size == 0;
  return fd;
}

void require_room(const Asked& asked, const fs::path& file) {
  if (asked.columns.size() <= most_columns) return;
  run::refuse(file, std::to_string(asked.columns.size()) + " columns",
              "at most " + std::to_string(most_columns), "fewer ranges or figures, or a CSV file");
}

}  // namespace

Results::Results(const fs::path& file, const Asked& asked) : file_(file) {
  require_room(asked, file);
  if (fs::is_directory(file)) run::refuse(file, "a folder", "the name of a file");
  run::require_folder_of(file);
  lock_ = take(file, made_);
  try {
    database_.emplace(file, Database::Use::write);
    if (!has_study(*database_, file)) make_tables(*database_, asked);
    require_same(file, study_of(*database_, file), asked);
    // What is not on the disk when the power fails is run again; no row is half there.
    database_->run("PRAGMA synchronous = NORMAL");
    insert_.emplace(*database_,
                    "INSERT INTO result (point, ok, stop_reached, no_air, out_of_reach, lacks, "
                    "differs, cells) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
  } catch (...) {
    database_.reset();
    if (made_) ::unlink(file.c_str());
    ::close(lock_);
    throw;
  }
}

Results::~Results() {
  bool empty = false;
  try {
    empty = made_ && database_->number("SELECT count(*) FROM result") == 0;
  } catch (...) {}
  insert_.reset();
  database_.reset();
  if (empty)
    for (const char* part : {"", "-wal", "-shm"}) ::unlink((file_.string() + part).c_str());
  ::close(lock_);  // only now: closing it ends SQLite's own locks on the file
}

std::vector<Row> Results::rows() { return rows_of(*database_, file_, study_of(*database_, file_)); }

void Results::insert(const Row& row) {
  insert_->bind(static_cast<std::int64_t>(row.point))
      .bind(std::int64_t{row.ok})
      .bind(std::int64_t{row.notes.stop_reached})
      .bind(std::int64_t{row.notes.no_air})
      .bind(std::int64_t{row.notes.out_of_reach})
      .bind(json_of(row.notes.lacks))
      .bind(json_of(row.notes.differs))
      .bind(json_of(row.cells))
      .to_the_end();
}

bool Results::add(const Row& row) noexcept {
  if (failure_) return false;
  try {
    insert(row);
  } catch (...) {
    failure_ = std::current_exception();
  }
  return !failure_;
}

void Results::add_all(const std::vector<Row>& rows) {
  all_or_none([&] {
    for (const Row& row : rows) insert(row);
  });
}

void Results::add_candidates(const std::vector<CandidateRow>& candidates) {
  all_or_none([&] {
    Statement insert(*database_,
                     "INSERT OR REPLACE INTO candidate_result (candidate, generation, feasible, "
                     "violation, holds, cells) VALUES (?1, ?2, ?3, ?4, ?5, ?6)");
    for (const CandidateRow& c : candidates)
      insert.bind(static_cast<std::int64_t>(c.number))
          .bind(static_cast<std::int64_t>(c.generation))
          .bind(std::int64_t{c.feasible})
          .bind(c.violation)
          .bind(c.holds)
          .bind(json_of(c.cells))
          .to_the_end();
  });
}

void Results::expect(std::size_t points) {
  Statement update(*database_, "UPDATE study SET value = ?1 WHERE key = 'points'");
  update.bind(std::to_string(points)).to_the_end();
}

void Results::all_or_none(const std::function<void()>& write) {
  database_->run("BEGIN IMMEDIATE");
  try {
    write();
    database_->run("COMMIT");
  } catch (...) {
    try {
      database_->run("ROLLBACK");  // SQLite may have done it already
    } catch (...) {}
    throw;
  }
}

void Results::throw_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

HeldStudy read_results(const fs::path& file) {
  if (!fs::is_regular_file(file))
    run::refuse(file, fs::exists(file) ? "no file" : "nothing", "a study's file");
  Database database(file, Database::Use::read);
  if (!has_study(database, file)) run::refuse(file, "a database without tables", "a study's file");
  // The rows of one moment, while others are added.
  database.run("BEGIN");
  HeldStudy out{.asked = study_of(database, file), .rows = {}};
  out.rows = rows_of(database, file, out.asked);
  out.candidates = candidates_of(database, file, out.asked);
  return out;
}

}  // namespace sinew::tune
