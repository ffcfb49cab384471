#include "sinew/tune/results/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "sinew/json/json.h"
#include "sinew/log/error.h"
#include "sinew/run/folder/refusal.h"
#include "sinew/tune/results/results.h"
#include "sinew/units/hash.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t application = 0x53696e77;  // "Sinw", by which `file` and SQLite tell it

const char* const tables =
    "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE heading (number INTEGER PRIMARY KEY, heading TEXT NOT NULL,"
    "  name TEXT NOT NULL, is_number INTEGER NOT NULL, role TEXT NOT NULL);"
    "CREATE TABLE result (point INTEGER PRIMARY KEY, ok INTEGER NOT NULL,"
    "  stop_reached INTEGER NOT NULL, no_air INTEGER NOT NULL, out_of_reach INTEGER NOT NULL,"
    "  lacks TEXT NOT NULL, differs TEXT NOT NULL, cells TEXT NOT NULL,"
    "  checksum TEXT NOT NULL);";

// Of a tuning alone.
const char* const tables_of_candidates =
    "CREATE TABLE candidate_heading (number INTEGER PRIMARY KEY, heading TEXT NOT NULL,"
    "  name TEXT NOT NULL, is_number INTEGER NOT NULL, role TEXT NOT NULL);"
    "CREATE TABLE candidate_result (candidate INTEGER PRIMARY KEY, generation INTEGER NOT NULL,"
    "  feasible INTEGER NOT NULL, violation REAL NOT NULL, holds REAL NOT NULL,"
    "  cells TEXT NOT NULL, checksum TEXT NOT NULL);";

constexpr std::string_view of_runs = "point, ok, stop_reached, no_air, out_of_reach";
constexpr std::string_view of_candidates = "candidate, generation, feasible, violation, holds";

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// SQLite's names do not tell letters by their case. `own` are the view's other names.
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

// A view of a table whose column `cells` is a list of texts; `own` are the table's other columns.
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
        .bind(std::string(to_text(columns[i].role)))
        .to_the_end();
}

std::vector<Column> columns_of(Database& database, const char* table) {
  constexpr int last_role = static_cast<int>(Column::Role::other);
  std::vector<Column> out;
  Statement headings(database,
                     fmt::format("SELECT heading, is_number, role FROM {} ORDER BY number", table));
  while (headings.step()) {
    out.push_back({headings.text(0), headings.number(1) != 0});
    for (int role = 0; role < last_role; ++role)
      if (headings.text(2) == to_text(static_cast<Column::Role>(role)))
        out.back().role = static_cast<Column::Role>(role);
  }
  return out;
}

std::string value_of(Database& database, const std::string& key) {
  Statement select(database, "SELECT value FROM study WHERE key = ?1");
  return select.bind(key).step() ? select.text(0) : "";
}

// A file that lacks them may be of a Sinew that did not keep them.
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
  throw log::Error(file, "is damaged: its cases cannot be read",
                   "keep a copy, and choose another name");
}

std::string json_of(const std::vector<Case>& cases) {
  Json out = Json::array();
  for (const Case& one : cases)
    out.push_back({{"experiment", one.experiment},
                   {"name", one.name},
                   {"sets", one.sets},
                   {"weight", one.weight}});
  return out.text();
}

// Returns the checksum of all but the rows: of the request, the headings and the tables themselves.
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

}  // namespace

void write_checksum(Database& database) {
  const bool tuning = value_of(database, "kind") == "tuning";
  Statement fact(database, "INSERT OR REPLACE INTO study VALUES ('checksum', ?1)");
  fact.bind(checksum_of(database, tuning)).to_the_end();
}

bool has_study(Database& database, const fs::path& file) {
  const std::int64_t owner = database.number("PRAGMA application_id");
  const std::int64_t format = database.number("PRAGMA user_version");
  if (owner == 0 && database.number("SELECT count(*) FROM sqlite_schema") == 0) return false;
  if (owner != application)
    run::refuse(file, "a database of another program", "a study's file",
                "another name, or to remove it first");
  if (format > study_format)
    run::refuse(file, fmt::format("a study's file of format {}", format),
                fmt::format("format {}", study_format),
                "a newer Sinew: the file was written by one");
  if (format < study_format)
    run::refuse(file, fmt::format("a study's file of format {}", format),
                fmt::format("format {}", study_format),
                "another name: an older Sinew wrote it, and any SQLite program still reads it");
  return true;
}

void make_tables(Database& database, const Asked& asked) {
  database.run("PRAGMA journal_mode = WAL");
  database.run("BEGIN IMMEDIATE");
  database.run(tables);
  Statement fact(database, "INSERT INTO study VALUES (?1, ?2)");
  const auto say = [&](const char* key, const std::string& value) {
    fact.bind(std::string(key)).bind(value).to_the_end();
  };
  say("format", fmt::format("sinew.study/{}", study_format));
  say("sinew_version", SINEW_VERSION);
  say("kind", asked.of_candidates.empty() ? "sweep" : "tuning");
  say("title", asked.title);
  say("experiment", asked.experiment);
  say("sets", json_of(asked.sets));
  say("cases", json_of(asked.cases));
  say("points", std::to_string(asked.points));
  say("hash", hash_of(asked));
  say("asked", asked.text);
  const std::vector<std::string> names = names_of(asked.columns, of_runs);
  make_headings(database, "heading", asked.columns, names);
  database.run(view_of("run", "result", of_runs, asked.columns, names));
  if (!asked.of_candidates.empty()) {
    database.run(tables_of_candidates);
    const std::vector<std::string> theirs = names_of(asked.of_candidates, of_candidates);
    make_headings(database, "candidate_heading", asked.of_candidates, theirs);
    database.run(
        view_of("candidate", "candidate_result", of_candidates, asked.of_candidates, theirs));
  }
  write_checksum(database);
  database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT",
                           application, study_format));
}

Asked study_of(Database& database, const fs::path& file) {
  Asked out{.text = value_of(database, "asked"),
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
    throw log::Error(file, "is damaged: what it was asked for cannot be read",
                     "keep a copy, and choose another name");
  return out;
}

std::string json_of(const std::vector<std::string>& texts) { return Json(texts).text(); }

std::vector<std::string> texts_of(const std::string& json, const fs::path& file) {
  Json list;
  (void)Json::parse(json, list);
  const auto is_text = [](const Json& item) { return item.is_string(); };
  if (list.is_array() && std::ranges::all_of(list, is_text)) return list.strings();
  throw log::Error(file, "is damaged: a list of texts cannot be read",
                   "keep a copy, and choose another name");
}

}  // namespace sinew::tune
