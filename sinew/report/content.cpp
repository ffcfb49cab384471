#include "sinew/report/content.h"

#include "sinew/analysis/derived.h"
#include "sinew/analysis/summary.h"
#include "sinew/report/page.h"

namespace sinew::report {
namespace {

std::string text_at(const config::Node& root, std::string_view key) {
  const config::Node* node = root.find(key);
  if (!node) return "";
  const config::Node* value = node->find("value");
  return config::written(value ? *value : *node);
}

double end_of(const Channels& channels) {
  std::int64_t end = 0;
  for (const signals::Table* table : channels.tables())
    for (const signals::Series& s : table->series)
      if (!s.time_ns.empty()) end = std::max(end, s.time_ns.back());
  return static_cast<double>(end) / 1e9;
}

Json clocks_of(const Blob& blob) {
  const Blob::Layout layout = blob.layout();
  return {{"clocks", layout.clocks}, {"columns", layout.columns}};
}

Json about(const Run& run, const analysis::Machine& machine) {
  Json out;
  out["format"] = "sinew.report/1";
  out["title"] = machine.title;
  out["reproduces"] = machine.reproduces;
  out["name"] = run.name;
  out["robot"] = machine.robot.name;
  out["seed"] = text_at(run.resolved, "seed");
  out["version"] = text_at(run.resolved, "sinew_version");
  out["atmosphere"] = machine.atmosphere;
  return out;
}

}  // namespace

Content content(const Run& run) {
  const analysis::Machine machine = analysis::read_machine(run.resolved);
  const signals::Table derived = analysis::derive(run.table, machine);
  const analysis::Record record(run.table, machine, &derived);
  const analysis::Summary summary = analysis::summarize(run.table, machine);

  Channels channels;
  channels.add(run.table);
  channels.add(derived);
  signals::Table drawn;
  const Scene scene_of_run = scene(channels, machine, record, drawn);
  channels.add(drawn);

  Blob blob;
  Columns columns(channels, blob);
  Json json = about(run, machine);
  json["duration"] = end_of(channels);
  json["phases"] = phases_of(record, machine);
  json["panels"] = to_json(panels(channels, machine.robot), columns);
  json["scene"] = to_json(scene_of_run, columns);
  json["verdicts"] = to_json(compare(summary, machine.reported, machine.atmosphere));
  json["summary"] = Json::parse(analysis::to_json(summary));
  json["warnings"] = to_json(analysis::warnings(run.table, machine));
  json["parameters"] = to_json(parameters(run.resolved));
  json["samples"] = clocks_of(blob);
  return {machine.title.empty() ? run.name : machine.title,
          json.dump(-1, ' ', false, Json::error_handler_t::replace), blob.base64()};
}

}  // namespace sinew::report
