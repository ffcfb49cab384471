#include "sinew/report/figures/run_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/stand.h"
#include "sinew/config/compose.h"
#include "sinew/report/page/panels.h"
#include "sinew/report/page/stand.h"
#include "sinew/robot/legs.h"

namespace sinew::report {
namespace {

using units::ShownUnit;
using Kind = Curve::Kind;

constexpr int most_colors = 4;  // in one plot; more go into the next one below

// An axis of plain numbers says so.
std::string unit_on_axis(const ShownUnit& unit) { return unit.name.empty() ? "-" : unit.label(); }

// What all captions of a run begin and end with.
struct About {
  std::string run;     // "Walking, test 1" (walk-test-1)
  std::string source;  // of every curve: "simulated, robot …, seed 1, sinew 0.1.0"
  Kind kind = Kind::computed;
};

std::string value_at(const config::Node& root, std::string_view key) {
  const config::Node* node = root.find(key);
  if (!node) return "";
  const config::Node* value = node->find("value");
  return config::written(value ? *value : *node);
}

bool is_simulated(const signals::Table& table) {
  return std::ranges::any_of(
      table.series, [](const signals::Series& s) { return s.topic.name.starts_with("/true/"); });
}

About about(const Run& run, const std::string& title, const std::string& robot) {
  const bool simulated = is_simulated(run.table);
  About out{.kind = simulated ? Kind::computed : Kind::measured};
  out.run = title.empty() ? run.name : "“" + title + "”";
  if (!title.empty() && !run.name.empty()) out.run += " (" + run.name + ")";
  std::vector<std::string> parts;
  parts.push_back(simulated ? "simulated" : "from a log without the channels of a simulation");
  if (!robot.empty()) parts.push_back("robot " + robot);
  for (const auto& [key, word] : {std::pair("seed", "seed "), std::pair("sinew_version", "Sinew ")})
    if (const std::string value = value_at(run.resolved, key); !value.empty())
      parts.push_back(word + value);
  out.source = fmt::format("{}", fmt::join(parts, ", "));
  return out;
}

class Maker {
 public:
  Maker(const Channels& channels, About about, const RunFigureOptions& options, double atmosphere)
      : channels_(channels), about_(std::move(about)), options_(options), atmosphere_(atmosphere) {}

  void shade(std::vector<Span> stance) { stance_ = std::move(stance); }
  // The faults that the run had, up to its end  [s].
  void shade(const std::vector<analysis::MachineFault>& faults, double end);
  void panel(const Panel& panel);
  // y over x, at the times of x; `desired` may have none.
  void over(const std::string& name, const std::string& title, const Axis& x, const Axis& y,
            std::vector<Curve> curves, bool equal_scale, const std::string& caption);
  Curve pair(const std::string& label, const Channel& x, const Channel& y, const ShownUnit& x_unit,
             const ShownUnit& y_unit, Kind kind) const;
  // For numbers of that size  [SI].
  ShownUnit unit(std::string_view of, double largest) const {
    return options_.units.of(of, largest, atmosphere_);
  }
  double largest(const Channel& channel) const;
  Kind kind() const { return about_.kind; }

  std::vector<Figure> list;

 private:
  bool shown(double seconds) const { return seconds >= options_.from && seconds <= options_.to; }
  Curve curve(const Line& line, const ShownUnit& unit, bool steps) const;
  std::string description(const Channel& channel) const;
  std::string meanings(const Panel& panel) const;
  void finish(Figure figure);

  const Channels& channels_;
  const About about_;
  const RunFigureOptions options_;
  const double atmosphere_;
  std::vector<Span> stance_, faults_;
  std::string broken_;  // those faults in words
};

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

void Maker::shade(const std::vector<analysis::MachineFault>& faults, double end) {
  std::vector<std::string> words;
  for (const analysis::MachineFault& f : faults) {
    const double to = std::min(f.end, end);
    if (f.begin > std::min(options_.to, end) || to < options_.from) continue;
    faults_.push_back({f.begin, to, Span::Of::fault});
    words.push_back(fmt::format("{} {} from {:.10g} s {}", f.of, f.what, f.begin,
                                std::isfinite(f.end) ? fmt::format("to {:.10g} s", f.end) : "on"));
  }
  broken_ = fmt::format("{}", fmt::join(words, ", "));
}

Curve Maker::curve(const Line& line, const ShownUnit& unit, bool steps) const {
  Curve out{.label = line.label, .kind = about_.kind, .color = line.color, .source = about_.source};
  if (line.style == Line::Style::desired) out.kind = Kind::desired;
  if (steps) out.style = Curve::Style::steps;
  const Samples samples = channels_.find(line.channel);
  for (std::size_t i = 0; i < samples.values->size(); ++i) {
    const double t = seconds((*samples.time_ns)[i]);
    if (!shown(t)) continue;
    out.xs.push_back(t);
    out.ys.push_back(unit.of((*samples.values)[i]));
  }
  return out;
}

double size_of(const signals::Column& values) {
  double out = 0;
  for (const double v : values)
    if (std::isfinite(v)) out = std::max(out, std::fabs(v));
  return out;
}

double Maker::largest(const Channel& channel) const {
  const Samples samples = channels_.find(channel);
  return samples ? size_of(*samples.values) : 0;
}

// At the times of x; y is held in between.
Curve Maker::pair(const std::string& label, const Channel& x, const Channel& y,
                  const ShownUnit& x_unit, const ShownUnit& y_unit, Kind kind) const {
  Curve out{.label = label, .kind = kind, .source = about_.source};
  const Samples a = channels_.find(x), b = channels_.find(y);
  if (!a || !b) return out;
  const analysis::Column held = analysis::held(*b.time_ns, *b.values, *a.time_ns);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!shown(seconds((*a.time_ns)[i]))) continue;
    out.xs.push_back(x_unit.of((*a.values)[i]));
    out.ys.push_back(y_unit.of(held[i]));
  }
  return out;
}

std::string Maker::description(const Channel& channel) const {
  for (const signals::Table* table : channels_.tables())
    if (const signals::Series* series = table->find(channel.topic))
      return series->topic.description;
  return "";
}

// "hip, knee: measured, by the controller's scale. hip desired: …"
std::string Maker::meanings(const Panel& panel) const {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_text;
  for (const Line& line : panel.lines) {
    const std::string text = description(line.channel);
    if (text.empty()) continue;
    const auto at = std::ranges::find(by_text, text, [](const auto& entry) { return entry.first; });
    if (at == by_text.end())
      by_text.push_back({text, {line.label}});
    else
      at->second.push_back(line.label);
  }
  std::string out;
  for (const auto& [text, labels] : by_text)
    out += fmt::format(" {}: {}.", fmt::join(labels, ", "), text);
  return out;
}

void Maker::finish(Figure figure) {
  std::erase_if(figure.plots, [](const Plot& plot) { return plot.curves.empty(); });
  if (figure.plots.empty()) return;
  const std::string name = figure.name;
  for (int n = 2; std::ranges::find(list, figure.name, &Figure::name) != list.end(); ++n)
    figure.name = fmt::format("{}-{}", name, n);
  list.push_back(std::move(figure));
}

std::string in_sentence(std::string title) {
  if (title.size() > 1 && !(title[1] >= 'A' && title[1] <= 'Z')) title[0] |= 0x20;
  return title;
}

void Maker::panel(const Panel& all) {
  Panel panel = all;
  std::erase_if(panel.lines, [](const Line& l) { return l.style == Line::Style::hidden; });
  if (panel.lines.empty()) return;
  double size = 0;
  for (const Line& line : panel.lines) size = std::max(size, largest(line.channel));
  const ShownUnit unit = this->unit(panel.unit, size);
  const bool steps = panel.group == "Valves";
  std::map<int, Plot> plots;
  for (const Line& line : panel.lines) {
    const int part = line.color / most_colors;
    Plot& plot = plots[part];
    plot.name = std::to_string(part + 1);
    plot.x = {"time", "s"};
    plot.y = {in_sentence(panel.title), unit_on_axis(unit)};
    plot.spans = stance_;
    plot.spans.insert(plot.spans.end(), faults_.begin(), faults_.end());
    plot.curves.push_back(curve(line, unit, steps));
    if (plot.curves.back().xs.empty()) plot.curves.pop_back();
  }
  const bool desired = std::ranges::any_of(
      panel.lines, [](const Line& l) { return l.style == Line::Style::desired; });
  Figure figure{.name = file_name_of(panel.title), .title = panel.title};
  figure.caption = fmt::format("{} of {}, {}.", panel.title, about_.run, about_.source);
  if (desired) figure.caption += " Dotted: desired.";
  if (!stance_.empty()) figure.caption += " Shaded: stance by plan.";
  if (!broken_.empty()) figure.caption += " Between red lines, broken on purpose: " + broken_ + ".";
  figure.caption += meanings(panel);
  for (auto& [part, plot] : plots) {
    if (plots.size() == 1 && plot.curves.size() == 1)
      plot.curves[0].label.clear();  // its axis says it
    figure.plots.push_back(std::move(plot));
  }
  finish(std::move(figure));
}

void Maker::over(const std::string& name, const std::string& title, const Axis& x, const Axis& y,
                 std::vector<Curve> curves, bool equal_scale, const std::string& caption) {
  std::erase_if(curves, [](const Curve& c) { return c.xs.empty(); });
  if (curves.size() == 1) curves[0].label.clear();
  Figure figure{.name = name, .title = title};
  figure.caption = fmt::format("{} of {}, {}.{}", title, about_.run, about_.source, caption);
  figure.plots.push_back({.x = x, .y = y, .curves = std::move(curves), .equal_scale = equal_scale});
  finish(std::move(figure));
}

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
            leg.empty() ? "Foot path" : "Foot path of leg " + leg,
            {"x forward", unit_on_axis(unit)}, {"y up", unit_on_axis(unit)},
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
  make.over(file_name_of(chart.title), chart.title, {in_sentence(chart.x.label), unit_on_axis(x)},
            {in_sentence(chart.y.label), unit_on_axis(y)}, std::move(curves), false, "");
}

std::vector<Figure> of_robot(const Run& run, const RunFigureOptions& options) {
  const analysis::Machine machine = analysis::read_machine(run.resolved);
  const signals::Table derived = analysis::derive(run.table, machine);
  const analysis::Record record(run.table, machine, &derived);
  Channels channels;
  channels.add(run.table);
  channels.add(derived);

  Maker make(channels, about(run, machine.title, machine.robot.name), options, machine.atmosphere);
  if (machine.robot.legs.empty()) make.shade(stance_of(record, machine));  // else each has its own
  if (record.rows() > 0) make.shade(machine.faults, record.time(record.rows() - 1));
  for (const Panel& panel : panels(channels, machine.robot)) make.panel(panel);
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

  Maker make(channels, about(run, file.title, ""), options, file.atmosphere);
  if (!stand_of_run.empty()) {
    const signals::Times& time = *channels.find(stand_of_run.length).time_ns;
    if (!time.empty()) make.shade(file.faults, seconds(time.back()));
  }
  for (const Panel& panel : panels_of_stand(channels, file.element)) make.panel(panel);
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

std::vector<Figure> run_figures(const Run& run, const RunFigureOptions& options) {
  return config::format_kind(run.resolved) == "rig" ? of_stand(run, options)
                                                    : of_robot(run, options);
}

}  // namespace sinew::report
