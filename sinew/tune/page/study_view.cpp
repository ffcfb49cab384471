#include "sinew/tune/page/study_view.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "sinew/config/diagnostics.h"
#include "sinew/tune/page/asked_facts.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {
namespace {

namespace fs = std::filesystem;

// A study of "experiments/leg-in-air.toml": "leg in air".
std::string title_of(const std::string& experiment) {
  std::string out = fs::path(experiment).stem().string();
  std::ranges::replace(out, '-', ' ');
  if (!out.empty()) out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

// "joint.hip.angle_gain [%/count]" of "0.02": "joint.hip.angle_gain=0.02 %/count".
std::string set_of(const StudyColumn& column, const std::string& cell) {
  const std::size_t unit = column.number ? column.heading.find(" [") : std::string::npos;
  if (unit == std::string::npos || !column.heading.ends_with(']'))
    return column.heading + "=" + cell;
  return column.heading.substr(0, unit) + "=" + cell + " " +
         column.heading.substr(unit + 2, column.heading.size() - unit - 3);
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
  HeldStudy held = read_results(file);
  StudyView out{.title = title_of(held.asked.experiment),
                .kind = "sweep",
                .experiment = held.asked.experiment,
                .file = file.filename().string(),
                .columns = columns_with_roles(held.asked),
                .rows = {},
                .expected = held.asked.points,
                .asked = held.asked.text,
                .version = fact(held.asked, "sinew"),
                .sets = sets_of(held.asked),
                .allow_unreachable = fact(held.asked, "allow_unreachable") == "true"};
  out.rows.reserve(held.rows.size());
  for (Row& row : held.rows)
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
      out.experiment = beside({.experiment = study.experiment}, row->cells[i]);
    else
      out.sets.push_back(set_of(column, row->cells[i]));
  }
  return out;
}

}  // namespace sinew::tune
