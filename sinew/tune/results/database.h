// tune/results/database.h - SQLite as used by a study. Only database.cpp includes its header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace sinew::tune {

class Statement;

// Every member function throws log::Error with the name of the file, the fault and the remedy.
class Database {
 public:
  // read: others may write meanwhile, and no row is changed. FILE-wal and FILE-shm may be left if
  // the folder may be written to and the file may not.
  enum class Use { write, read };

  // Opens the file; to write, creates it if it is missing.
  Database(const std::filesystem::path& file, Use use);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  // Executes statements without a result.
  void run(const std::string& sql);
  std::int64_t number(const std::string& sql);  // returns the first cell of the result

 private:
  friend class Statement;
  [[noreturn]] void fail(int code) const;

  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

// A statement with parameters ?1, ?2, … Its database must outlive it.
class Statement {
 public:
  // Prepares the statement.
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  // Bind the parameters in their order, from the first one on after each complete execution.
  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(const std::string& value);

  // Steps to the next row of the result. Returns false after the last one; then the parameters can
  // be bound again.
  bool step();
  void to_the_end() {
    while (step()) {}
  }

  // Return cells of the present row, counted from 0.
  std::int64_t number(int column) const;
  double real(int column) const;
  std::string text(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

}  // namespace sinew::tune
