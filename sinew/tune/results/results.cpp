#include "sinew/tune/results/results.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <map>
#include <set>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sinew/json/json.h"
#include "sinew/log/file.h"
#include "sinew/run/folder/files.h"
#include "sinew/units/hash.h"

namespace sinew::tune {

namespace {

namespace fs = std::filesystem;

// A row and its file.
struct Origin {
  const fs::path* file;
  Row row;
};

bool same(const Row& a, const Row& b) {
  return a.cells == b.cells && a.ok == b.ok && a.notes == b.notes;
}

[[noreturn]] void refuse_point(const Origin& first, const fs::path& file, const Row& second,
                               const std::vector<Column>& columns) {
  std::size_t i = 0;
  while (i + 1 < columns.size() && first.row.cells[i] == second.cells[i]) ++i;
  run::refuse(
      file, fmt::format("point {} with {} = {}", second.point, columns[i].heading, second.cells[i]),
      fmt::format("{}, as {} has it", first.row.cells[i], first.file->string()),
      "the same program for all shards, and to run one of both files again");
}

class Rows {
 public:
  explicit Rows(const std::vector<Column>& columns) : columns_(columns) {}

  void add(const fs::path& file, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      const auto [at, is_new] = rows_.try_emplace(row.point, Origin{&file, row});
      if (!is_new && !same(at->second.row, row)) refuse_point(at->second, file, row, columns_);
    }
  }

  std::size_t size() const { return rows_.size(); }

  // Returns the rows that come from other files.
  std::vector<Row> besides(const fs::path& file) const {
    std::vector<Row> out;
    for (const auto& [point, origin] : rows_)
      if (origin.file != &file) out.push_back(origin.row);
    return out;
  }

 private:
  const std::vector<Column>& columns_;
  std::map<std::size_t, Origin> rows_;
};

}  // namespace

Merged merge(const std::vector<fs::path>& from, const fs::path& to) {
  std::error_code none;
  for (const fs::path& file : from)
    if (fs::equivalent(file, to, none))
      run::refuse(to, "a file that is merged", "a name for all of them", "another name");

  const StudyRequest request = read_results(from.front()).request;
  Results out(to, request);
  Rows rows(request.columns);
  rows.add(to, out.rows());
  const std::size_t before = rows.size();
  for (const fs::path& file : from) {
    const StoredStudy held = read_results(file);
    require_same(file, held.request, request);
    rows.add(file, held.rows);
  }
  out.add_all(rows.besides(to));
  return {request.points, rows.size(), rows.size() - before};
}

namespace {

// Opens the study's file and sets the stored rows of the share as known.
void open_results(const Sweep& s, const fs::path& file, Options& options,
                  std::optional<Results>& results, const run::Notices& notices) {
  if (file.empty()) return;
  results.emplace(file, request_of(s));
  options.known = results->rows();
  std::erase_if(options.known, [&](const Row& row) { return !options.share.has(row.point); });
  if (!options.known.empty())
    notices.note(fmt::format("{}: {} of {} points are there", file.string(), options.known.size(),
                             options.share.size(points(s))));
}

// Reports warnings about rows, and refuses an incomplete table. `kept` is the file with the rows,
// empty if absent; `can_continue`: the same command runs the others.
void check_rows(const std::vector<Row>& rows, const Sweep& s, const Share& share,
                const std::string& kept, bool can_continue, const run::Notices& notices) {
  for (const std::string& text : warnings(rows)) notices.warning(text);
  if (const std::size_t all = share.size(points(s)); rows.size() < all)
    throw std::runtime_error(
        fmt::format("interrupted: {} of {} points are done{}{}", rows.size(), all,
                    kept.empty() ? "" : " and kept in " + kept,
                    can_continue ? "; the same command continues with the others" : ""));
  try {
    refuse_empty_columns(rows, s);
  } catch (const std::exception& e) {
    if (kept.empty()) throw;
    throw std::runtime_error(fmt::format("{}\n{}: holds the rows", e.what(), kept));
  }
}

}  // namespace

std::vector<Row> sweep_and_store(const Sweep& s, const fs::path& file,
                                 const StoredSweepOptions& options) {
  Options own = options.sweep;
  TableFile* const table = options.table;
  std::optional<Results> results;
  open_results(s, file, own, results, options.notices);
  // Rows that a study's file keeps are not needed in half a table.
  const bool late = results && table && !table->part().empty();
  const auto stop = [&] {
    if (options.ask_to_stop) options.ask_to_stop();
  };
  own.row = [&](const Row& row) {
    if (table && !late && !table->add(row.cells)) stop();
  };
  own.done = [&](const Row& row) {
    if (results && !results->add(row)) stop();
  };
  std::vector<Row> rows = sweep(s, own);
  if (results) results->throw_failure();
  if (table) table->throw_failure();
  check_rows(rows, s, own.share, results || !table ? file.string() : table->part(),
             results.has_value(), options.notices);
  if (!table) return rows;
  if (late)
    for (const Row& row : rows) table->add(row.cells);
  table->throw_failure();
  table->take_place();
  return rows;
}

namespace {

// --- the tables of a study's file, described in docs/reference/study-file.md ---

constexpr std::int64_t application = 0x53696e77;  // "Sinw", by which `file` and SQLite identify it

const char* const tables =
    "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE heading (number INTEGER PRIMARY KEY, heading TEXT NOT NULL,"
    "  name TEXT NOT NULL, is_number INTEGER NOT NULL, role TEXT NOT NULL);"
    "CREATE TABLE result (point INTEGER PRIMARY KEY, ok INTEGER NOT NULL,"
    "  stop_reached INTEGER NOT NULL, no_air INTEGER NOT NULL, out_of_reach INTEGER NOT NULL,"
    "  lacks TEXT NOT NULL, differs TEXT NOT NULL, cells TEXT NOT NULL,"
    "  checksum TEXT NOT NULL);";

// Tables of a tuning only.
const char* const tables_of_candidates =
    "CREATE TABLE candidate_heading (number INTEGER PRIMARY KEY, heading TEXT NOT NULL,"
    "  name TEXT NOT NULL, is_number INTEGER NOT NULL, role TEXT NOT NULL);"
    "CREATE TABLE candidate_result (candidate INTEGER PRIMARY KEY, generation INTEGER NOT NULL,"
    "  feasible INTEGER NOT NULL, violation REAL NOT NULL, holds REAL NOT NULL,"
    "  cells TEXT NOT NULL, checksum TEXT NOT NULL);";

constexpr std::string_view of_runs = "point, ok, stop_reached, no_air, out_of_reach";
constexpr std::string_view of_candidates = "candidate, generation, feasible, violation, holds";

[[noreturn]] void damaged(const fs::path& file, const std::string& why) {
  throw log::Error(file, "is damaged: " + why, "keep a copy, and choose another name");
}

// Returns a list of texts as JSON; a text need not be UTF-8.
std::string json_of(const std::vector<std::string>& texts) { return Json(texts).text(); }

// Returns the texts of such a list. Throws log::Error if the JSON is not a list of texts.
std::vector<std::string> texts_of(const std::string& json, const fs::path& file) {
  Json list;
  (void)Json::parse(json, list);
  const auto is_text = [](const Json& item) { return item.is_string(); };
  if (list.is_array() && std::ranges::all_of(list, is_text)) return list.strings();
  damaged(file, "a list of texts cannot be read");
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Returns names that are unique without regard to case, as in SQLite. `own` are the view's other
// names.
std::vector<std::string> names_of(const std::vector<Column>& columns, std::string_view own) {
  std::set<std::string> taken;
  for (const std::string_view name : list_of(own)) taken.emplace(name);
  std::vector<std::string> out;
  for (const Column& column : columns) {
    std::string name = column.heading;
    for (int n = 2; !taken.insert(lower(name)).second; ++n)
      name = fmt::format("{} ({})", column.heading, n);
    out.push_back(std::move(name));
  }
  return out;
}

std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out.append(c == '"' ? 2 : 1, c);
  return out + "\"";
}

// Returns the view of a table whose column `cells` is a list of texts; `own` are the table's other
// columns.
std::string view_of(const char* view, const char* table, std::string_view own,
                    const std::vector<Column>& columns, const std::vector<std::string>& names) {
  const std::size_t comma = own.find(',');
  std::string out = fmt::format("CREATE VIEW {} AS SELECT {}", view, own.substr(0, comma));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string cell = fmt::format("nullif(json_extract(cells, '$[{}]'), '')", i);
    out += fmt::format(", {} AS {}",
                       columns[i].number ? fmt::format("CAST({} AS NUMERIC)", cell) : cell,
                       quoted(names[i]));
  }
  return out + fmt::format("{} FROM {}", own.substr(comma), table);
}

void make_headings(Database& database, const char* table, const std::vector<Column>& columns,
                   const std::vector<std::string>& names) {
  Statement heading(database, fmt::format("INSERT INTO {} VALUES (?1, ?2, ?3, ?4, ?5)", table));
  for (std::size_t i = 0; i < names.size(); ++i)
    heading.bind(static_cast<std::int64_t>(i))
        .bind(columns[i].heading)
        .bind(names[i])
        .bind(std::int64_t{columns[i].number})
        .bind(std::string(role_names[static_cast<std::size_t>(columns[i].role)]))
        .to_the_end();
}

std::vector<Column> columns_of(Database& database, const char* table) {
  std::vector<Column> out;
  Statement headings(database,
                     fmt::format("SELECT heading, is_number, role FROM {} ORDER BY number", table));
  while (headings.step()) {
    out.push_back({headings.text(0), headings.number(1) != 0});
    const auto role = std::ranges::find(role_names, headings.text(2));
    if (role != role_names.end())
      out.back().role = static_cast<Column::Role>(role - role_names.begin());
  }
  return out;
}

std::string value_of(Database& database, const std::string& key) {
  Statement select(database, "SELECT value FROM study WHERE key = ?1");
  return select.bind(key).step() ? select.text(0) : "";
}

// Returns the cases in a text, which is empty in the files of versions of Sinew that did not store
// them.
std::vector<Case> cases_of(const std::string& text, const fs::path& file) try {
  std::vector<Case> out;
  if (text.empty()) return out;
  const Json cases = Json::parse(text);
  for (const Json& one : cases.list())
    out.push_back({.name = one.at("name").string(),
                   .experiment = one.at("experiment").string(),
                   .sets = one.at("sets").strings(),
                   .weight = one.at("weight").number()});
  return out;
} catch (const JsonError&) {
  damaged(file, "its cases cannot be read");
}

// Returns the cases as JSON.
std::string json_of(const std::vector<Case>& cases) {
  Json out = Json::array();
  for (const Case& one : cases)
    out.push_back({{"experiment", one.experiment},
                   {"name", one.name},
                   {"sets", one.sets},
                   {"weight", one.weight}});
  return out.text();
}

// Returns the checksum of everything but the rows: the request, the headings and the tables
// themselves.
std::string checksum_of(Database& database, bool tuning) {
  std::uint64_t h = units::hash("");
  const auto add = [&](const std::string& sql, int columns) {
    Statement select(database, sql);
    while (select.step())
      for (int i = 0; i < columns; ++i) h = units::hash(select.text(i) + '\n', h);
  };
  add("SELECT name, sql FROM sqlite_schema ORDER BY name", 2);
  add("SELECT key, value FROM study WHERE key <> 'checksum' ORDER BY key", 2);
  for (const char* table : {"heading", "candidate_heading"})
    if (tuning || table == std::string_view("heading"))
      add(fmt::format("SELECT number, heading, name, is_number, role FROM {} ORDER BY number",
                      table),
          5);
  return fmt::format("{:016x}", h);
}

// Stores the checksum of everything but the rows in the table `study`, after a change.
void write_checksum(Database& database) {
  const bool tuning = value_of(database, "kind") == "tuning";
  Statement fact(database, "INSERT OR REPLACE INTO study VALUES ('checksum', ?1)");
  fact.bind(checksum_of(database, tuning)).to_the_end();
}

// Returns false for a database without tables. Throws config::Error for a database of another
// program, and for tables of another format.
bool has_study(Database& database, const fs::path& file) {
  const std::int64_t owner = database.number("PRAGMA application_id");
  const std::int64_t format = database.number("PRAGMA user_version");
  if (owner == 0 && database.number("SELECT count(*) FROM sqlite_schema") == 0) return false;
  if (owner != application)
    run::refuse(file, "a database of another program", "a study's file",
                "another name, or to remove it first");
  if (format != study_format)
    run::refuse(
        file, fmt::format("a study's file of format {}", format),
        fmt::format("format {}", study_format),
        format > study_format
            ? "a newer Sinew: the file was written by one"
            : "another name: an older Sinew wrote it, and any SQLite program still reads it");
  return true;
}

// Creates all tables at once, with the request. The view `run` has a column of numbers or texts for
// each cell, named by its heading; a repeated name has a number appended.
void make_tables(Database& database, const StudyRequest& request) {
  database.run("PRAGMA journal_mode = WAL");
  database.run("BEGIN IMMEDIATE");
  database.run(tables);
  Statement fact(database, "INSERT INTO study VALUES (?1, ?2)");
  const auto put = [&](const char* key, const std::string& value) {
    fact.bind(std::string(key)).bind(value).to_the_end();
  };
  put("format", fmt::format("sinew.study/{}", study_format));
  put("sinew_version", SINEW_VERSION);
  put("kind", request.of_candidates.empty() ? "sweep" : "tuning");
  put("title", request.title);
  put("experiment", request.experiment);
  put("sets", json_of(request.sets));
  put("cases", json_of(request.cases));
  put("points", std::to_string(request.points));
  put("hash", hash_of(request));
  put("asked", request.text);
  const std::vector<std::string> names = names_of(request.columns, of_runs);
  make_headings(database, "heading", request.columns, names);
  database.run(view_of("run", "result", of_runs, request.columns, names));
  if (!request.of_candidates.empty()) {
    database.run(tables_of_candidates);
    const std::vector<std::string> theirs = names_of(request.of_candidates, of_candidates);
    make_headings(database, "candidate_heading", request.of_candidates, theirs);
    database.run(
        view_of("candidate", "candidate_result", of_candidates, request.of_candidates, theirs));
  }
  write_checksum(database);
  database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT",
                           application, study_format));
}

// Returns the request in the file. Throws log::Error if it is damaged.
StudyRequest study_of(Database& database, const fs::path& file) {
  StudyRequest out{.text = value_of(database, "asked"),
                   .columns = {},
                   .points = 0,
                   .experiment = value_of(database, "experiment"),
                   .sets = texts_of(value_of(database, "sets"), file),
                   .title = value_of(database, "title"),
                   .cases = cases_of(value_of(database, "cases"), file)};
  out.points = static_cast<std::size_t>(
      database.number("SELECT CAST(value AS INTEGER) FROM study WHERE key = 'points'"));
  out.columns = columns_of(database, "heading");
  if (value_of(database, "kind") == "tuning")
    out.of_candidates = columns_of(database, "candidate_heading");
  const bool tuning = !out.of_candidates.empty();
  if (hash_of(out) != value_of(database, "hash") || out.points > most_points ||
      checksum_of(database, tuning) != value_of(database, "checksum"))
    damaged(file, "its study cannot be read");
  return out;
}

// Return the checksum of all values of a row.
std::string checksum_of(const Row& row) {
  const std::string text =
      fmt::format("{} {:d} {:d} {:d} {:d}\n{}\n{}\n{}", row.point, row.ok, row.notes.stop_reached,
                  row.notes.no_air, row.notes.out_of_reach, json_of(row.notes.lacks),
                  json_of(row.notes.differs), json_of(row.cells));
  return fmt::format("{:016x}", units::hash(text));
}

// Adds 0.0, since a zero of SQLite has no sign.
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
    damaged(file, "the checksum of " + what + " is not that of its values");
}

// Throws log::Error if SQLite's structure is damaged, since rows may be missing then.
void require_whole(Database& database, const fs::path& file) {
  Statement check(database, "PRAGMA quick_check(1)");
  if (!check.step() || check.text(0) != "ok") damaged(file, "SQLite finds its pages not in order");
}

std::vector<Row> rows_of(Database& database, const fs::path& file, const StudyRequest& request) {
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
    if (row.point >= request.points || row.cells.size() != request.columns.size())
      damaged(file, "a row that the study cannot have");
    out.push_back(std::move(row));
  }
  return out;
}

std::vector<CandidateRow> candidates_of(Database& database, const fs::path& file,
                                        const StudyRequest& request) {
  std::vector<CandidateRow> out;
  if (request.of_candidates.empty()) return out;
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

// Locks the file until the descriptor is closed, and creates it if it is missing.
int take(const fs::path& file, bool& made) {
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  const int error = errno;
  if (fd < 0)
    throw log::Error(file, "cannot be written: " + log::system_error_text(error),
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

void require_room(const StudyRequest& request, const fs::path& file) {
  if (request.columns.size() <= most_columns) return;
  run::refuse(file, std::to_string(request.columns.size()) + " columns",
              "at most " + std::to_string(most_columns), "fewer ranges or figures, or a CSV file");
}

}  // namespace

Results::Results(const fs::path& file, const StudyRequest& request) : file_(file) {
  require_room(request, file);
  if (fs::is_directory(file)) run::refuse(file, "a folder", "the name of a file");
  run::require_folder_of(file);
  lock_ = take(file, made_);
  try {
    database_.emplace(file, Database::Use::write);
    if (!has_study(*database_, file)) make_tables(*database_, request);
    require_whole(*database_, file);
    require_same(file, study_of(*database_, file), request);
    // Rows that are not on the disk when the power fails are run again; no row is stored in part.
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
    require_place();  // another file of this name is not removed
    empty = made_ && database_->number("SELECT count(*) FROM result") == 0;
  } catch (...) {}
  insert_.reset();
  database_.reset();
  if (empty)
    for (const char* part : {"", "-wal", "-shm"}) ::unlink((file_.string() + part).c_str());
  ::close(lock_);  // last, since closing it releases SQLite's own locks on the file
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

// Checks that the file is still at its place, since SQLite reports no error for an unlinked file.
void Results::require_place() const {
  struct stat there {
  }, held{};
  const bool is_there = ::stat(file_.c_str(), &there) == 0 && ::fstat(lock_, &held) == 0 &&
                        there.st_dev == held.st_dev && there.st_ino == held.st_ino;
  if (!is_there)
    throw log::Error(file_, "was removed or replaced while the study was written into it",
                     "leave the file where it is; the same command starts the study again");
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
  if (points <= study_of(*database_, file_).points) return;
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

StoredStudy read_results(const fs::path& file) {
  if (!fs::is_regular_file(file))
    run::refuse(file, fs::exists(file) ? "no file" : "nothing", "a study's file");
  Database database(file, Database::Use::read);
  if (!has_study(database, file)) run::refuse(file, "a database without tables", "a study's file");
  // Reads the rows of one instant while others are added.
  database.run("BEGIN");
  require_whole(database, file);
  StoredStudy out{.request = study_of(database, file), .rows = {}};
  out.rows = rows_of(database, file, out.request);
  out.candidates = candidates_of(database, file, out.request);
  return out;
}

}  // namespace sinew::tune
