#include "sinew/run/folder/replayed.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/log/reader.h"
#include "sinew/report/page/plot.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/replay_plant.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

namespace {

// Throws unless the table has the counts of every sensor, which the controller reads.
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
  out.divergences = analysis::divergences(recorded, replayed.outcome.table, out.band);
  return std::move(replayed.outcome);
}

}  // namespace

bool Replayed::agrees() const {
  if (!cause.empty()) return false;
  if (of == ReplayOf::controller) return !edges.first;
  return std::ranges::none_of(divergences, [](const auto& p) { return p.at.has_value(); });
}

Replayed replay_run(const ReplayRequest& request, const Notices& notices) {
  if (!(request.band >= 0 && request.band <= 1))
    config::fail({"replay", 0, 0}, "band", fmt::format("{:g} %", 100 * request.band),
                 "a share of a channel's range, 0 to 100 %", "5 %");
  const RunFiles run = run_files(request.run);
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
        store_table(outcome.table, e, {.folder = *request.folder, .force = request.force}, notices)
            .folder;
  return out;
}

namespace {

using report::TextTable;
using Align = TextTable::Align;

// --- JSON ---

Json json_of(const analysis::EdgeComparison& c) {
  Json out{{"recorded_edges", c.recorded}, {"replayed_edges", c.replayed}, {"equal", !c.first}};
  if (c.first)
    out["first_difference"] = {{"time_s", 1e-9 * static_cast<double>(c.first->time_ns)},
                               {"topic", c.first->topic},
                               {"recorded", c.first->recorded},
                               {"replayed", c.first->replayed}};
  out["valves"] = Json::array(c.valves, [](const analysis::ValveEdges& v) -> Json {
    return {{"topic", v.topic},
            {"recorded", v.recorded},
            {"replayed", v.replayed},
            {"moved", v.moved},
            {"only_recorded", v.only_recorded},
            {"only_replayed", v.only_replayed},
            {"mean_move_s", v.mean_move},
            {"largest_move_s", v.largest_move}};
  });
  return out;
}

Json divergence_of(const analysis::Divergence& p) {
  const analysis::Difference& d = p.difference;
  return {{"topic", p.topic},
          {"field", p.field},
          {"unit", p.unit},
          {"same", d.same},
          {"parts_at_s", p.at ? Json(*p.at) : Json()},
          {"band", p.band},
          {"rms", d.rms},
          {"bias", d.bias},
          {"largest", d.largest},
          {"largest_at_s", d.at},
          {"span", d.span},
          {"correlation", d.correlation},
          {"rms_by_tenth", p.growth}};
}

// --- text ---

// Returns "▁▂▅█": the rms of each tenth, relative to the greatest one.
std::string bars_of(const std::array<double, 10>& growth) {
  static constexpr const char* bars[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  double most = 0;
  for (const double rms : growth)
    if (rms > most) most = rms;
  std::string out;
  for (const double rms : growth)
    out +=
        std::isfinite(rms) && most > 0 ? bars[std::min(7, static_cast<int>(8 * rms / most))] : " ";
  return out;
}

// Returns a difference in the unit that is shown.
std::string difference_text(double value, const std::string& unit, const units::ShownUnits& units,
                            bool sign = false) {
  if (!std::isfinite(value)) return "";
  const units::ShownUnit shown = units.of_difference(unit, std::abs(value));
  return fmt::format("{}{:.3g}{}{}", sign && value > 0 ? "+" : "", value * shown.scale,
                     shown.name.empty() ? "" : " ", shown.name);
}

std::string plant_text(const Replayed& r, const units::ShownUnits& units, std::size_t width) {
  std::size_t parted = 0, same = 0;
  TextTable table({"", "parts at", "beyond", "rms", "of range", "at most", "at", "rms by tenths"},
                  {Align::left, Align::right, Align::right, Align::right, Align::right,
                   Align::right, Align::right, Align::left});
  for (const analysis::Divergence& p : r.divergences) {
    const analysis::Difference& d = p.difference;
    parted += p.at.has_value();
    same += d.same || d.equal();
    if (d.same || d.equal()) continue;
    table.add({report::Channel{p.topic, p.field}.name(),
               p.at ? fmt::format("{:.3f} s", *p.at) : "stays",
               difference_text(p.band, p.unit, units), difference_text(d.rms, p.unit, units),
               d.span > 0 ? fmt::format("{:.2g} %", 100 * d.share()) : "",
               difference_text(d.largest, p.unit, units, true), fmt::format("{:.3f} s", d.at),
               bars_of(p.growth)});
  }
  std::string out = fmt::format(
      "recorded valves through today's plant, {:.2f} s: of {} channels {} with the same samples, "
      "{} "
      "part by more than {:.3g} % of their range or 4 sigma of noise\n",
      r.duration, r.divergences.size(), same, parted, 100 * r.band);
  if (!r.rebuilt.empty())
    out += fmt::format("edges of {} valves were made from their duties\n", r.rebuilt.size());
  if (!table.empty()) out += table.text_within(width);
  return out;
}

std::string controller_text(const Replayed& r, std::size_t width) {
  const analysis::EdgeComparison& c = r.edges;
  if (!c.first) return fmt::format("{} edges, all equal\n", c.recorded);
  std::string out = fmt::format("{} edges recorded, {} replayed\n", c.recorded, c.replayed);
  out += fmt::format("first difference at {:.4f} s: {} {} in the log, {} in the replay\n",
                     1e-9 * static_cast<double>(c.first->time_ns), c.first->topic,
                     c.first->recorded, c.first->replayed);
  TextTable table({"", "edges", "differ", "moved", "on average", "at most", "only in the log",
                   "only in the replay"},
                  std::vector<Align>{Align::left, Align::right, Align::right, Align::right,
                                     Align::right, Align::right, Align::right, Align::right});
  for (const analysis::ValveEdges& v : c.valves) {
    if (v.differing() == 0) continue;
    const auto ms = [&](double s) { return v.moved > 0 ? fmt::format("{:+.2f} ms", 1e3 * s) : ""; };
    table.add({v.topic, fmt::format("{}", v.recorded), fmt::format("{}", v.differing()),
               fmt::format("{}", v.moved), ms(v.mean_move), ms(v.largest_move),
               fmt::format("{}", v.only_recorded), fmt::format("{}", v.only_replayed)});
  }
  if (!table.empty()) out += table.text_within(width);
  return out;
}

}  // namespace

std::string to_json(const Replayed& r) {
  Json out{{"format", "sinew.replay/1"},
           {"of", r.of == ReplayOf::controller ? "controller" : "plant"},
           {"duration_s", r.duration},
           {"agrees", r.agrees()}};
  if (r.of == ReplayOf::controller) out.update(json_of(r.edges));
  if (r.of == ReplayOf::plant) {
    out["band"] = r.band;
    out["duties"] = r.rebuilt;
    out["channels"] = Json::array(r.divergences, divergence_of);
  }
  if (!r.cause.empty()) out["ended_early"] = r.cause;
  if (r.folder) out["folder"] = r.folder->string();
  return out.text(2) + "\n";
}

std::string text_of(const Replayed& r, const units::ShownUnits& units, std::size_t width) {
  std::string out =
      r.of == ReplayOf::controller ? controller_text(r, width) : plant_text(r, units, width);
  if (!r.cause.empty()) out += "ended early: " + r.cause + "\n";
  return out;
}

}  // namespace sinew::run
