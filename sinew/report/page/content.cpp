#include "sinew/report/page/content.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/quantity.h"
#include "sinew/report/page/changes.h"
#include "sinew/report/page/page.h"

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

struct About {
  std::string title, reproduces, robot;
  double atmosphere = 0;
};

// A JSON object that grows; its members are JSON.
class Object {
 public:
  void put(std::string_view key, std::string_view json) {
    text_ += text_.empty() ? "{\"" : ",\"";
    text_.append(key).append("\":").append(json);
  }
  std::string text() const { return text_ + "}"; }

 private:
  std::string text_;
};

Object head(const Run& run, const About& about) {
  Object out;
  out.put("format", to_json(std::string("sinew.report/1")));
  out.put("title", to_json(about.title));
  out.put("reproduces", to_json(about.reproduces));
  out.put("name", to_json(run.name));
  out.put("robot", to_json(about.robot));
  out.put("seed", to_json(text_at(run.resolved, "seed")));
  out.put("version", to_json(text_at(run.resolved, "sinew_version")));
  out.put("atmosphere", config::format_number(about.atmosphere));
  return out;
}

// What pages of any run end with.
Content finish(Object json, const Run& run, const Blob& blob) {
  const analysis::Summary& summary = run.analysis.summary;
  json.put("verdicts", to_json(run.analysis.verdicts));
  json.put("summary", analysis::to_json(summary));
  json.put("parameters", to_json(parameters(run.resolved)));
  json.put("samples", to_json(blob.layout()));
  const config::UnitsToShow shown = config::units_to_show({.now = run.units, .run = &run.resolved});
  return {.title = summary.title.empty() ? run.name : summary.title,
          .json = json.text(),
          .samples = blob.base64(),
          .units = units_json(shown.units)};
}

// Returns the warning at the top of the page of a run that was ended.
std::vector<analysis::Warning> how_it_ended(const Run& run) {
  if (run.analysis.ended.empty()) return {};
  return {{"the run was ended: " + run.analysis.ended, {}}};
}

// Returns what the page says where it cannot show all of a long run.
std::vector<analysis::Warning> what_is_left_out(const Blob& blob, const Channels& channels,
                                                std::size_t stretches) {
  if (blob.thinned() == 0) return {};
  std::size_t samples = 0;
  for (const signals::Table* table : channels.tables())
    for (const signals::Series& s : table->series)
      if (!signals::is_of_valve(s.topic.name)) samples = std::max(samples, s.time_ns.size());
  const double each = end_of(channels) * static_cast<double>(blob.thinned()) /
                      static_cast<double>(std::max<std::size_t>(samples, 1));
  return {{fmt::format("the run is longer than a page can show: of every {:.2g} s a line has its "
                       "least and its greatest value, the drawing two instants{}; the log has all",
                       each, stretches > most_stretches ? ", and phases are not marked" : ""),
           {}}};
}

}  // namespace

Content content(const Run& run) {
  const auto& [table, ended, machine, derived, record, warned, summary, verdicts] = run.analysis;
  Channels channels;
  channels.add(table);
  channels.add(derived);
  signals::Table drawn;
  Scene scene_of_run;
  Stand stand_of_run;
  if (machine.stand)
    stand_of_run = stand(channels, machine, drawn);
  else
    scene_of_run = scene(channels, machine, record, drawn);
  channels.add(drawn);

  Blob blob;
  Columns columns(channels, blob);
  Object json =
      head(run, {machine.title, machine.reproduces, machine.robot.name, machine.atmosphere});
  json.put("duration", config::format_number(end_of(channels)));
  json.put("phases", phases_of(record, machine));
  if (!summary.faults.empty()) json.put("faults", to_json(summary.faults, end_of(channels)));
  if (const std::vector<PageChange> changes = changes_of(run.resolved); !changes.empty())
    json.put("changes", to_json(changes));
  json.put("panels", to_json(panels(channels, machine), columns));
  json.put("scene", to_json(scene_of_run, columns));
  if (machine.stand) {
    json.put("stand", to_json(stand_of_run, columns));
    json.put("charts", to_json(stand_charts(channels, stand_of_run), columns));
  }
  std::vector<analysis::Warning> warnings = how_it_ended(run);
  std::ranges::move(what_is_left_out(blob, channels, record.stretches().size()),
                    std::back_inserter(warnings));
  std::ranges::move(analysis::cut_logs(table), std::back_inserter(warnings));
  std::ranges::copy(warned, std::back_inserter(warnings));
  json.put("warnings", to_json(warnings));
  return finish(std::move(json), run, blob);
}

}  // namespace sinew::report
