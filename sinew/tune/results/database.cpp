#include "sinew/tune/results/database.h"

#include <sqlite3.h>

#include <array>
#include <cerrno>
#include <fstream>

#include "sinew/log/file.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

constexpr int patience = 5000;  // for another process's transaction [ms]

// Start of every SQLite file. A file of no bytes is a database without tables.
constexpr std::string_view magic("SQLite format 3\0", 16);

[[noreturn]] void refuse_other_file(const fs::path& file) {
  throw log::Error(file, "is no database of SQLite, and no study",
                   "choose another name, or remove it first");
}

// Throws if the file is not a database. SQLite itself would take a short file for an empty one.
void require_database(const fs::path& file) {
  std::array<char, magic.size()> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  const auto read = static_cast<std::size_t>(in.gcount());
  if (read > 0 && std::string_view(head.data(), read) != magic) refuse_other_file(file);
}

// Returns the URI of a file that cannot be written, in a folder where no file can be created,
// so that no process writes to it.
std::string unchanging(const fs::path& file) {
  std::string name;
  for (const char c : fs::absolute(file).string())
    name += c == '?' ? "%3f" : c == '#' ? "%23" : c == '%' ? "%25" : std::string(1, c);
  return "file:" + name + "?immutable=1";
}

// A reader opens the file for writing, too, if it may: otherwise SQLite leaves FILE-wal and
// FILE-shm when the reader is the last one that closes it.
int open(const fs::path& file, Database::Use use, sqlite3*& handle) {
  const int code = sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr);
  if (code != SQLITE_OK) return code;
  if (use == Database::Use::read)
    sqlite3_exec(handle, "PRAGMA query_only = true", nullptr, nullptr, nullptr);
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, patience);
  return sqlite3_exec(handle, "SELECT count(*) FROM sqlite_schema", nullptr, nullptr, nullptr);
}

}  // namespace

Database::Database(const fs::path& file, Use use) : file_(file) {
  require_database(file);
  int code = open(file, use, handle_);
  const int kind = code & 0xff;
  const bool still = use == Use::read && !fs::exists(file.string() + "-wal");
  if (still && (kind == SQLITE_CANTOPEN || kind == SQLITE_READONLY)) {
    sqlite3_close_v2(handle_);
    code = sqlite3_open_v2(unchanging(file).c_str(), &handle_,
                           SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  }
  if (code == SQLITE_OK) return;
  try {
    fail(code);
  } catch (...) {
    sqlite3_close_v2(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close_v2(handle_); }

void Database::run(const std::string& sql) {
  if (const int code = sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr)) fail(code);
}

std::int64_t Database::number(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.number(0) : 0;
}

void Database::fail(int code) const {
  const char* const stays = "make room, or let it be written; its rows are kept";
  const int error = handle_ ? sqlite3_system_errno(handle_) : 0;
  const std::string words = error != 0 ? log::system_error_text(error) : sqlite3_errmsg(handle_);
  switch (code & 0xff) {
    case SQLITE_FULL:
      throw log::Error(file_, "cannot be written: " + log::system_error_text(ENOSPC), stays);
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      throw log::Error(file_, "cannot be opened or written: " + words, stays);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw log::Error(file_, "another program is writing into it",
                       "let that one end, then repeat the command; its rows are kept");
    case SQLITE_NOTADB:
      refuse_other_file(file_);
    case SQLITE_CORRUPT:
      throw log::Error(file_, "is damaged: " + words, "keep a copy, and choose another name");
    default:
      throw log::Error(file_, words, "choose another name");
  }
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  const int code = sqlite3_prepare_v2(database.handle_, sql.data(), static_cast<int>(sql.size()),
                                      &handle_, nullptr);
  if (code != SQLITE_OK) database_.fail(code);
}

Statement::~Statement() { sqlite3_finalize(handle_); }

Statement& Statement::bind(std::int64_t value) {
  sqlite3_bind_int64(handle_, ++bound_, value);
  return *this;
}

Statement& Statement::bind(double value) {
  sqlite3_bind_double(handle_, ++bound_, value);
  return *this;
}

Statement& Statement::bind(const std::string& value) {
  sqlite3_bind_text(handle_, ++bound_, value.data(), static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(handle_);
  bound_ = 0;
  if (code != SQLITE_DONE) database_.fail(code);
  return false;
}

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(handle_, column); }

double Statement::real(int column) const { return sqlite3_column_double(handle_, column); }

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)))
              : "";
}

}  // namespace sinew::tune
