#include "sinew/tune/results/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "sinew/log/error.h"
#include "sinew/run/folder/refusal.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t application = 0x53696e77;  // "Sinw", by which `file` and SQLite tell it

const char* const tables =
    "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE heading (number INTEGER PRIMARY KEY, heading TEXT NOT NULL,"
    "  name TEXT NOT NULL, is_number INTEGER NOT NULL);"
    "CREATE TABLE result (point INTEGER PRIMARY KEY, ok INTEGER NOT NULL,"
    "  stop_reached INTEGER NOT NULL, no_air INTEGER NOT NULL, out_of_reach INTEGER NOT NULL,"
    "  lacks TEXT NOT NULL, differs TEXT NOT NULL, cells TEXT NOT NULL);";

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// SQLite's names do not tell letters by their case.
std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::set<std::string> taken{"point", "ok", "stop_reached", "no_air", "out_of_reach"};
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

std::string view_of(const std::vector<Column>& columns, const std::vector<std::string>& names) {
  std::string out = "CREATE VIEW run AS SELECT point";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string cell = fmt::format("nullif(json_extract(cells, '$[{}]'), '')", i);
    out += fmt::format(", {} AS {}",
                       columns[i].number ? fmt::format("CAST({} AS NUMERIC)", cell) : cell,
                       quoted(names[i]));
  }
  return out + ", ok, stop_reached, no_air, out_of_reach FROM result";
}

std::string value_of(Database& database, const std::string& key) {
  Statement select(database, "SELECT value FROM study WHERE key = ?1");
  return select.bind(key).step() ? select.text(0) : "";
}

}  // namespace

bool has_study(Database& database, const fs::path& file) {
  const std::int64_t owner = database.number("PRAGMA application_id");
  const std::int64_t format = database.number("PRAGMA user_version");
  if (owner == 0 && database.number("SELECT count(*) FROM sqlite_schema") == 0) return false;
  if (owner != application)
    run::refuse(file, "a database of another program", "a study's file",
                "another name, or to remove it first");
  if (format > study_format)
    run::refuse(file, fmt::format("a study's file of format {}", format),
                fmt::format("format {} or older", study_format),
                "a newer Sinew: the file was written by one");
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
  say("experiment", asked.experiment);
  say("points", std::to_string(asked.points));
  say("hash", hash_of(asked));
  say("asked", asked.text);
  const std::vector<std::string> names = names_of(asked.columns);
  Statement heading(database, "INSERT INTO heading VALUES (?1, ?2, ?3, ?4)");
  for (std::size_t i = 0; i < names.size(); ++i)
    heading.bind(static_cast<std::int64_t>(i))
        .bind(asked.columns[i].heading)
        .bind(names[i])
        .bind(std::int64_t{asked.columns[i].number})
        .to_the_end();
  database.run(view_of(asked.columns, names));
  database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT",
                           application, study_format));
}

Asked study_of(Database& database, const fs::path& file) {
  Asked out{.text = value_of(database, "asked"),
            .columns = {},
            .points = 0,
            .experiment = value_of(database, "experiment")};
  out.points = static_cast<std::size_t>(
      database.number("SELECT CAST(value AS INTEGER) FROM study WHERE key = 'points'"));
  Statement headings(database, "SELECT heading, is_number FROM heading ORDER BY number");
  while (headings.step()) out.columns.push_back({headings.text(0), headings.number(1) != 0});
  if (hash_of(out) != value_of(database, "hash") || out.points > most_points)
    throw log::Error(file, "is damaged: what it was asked for cannot be read",
                     "keep a copy, and choose another name");
  return out;
}

}  // namespace sinew::tune
