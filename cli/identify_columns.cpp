// cli/identify_columns.cpp - `sinew identify columns`: what the table of a method must hold.
#include "cli/identify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "cli/settings.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/task/inputs.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

struct IdentifyColumnsOptions {
  std::string method, kind, file;
  bool json = false, force = false, quiet = false;
};

constexpr std::size_t shown_units = 5;

// The first units of a column, as people write them; --json has all.
std::string units_of(const identify::Wanted& column) {
  std::string words;
  for (const auto& [word, value] : column.words)
    words += fmt::format("{}{}", words.empty() ? "" : " or ", word);
  if (!words.empty()) return words;
  std::vector<std::string> units = identify::accepted_units(column);
  if (identify::quantity_of(column) == "pressure") {
    // Each of them from the room's pressure or from none.
    std::erase_if(units, [](const std::string& unit) { return !unit.ends_with(" gauge"); });
    for (std::string& unit : units) unit.resize(unit.size() - std::string_view(" gauge").size());
    return fmt::format("{}; gauge or abs", fmt::join(units, ", "));
  }
  const bool more = units.size() > shown_units;
  if (more) units.resize(shown_units);
  return fmt::format("{}{}", fmt::join(units, ", "), more ? ", ..." : "");
}

void print(const identify::MethodInputs& inputs) {
  report::TextTable table({"column", "quantity", "needed", "units", "meaning"},
                          std::vector(5, report::TextTable::Align::left));
  for (const identify::Wanted& w : inputs.columns())
    table.add({std::string(w.name), identify::quantity_of(w), identify::need_of(inputs, w.name),
               units_of(w), std::string(w.doc)});
  fmt::print("{}\n", table.text());
  for (const identify::TableKind& kind : inputs.kinds)
    fmt::print("{}a row: {}\n  {}\n", kind.name.empty() ? "" : fmt::format("{}, ", kind.name),
               kind.row, kind.header);
  for (const std::string_view sentence : inputs.advice) fmt::print("{}\n", as_options(sentence));
}

ExitCode run_columns(const IdentifyColumnsOptions& options) {
  const identify::MethodInputs& inputs = identify::inputs_of(options.method);
  const std::string text = identify::template_of(inputs, options.kind);  // is the kind one?
  if (options.file.empty()) {
    if (options.json)
      fmt::print("{}\n", to_json(inputs).text(2));
    else
      print(inputs);
    return ok;
  }
  refuse_to_replace(options.file, options.force,
                    {"template of `sinew identify`", "a template", "#For`sinewidentify", ".csv"});
  run::write_file(options.file, text);
  Messages(options.quiet).note(fmt::format("{}: written", options.file));
  return ok;
}

// Is the word at `at` an option of a line, and no value of the one before it?
bool is_option(const std::vector<std::string>& words, std::size_t at) {
  return at < words.size() && words[at].size() > 1 && words[at].starts_with('-');
}

bool asks_for_columns(const std::vector<std::string>& words) {
  for (std::size_t i = 2; i < words.size(); ++i) {
    if (words[i] == "--template" || words[i].starts_with("--template=")) return true;
    if (words[i] == "--columns" && (i + 1 == words.size() || is_option(words, i + 1))) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> with_columns_first(std::vector<std::string> words) {
  if (words.size() < 3 || words[0] != "identify" || words[1] == "columns" ||
      !asks_for_columns(words))
    return words;
  std::vector<std::string> out{"identify", "columns", words[1]};
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    const bool valued = name == "--template" || name == "--kind";
    if (name == "--json" || name == "--force" || name == "--quiet" || name == "--help" || valued)
      out.push_back(words[i]);
    if (valued && name == words[i] && i + 1 < words.size()) out.push_back(words[++i]);
  }
  return out;
}

void add_identify_columns(CLI::App& identify, Action& action) {
  auto options = std::make_shared<IdentifyColumnsOptions>();
  CLI::App& sub =
      subcommand(identify, "columns",
                 "which columns a method reads, and a table to fill in; --columns of each method",
                 "sinew identify columns static --template forces.csv");
  std::vector<std::string> methods;
  for (const identify::MethodInputs& inputs : identify::method_inputs())
    methods.emplace_back(inputs.method);
  sub.add_option("METHOD", options->method, "of sinew identify")
      ->required()
      ->check(one_of(methods));
  sub.add_option("--kind", options->kind, "of table, where a method takes several: chart");
  sub.add_option("--template", options->file, "FILE.csv: a table to fill in");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--json", options->json, "print as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors");
  sub.callback([options, &action] { action = [options] { return run_columns(*options); }; });
}

}  // namespace sinew::cli
