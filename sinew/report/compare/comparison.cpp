#include "sinew/report/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/units/quantity.h"

namespace sinew::report {

namespace {

// --- perfect sensors ---

// Adds readings of perfect sensors, so that measured channels can be compared with true ones: if a
// table has a topic only under /true and another table has it without /true, a copy under the plain
// name is added.
void add_perfect_sensors(const std::vector<signals::Table*>& tables) {
  constexpr std::string_view truth = "/true";
  std::set<std::string> measured;
  for (const signals::Table* table : tables)
    for (const signals::Series& s : table->series)
      if (!s.topic.name.starts_with("/true/")) measured.insert(s.topic.name);
  for (signals::Table* table : tables)
    for (const std::string& topic : measured) {
      const signals::Series* known = table->find(std::string(truth) + topic);
      if (!known || table->find(topic)) continue;
      signals::Series copy = *known;
      copy.topic.name = topic;
      copy.topic.description += "; as a sensor without error would read it";
      table->series.push_back(std::move(copy));
    }
}

std::string value_of(const std::vector<Parameter>& parameters, std::string_view key) {
  const auto at = std::ranges::find(parameters, key, &Parameter::key);
  return at == parameters.end() ? "" : at->value;
}

// Adds phases, drawings, charts and panels, from the samples at their aligned times.
void describe(ComparedRun& run, const analysis::Machine& machine) {
  const analysis::Record record(run.logged, machine, &run.derived);
  run.phases = phases_of(record, machine);
  Drawing drawing(run.logged, run.derived, machine, record);
  run.panels = panels(drawing.channels, machine);
  if (machine.stand) run.charts = stand_charts(drawing.channels, drawing.stand);
  run.drawn = std::move(drawing.drawn);
  run.scene = std::move(drawing.scene);
  run.stand = std::move(drawing.stand);
}

// Adds the results of the analysis, from the samples at their original times.
void open(ComparedRun& run, const analysis::Analysis& own) {
  run.title = own.machine.title;
  run.reproduces = own.machine.reproduces;
  run.robot = own.machine.robot.name;
  run.atmosphere = own.machine.atmosphere;
  run.summary = own.summary;
  run.verdicts = own.verdicts;
  run.derived = own.derived;
}

// Converts the run's times to the first run's clock.
void place(ComparedRun& run, const analysis::Machine& machine, const analysis::Clock& clock) {
  run.shift = clock.shift;
  analysis::reclock(run.logged, clock);
  analysis::reclock(run.derived, clock);
  describe(run, machine);
  if (const auto times = analysis::times_of(run.logged)) {
    run.first = static_cast<double>(times->first) / 1e9;
    run.last = static_cast<double>(times->last) / 1e9;
  }
}

[[noreturn]] void no_sequence(const std::string& label) {
  config::fail({label, 0, 0}, "align=sequence", "a run without phases",
               "a run that goes through a sequence", "align=start");
}

// The first run, with which others are aligned.
struct Base {
  const ComparedRun* run = nullptr;      // nullptr while the first run is opened
  std::optional<std::int64_t> sequence;  // start of its sequence [ns]
};

// Finds the run's clock in relation to the first one's.
analysis::Clock clock_of(ComparedRun& run, const AlignOptions& options, const Base& first,
                         std::optional<std::int64_t> sequence) {
  if (!first.run) return {};
  analysis::AlignRequest request{.name = run.label,
                                 .by = analysis::AlignBy::known,
                                 .event = options.event,
                                 .channels = options.channels,
                                 .fit_clock = options.fit_clock,
                                 .largest_shift = options.largest_shift,
                                 .atmosphere = first.run->atmosphere};
  if (options.by == Align::sequence) {
    request.shift = 1e-9 * static_cast<double>(*sequence - *first.sequence);
    request.known_at = 1e-9 * static_cast<double>(*first.sequence);
  }
  if (options.by == Align::event) request.by = analysis::AlignBy::event;
  if (options.by == Align::correlation) request.by = analysis::AlignBy::correlation;
  if (request.by == analysis::AlignBy::known && !options.fit_clock) return {request.shift, 0};
  run.alignment = analysis::align(first.run->logged, run.logged, request);
  return run.alignment->clock;
}

// Analyses a run and aligns it with `first`, in which the start of the first run's sequence is set.
ComparedRun opened(NamedRun&& recorded, const AlignOptions& options, Base& first) {
  ComparedRun run;
  run.label = std::move(recorded.label);
  run.logged = std::move(recorded.logged);
  run.parameters = parameters(recorded.resolved);
  run.seed = value_of(run.parameters, "seed");
  run.version = value_of(run.parameters, "sinew_version");
  const analysis::Machine machine = analysis::read_machine(recorded.resolved);
  std::optional<std::int64_t> sequence;  // start of the sequence [ns]
  {
    const analysis::Analysis own(run.logged, machine);
    open(run, own);
    if (own.record.has_sequence()) sequence = own.record.time_ns()[own.record.first_row()];
  }
  if (options.by == Align::sequence && !sequence) no_sequence(run.label);
  if (!first.run) first.sequence = sequence;
  place(run, machine, clock_of(run, options, first, sequence));
  return run;
}

// Adds the differences of a run to the rows of the channels.
void add_differences(std::vector<ChannelRow>& rows, const signals::Table& first,
                     const signals::Table& other, std::size_t run, std::size_t runs) {
  for (analysis::ChannelDifference& d : analysis::differences(first, other)) {
    auto at = std::ranges::find(rows, Channel{d.topic, d.field}, &ChannelRow::channel);
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
    return v.key == key && v.agreement != analysis::Verdict::Agreement::not_applicable;
  });
  if (at == verdicts.end()) return "";
  std::string out(to_text(at->agreement));
  if (at->statement_class != config::StatementClass::none)
    out += fmt::format(" ({})", to_text(at->statement_class));
  return out;
}

std::string_view to_text(Align align) {
  constexpr std::string_view names[] = {"start", "sequence", "event", "correlation"};
  return names[static_cast<std::size_t>(align)];
}

Comparison compare(std::vector<NamedRun> runs, const AlignOptions& options) {
  Comparison out{.align = options.by, .clocks_fitted = options.fit_clock};
  out.runs.reserve(runs.size());  // the pointer to the first run stays valid
  std::vector<signals::Table*> tables;
  for (NamedRun& run : runs) tables.push_back(&run.logged);
  add_perfect_sensors(tables);
  Base first;
  for (NamedRun& run : runs) {
    out.runs.push_back(opened(std::move(run), options, first));
    first.run = &out.runs.front();
  }

  std::vector<const analysis::Summary*> summaries;
  std::vector<const std::vector<Parameter>*> used;
  for (const ComparedRun& run : out.runs) {
    summaries.push_back(&run.summary);
    used.push_back(&run.parameters);
  }
  out.figures = analysis::compare_figures(summaries);
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

void keep(Comparison& comparison, const std::vector<std::string>& topics) {
  std::erase_if(comparison.channels, [&](const ChannelRow& row) {
    return std::ranges::find(topics, row.channel.topic) == topics.end();
  });
}

namespace {

// Differences of one channel of a run from the first run's.
struct Residual {
  std::string heading;  // "B /joint/hip/angle [rad]"
  analysis::PairedSamples met;
  std::size_t at = 0;  // index of the next difference to be written
};

// Returns the channel's samples, logged or derived.
analysis::Recording recording_of(const ComparedRun& run, const Channel& channel) {
  for (const signals::Table* table : {&run.logged, &run.derived}) {
    const signals::Series* s = table->find(channel.topic);
    if (s) return {&s->time_ns, table->column(channel.topic, channel.field)};
  }
  return {};
}

std::vector<Residual> residuals_of(const Comparison& c) {
  std::vector<Residual> out;
  for (std::size_t i = 1; i < c.runs.size(); ++i)
    for (const ChannelRow& row : c.channels) {
      if (!row.differences[i] || analysis::is_edges(row.channel.topic)) continue;
      const analysis::Recording a = recording_of(c.runs.front(), row.channel);
      const analysis::Recording b = recording_of(c.runs[i], row.channel);
      if (!a.values || !b.values) continue;
      analysis::PairedSamples met = analysis::pair_samples(a, b);
      if (met.time_ns.empty()) continue;
      out.push_back({fmt::format("{} {} [{}]", static_cast<char>('A' + i), row.channel.name(),
                                 units::difference_unit(row.unit)),
                     std::move(met)});
    }
  return out;
}

}  // namespace

std::string residuals_csv(const Comparison& comparison) {
  std::vector<Residual> all = residuals_of(comparison);
  std::string out = "time [s]";
  for (const Residual& r : all) out += "," + r.heading;
  out += "\n";
  for (;;) {
    // The next row is at the earliest time that is not written yet.
    std::optional<std::int64_t> now;
    for (const Residual& r : all)
      if (r.at < r.met.time_ns.size())
        now = std::min(now.value_or(r.met.time_ns[r.at]), r.met.time_ns[r.at]);
    if (!now) return out;
    out += units::format_number(1e-9 * static_cast<double>(*now));
    for (Residual& r : all) {
      out += ",";
      if (r.at >= r.met.time_ns.size() || r.met.time_ns[r.at] != *now) continue;
      const double d = r.met.difference[r.at++];
      if (std::isfinite(d)) out += units::format_number(d);
    }
    out += "\n";
  }
}

}  // namespace sinew::report
