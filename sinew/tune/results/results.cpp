#include "sinew/tune/results/results.h"

#include <fcntl.h>
#include <fmt/format.h>
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
#include "sinew/units/hash.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

// Checksums of a row, over all that it has.
std::string checksum_of(const Row& row) {
  const std::string text =
      fmt::format("{} {:d} {:d} {:d} {:d}\n{}\n{}\n{}", row.point, row.ok, row.notes.stop_reached,
                  row.notes.no_air, row.notes.out_of_reach, json_of(row.notes.lacks),
                  json_of(row.notes.differs), json_of(row.cells));
  return fmt::format("{:016x}", units::hash(text));
}

// A zero of SQLite has no sign.
std::string checksum_of(const CandidateRow& row) {
  const std::string text =
      fmt::format("{} {} {:d} {} {}\n{}", row.number, row.generation, row.feasible,
                  row.violation + 0.0, row.holds + 0.0, json_of(row.cells));
  return fmt::format("{:016x}", units::hash(text));
}

template <class AnyRow>
void require_checksum(const AnyRow& row, const std::string& kept, const fs::path& file,
                      const std::string& what) {
  if (checksum_of(row) != kept)
    throw log::Error(file, "is damaged: the checksum of " + what + " is not that of its values",
                     "keep a copy, and choose another name");
}

// Throws log::Error where SQLite's own structure does not hold together, as rows may be missing
// then.
void require_whole(Database& database, const fs::path& file) {
  Statement check(database, "PRAGMA quick_check(1)");
  if (!check.step() || check.text(0) != "ok")
    throw log::Error(file, "is damaged: SQLite finds its pages not in order",
                     "keep a copy, and choose another name");
}

std::vector<Row> rows_of(Database& database, const fs::path& file, const Asked& asked) {
  std::vector<Row> out;
  Statement select(database,
                   "SELECT point, ok, stop_reached, no_air, out_of_reach, lacks, differs, cells, "
                   "checksum FROM result ORDER BY point");
  while (select.step()) {
    Row row{.point = static_cast<std::size_t>(select.number(0)),
            .cells = texts_of(select.text(7), file),
            .ok = select.number(1) != 0};
    row.notes = {.lacks = texts_of(select.text(5), file),
                 .differs = texts_of(select.text(6), file),
                 .stop_reached = select.number(2) != 0,
                 .no_air = select.number(3) != 0,
                 .out_of_reach = select.number(4) != 0};
    require_checksum(row, select.text(8), file, fmt::format("point {}", row.point));
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
                   "SELECT candidate, generation, feasible, violation, holds, cells, checksum "
                   "FROM candidate_result ORDER BY candidate");
  while (select.step()) {
    out.push_back({.number = static_cast<std::size_t>(select.number(0)),
                   .generation = static_cast<std::size_t>(select.number(1)),
                   .feasible = select.number(2) != 0,
                   .violation = select.real(3),
                   .holds = select.real(4),
                   .cells = texts_of(select.text(5), file)});
    require_checksum(out.back(), select.text(6), file,
                     fmt::format("candidate {}", out.back().number));
  }
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
    require_whole(*database_, file);
    require_same(file, study_of(*database_, file), asked);
    // What is not on the disk when the power fails is run again; no row is half there.
    database_->run("PRAGMA synchronous = NORMAL");
    insert_.emplace(*database_,
                    "INSERT INTO result (point, ok, stop_reached, no_air, out_of_reach, lacks, "
                    "differs, cells, checksum) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)");
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
    require_place();  // another file of this name stays
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
      .bind(checksum_of(row))
      .to_the_end();
}

// Writes into a file without a name are no error to SQLite.
void Results::require_place() const {
  struct stat there {
  }, held{};
  const bool is_there = ::stat(file_.c_str(), &there) == 0 && ::fstat(lock_, &held) == 0 &&
                        there.st_dev == held.st_dev && there.st_ino == held.st_ino;
  if (!is_there)
    throw log::Error(file_, "was removed or replaced while the study was written into it",
                     "leave the file where it is; the same command begins the study anew");
}

bool Results::add(const Row& row) noexcept {
  if (failure_) return false;
  try {
    require_place();
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
                     "violation, holds, cells, checksum) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
    for (const CandidateRow& c : candidates)
      insert.bind(static_cast<std::int64_t>(c.number))
          .bind(static_cast<std::int64_t>(c.generation))
          .bind(std::int64_t{c.feasible})
          .bind(c.violation)
          .bind(c.holds)
          .bind(json_of(c.cells))
          .bind(checksum_of(c))
          .to_the_end();
  });
}

void Results::expect(std::size_t points) {
  all_or_none([&] {
    Statement update(*database_, "UPDATE study SET value = ?1 WHERE key = 'points'");
    update.bind(std::to_string(points)).to_the_end();
    write_checksum(*database_);
  });
}

void Results::all_or_none(const std::function<void()>& write) {
  require_place();
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
  require_place();
}

HeldStudy read_results(const fs::path& file) {
  if (!fs::is_regular_file(file))
    run::refuse(file, fs::exists(file) ? "no file" : "nothing", "a study's file");
  Database database(file, Database::Use::read);
  if (!has_study(database, file)) run::refuse(file, "a database without tables", "a study's file");
  // The rows of one moment, while others are added.
  database.run("BEGIN");
  require_whole(database, file);
  HeldStudy out{.asked = study_of(database, file), .rows = {}};
  out.rows = rows_of(database, file, out.asked);
  out.candidates = candidates_of(database, file, out.asked);
  return out;
}

}  // namespace sinew::tune
