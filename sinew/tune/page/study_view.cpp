#include "sinew/tune/page/study_view.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/report/page/page.h"
#include "sinew/tune/results/request.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {

namespace {

// --- facts from the text of a study (results/) ---

// Returns "KEY [unit]: values" of "vary = KEY [unit]: values"; nothing for a line of another name.
std::optional<std::string> value_after(const std::string& line, const std::string& name) {
  const std::string begin = name + " = ";
  if (!line.starts_with(begin)) return std::nullopt;
  return line.substr(begin.size());
}

// Returns the value of a fact, "0.1.0" of `sinew`; empty if it does not exist.
std::string fact(const StudyRequest& request, const std::string& name) {
  std::istringstream lines(request.text);
  for (std::string line; std::getline(lines, line);)
    if (const auto value = value_after(line, name)) return *value;
  return "";
}

// Returns how many facts have that name.
std::size_t count(const StudyRequest& request, const std::string& name) {
  std::size_t out = 0;
  std::istringstream lines(request.text);
  for (std::string line; std::getline(lines, line);) out += value_after(line, name) ? 1 : 0;
  return out;
}

namespace fs = std::filesystem;

// Returns "Leg in air" for "experiments/leg-in-air.toml".
std::string title_of(const std::string& experiment) {
  std::string out = fs::path(experiment).stem().string();
  std::ranges::replace(out, '-', ' ');
  if (!out.empty()) out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

// Returns "joint.hip.angle_gain=0.02 %/count" for "joint.hip.angle_gain [%/count]" and "0.02".
std::string set_of(const StudyColumn& column, const std::string& cell) {
  const std::size_t unit = column.number ? column.heading.find(" [") : std::string::npos;
  if (unit == std::string::npos || !column.heading.ends_with(']'))
    return column.heading + "=" + cell;
  return column.heading.substr(0, unit) + "=" + cell + " " +
         column.heading.substr(unit + 2, column.heading.size() - unit - 3);
}

StudyColumn shown(const Column& column) {
  using From = Column::Role;
  using To = StudyColumn::Role;
  StudyColumn out{.heading = column.heading, .number = column.number};
  out.set = column.role == From::parameter || column.role == From::circumstance;
  out.maximize = column.role == From::maximize;
  if (column.role == From::parameter) out.role = To::parameter;
  if (column.role == From::figure) out.role = To::figure;
  if (column.role == From::maximize || column.role == From::minimize) out.role = To::objective;
  if (column.role == From::limit) out.role = To::constraint;
  return out;
}

// Returns the columns of a sweep. The key that is searched is a result of the search and a
// setting of its run.
std::vector<StudyColumn> columns_of_runs(const StudyRequest& request) {
  const std::string searched = fact(request, "largest");
  std::vector<StudyColumn> out;
  for (const Column& column : request.columns) {
    out.push_back(shown(column));
    if (!searched.starts_with(column.heading + ": ")) continue;
    out.back().role = StudyColumn::Role::figure;
    out.back().set = true;
  }
  return out;
}

// Returns the columns of a tuning. A figure that is both a goal and a limit has two
// columns; that of the limit is the worst run's.
std::vector<StudyColumn> columns_of_candidates(const StudyRequest& request) {
  std::vector<StudyColumn> out;
  for (const Column& column : request.of_candidates) {
    StudyColumn next = shown(column);
    if (std::ranges::find(out, next.heading, &StudyColumn::heading) != out.end()) {
      const std::size_t unit = std::min(next.heading.find(" ["), next.heading.size());
      next.heading.insert(unit, " worst");
    }
    out.push_back(std::move(next));
  }
  return out;
}

// Returns the product of the numbers of seeds, draws and cases.
std::size_t runs_of_a_candidate(const StudyRequest& request) {
  const std::string draws = fact(request, "draws"), seeds = fact(request, "vary");
  const auto number = static_cast<std::size_t>(std::atoll(draws.c_str()));
  const auto commas = static_cast<std::size_t>(std::ranges::count(seeds, ','));
  return std::max<std::size_t>(1, number) * (commas + 1) *
         std::max<std::size_t>(1, count(request, "case"));
}

StudyRow row_of(CandidateRow row, const std::vector<StudyColumn>& columns) {
  StudyRow out{.cells = std::move(row.cells),
               .number = row.number,
               .generation = static_cast<int>(row.generation),
               .violation = row.violation};
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].role == StudyColumn::Role::objective && !out.cells[i].empty()) out.ok = true;
  return out;
}

}  // namespace

bool is_study(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return file.extension() == ".db";
  constexpr std::string_view begins = "SQLite format 3";
  std::string head(begins.size(), ' ');
  std::ifstream(file, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == begins || file.extension() == ".db";
}

StudyView study_view(const fs::path& file) {
  StoredStudy held = read_results(file);
  const StudyRequest& request = held.request;
  const bool tune = !request.of_candidates.empty();
  StudyView out{.title = request.title.empty() ? title_of(request.experiment) : request.title,
                .kind = tune ? "tune" : "sweep",
                .experiment = request.experiment,
                .file = file.filename().string(),
                .columns = tune ? columns_of_candidates(request) : columns_of_runs(request),
                .rows = {},
                .expected = tune ? request.points / runs_of_a_candidate(request) : request.points,
                .request = request.text,
                .version = fact(request, "sinew"),
                .sets = request.sets,
                .allow_unreachable = fact(request, "allow_unreachable") == "true"};
  out.cases = request.cases;
  for (Case& one : out.cases) {
    if (one.experiment.empty()) one.experiment = request.experiment;
    one.sets.insert(one.sets.begin(), request.sets.begin(), request.sets.end());
  }
  for (CandidateRow& row : held.candidates) out.rows.push_back(row_of(std::move(row), out.columns));
  for (Row& row : held.rows)
    if (!tune)
      out.rows.push_back({.cells = std::move(row.cells), .number = row.point, .ok = row.ok});
  return out;
}

StudyRun run_of(const StudyView& study, std::size_t number) {
  const auto row = std::ranges::find(study.rows, number, &StudyRow::number);
  if (row == study.rows.end())
    config::fail({study.file, 0, 0}, "", "no row " + std::to_string(number),
                 "one of " + std::to_string(study.rows.size()) + " rows that are there");
  StudyRun out{study.experiment, study.sets, study.allow_unreachable};
  for (std::size_t i = 0; i < study.columns.size(); ++i) {
    const StudyColumn& column = study.columns[i];
    if (!column.set && column.role != StudyColumn::Role::parameter) continue;
    if (row->cells[i].empty()) continue;
    if (column.heading == "experiment")
      out.experiment = experiment_path({.experiment = study.experiment}, row->cells[i]);
    else
      out.sets.push_back(set_of(column, row->cells[i]));
  }
  return out;
}

namespace {

std::string text_of(const Json& json) { return json.text(); }

const char* to_text(StudyColumn::Role role) {
  using Role = StudyColumn::Role;
  if (role == Role::parameter) return "parameter";
  if (role == Role::objective) return "objective";
  if (role == Role::constraint) return "constraint";
  return role == Role::figure ? "figure" : "other";
}

// Rows are lists, since there may be ten thousand.
Json json_of(const std::vector<StudyRow>& rows) {
  return Json::array(rows, [](const StudyRow& row) -> Json {
    return {row.number, row.ok ? 1 : 0, row.generation, row.violation, row.cells};
  });
}

Json json_of(const StudyView& study) {
  const auto column = [](const StudyColumn& c) -> Json {
    return {{"heading", c.heading},
            {"number", c.number},
            {"role", to_text(c.role)},
            {"maximize", c.maximize},
            {"set", c.set || c.role == StudyColumn::Role::parameter}};
  };
  const auto case_of = [](const Case& one) -> Json {
    return {{"name", one.name}, {"experiment", one.experiment}, {"sets", one.sets}};
  };
  return {{"title", study.title},
          {"kind", study.kind},
          {"experiment", study.experiment},
          {"file", study.file},
          {"version", study.version},
          {"expected", study.expected},
          {"sets", study.sets},
          {"cases", Json::array(study.cases, case_of)},
          {"allow_unreachable", study.allow_unreachable},
          {"asked", study.request},
          {"columns", Json::array(study.columns, column)},
          {"rows", json_of(study.rows)}};
}

Json json_of(const std::vector<StudyView>& studies) {
  Json out = {{"format", "sinew.study_page/1"}, {"studies", Json::array()}};
  for (const StudyView& study : studies) out["studies"].push_back(json_of(study));
  return out;
}

std::string filled(const std::vector<StudyView>& studies, const Json& json,
                   const std::string& connect) {
  report::require_page("the page of a study");
  std::string title = studies.front().title;
  if (studies.size() > 1) title += " and " + studies[1].title;
  return report::fill(report::study_template(), {title, text_of(json), "", connect});
}

}  // namespace

std::string study_json(const StudyView& study) { return text_of(json_of(std::vector{study})); }

std::string rows_json(const std::vector<StudyRow>& rows) { return text_of(json_of(rows)); }

std::string study_page(const StudyView& study) { return study_page(std::vector{study}); }

std::string study_page(const std::vector<StudyView>& studies) {
  return filled(studies, json_of(studies), "");
}

std::string study_page_of(const std::vector<std::filesystem::path>& files) {
  std::vector<StudyView> studies;
  for (const std::filesystem::path& file : files) studies.push_back(study_view(file));
  return study_page(studies);
}

std::string study_page(const std::vector<StudyView>& studies, const StudyServer& server) {
  Json json = json_of(studies);
  json["served"] = true;
  json["known"] = server.known;
  return filled(studies, json, "; connect-src 'self'");
}

}  // namespace sinew::tune
