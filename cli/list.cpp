// cli/list.cpp - `sinew list`: robots, experiments and more, with Sinew and in this folder.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/files/list.h"
#include "sinew/json/json.h"

namespace sinew::cli {

namespace {

struct ListOptions {
  std::string kind;
  bool json = false;
};

Json json_of(const files::Listing& listing) {
  Json all{{"format", "sinew.list/1"}};
  if (!listing.shipped_from.empty()) all["shipped_from"] = listing.shipped_from;
  all["cut"] = listing.cut;
  all["files"] = Json::array();
  for (const files::Listed& one : listing.files) {
    all["files"].push_back(
        {{"kind", one.kind}, {"path", one.path}, {"title", one.title}, {"shipped", one.shipped}});
    if (!one.problem.empty()) all["files"].back()["problem"] = one.problem;
  }
  return all;
}

ExitCode list(const ListOptions& options) {
  const files::Listing listing = files::list(options.kind);
  if (options.json)
    fmt::print("{}\n", json_of(listing).text(2));
  else
    fmt::print("{}", files::text_of(listing, options.kind));
  const Messages messages(false);
  if (listing.shipped_from.empty())
    messages.warning(
        "found none of the files that come with Sinew; SINEW_SHARE=FOLDER in the environment says "
        "where they are");
  if (listing.cut) messages.warning("this folder has too much below it; not all was looked at");
  return ok;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  auto options = std::make_shared<ListOptions>();
  CLI::App& sub =
      subcommand(app, "list", "robots, experiments and more: with Sinew and in this folder",
                 "sinew list experiments");
  std::vector<std::string> kinds;
  for (const std::string_view kind : files::listed_kinds()) kinds.emplace_back(kind);
  sub.add_option("KIND", options->kind, "one kind alone; else all")->check(one_of(kinds));
  sub.add_flag("--json", options->json, "as JSON");
  sub.callback([=, &action] { action = [=] { return list(*options); }; });
}

}  // namespace sinew::cli
