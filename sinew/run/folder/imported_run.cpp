#include "sinew/run/folder/imported_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/config/write/writer.h"
#include "sinew/log/file.h"
#include "sinew/recording/assemble.h"
#include "sinew/recording/recorded.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/sensing.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"

namespace sinew::run {

namespace {

using Kind = robot::Sensor::Kind;

// A sensor's quantity: its topic, and the linear relation of its values and counts.
struct ChannelLine : robot::SensorLine {
  std::string topic, unit;
};

ChannelLine line_of(const robot::Robot& robot, const robot::Sensor& sensor, double atmosphere) {
  const double per_volt = robot.converter.counts_per_volt();
  const int joint = robot::find_joint(robot, sensor.of);
  const int muscle = robot::find_muscle(robot, sensor.of);
  ChannelLine out;
  out.count_at_zero = sensor.assumed_at_rest;
  out.counts_per_unit = sensor.assumed_scale;
  if (sensor.kind == Kind::angle && joint >= 0) {
    out.topic = robot::topic_of_joint(robot, static_cast<std::size_t>(joint)) + "/angle";
    out.unit = "rad";
    out.at_zero = robot.joints[static_cast<std::size_t>(joint)].rest_angle;
  } else if (sensor.kind == Kind::tension && muscle >= 0) {
    out.topic = robot::topic_of_muscle(robot, static_cast<std::size_t>(muscle)) + "/tension";
    out.unit = "N";
    static_cast<robot::SensorLine&>(out) = robot::own_tension(sensor, robot.converter);
  } else if (sensor.kind == Kind::pressure && muscle >= 0) {
    out.topic = robot::topic_of_muscle(robot, static_cast<std::size_t>(muscle)) + "/pressure";
    out.unit = "Pa";
    out.at_zero = atmosphere;
    out.counts_per_unit *= per_volt;
  } else if (sensor.kind == Kind::velocity && joint >= 0) {
    out.topic = robot::topic_of_joint(robot, static_cast<std::size_t>(joint)) + "/velocity";
    out.unit = "rad/s";
    out.counts_per_unit *= per_volt;
  } else if (sensor.kind == Kind::cylinder) {
    out.topic = "/cylinder/position";
    out.unit = "m";
  }
  return out;
}

class Filler {
 public:
  Filler(signals::Table& table, const robot::Robot& robot) : table_(table), robot_(robot) {}

  void counts_of(const robot::Sensor& sensor, const ChannelLine& line) {
    const signals::Series from = *table_.find(line.topic);  // copies share their samples
    const double top = robot_.converter.top();
    std::size_t beyond = 0;
    add(name_of(sensor), "count", fmt::format("from {} by the sensor's scale", line.topic), from,
        [&](double value) {
          const double count = std::round(line.counts(value));
          beyond += count < 0 || count > top ? 1 : 0;
          return std::clamp(count, 0.0, top);
        });
    counted_.push_back(sensor.name);
    if (beyond > 0)
      notes_.push_back(fmt::format(
          "{}: {} of {} values are beyond what its converter can count, and stand at its end; is "
          "the unit right, or the robot's scale?",
          line.topic, beyond, from.time_ns.size()));
  }

  void quantity_of(const robot::Sensor& sensor, const ChannelLine& line) {
    add(line.topic, line.unit, fmt::format("from {} by the sensor's scale", name_of(sensor)),
        signals::Series(*table_.find(name_of(sensor))),
        [&](double count) { return line.value(count); });
    measured_.push_back(line.topic);
  }

  // Adds the counts of a joint that does not move: those at rest, at the times of the first sensor.
  void constant(const robot::Sensor& sensor) {
    const signals::Series* first = nullptr;
    for (const robot::Sensor& other : robot_.sensors)
      if (!first) first = table_.find(name_of(other));
    if (!first) return;
    const signals::Series times = *first;
    add(name_of(sensor), "count", "of a quantity that does not move, as it is at rest", times,
        [&](double) { return std::round(sensor.at_rest); });
    counted_.push_back(sensor.name);
  }

  static std::string name_of(const robot::Sensor& sensor) {
    return "/sensor/" + sensor.name + "/count";
  }

  std::vector<std::string> take() {
    if (!counted_.empty())
      notes_.insert(notes_.begin(),
                    fmt::format("counts by the robot's scales, which the recording lacks: {}",
                                fmt::join(counted_, ", ")));
    if (!measured_.empty())
      notes_.insert(notes_.begin(),
                    fmt::format("quantities by the robot's scales, of which the recording has the "
                                "counts: {}",
                                fmt::join(measured_, ", ")));
    return std::move(notes_);
  }

 private:
  template <class Of>
  void add(std::string topic, std::string unit, std::string description,
           const signals::Series& from, Of of) {
    signals::Series out{{std::move(topic), std::move(description), {{"value", std::move(unit)}}},
                        signals::Times(from.time_ns.file()),
                        {signals::Column(from.time_ns.file())}};
    for (std::size_t i = 0; i < from.time_ns.size(); ++i) {
      const double value = from.columns[0][i];
      if (!std::isfinite(value)) continue;
      out.time_ns.push_back(from.time_ns[i]);
      out.columns[0].push_back(of(value));
    }
    table_.series.push_back(std::move(out));
  }

  signals::Table& table_;
  const robot::Robot& robot_;
  std::vector<std::string> counted_, measured_, notes_;
};

}  // namespace

std::vector<std::string> fill_channels(signals::Table& table, const robot::Robot& robot,
                                       double atmosphere,
                                       const std::vector<signals::Topic>& logged) {
  Filler filler(table, robot);
  for (const robot::Sensor& sensor : robot.sensors) {
    const bool counts = table.find(Filler::name_of(sensor)) != nullptr;
    const ChannelLine line = line_of(robot, sensor, atmosphere);
    if (line.topic.empty() || line.counts_per_unit == 0) continue;
    const bool quantity = table.find(line.topic) != nullptr;
    const bool wanted = std::ranges::count(logged, line.topic, &signals::Topic::name) > 0;
    if (counts && !quantity && wanted) filler.quantity_of(sensor, line);
    if (quantity && !counts) filler.counts_of(sensor, line);
  }
  for (const robot::Sensor& sensor : robot.sensors)
    if (sensor.kind == Kind::fixed && !table.find(Filler::name_of(sensor))) filler.constant(sensor);
  return filler.take();
}

namespace {

int whole(std::size_t count) {
  return static_cast<int>(
      std::min(count, static_cast<std::size_t>(std::numeric_limits<int>::max())));
}

// Returns the files that an import reads.
std::vector<std::filesystem::path> inputs_of(const ImportRequest& request) {
  std::vector<std::filesystem::path> out(request.files.begin(), request.files.end());
  out.insert(out.end(), {request.experiment, request.mapping_file});
  return out;
}

// Refuses early what would otherwise be refused after the work.
void refuse_early(const ImportRequest& request) {
  if (request.files.empty()) config::fail({"files", 0, 0}, "", "none", "a recording");
  if (request.save_mapping.empty()) return;
  require_folder_of(request.save_mapping);
  constexpr FileKind mapping{"mapping of `sinew import`", "a mapping", "format=\"sinew.mapping/"};
  refuse_to_overwrite(request.save_mapping, request.force, mapping, inputs_of(request));
}

void save_mapping(const ImportRequest& request, const recording::AssembledRecording& of) {
  if (!request.save_mapping.empty()) write_file(request.save_mapping, recording::text_of(of.used));
}

// Returns the recording in its files, mapped to the experiment's channels.
recording::AssembledRecording read(const ImportRequest& request, const experiment::Experiment& e) {
  recording::Mapping mapping = request.mapping;
  if (!request.mapping_file.empty())
    mapping = recording::merged(recording::load_mapping(request.mapping_file), request.mapping);
  recording::check_mapping(mapping, request.mapping_file);
  std::vector<recording::Recorded> files;
  for (const std::string& file : request.files)
    files.push_back(recording::read_recording(file, mapping, request.read));
  recording::check_stated(request.values, request.files);
  for (recording::Recorded& file : files) recording::add_stated(request.values, file);
  recording::Joining joining{
      .at_end = request.join_at_end, .shifts = request.shifts, .atmosphere = e.air.atmosphere};
  if (e.stand) joining.pulse_period = e.stand->drive.period;
  recording::AssembledRecording out =
      recording::assemble(files, mapping, importable_topics(e), joining);
  // A mapping describes columns, so stated values are removed from it.
  for (const std::string& text : request.values)
    std::erase_if(out.used.columns, [name = recording::stated_in(text).name](const auto& c) {
      return c.name == name;
    });
  return out;
}

std::vector<experiment::ImportedFile> facts_of(const recording::AssembledRecording& of) {
  std::vector<experiment::ImportedFile> out;
  for (const recording::ImportSummary& summary : of.files) {
    experiment::ImportedFile file = imported_file(summary.file, summary.kind);
    file.started = summary.started.empty() ? "not known" : summary.started;
    file.rows = whole(summary.rows);
    file.values = whole(summary.values);
    file.left_out = whole(summary.left_out);
    out.push_back(std::move(file));
  }
  return out;
}

// Returns the text of the experiment as read, followed by the recordings.
std::string with_files(std::string resolved, std::vector<experiment::ImportedFile> files) {
  config::Writer writer;
  experiment::fields(writer, files);
  return resolved + writer.text();
}

// Data that both kinds of experiments need.
struct Keeping {
  const std::string& name;
  int seed;
  const std::string& resolved;
  const config::Node& values;  // contents of `resolved`
  const std::string& mapping;
  const RunRequest& where;
  const Notices& notices;
};

void keep_files(const analysis::Analysis& a, const Keeping& what, StoredRun& kept) {
  const signals::Table& table = a.table;
  OutputFolder folder =
      run_folder(what.where.folder, what.where.force, what.name, what.where.inputs);
  try {
    kept.folder = folder.path();
    write_into(folder, resolved_name, what.resolved);
    if (!what.mapping.empty()) write_into(folder, mapping_name, what.mapping);
    RunLog log(folder.work() / log_name, what.name, what.seed, what.resolved,
               run::logged_topics(table));
    log.write(table);
    log.finish(what.resolved, "");
    write_into(folder, summary_name, kept.json);
    kept.page = write_report(folder, a, what.values, what.name, what.notices);
    commit_run(folder);
  } catch (const std::exception& problem) {
    throw std::runtime_error(problem.what() + where_left(folder));
  }
}

// Topics of a run, extended by measured topics that the run does not log already.
class Topics {
 public:
  explicit Topics(std::vector<signals::Topic> logged) : list_(std::move(logged)) {}

  void add(std::string name, std::string unit, std::string description) {
    add({std::move(name), std::move(description), {{"value", std::move(unit)}}});
  }
  void add(signals::Topic topic) {
    if (std::ranges::find(list_, topic.name, &signals::Topic::name) == list_.end())
      list_.push_back(std::move(topic));
  }
  std::vector<signals::Topic> take() { return std::move(list_); }

 private:
  std::vector<signals::Topic> list_;
};

double duration_of(const signals::Table& table) {
  std::int64_t end = 0;
  for (const signals::Series& s : table.series)
    if (!s.time_ns.empty()) end = std::max(end, s.time_ns.back());
  return 1e-9 * static_cast<double>(end);
}

void report(const recording::AssembledRecording& of, const std::vector<std::string>& filled,
            const Notices& notices) {
  for (const std::string& note : of.notes) notices.note(note);
  for (const std::string& note : filled) notices.note(note);
}

}  // namespace

experiment::ImportedFile imported_file(const std::string& path, const std::string& kind) {
  const log::Mapping bytes(path);
  return {.file = path,
          .kind = kind,
          .size = std::to_string(bytes.bytes().size()),
          .crc32 = fmt::format("{:08x}", bytes.crc(bytes.bytes().size()))};
}

std::vector<signals::Topic> importable_topics(const experiment::Experiment& e) {
  Topics out(run::topics(e));
  if (e.stand) {
    out.add("/stand/length", "m", "measured, of the element");
    out.add("/stand/force", "N", "measured, of the element");
    out.add("/muscle/" + e.stand->element.name + "/pressure", "Pa", "measured, absolute");
  }
  for (std::size_t j = 0; j < e.robot.joints.size(); ++j) {
    const std::string at = robot::topic_of_joint(e.robot, j);
    out.add(at + "/angle", "rad", "measured");
    out.add(at + "/velocity", "rad/s", "measured");
    out.add(at + "/torque", "N m", "measured; > 0 raises the angle");
  }
  for (std::size_t m = 0; m < e.robot.muscles.size(); ++m) {
    const std::string at = robot::topic_of_muscle(e.robot, m);
    out.add(at + "/tension", "N", "measured");
    out.add(at + "/pressure", "Pa", "measured, absolute");
    out.add(at + "/length", "m", "measured");
  }
  if (e.robot.trolley.present) {
    out.add("/trolley/position", "m", "measured");
    out.add("/trolley/velocity", "m/s", "measured");
  }
  if (e.robot.foot.present) {
    out.add({"/foot/position", "measured, about the first joint", {{"x", "m"}, {"y", "m"}}});
    out.add({"/foot/force", "measured, on the foot by the ground", {{"x", "N"}, {"y", "N"}}});
  }
  return out.take();
}

StoredRun store_imported(const signals::Table& table, const experiment::Experiment& e,
                         std::vector<experiment::ImportedFile> files, const std::string& mapping,
                         const RunRequest& where, const Notices& notices) {
  std::string resolved = experiment::resolved(e, SINEW_VERSION);
  if (!files.empty()) resolved = with_files(std::move(resolved), std::move(files));
  const config::Node values = config::parse_text(resolved, std::string(resolved_name));
  const analysis::Analysis a(table, analysis::read_machine(values));
  StoredRun kept{.summary = a.summary, .machine = a.machine, .json = to_json(a.summary)};
  kept.duration = duration_of(table);
  keep_files(a, {e.name, e.seed, resolved, values, mapping, where, notices}, kept);
  return kept;
}

StoredRun import_run(const ImportRequest& request, const Notices& notices) {
  refuse_early(request);
  const experiment::Experiment e = experiment::load(request.experiment, request.sets);
  recording::AssembledRecording read_in = read(request, e);
  const auto filled = fill_channels(read_in.table, e.robot, e.air.atmosphere, run::topics(e));
  report(read_in, filled, notices);
  if (!e.stand && !read_in.table.find("/plan/phase") && e.robot.legs.empty())
    notices.note("no plan in the recording: figures of its phases and steps are absent");
  auto kept = store_imported(
      read_in.table, e, facts_of(read_in), recording::text_of(read_in.used),
      {.folder = request.folder, .force = request.force, .inputs = inputs_of(request)}, notices);
  save_mapping(request, read_in);
  return kept;
}

}  // namespace sinew::run
