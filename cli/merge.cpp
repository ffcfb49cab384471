// cli/merge.cpp - `sinew merge`: the files of a study's shards as one.
#include "sinew/tune/results/results.h"

#include <fmt/format.h>

#include <memory>

#include "cli/command.h"
#include "cli/terminal.h"

namespace sinew::cli {

namespace {

struct MergeOptions {
  std::vector<std::string> files;
  std::string out;
};

ExitCode merge_all(const MergeOptions& options) {
  const tune::Merged merged =
      tune::merge({options.files.begin(), options.files.end()}, options.out);
  fmt::print("{}: {} of {} points are there, {} of them new\n", options.out, merged.there,
             merged.points, merged.added);
  return ok;
}

}  // namespace

void add_merge(CLI::App& app, Action& action) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App& sub = subcommand(app, "merge", "files of one study as one file",
                             "sinew merge a.db b.db c.db -o all.db");
  sub.add_option("FILE", options->files, "what sinew sweep --results wrote, each another --shard")
      ->required();
  sub.add_option("-o,--output", options->out, "the file for all rows; one of the same study grows")
      ->required();
  sub.callback([=, &action] { action = [=] { return merge_all(*options); }; });
}

}  // namespace sinew::cli
