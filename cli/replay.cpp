// cli/replay.cpp - `sinew replay`: recorded readings through today's controller; does it decide the
// same valve edges?
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.h"
#include "cli/json_text.h"
#include "cli/run_folder.h"
#include "cli/terminal.h"
#include "sinew/experiment/run.h"
#include "sinew/log/reader.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string run, machine;
  bool json = false, quiet = false;
};

struct Difference {
  std::int64_t time_ns = 0;
  std::string topic;
  std::string recorded, replayed;  // "opens", "shuts" or "nothing"
};

struct Comparison {
  std::size_t recorded = 0, replayed = 0;  // edges
  std::optional<Difference> first;
};

std::string word(const signals::Series& s, std::size_t i) {
  return s.columns[0][i] != 0 ? "opens" : "shuts";
}

// Edges up to `end`.
std::size_t edges(const signals::Series& s, std::int64_t end) {
  const auto it = std::ranges::upper_bound(s.time_ns, end);
  return static_cast<std::size_t>(it - s.time_ns.begin());
}

// Where two trains of edges part.
std::optional<Difference> difference(const signals::Series& recorded, std::size_t recorded_edges,
                                     const signals::Series& replayed, std::size_t replayed_edges) {
  for (std::size_t i = 0; i < std::max(recorded_edges, replayed_edges); ++i) {
    const bool has_a = i < recorded_edges, has_b = i < replayed_edges;
    const std::int64_t a = has_a ? recorded.time_ns[i] : INT64_MAX;
    const std::int64_t b = has_b ? replayed.time_ns[i] : INT64_MAX;
    if (a == b && recorded.columns[0][i] == replayed.columns[0][i]) continue;
    return Difference{std::min(a, b), recorded.topic.name, a <= b ? word(recorded, i) : "nothing",
                      b <= a ? word(replayed, i) : "nothing"};
  }
  return std::nullopt;
}

// A log that was cut off is compared as far as all of it was there.
std::int64_t end_of(const signals::Table& table) {
  std::int64_t end = INT64_MAX;
  if (table.complete) return end;
  for (const signals::Series& s : table.series)
    if (s.topic.name.starts_with("/sensor/") && !s.time_ns.empty())
      end = std::min(end, s.time_ns.back());
  return end;
}

Comparison compare_edges(const signals::Table& recorded, const signals::Table& replayed) {
  const std::int64_t end = end_of(recorded);
  Comparison out;
  for (const signals::Series& now : replayed.series) {
    if (!signals::is_of_valve(now.topic.name)) continue;
    const signals::Series* then = recorded.find(now.topic.name);
    if (!then) throw std::invalid_argument("the log has no " + now.topic.name + " to compare with");
    const std::size_t a = edges(*then, end), b = edges(now, end);
    out.recorded += a;
    out.replayed += b;
    const auto found = difference(*then, a, now, b);
    if (found && (!out.first || found->time_ns < out.first->time_ns)) out.first = found;
  }
  return out;
}

void print(const Comparison& c, bool json) {
  if (json) {
    Json out{{"recorded_edges", c.recorded}, {"replayed_edges", c.replayed}, {"equal", !c.first}};
    if (c.first)
      out["first_difference"] = {{"time_s", 1e-9 * static_cast<double>(c.first->time_ns)},
                                 {"topic", c.first->topic},
                                 {"recorded", c.first->recorded},
                                 {"replayed", c.first->replayed}};
    fmt::print("{}\n", json_text(out, 2));
  } else if (!c.first) {
    fmt::print("{} edges, all equal\n", c.recorded);
  } else {
    fmt::print("{} edges recorded, {} replayed\n", c.recorded, c.replayed);
    fmt::print("first difference at {:.4f} s: {} {} in the log, {} in the replay\n",
               1e-9 * static_cast<double>(c.first->time_ns), c.first->topic, c.first->recorded,
               c.first->replayed);
  }
}

ExitCode replay_run(const Options& options) {
  const Messages messages(options.quiet);
  const RecordedRun run = recorded_run(options.run);
  const auto experiment = experiment::load(machine_of(run, options.machine).string());
  const signals::Table recorded = log::read(run.log);
  if (!recorded.complete)
    messages.warning(run.log.string() + " was cut off; compared as far as it goes");

  const experiment::Outcome outcome = experiment::replay(experiment, recorded);
  const Comparison comparison = compare_edges(recorded, outcome.table);
  print(comparison, options.json);
  return comparison.first ? failed : ok;
}

}  // namespace

void add_replay(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(app, "replay", "recorded readings through today's controller",
                             "sinew replay runs/walk-test-1/1");
  sub.add_option("DIR", options->run, "a run's folder, or a log file")->required();
  sub.add_option("--machine", options->machine, "what was run, in place of the folder's");
  sub.add_flag("--json", options->json, "as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return replay_run(*options); }; });
}

}  // namespace sinew::cli
