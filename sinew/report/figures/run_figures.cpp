#include "sinew/report/figures/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/config/compose.h"
#include "sinew/report/figures/run_maker.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/stand.h"
#include "sinew/robot/legs.h"

namespace sinew::report {

namespace {

// --- figures of channels that a user chose ---

constexpr std::string_view truth = "/true";

bool same(const Channel& a, const Channel& b) { return a.topic == b.topic && a.field == b.field; }

// The topics of a choice, in the order of the tables.
std::vector<const signals::Series*> topics_in(const Channels& channels, const ChosenChannels& of) {
  std::vector<const signals::Series*> out;
  const auto add = [&](bool true_ones) {
    for (const signals::Table* table : channels.tables())
      for (const signals::Series& s : table->series) {
        std::string_view name = s.topic.name;
        if (true_ones && !name.starts_with(truth)) continue;
        if (true_ones) name.remove_prefix(truth.size());
        const bool there = std::ranges::any_of(
            out, [&](const signals::Series* o) { return o->topic.name == s.topic.name; });
        if (!there && of.has(name)) out.push_back(&s);
      }
  };
  add(false);
  if (out.empty()) add(true);
  return out;
}

// Where a channel stands in the panels; nullptr for both where it does not.
struct Known {
  const Panel* panel = nullptr;
  const Line* line = nullptr;
};

Known known(const std::vector<Panel>& panels, const Channel& channel) {
  for (const Panel& panel : panels)
    for (const Line& line : panel.lines)
      if (same(line.channel, channel)) return {&panel, &line};
  return {};
}

const Line* desired_of(const Known& of) {
  if (!of.panel || of.line->style == Line::Style::desired) return nullptr;
  for (const Line& line : of.panel->lines)
    if (line.style == Line::Style::desired && line.color == of.line->color) return &line;
  return nullptr;
}

// "/valve/hip_flexor/inlet/open" -> "valve hip flexor inlet open"
std::string words_in(std::string topic) {
  std::ranges::replace(topic, '/', ' ');
  std::ranges::replace(topic, '_', ' ');
  topic.erase(0, topic.find_first_not_of(' '));
  return topic;
}

// One plot, or as many as it has units, each as a panel.
class Part {
 public:
  Part(const Channels& channels, const std::vector<Panel>& panels, const ChosenChannels& of)
      : channels_(channels), panels_(panels), topics_(topics_in(channels, of)) {
    for (const signals::Series* s : topics_)
      for (const signals::Field& field : s->topic.fields) add({s->topic.name, field.name});
  }
  std::vector<Panel> list;

 private:
  void add(const Channel& channel) {
    const Samples samples = channels_.find(channel);
    if (!samples) return;
    const Known at = known(panels_, channel);
    Panel& panel = panel_for(at, channel, at.panel ? at.panel->unit : samples.unit);
    const auto there = [&](const Channel& c) {
      return std::ranges::any_of(panel.lines, [&](const Line& l) { return same(l.channel, c); });
    };
    if (there(channel)) return;
    const bool is_desired = at.line && at.line->style == Line::Style::desired;
    const int color = colors_of(panel);
    panel.lines.push_back({at.line ? at.line->label : label_of(channel), channel, color,
                           is_desired ? Line::Style::desired : Line::Style::measured});
    const Line* desired = desired_of(at);
    if (desired && channels_.has(desired->channel) && !there(desired->channel))
      panel.lines.push_back({desired->label, desired->channel, color, Line::Style::desired});
  }

  static int colors_of(const Panel& panel) {
    int out = 0;
    for (const Line& line : panel.lines) out = std::max(out, line.color + 1);
    return out;
  }

  std::string label_of(const Channel& channel) const {
    const std::string name = words_in(channel.topic);
    return channel.field == "value" ? name : name + " " + channel.field;
  }

  // Returns what all channels of a unit are called: as their panel, or as the end of their topics.
  Panel& panel_for(const Known& at, const Channel& channel, const std::string& unit) {
    const std::string title = at.panel && at.panel->title.find("channels") == std::string::npos
                                  ? at.panel->title
                                  : words_in(channel.topic.substr(channel.topic.rfind('/') + 1));
    for (Panel& panel : list)
      if (panel.unit == unit) {
        if (panel.title != title) panel.title = "value";
        return panel;
      }
    // Steps are drawn where a value holds until the next one.
    const bool steps =
        signals::is_of_valve(channel.topic) || (at.panel && at.panel->group == "Valves");
    list.push_back({steps ? "Valves" : "", title, unit, {}});
    return list.back();
  }

  const Channels& channels_;
  const std::vector<Panel>& panels_;
  const std::vector<const signals::Series*> topics_;
};

// Names of files, of what was asked for.
std::string name_for(const ChosenFigure& chosen) {
  std::string out;
  for (const ChosenChannels& part : chosen) out += part.name + " ";
  return file_name_of(out);
}

Figure figure_of(const Maker& make, const Channels& channels, const std::vector<Panel>& panels,
                 const ChosenFigure& chosen) {
  Figure figure{.name = name_for(chosen)};
  Panel all;  // for what is said of all lines
  for (const ChosenChannels& part : chosen) {
    const Part made(channels, panels, part);
    for (const Panel& panel : made.list) {
      for (Plot& plot : make.plots(panel)) {
        plot.name = fmt::format("{}-{}", figure.plots.size() + 1, file_name_of(panel.title));
        figure.plots.push_back(std::move(plot));
      }
      figure.title += (figure.title.empty() ? "" : ", ") + in_sentence(panel.title);
      all.lines.insert(all.lines.end(), panel.lines.begin(), panel.lines.end());
    }
  }
  if (!figure.title.empty() && figure.title[0] >= 'a' && figure.title[0] <= 'z')
    figure.title[0] = static_cast<char>(figure.title[0] - 'a' + 'A');
  figure.caption = fmt::format("{} of {}, {}.{}", figure.title, make.words().run,
                               make.words().source, make.notes(all));
  return figure;
}

// A figure for each choice, a plot for each of its parts, or several where a part has channels of
// several units. Beside a channel stands what it was to be, where the run has that. `panels` know
// what the channels are called and what they are measured in; a channel that no panel has is called
// as its topic. A choice that the run has nothing of leaves its plot out.
std::vector<Figure> channel_figures(Maker& make, const Channels& channels,
                                    const std::vector<Panel>& panels,
                                    const std::vector<ChosenFigure>& chosen) {
  for (const ChosenFigure& one : chosen) make.finish(figure_of(make, channels, panels, one));
  return std::move(make.list);
}

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
  add(run.analysis.table);
  add(run.analysis.derived);
  return out;
}

std::vector<Figure> run_figures(const Run& run, const RunFigureOptions& options) {
  const analysis::Machine& machine = run.analysis.machine;
  const analysis::Record& record = run.analysis.record;
  Channels channels;
  channels.add(run.analysis.table);
  channels.add(run.analysis.derived);
  signals::Table drawn;
  Stand stand_of_run;
  if (machine.stand) stand_of_run = stand(channels, machine, drawn);
  channels.add(drawn);

  Maker make(channels, words_of(run, machine.title, machine.robot.name), options,
             machine.atmosphere);
  if (machine.robot.legs.empty()) make.shade(stance_of(record, machine));  // else each has its own
  if (record.rows() > 0) make.shade(machine.faults, record.time(record.rows() - 1));
  if (!stand_of_run.empty()) {
    const signals::Times& time = *channels.find(stand_of_run.length).time_ns;
    if (!time.empty()) make.shade(machine.faults, seconds_of(time.back()));
  }
  const std::vector<Panel> all = panels(channels, machine);
  if (!options.channels.empty()) return channel_figures(make, channels, all, options.channels);
  for (const Panel& panel : all) make.panel(panel);
  for (const robot::LegParts& leg : robot::legs_of(machine.robot))
    add_foot_path(make, channels, leg.name);
  if (machine.stand)
    for (const Chart& chart : stand_charts(channels, stand_of_run)) add_chart(make, chart);
  return std::move(make.list);
}

}  // namespace sinew::report
