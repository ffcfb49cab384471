#include "sinew/run/folder/replayed.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/kept_run.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/replay_plant.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {
namespace {

// Every sensor's counts: what a controller reads.
void require_counts(const experiment::Experiment& e, const signals::Table& recorded,
                    const std::string& name) {
  std::string missing;
  for (const robot::Sensor& sensor : e.robot.sensors) {
    const std::string topic = "/sensor/" + sensor.name + "/count";
    const signals::Series* series = recorded.find(topic);
    if (!series || series->time_ns.empty()) missing += (missing.empty() ? "no " : ", no ") + topic;
  }
  if (!missing.empty())
    config::fail({name, 0, 0}, "", missing, "the counts of every sensor, once per period",
                 "of=plant, which needs the valves' commands instead");
}

Outcome of_controller(const experiment::Experiment& e, const signals::Table& recorded,
                      const std::string& name, Replayed& out) {
  require_counts(e, recorded, name);
  Outcome outcome = replay(e, recorded);
  std::string missing;
  for (const signals::Series& s : outcome.table.series)
    if (signals::is_of_valve(s.topic.name) && !recorded.find(s.topic.name))
      missing += (missing.empty() ? "no " : ", no ") + s.topic.name;
  if (!missing.empty())
    config::fail({name, 0, 0}, "", missing, "the edges of every valve, to compare with",
                 "a recording with them");
  out.edges = analysis::compare_edges(recorded, outcome.table);
  return outcome;
}

Outcome of_plant(const experiment::Experiment& e, const signals::Table& recorded,
                 const std::string& name, Replayed& out) {
  PlantReplay replayed = replay_plant(e, recorded, name);
  out.rebuilt = std::move(replayed.rebuilt);
  out.partings = analysis::partings(recorded, replayed.outcome.table, out.band);
  return std::move(replayed.outcome);
}

}  // namespace

bool Replayed::agrees() const {
  if (!cause.empty()) return false;
  if (of == ReplayOf::controller) return !edges.first;
  return std::ranges::none_of(partings, [](const auto& p) { return p.at.has_value(); });
}

Replayed replay_run(const ReplayRequest& request, const Notices& notices) {
  if (!(request.band >= 0 && request.band <= 1))
    config::fail({"replay", 0, 0}, "band", fmt::format("{:g} %", 100 * request.band),
                 "a share of a channel's range, 0 to 100 %", "5 %");
  const RecordedRun run = recorded_run(request.run);
  const std::string machine = machine_of(run, request.machine).string();
  const auto e = buildable_robot(config::compose(machine, request.sets), machine);
  const signals::Table recorded = log::read(run.log);
  if (!recorded.complete)
    notices.warning(run.log.string() + " was cut off; compared as far as it goes");

  Replayed out{.of = request.of, .band = request.band};
  const Outcome outcome = request.of == ReplayOf::controller
                              ? of_controller(e, recorded, run.log.string(), out)
                              : of_plant(e, recorded, run.log.string(), out);
  out.duration = outcome.duration;
  if (!out.rebuilt.empty())
    notices.note(
        fmt::format("edges were made from duties, as the low level makes them, of {} valves",
                    out.rebuilt.size()));
  if (request.of == ReplayOf::plant && outcome.ended_early()) {
    out.cause = cause_of(e, outcome);
    notices.warning("the replay ended early: " + out.cause);
  }
  if (request.folder)
    out.folder =
        keep_table(outcome.table, e, {.folder = *request.folder, .force = request.force}, notices)
            .folder;
  return out;
}

}  // namespace sinew::run
