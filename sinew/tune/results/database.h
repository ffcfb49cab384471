// tune/results/database.h - SQLite, as far as a study needs it. No other file knows its header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace sinew::tune {

class Statement;

// Every member function throws log::Error, which names the file, what happened and what to do.
class Database {
 public:
  // To read: others may write meanwhile. Nothing is made, nothing changed.
  enum class Use { write, read };

  // Opens the file; to write it is made where it is missing.
  Database(const std::filesystem::path& file, Use use);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  // Runs statements that answer nothing.
  void run(const std::string& sql);
  std::int64_t number(const std::string& sql);  // the first cell of its answer

 private:
  friend class Statement;
  [[noreturn]] void fail(int code) const;

  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

// A statement with places ?1, ?2, … Its database must outlive it.
class Statement {
 public:
  // Prepares the statement.
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  // Fill the places in their order, from the first after each step to the end.
  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(const std::string& value);

  // Goes to the next row of the answer. Returns false behind the last one; then it can be filled
  // again.
  bool step();
  void to_the_end() {
    while (step()) {}
  }

  // Cells of this row, counted from 0.
  std::int64_t number(int column) const;
  double real(int column) const;
  std::string text(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

}  // namespace sinew::tune
