
#include "sinew/json/json.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/page_template.h"
#include "sinew/tune/page/study_view.h"

namespace sinew::tune {
namespace {

std::string text_of(const Json& json) { return json.text(); }

const char* to_text(StudyColumn::Role role) {
  using Role = StudyColumn::Role;
  if (role == Role::parameter) return "parameter";
  if (role == Role::objective) return "objective";
  if (role == Role::constraint) return "constraint";
  return role == Role::figure ? "figure" : "other";
}

// A row is a list: there may be ten thousand.
Json json_of(const std::vector<StudyRow>& rows) {
  Json out = Json::array();
  for (const StudyRow& row : rows)
    out.push_back({row.number, row.ok ? 1 : 0, row.generation, row.violation, row.cells});
  return out;
}

Json json_of(const StudyView& study) {
  Json columns = Json::array();
  for (const StudyColumn& c : study.columns)
    columns.push_back({{"heading", c.heading},
                       {"number", c.number},
                       {"role", to_text(c.role)},
                       {"maximize", c.maximize},
                       {"set", c.set || c.role == StudyColumn::Role::parameter}});
  Json cases = Json::array();
  for (const Case& one : study.cases)
    cases.push_back({{"name", one.name}, {"experiment", one.experiment}, {"sets", one.sets}});
  return {{"title", study.title},
          {"kind", study.kind},
          {"experiment", study.experiment},
          {"file", study.file},
          {"version", study.version},
          {"expected", study.expected},
          {"sets", study.sets},
          {"cases", std::move(cases)},
          {"allow_unreachable", study.allow_unreachable},
          {"asked", study.asked},
          {"columns", std::move(columns)},
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
