#include "sinew/tune/optimizer/tuned_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/compose.h"
#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"

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
    add("          " + heading_of(axis.key, unit.name), [&](const Candidate& c) {
      return fmt::format("{:.5g}", unit.of(units::split_number(c.values[i].cell).number));
    });
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
    const double share = range.share_of(units::split_number(candidate.values[i].cell).number);
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

namespace {

[[noreturn]] void refuse_candidate(const std::string& found, std::size_t all) {
  config::fail({"candidate", 0, 0}, "", found, fmt::format("the number of one, 0 to {}", all - 1),
               "one of the table's");
}

}  // namespace

void require_candidate(const Tuning& tuning, int number) {
  const std::size_t all = tuning.method.population * tuning.generations;
  if (number >= 0 && static_cast<std::size_t>(number) >= all)
    refuse_candidate(std::to_string(number), all);
  if (const std::size_t goals = tuning.goals.goals.size(); number < 0 && goals > 1)
    refuse_candidate(fmt::format("{} goals, for which no single candidate is the best", goals),
                     all);
}

const Candidate& candidate_of(const Tuned& tuned, int number) {
  const std::size_t all = tuned.candidates.size();
  const auto wanted = static_cast<std::size_t>(number);
  if (number < 0 && tuned.best.size() == 1) return tuned.candidates[tuned.best.front()];
  if (number >= 0 && wanted < all) return tuned.candidates[wanted];
  refuse_candidate(
      number < 0 ? fmt::format("{} best candidates", tuned.best.size()) : std::to_string(wanted),
      all);
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

namespace {

namespace fs = std::filesystem;
using config::Node;

std::string from_folder_of(const fs::path& file, const fs::path& to) {
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  return fs::absolute(to).lexically_normal().lexically_relative(folder).string();
}

// Changes the names of files to be relative to the new place.
void move_path(Node& name, const fs::path& file) {
  for (Node& one : name.children) move_path(one, file);
  if (name.kind != Node::Kind::text || fs::path(name.text).is_absolute()) return;
  name.text = from_folder_of(file, fs::path(name.where.file).parent_path() / name.text);
}

// Returns the file into which the candidate's values are put. Only one level of bases is allowed,
// so an experiment that has a base is copied.
Node ground(const Tuning& tuning, const fs::path& file) {
  Node own = config::parse_file(tuning.runs.experiment);
  if (!own.find("base")) {
    Node out;
    out.put(config::make_text("format", own.find("format")->text));
    out.put(config::make_text("base", from_folder_of(file, tuning.runs.experiment)));
    return out;
  }
  for (const char* key : {"base", "robot", "files"})
    if (Node* name = own.find(key)) move_path(*name, file);
  return own;
}

// Returns "phase.swing.y.polynomial" for "phase.swing.y.polynomial[1]": a list is copied as a
// whole.
std::string without_index(const std::string& key) {
  return key.ends_with(']') ? key.substr(0, key.rfind('[')) : key;
}

void put_at(Node& root, const std::string& path, Node value) {
  Node* table = &root;
  std::size_t from = 0;
  for (std::size_t dot; (dot = path.find('.', from)) != path.npos; from = dot + 1) {
    const std::string segment = path.substr(from, dot - from);
    Node* next = table->find(segment);
    table = next && next->is_table() ? next : &table->put(config::make_table(segment));
  }
  value.key = path.substr(from);
  table->put(std::move(value));
}

// Adds the source to a quantity; a whole number and a list cannot have one.
Node with_source(Node value, const Range& range, const std::string& source) {
  if (range.axis.unit.empty() || value.kind == Node::Kind::array) return value;
  Node out = config::make_table(value.key);
  value.key = "value";
  out.put(std::move(value));
  out.put(config::make_text("source", source));
  return out;
}

std::string goals_of(const Tuning& tuning, const Candidate& candidate) {
  std::string out;
  const auto add = [&](const Figure& figure, double number, const char* of) {
    out += fmt::format("#   {} = {:.6g}{}\n", figure.heading(), number, of);
  };
  const std::size_t runs = tuning.runs_of_candidate();
  const bool mean = tuning.goals.over == Goals::Over::mean;
  const char* of = runs == 1 ? "" : mean ? ", the mean of its runs" : ", the worst of its runs";
  for (std::size_t i = 0; i < tuning.goals.goals.size(); ++i)
    add(tuning.goals.goals[i].figure, candidate.evaluation.goals[i], of);
  for (std::size_t i = 0; i < tuning.goals.limits.size(); ++i) {
    const Figure& figure = tuning.goals.limits[i].figure;
    const auto same = [&](const Goal& g) { return g.figure.key == figure.key; };
    if (std::ranges::none_of(tuning.goals.goals, same))
      add(figure, candidate.evaluation.limits[i], runs == 1 ? "" : ", the worst of its runs");
  }
  if (tuning.runs.allow_unreachable)
    out += "# It was tuned with points out of reach allowed: the nearest ones were aimed at.\n";
  return out;
}

}  // namespace

std::string experiment_of(const Tuning& tuning, const Candidate& candidate, const fs::path& file) {
  std::vector<std::string> sets = tuning.runs.sets;
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    sets.push_back(tuning.runs.sample->ranges[i].axis.set(candidate.values[i]));
  const Node all = config::compose(tuning.runs.experiment, sets);

  const std::string plan = from_folder_of(file, tuning.file);
  const std::string source = fmt::format("tuned: {}, candidate {}", plan, candidate.number);
  Node out = ground(tuning, file);
  out.put(
      config::make_text("title", fmt::format("{}: candidate {}", tuning.title, candidate.number)));
  // No source reports values of a candidate.
  Node none;
  none.kind = Node::Kind::array;
  none.key = "reported";
  if (all.find("reported")) out.put(std::move(none));
  if (all.find("reproduces")) out.put(config::make_text("reproduces", ""));
  for (const std::string& set : tuning.runs.sets) {
    const std::string key = without_index(set.substr(0, set.find('=')));
    if (const Node* value = config::value_at(all, key)) put_at(out, key, *value);
  }
  for (std::size_t i = 0; i < tuning.tuned; ++i) {
    const Range& range = tuning.runs.sample->ranges[i];
    const std::string key = without_index(range.axis.key);
    put_at(out, key, with_source(*config::value_at(all, key), range, source));
  }
  return fmt::format("# Candidate {} (generation {}) of {}:\n{}\n{}", candidate.number,
                     candidate.generation, plan, goals_of(tuning, candidate), config::to_toml(out));
}

}  // namespace sinew::tune
