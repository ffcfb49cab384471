#include "sinew/tune/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/log/csv.h"
#include "sinew/run/folder/files.h"

namespace sinew::tune {

namespace {

// Returns a number or a flag as JSON, and other texts as a string.
Json json_cell(const std::string& cell) {
  if (cell.empty()) return nullptr;
  Json out;
  return Json::parse(cell, out) ? out : Json(cell);
}

}  // namespace

std::string csv_line(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i)
    out += (i > 0 ? "," : "") + log::csv_cell(cells[i]);
  return out + "\n";
}

std::string json_of(const std::vector<std::string>& headings, const std::vector<Row>& rows) {
  Json out{{"format", "sinew.sweep/1"}, {"rows", Json::array()}};
  for (const Row& row : rows) {
    Json entry = Json::object();
    for (std::size_t i = 0; i < headings.size(); ++i) entry[headings[i]] = json_cell(row.cells[i]);
    out["rows"].push_back(std::move(entry));
  }
  return out.text(2) + "\n";
}

TableFile::TableFile(const std::filesystem::path& file, std::vector<std::string> headings,
                     bool force, const std::vector<std::filesystem::path>& inputs,
                     const run::FileKind& kind)
    : name_(file), headings_(std::move(headings)) {
  run::refuse_to_overwrite(name_, force, kind, inputs);
  run::require_folder_of(name_);
  log::require_free_part(name_);
}

TableFile::TableFile(std::vector<std::string> headings, std::function<void(std::string_view)> print)
    : headings_(std::move(headings)), print_(std::move(print)) {}

bool TableFile::add(const std::vector<std::string>& cells) noexcept {
  if (failure_) return false;
  try {
    const std::string text = (begun_ ? "" : csv_line(headings_)) + csv_line(cells);
    begun_ = true;
    if (print_) {
      print_(text);
      return true;
    }
    if (!file_) file_.emplace(name_, log::Replacement::Sync::now, log::Replacement::Part::kept);
    file_->write(text);
  } catch (...) {
    failure_ = std::current_exception();
  }
  return !failure_;
}

void TableFile::throw_failure() const {
  if (!failure_) return;
  try {
    std::rethrow_exception(failure_);
  } catch (const std::exception& e) {
    throw std::runtime_error(
        e.what() + (file_ ? "\n" + part() + ": holds the rows that are done" : std::string()));
  }
}

void TableFile::take_place() {
  if (file_) file_->commit();
}

void write_table(const std::string& file, const std::vector<std::string>& headings,
                 const std::vector<std::vector<std::string>>& rows, bool force,
                 const std::vector<std::filesystem::path>& inputs, const run::FileKind& kind) {
  if (file.empty()) return;
  TableFile csv(file, headings, force, inputs, kind);
  for (const std::vector<std::string>& row : rows) csv.add(row);
  csv.throw_failure();
  csv.take_place();
}

std::vector<std::string> warnings(const std::vector<Row>& rows) {
  std::vector<std::string> out;
  const auto part =
      std::ranges::count_if(rows, [](const Row& row) { return !row.notes.lacks.empty(); });
  if (part > 0)
    out.push_back(
        fmt::format("{} of {} rows lack a figure; their status names it", part, rows.size()));
  const auto bad = std::ranges::count_if(rows, [](const Row& row) { return !row.ok; });
  if (bad > 0)
    out.push_back(fmt::format("{} of {} rows have no figures; their status has the reason", bad,
                              rows.size()));
  const auto ended =
      std::ranges::count_if(rows, [](const Row& row) { return row.notes.stop_reached; });
  if (ended > 0)
    out.push_back(
        fmt::format("in {} of {} rows the trolley reaches the end of its track; distance and mean "
                    "speed are up to there",
                    ended, rows.size()));
  const auto idle = std::ranges::count_if(rows, [](const Row& row) { return row.notes.no_air; });
  if (idle > 0)
    out.push_back(fmt::format("in {} of {} rows no muscle takes any air: the robot does nothing",
                              idle, rows.size()));
  return out;
}

void refuse_empty_columns(const std::vector<Row>& rows, const Sweep& s) {
  std::vector<config::Problem> problems;
  for (const std::string& key : keys(s)) {
    const auto has = [&](const Row& row) {
      return row.ok && std::ranges::find(row.notes.lacks, key) == row.notes.lacks.end();
    };
    const auto lacks = [&](const Row& row) {
      return std::ranges::find(row.notes.lacks, key) != row.notes.lacks.end();
    };
    if (std::ranges::any_of(rows, lacks) && std::ranges::none_of(rows, has))
      problems.push_back(config::Problem{.where = config::Location{key, 0, 0},
                                         .key = {},
                                         .found = "no run with it",
                                         .expected = "a key of the runs' summary.json",
                                         .try_this = "sinew run, whose summary.json has them all"});
  }
  if (!problems.empty()) throw config::Error(problems);
  if (!rows.empty() && std::ranges::none_of(rows, &Row::ok))
    throw std::runtime_error("no row has figures; the first one's status: " +
                             rows.front().cells.back());
}

}  // namespace sinew::tune
