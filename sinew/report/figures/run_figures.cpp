#include "sinew/report/figures/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/stand.h"
#include "sinew/config/compose.h"
#include "sinew/report/figures/channel_figures.h"
#include "sinew/report/figures/run_maker.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/stand.h"
#include "sinew/robot/legs.h"

namespace sinew::report {
namespace {

using units::ShownUnit;
using Kind = Curve::Kind;

// `leg`: whose; empty: the machine's only one.
void add_foot_path(Maker& make, const Channels& channels, const std::string& leg) {
  const std::string measured = robot::topic_of_leg(leg, "/foot/position");
  const std::string desired = robot::topic_of_leg(leg, "/desired/foot/position");
  std::string which;
  for (const std::string& topic : {robot::topic_of_leg(leg, "/true/foot/position"), measured})
    if (which.empty() && channels.has({topic, "x"})) which = topic;
  if (which.empty()) return;
  const ShownUnit unit =
      make.unit("m", std::max(make.largest({which, "x"}), make.largest({which, "y"})));
  const auto path = [&](const char* label, const std::string& topic, Kind kind) {
    return make.pair(label, {topic, "x"}, {topic, "y"}, unit, unit, kind);
  };
  make.over(leg.empty() ? "foot-path" : "foot-path-" + leg,
            leg.empty() ? "Foot path" : "Foot path of leg " + leg, axis_of("x forward", unit),
            axis_of("y up", unit),
            {path("actual", which, make.kind()), once(path("desired", desired, Kind::desired))},
            true,
            which == measured
                ? " Of the ankle about the first joint, from measured angles; the desired one once."
                : " Of the ankle about the first joint, as simulated; the desired one once.");
}

// The numbers of a chart, in its axes' units.
Curve charted(const Maker& make, const ChartCurve& from, const ShownUnit& x, const ShownUnit& y) {
  Curve out = from.x_channel.none()
                  ? Curve{.label = from.label, .xs = from.x, .ys = from.y, .kind = make.kind()}
                  : make.pair(from.label, from.x_channel, from.y_channel, x, y, make.kind());
  out.color = from.color;
  if (from.style != ChartCurve::Style::line) out.style = Curve::Style::points;
  if (!from.x_channel.none()) return out;
  for (double& value : out.xs) value = x.of(value);
  for (double& value : out.ys) value = y.of(value);
  return out;
}

void add_chart(Maker& make, const Chart& chart) {
  double x_size = 0, y_size = 0;
  for (const ChartCurve& c : chart.curves) {
    x_size = std::max({x_size, size_of(c.x), make.largest(c.x_channel)});
    y_size = std::max({y_size, size_of(c.y), make.largest(c.y_channel)});
  }
  const ShownUnit x = make.unit(chart.x.unit, x_size), y = make.unit(chart.y.unit, y_size);
  std::vector<Curve> curves;
  for (const ChartCurve& c : chart.curves) {
    Curve curve = charted(make, c, x, y);
    // The points of the line before them.
    if (!curves.empty() && curve.label.empty() && curve.xs == curves.back().xs)
      curves.back().style = Curve::Style::marked;
    else
      curves.push_back(std::move(curve));
  }
  make.over(file_name_of(chart.title), chart.title, axis_of(in_sentence(chart.x.label), x),
            axis_of(in_sentence(chart.y.label), y), std::move(curves), false, "");
}

std::vector<Figure> of_robot(const Run& run, const RunFigureOptions& options) {
  const analysis::Machine machine = analysis::read_machine(run.resolved);
  const signals::Table derived = analysis::derive(run.table, machine);
  const analysis::Record record(run.table, machine, &derived);
  Channels channels;
  channels.add(run.table);
  channels.add(derived);

  Maker make(channels, words_of(run, machine.title, machine.robot.name), options,
             machine.atmosphere);
  if (machine.robot.legs.empty()) make.shade(stance_of(record, machine));  // else each has its own
  if (record.rows() > 0) make.shade(machine.faults, record.time(record.rows() - 1));
  const std::vector<Panel> all = panels(channels, machine.robot);
  if (!options.channels.empty()) return channel_figures(make, channels, all, options.channels);
  for (const Panel& panel : all) make.panel(panel);
  for (const robot::LegParts& leg : robot::legs_of(machine.robot))
    add_foot_path(make, channels, leg.name);
  return std::move(make.list);
}

std::vector<Figure> of_stand(const Run& run, const RunFigureOptions& options) {
  const analysis::StandFile file = analysis::read_stand(run.resolved);
  Channels channels;
  channels.add(run.table);
  signals::Table drawn;
  const Stand stand_of_run = stand(channels, run.resolved, file, drawn);
  channels.add(drawn);

  Maker make(channels, words_of(run, file.title, ""), options, file.atmosphere);
  if (!stand_of_run.empty()) {
    const signals::Times& time = *channels.find(stand_of_run.length).time_ns;
    if (!time.empty()) make.shade(file.faults, seconds_of(time.back()));
  }
  const std::vector<Panel> all = panels_of_stand(channels, file.element);
  if (!options.channels.empty()) return channel_figures(make, channels, all, options.channels);
  for (const Panel& panel : all) make.panel(panel);
  for (const Chart& chart : stand_charts(channels, stand_of_run)) add_chart(make, chart);
  return std::move(make.list);
}

}  // namespace

std::vector<Span> stance_of(const analysis::Record& record, const analysis::Machine& machine) {
  std::vector<Span> out;
  for (const analysis::Stretch& s : record.stretches()) {
    if (!analysis::is_stance(machine, s.phase)) continue;
    const double from = record.time(s.first), to = record.end_of(s.last - 1);
    if (!out.empty() && from - out.back().to < 1e-9)
      out.back().to = to;  // foot plant and propulsion
    else
      out.push_back({from, to});
  }
  return out;
}

std::vector<std::string> topics_of(const Run& run) {
  std::vector<std::string> out;
  const auto add = [&](const signals::Table& table) {
    for (const signals::Series& s : table.series) out.push_back(s.topic.name);
  };
  add(run.table);
  if (config::format_kind(run.resolved) != "rig")
    add(analysis::derive(run.table, analysis::read_machine(run.resolved)));
  return out;
}

std::vector<Figure> run_figures(const Run& run, const RunFigureOptions& options) {
  return config::format_kind(run.resolved) == "rig" ? of_stand(run, options)
                                                    : of_robot(run, options);
}

}  // namespace sinew::report
