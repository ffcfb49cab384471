#include "sinew/report/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/stand.h"
#include "sinew/config/compose.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/stand.h"

namespace sinew::report {
namespace {

std::string value_of(const std::vector<Parameter>& parameters, std::string_view key) {
  const auto at = std::ranges::find(parameters, key, &Parameter::key);
  return at == parameters.end() ? "" : at->value;
}

// Start of the sequence; nothing where the run has none  [ns].
std::optional<std::int64_t> sequence_start(const signals::Table& table,
                                           const analysis::Machine& machine) {
  const analysis::Record record(table, machine);
  if (!record.has_sequence()) return std::nullopt;
  return record.time_ns()[record.first_row()];
}

// What follows from the samples at their new times.
void describe(ComparedRun& run, const analysis::Machine& machine, const config::Node&) {
  run.derived = analysis::derive(run.logged, machine);
  const analysis::Record record(run.logged, machine, &run.derived);
  run.phases = phases_of(record, machine);
  Channels channels;
  channels.add(run.logged);
  channels.add(run.derived);
  run.panels = panels(channels, machine.robot);
}

void describe(ComparedRun& run, const analysis::StandFile& file, const config::Node& resolved) {
  run.phases = R"({"names":[],"stretches":[]})";
  Channels channels;
  channels.add(run.logged);
  const Stand drawn = stand(channels, resolved, file, run.drawn);
  channels.add(run.drawn);
  run.charts = stand_charts(channels, drawn);
  run.panels = panels_of_stand(channels, file.element);
}

// Of a machine or a stand; its times are moved back by `shift_ns`.
template <class Machine>
void open(ComparedRun& run, const Machine& machine, const config::Node& resolved,
          std::int64_t shift_ns) {
  run.title = machine.title;
  run.reproduces = machine.reproduces;
  run.atmosphere = machine.atmosphere;
  run.summary = analysis::summarize(run.logged, machine);
  run.verdicts = compare(run.summary, machine.reported, machine.atmosphere);
  run.shift = static_cast<double>(shift_ns) / 1e9;
  analysis::shift(run.logged, shift_ns);
  describe(run, machine, resolved);
  if (const auto times = analysis::times_of(run.logged)) {
    run.first = static_cast<double>(times->first) / 1e9;
    run.last = static_cast<double>(times->last) / 1e9;
  }
}

[[noreturn]] void no_sequence(const std::string& label) {
  config::fail({label, 0, 0}, "align=sequence", "a run without phases",
               "a run that goes through a sequence", "align=start");
}

// `sequence` is the first run's start, known after it was opened.
ComparedRun opened(RecordedRun&& recorded, Align align, std::optional<std::int64_t>& sequence) {
  ComparedRun run;
  run.label = std::move(recorded.label);
  run.logged = std::move(recorded.logged);
  run.parameters = parameters(recorded.resolved);
  run.seed = value_of(run.parameters, "seed");
  run.version = value_of(run.parameters, "sinew_version");
  if (config::format_kind(recorded.resolved) == "rig") {
    if (align == Align::sequence) no_sequence(run.label);
    open(run, analysis::read_stand(recorded.resolved), recorded.resolved, 0);
    return run;
  }
  const analysis::Machine machine = analysis::read_machine(recorded.resolved);
  run.robot = machine.robot.name;
  std::int64_t shift_ns = 0;
  if (align == Align::sequence) {
    const auto start = sequence_start(run.logged, machine);
    if (!start) no_sequence(run.label);
    if (!sequence) sequence = start;
    shift_ns = *start - *sequence;
  }
  open(run, machine, recorded.resolved, shift_ns);
  return run;
}

// Into the rows of the first run's channels.
void add_differences(std::vector<ChannelRow>& rows, const signals::Table& first,
                     const signals::Table& other, std::size_t run, std::size_t runs) {
  for (analysis::ChannelDifference& d : analysis::differences(first, other)) {
    const auto same = [&](const ChannelRow& r) {
      return r.channel.topic == d.topic && r.channel.field == d.field;
    };
    auto at = std::ranges::find_if(rows, same);
    if (at == rows.end()) {
      rows.push_back({{d.topic, d.field}, d.unit, {}});
      at = rows.end() - 1;
      at->differences.resize(runs);
    }
    at->differences[run] = d.difference;
  }
}

}  // namespace

std::string ComparedRun::verdict_of(const std::string& key) const {
  const auto at = std::ranges::find_if(verdicts, [&](const analysis::Verdict& v) {
    return v.key == key && v.is != analysis::Verdict::Is::not_applicable;
  });
  if (at == verdicts.end()) return "";
  std::string out(to_text(at->is));
  if (at->statement_class != config::StatementClass::none)
    out += fmt::format(" ({})", to_text(at->statement_class));
  return out;
}

Comparison compare(std::vector<RecordedRun> runs, Align align) {
  Comparison out{.align = align};
  std::optional<std::int64_t> sequence;
  for (RecordedRun& run : runs) out.runs.push_back(opened(std::move(run), align, sequence));

  std::vector<const analysis::Summary*> summaries;
  std::vector<const std::vector<Parameter>*> used;
  for (const ComparedRun& run : out.runs) {
    summaries.push_back(&run.summary);
    used.push_back(&run.parameters);
  }
  out.figures = analysis::figures_beside(summaries);
  out.parameters = differing(used);

  const std::size_t count = out.runs.size();
  for (const auto table : {&ComparedRun::logged, &ComparedRun::derived})
    for (std::size_t i = 1; i < count; ++i)
      add_differences(out.channels, out.runs.front().*table, out.runs[i].*table, i, count);
  if (out.channels.empty())
    config::fail({out.runs.back().label, 0, 0}, "",
                 "no channel that " + out.runs.front().label + " has too",
                 "runs with common channels",
                 "other channels: the first line of a run's log as CSV names its own");
  return out;
}

void keep(Comparison& comparison, const std::set<std::string>& topics) {
  std::erase_if(comparison.channels,
                [&](const ChannelRow& row) { return !topics.contains(row.channel.topic); });
}

}  // namespace sinew::report
