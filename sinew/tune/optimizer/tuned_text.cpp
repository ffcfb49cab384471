#include "sinew/tune/optimizer/tuned_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"

namespace sinew::tune {
namespace {

constexpr std::size_t most_shown = 12;  // candidates of a front, side by side

// Returns evenly spaced candidates of the front, with both ends.
std::vector<std::size_t> shown_of(const std::vector<std::size_t>& front) {
  if (front.size() <= most_shown) return front;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < most_shown; ++i)
    out.push_back(front[i * (front.size() - 1) / (most_shown - 1)]);
  return out;
}

const Candidate& closest(const std::vector<Candidate>& candidates) {
  return *std::ranges::min_element(candidates, {},
                                   [](const Candidate& c) { return c.evaluation.violation; });
}

std::string cell(double number) {
  return std::isfinite(number) ? fmt::format("{:.4g}", number) : "-";
}

double number_of(const Value& value) {
  double number = 0;
  std::from_chars(value.cell.data(), value.cell.data() + value.cell.size(), number);
  return number;
}

// Conversion from the unit of a row's numbers to the one in which they are shown.
struct RowUnit {
  std::string name;  // empty: no unit
  units::ShownUnit from, to;

  double of(double number) const { return to.of(from.back(number)); }
};

// `named`: the file has the unit.
RowUnit row_unit(const std::string& unit, bool named, const TableUnits* shown, double room) {
  RowUnit out{unit, {}, {}};
  if (!shown || (named && !shown->of_all)) return out;
  const std::optional<units::QuantityUnit> given = units::read_quantity_unit(unit, room);
  if (!given) return out;
  const units::ShownUnit to = shown->units.of(given->stored, units::ShownUnits::unknown_size, room);
  return {to.name, given->unit, to};
}

std::string heading_of(const std::string& key, const std::string& unit) {
  return unit.empty() || unit == "1" ? key : fmt::format("{} [{}]", key, unit);
}

// Returns "trolley.mean_speed >= 76.2 mm/s", or the text as written if its unit is kept.
std::string text_of(const Limit& limit, const RowUnit& unit) {
  if (unit.to.name.empty()) return limit.text;
  const char* const signs[] = {"<", "<=", ">", ">="};
  return fmt::format("{} {} {:.4g} {}", analysis::without_unit(limit.figure.key),
                     signs[static_cast<int>(limit.is)], unit.of(limit.limit), unit.name);
}

// Returns a table with a line for each goal, limit and tuned key, and a column for each candidate.
std::string table_of(const Tuning& tuning, const std::vector<const Candidate*>& candidates,
                     const TableUnits* shown) {
  using report::TextTable;
  std::vector<std::string> titles{""};
  for (const Candidate* c : candidates)
    titles.push_back(c->number == 0 ? "as it is" : fmt::format("candidate {}", c->number));
  std::vector<TextTable::Align> align(titles.size(), TextTable::Align::right);
  align.front() = TextTable::Align::left;
  TextTable table(titles, align);
  const auto add = [&](const std::string& name, const auto& cell_of) {
    std::vector<std::string> row{name};
    for (const Candidate* c : candidates) row.push_back(cell_of(*c));
    table.add(std::move(row));
  };
  const Goals& goals = tuning.goals;
  const double room = tuning.atmosphere;
  for (std::size_t i = 0; i < goals.goals.size(); ++i) {
    const Figure& figure = goals.goals[i].figure;
    const RowUnit unit = row_unit(figure.unit, figure.named, shown, room);
    const bool plain = figure.unit == "1";
    add((goals.goals[i].maximize ? "maximize  " : "minimize  ") +
            (plain ? figure.key
                   : heading_of(std::string(analysis::without_unit(figure.key)), unit.name)),
        [&](const Candidate& c) { return cell(unit.of(c.evaluation.goals[i])); });
  }
  for (std::size_t i = 0; i < goals.limits.size(); ++i) {
    const RowUnit unit = row_unit(goals.limits[i].figure.unit, true, shown, room);
    add("where     " + text_of(goals.limits[i], unit),
        [&](const Candidate& c) { return cell(unit.of(c.evaluation.limits[i])); });
  }
  if (!goals.limits.empty())
    add("          holds [%]", [](const Candidate& c) { return cell(100 * c.evaluation.holds); });
  for (std::size_t i = 0; i < tuning.tuned; ++i) {
    const Axis& axis = tuning.runs.sample->ranges[i].axis;
    const RowUnit unit = row_unit(axis.unit, true, shown, room);
    add("          " + heading_of(axis.key, unit.name),
        [&](const Candidate& c) { return fmt::format("{:.5g}", unit.of(number_of(c.values[i]))); });
  }
  return table.text();
}

Json json_of(const Tuning& tuning, const Candidate& candidate) {
  Json out{{"candidate", candidate.number},
           {"generation", candidate.generation},
           {"feasible", candidate.evaluation.feasible()},
           {"violation", candidate.evaluation.violation},
           {"holds", candidate.evaluation.holds}};
  for (std::size_t i = 0; i < tuning.goals.goals.size(); ++i)
    out["goals"][tuning.goals.goals[i].figure.heading()] = candidate.evaluation.goals[i];
  for (std::size_t i = 0; i < tuning.goals.limits.size(); ++i)
    out["limits"][tuning.goals.limits[i].text] = candidate.evaluation.limits[i];
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    out["set"][tuning.runs.sample->ranges[i].axis.key] = candidate.values[i].text;
  return out;
}

std::string count(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

// Returns a line for each number of a candidate that is within a hundredth of its range from an
// end, since a wider range may contain a better one.
std::string ends_of(const Tuning& tuning, const Candidate& candidate) {
  constexpr double near = 0.01;
  std::string out;
  for (std::size_t i = 0; i < tuning.tuned; ++i) {
    const Range& range = tuning.runs.sample->ranges[i];
    if (range.scale == Range::Scale::whole) continue;
    const double share = range.share_of(number_of(candidate.values[i]));
    if (share > near && share < 1 - near) continue;
    out += fmt::format(
        "candidate {}: {} is at the {} end of its range; a wider one may be better\n",
        candidate.number, range.axis.set(candidate.values[i]), share < 0.5 ? "lower" : "upper");
  }
  return out;
}

}  // namespace

std::string text_of(const Tuning& tuning, const Tuned& tuned, const TableUnits* shown) {
  if (tuned.candidates.empty()) return "no generation is whole\n";
  std::string out = fmt::format("{}: {} in {}, {} each{}\n", tuning.title,
                                count(tuned.candidates.size(), "candidate"),
                                count(tuned.candidates.back().generation + 1, "generation"),
                                count(tuning.runs_of_candidate(), "run"),
                                tuned.converged ? "; the method has converged" : "");
  std::vector<const Candidate*> columns{&tuned.candidates.front()};
  if (tuned.best.empty()) {
    out += "nothing keeps every limit; the closest:\n";
    columns.push_back(&closest(tuned.candidates));
    return out + table_of(tuning, columns, shown);
  }
  if (tuning.goals.goals.size() > 1)
    out += fmt::format("{} on the front{}\n", count(tuned.best.size(), "candidate"),
                       tuned.best.size() > most_shown ? ", of which these" : "");
  for (const std::size_t i : shown_of(tuned.best))
    if (i != 0) columns.push_back(&tuned.candidates[i]);
  out += table_of(tuning, columns, shown);
  for (const std::size_t i : shown_of(tuned.best)) out += ends_of(tuning, tuned.candidates[i]);
  return out;
}

std::string json_of(const Tuning& tuning, const Tuned& tuned) {
  Json out{{"format", "sinew.tuned/1"},
           {"title", tuning.title},
           {"candidates", tuned.candidates.size()},
           {"generations", tuned.candidates.empty() ? 0 : tuned.candidates.back().generation + 1},
           {"runs_of_a_candidate", tuning.runs_of_candidate()},
           {"converged", tuned.converged}};
  if (!tuned.candidates.empty()) out["as_it_is"] = json_of(tuning, tuned.candidates.front());
  out["best"] = Json::array();
  for (const std::size_t i : tuned.best)
    out["best"].push_back(json_of(tuning, tuned.candidates[i]));
  if (tuned.best.empty() && !tuned.candidates.empty())
    out["closest"] = json_of(tuning, closest(tuned.candidates));
  return out.text(2) + "\n";
}

std::vector<std::string> candidate_headings(const Tuning& tuning) {
  std::vector<std::string> out{"candidate", "generation", "feasible", "violation", "holds"};
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    out.push_back(tuning.runs.sample->ranges[i].axis.heading());
  for (const Goal& goal : tuning.goals.goals) out.push_back(goal.figure.heading());
  for (const Limit& limit : tuning.goals.limits) out.push_back(limit.text);
  return out;
}

std::vector<std::string> candidate_cells(const Candidate& candidate) {
  CandidateRow row = row_of(candidate);
  std::vector<std::string> out{
      std::to_string(row.number), std::to_string(row.generation), row.feasible ? "true" : "false",
      fmt::format("{:.9g}", row.violation), fmt::format("{:.9g}", row.holds)};
  out.insert(out.end(), row.cells.begin(), row.cells.end());
  return out;
}

}  // namespace sinew::tune
