// cli/keys.cpp - `sinew keys`: every key that a file can have.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/files/key_text.h"
#include "sinew/files/keys.h"
#include "sinew/json/json.h"

namespace sinew::cli {

namespace {

struct KeysOptions {
  std::vector<std::string> words;
  std::string kind, schema;
  bool json = false, page = false;
};

// The schema of each kind has what all kinds have.
std::vector<std::string> kinds_with_a_schema() {
  std::vector<std::string> out = files::key_kinds();
  std::erase(out, "any");
  return out;
}

ExitCode keys(const KeysOptions& options) {
  const bool all = options.words.empty() && options.kind.empty();
  if (options.page) {
    fmt::print("{}", files::page_of_keys());
  } else if (!options.schema.empty()) {
    fmt::print("{}", files::schema_of(options.schema));
  } else if (options.json) {
    const std::vector<files::Key> found = files::find_keys(options.words, options.kind);
    fmt::print("{}\n", (Json::parse(files::json_of(found))).text(2));
  } else if (all) {
    fmt::print("{}", files::overview_of_keys(width_of_output()));
  } else {
    const std::vector<files::Key> found = files::find_keys(options.words, options.kind);
    fmt::print("{}", files::text_of(found, width_of_output()));
  }
  return ok;
}

}  // namespace

void add_keys(CLI::App& app, Action& action) {
  auto options = std::make_shared<KeysOptions>();
  CLI::App& sub = subcommand(app, "keys", "every key of every file: unit, range, default, meaning",
                             "sinew keys damping\n  sinew keys joint.hip.damping");
  sub.add_option("WORD", options->words,
                 "a key, how it begins, or words of its description; without one, the tables");
  CLI::Option* kind = sub.add_option("--kind", options->kind, "of one kind of file alone")
                          ->check(one_of(files::key_kinds()));
  CLI::Option* json = sub.add_flag("--json", options->json, "as JSON");
  CLI::Option* schema = sub.add_option("--schema", options->schema,
                                       "a JSON schema of that kind of file, for an editor")
                            ->check(one_of(kinds_with_a_schema()));
  CLI::Option* page =
      sub.add_flag("--page", options->page, "all keys as Markdown, docs/reference/keys.md");
  CLI::Option* words = sub.get_option("WORD");
  for (CLI::Option* other : {kind, json, words}) {
    schema->excludes(other);
    page->excludes(other);
  }
  page->excludes(schema);
  sub.callback([=, &action] { action = [=] { return keys(*options); }; });
}

}  // namespace sinew::cli
