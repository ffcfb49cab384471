#include "sinew/tune/optimizer/candidate_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/compose.h"
#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"

namespace sinew::tune {
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
