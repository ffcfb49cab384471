#include "sinew/report/figures/run_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/report/page/content.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/plot.h"
#include "sinew/report/page/stand.h"
#include "sinew/robot/legs.h"

namespace sinew::report {

namespace {

using units::ShownUnit;
using Kind = Curve::Kind;

// --- Common part of the figures of one run: samples in shown units, shaded spans, captions ---

constexpr int most_colors = 4;  // in one plot; more go into the next one below

// Description of a run in captions and curves.
struct RunDescription {
  std::string run;     // "Walking, test 1" (walk-test-1)
  std::string source;  // source of every curve: "simulated, robot …, seed 1, Sinew 0.1.0"
  Curve::Kind kind = Curve::Kind::computed;
};

bool is_simulated(const signals::Table& table) {
  return std::ranges::any_of(
      table.series, [](const signals::Series& s) { return s.topic.name.starts_with("/true/"); });
}

// Returns the description of a run. `title` and `robot` may be empty.
RunDescription words_of(const Run& run, const std::string& title, const std::string& robot) {
  const bool simulated = is_simulated(run.analysis.table);
  RunDescription out{.kind = simulated ? Kind::computed : Kind::measured};
  out.run = title.empty() ? run.name : "“" + title + "”";
  if (!title.empty() && !run.name.empty()) out.run += " (" + run.name + ")";
  std::vector<std::string> parts;
  parts.push_back(simulated ? "simulated" : "from a log without the channels of a simulation");
  if (!robot.empty()) parts.push_back("robot " + robot);
  for (const auto& [key, word] : {std::pair("seed", "seed "), std::pair("sinew_version", "Sinew ")})
    if (const std::string value = value_text(run.resolved, key); !value.empty())
      parts.push_back(word + value);
  out.source = fmt::format("{}", fmt::join(parts, ", "));
  return out;
}

// Converts a time of a table  [s].
double seconds_of(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

// Returns an axis of a quantity in a unit; plain numbers have the unit "-".
Axis axis_of(std::string name, const units::ShownUnit& unit) {
  return {
      .name = std::move(name), .unit = unit.name.empty() ? "-" : unit.label(), .scale = unit.scale};
}

// Returns the greatest magnitude of the finite values; 0 without any.
double size_of(const signals::Column& values) {
  double out = 0;
  for (const double v : values)
    if (std::isfinite(v)) out = std::max(out, std::fabs(v));
  return out;
}

// Returns a title for use within a sentence, "joint angles" for "Joint angles".
std::string in_sentence(std::string title) {
  if (title.size() > 1 && !(title[1] >= 'A' && title[1] <= 'Z')) title[0] |= 0x20;
  return title;
}

// Makes the figures of one run out of its channels.
class Maker {
 public:
  // `channels` must outlive this. `atmosphere` is the reference of gauge pressures  [Pa].
  Maker(const Channels& channels, RunDescription about, const RunFigureOptions& options,
        double atmosphere)
      : channels_(channels), about_(std::move(about)), options_(options), atmosphere_(atmosphere) {}

  // Shades the stance.
  void shade(std::vector<Span> stance) { stance_ = std::move(stance); }
  // The faults that the run had, up to its end  [s].
  void shade(const std::vector<analysis::MachineFault>& faults, double end);
  // Adds the figure of a panel, without its hidden lines.
  void panel(const Plot& panel);
  // Returns the lines of a panel as plots, each with as many lines as there are colors. Plots
  // without samples are left out.
  std::vector<Plot> plots(const Plot& panel) const;
  // Returns the end of all captions of the run: stance, faults, and the definitions of the lines.
  std::string notes(const Plot& panel) const;
  // Adds a figure under a unique name, unless it is empty.
  void finish(Figure figure);
  // Adds a figure of curves of y over x, without those that have no samples.
  void over(const std::string& name, const std::string& title, const Axis& x, const Axis& y,
            std::vector<Curve> curves, bool equal_scale, const std::string& caption);
  // Returns a curve in these units, with numbers in place of its channels. y is held between its
  // samples.
  Curve in_numbers(Curve curve, const units::ShownUnit& x, const units::ShownUnit& y) const;
  // Returns the shown unit for numbers of that size  [SI].
  units::ShownUnit unit(std::string_view of, double largest) const {
    return options_.units.of(of, largest, atmosphere_);
  }
  // Returns the greatest magnitude of the y of curves  [SI].
  double largest(const std::vector<Curve>& curves) const;
  double largest(const Channel& channel) const;
  const RunDescription& words() const { return about_; }

  std::vector<Figure> list;

 private:
  bool shown(double seconds) const { return seconds >= options_.from && seconds <= options_.to; }
  std::string description(const Channel& channel) const;
  std::string meanings(const Plot& panel) const;

  const Channels& channels_;
  const RunDescription about_;
  const RunFigureOptions options_;
  const double atmosphere_;
  std::vector<Span> stance_, faults_;
  std::string broken_;  // description of the faults
};

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

double Maker::largest(const Channel& channel) const {
  const Samples samples = channels_.find(channel);
  return samples ? size_of(*samples.values) : 0;
}

double Maker::largest(const std::vector<Curve>& curves) const {
  double out = 0;
  for (const Curve& c : curves) out = std::max({out, size_of(c.ys), largest(c.y_channel)});
  return out;
}

Curve Maker::in_numbers(Curve curve, const units::ShownUnit& x, const units::ShownUnit& y) const {
  curve.source = about_.source;
  if (curve.kind != Kind::desired) curve.kind = about_.kind;
  if (curve.y_channel.is_empty()) {
    for (double& value : curve.xs) value = x.of(value);
    for (double& value : curve.ys) value = y.of(value);
    return curve;
  }
  const bool over_time = curve.x_channel.is_empty();
  const Samples ys = channels_.find(curve.y_channel);
  const Samples xs = over_time ? ys : channels_.find(curve.x_channel);
  if (!xs || !ys) return curve;
  analysis::Column held;
  if (!over_time) held = analysis::held(*ys.time_ns, *ys.values, *xs.time_ns);
  for (std::size_t i = 0; i < xs.values->size(); ++i) {
    const double t = seconds_of((*xs.time_ns)[i]);
    if (!shown(t)) continue;
    curve.xs.push_back(over_time ? t : x.of((*xs.values)[i]));
    curve.ys.push_back(y.of(over_time ? (*ys.values)[i] : held[i]));
  }
  return curve;
}

std::string Maker::description(const Channel& channel) const {
  for (const signals::Table* table : channels_.tables())
    if (const signals::Series* series = table->find(channel.topic))
      return series->topic.description;
  return "";
}

// Returns the definitions of lines: "hip, knee: measured, by the controller's scale. hip desired:
// …"
std::string Maker::meanings(const Plot& panel) const {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_text;
  for (const Curve& line : panel.curves) {
    const std::string text = description(line.y_channel);
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

std::string Maker::notes(const Plot& panel) const {
  std::string out;
  if (std::ranges::any_of(panel.curves, [](const Curve& c) { return c.kind == Kind::desired; }))
    out += " Dotted: desired.";
  if (!stance_.empty()) out += " Shaded: stance by plan.";
  if (!broken_.empty()) out += " Between red lines, broken on purpose: " + broken_ + ".";
  return out + meanings(panel);
}

std::vector<Plot> Maker::plots(const Plot& panel) const {
  const units::ShownUnit unit = this->unit(panel.y.unit, largest(panel.curves));
  const bool steps = panel.group == "Valves";
  std::map<int, Plot> parts;
  for (const Curve& line : panel.curves) {
    const int part = line.color / most_colors;
    Plot& plot = parts[part];
    plot.name = std::to_string(part + 1);
    plot.x = {"time", "s"};
    plot.y = axis_of(in_sentence(panel.title), unit);
    plot.spans = stance_;
    plot.spans.insert(plot.spans.end(), faults_.begin(), faults_.end());
    plot.curves.push_back(in_numbers(line, {}, unit));
    if (steps) plot.curves.back().style = Curve::Style::steps;
    if (plot.curves.back().xs.empty()) plot.curves.pop_back();
  }
  std::vector<Plot> out;
  for (auto& [part, plot] : parts)
    if (!plot.curves.empty()) out.push_back(std::move(plot));
  return out;
}

void Maker::panel(const Plot& all) {
  Plot panel = all;
  std::erase_if(panel.curves, [](const Curve& c) { return c.hidden; });
  if (panel.curves.empty()) return;
  Figure figure{.name = file_name_of(panel.title), .title = panel.title};
  figure.caption = fmt::format("{} of {}, {}.", panel.title, about_.run, about_.source);
  figure.caption += notes(panel);
  figure.plots = plots(panel);
  if (figure.plots.size() == 1 && figure.plots[0].curves.size() == 1)
    figure.plots[0].curves[0].label.clear();  // its axis has the name
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

// --- figures of channels that a user chose ---

constexpr std::string_view truth = "/true";

// Returns the topics of a choice, in the order of the tables.
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

// Position of a channel in the panels; nullptr for both if no panel has it.
struct PanelLine {
  const Plot* panel = nullptr;
  const Curve* line = nullptr;
};

PanelLine find_line(const std::vector<Plot>& panels, const Channel& channel) {
  for (const Plot& panel : panels)
    for (const Curve& line : panel.curves)
      if (line.y_channel == channel) return {&panel, &line};
  return {};
}

const Curve* desired_of(const PanelLine& of) {
  if (!of.panel || of.line->kind == Kind::desired) return nullptr;
  for (const Curve& line : of.panel->curves)
    if (line.kind == Kind::desired && line.color == of.line->color) return &line;
  return nullptr;
}

// Converts "/valve/hip_flexor/inlet/open" to "valve hip flexor inlet open".
std::string words_in(std::string topic) {
  std::ranges::replace(topic, '/', ' ');
  std::ranges::replace(topic, '_', ' ');
  topic.erase(0, topic.find_first_not_of(' '));
  return topic;
}

// One chosen plot as panels, one for each unit.
class Part {
 public:
  Part(const Channels& channels, const std::vector<Plot>& panels, const ChosenChannels& of)
      : channels_(channels), panels_(panels), topics_(topics_in(channels, of)) {
    for (const signals::Series* s : topics_)
      for (const signals::Field& field : s->topic.fields) add({s->topic.name, field.name});
  }
  std::vector<Plot> list;

 private:
  void add(const Channel& channel) {
    const Samples samples = channels_.find(channel);
    if (!samples) return;
    const PanelLine at = find_line(panels_, channel);
    Plot& panel = panel_for(at, channel, at.panel ? at.panel->y.unit : samples.unit);
    const auto there = [&](const Channel& c) {
      return std::ranges::find(panel.curves, c, &Curve::y_channel) != panel.curves.end();
    };
    if (there(channel)) return;
    int color = 0;
    for (const Curve& line : panel.curves) color = std::max(color, line.color + 1);
    const bool is_desired = at.line && at.line->kind == Kind::desired;
    panel.curves.push_back({.label = at.line ? at.line->label : label_of(channel),
                            .kind = is_desired ? Kind::desired : Kind::computed,
                            .color = color,
                            .y_channel = channel});
    const Curve* desired = desired_of(at);
    if (!desired || !channels_.has(desired->y_channel) || there(desired->y_channel)) return;
    panel.curves.push_back(*desired);
    panel.curves.back().color = color;
  }

  std::string label_of(const Channel& channel) const {
    const std::string name = words_in(channel.topic);
    return channel.field == "value" ? name : name + " " + channel.field;
  }

  // Returns the panel of a unit, creating it if it is new. Its title is that of the channel's
  // panel, or the end of its topic.
  Plot& panel_for(const PanelLine& at, const Channel& channel, const std::string& unit) {
    const std::string title = at.panel && at.panel->title.find("channels") == std::string::npos
                                  ? at.panel->title
                                  : words_in(channel.topic.substr(channel.topic.rfind('/') + 1));
    for (Plot& panel : list)
      if (panel.y.unit == unit) {
        if (panel.title != title) panel.title = "value";
        return panel;
      }
    // Values that hold until the next one are drawn as steps.
    const bool steps =
        signals::is_of_valve(channel.topic) || (at.panel && at.panel->group == "Valves");
    list.push_back({.title = title, .y = {.unit = unit}, .group = steps ? "Valves" : ""});
    return list.back();
  }

  const Channels& channels_;
  const std::vector<Plot>& panels_;
  const std::vector<const signals::Series*> topics_;
};

// Returns the file name of a chosen figure.
std::string name_for(const ChosenFigure& chosen) {
  std::string out;
  for (const ChosenChannels& part : chosen) out += part.name + " ";
  return file_name_of(out);
}

Figure figure_of(const Maker& make, const Channels& channels, const std::vector<Plot>& panels,
                 const ChosenFigure& chosen) {
  Figure figure{.name = name_for(chosen)};
  Plot all;  // all lines, for the notes
  for (const ChosenChannels& part : chosen) {
    const Part made(channels, panels, part);
    for (const Plot& panel : made.list) {
      for (Plot& plot : make.plots(panel)) {
        plot.name = fmt::format("{}-{}", figure.plots.size() + 1, file_name_of(panel.title));
        figure.plots.push_back(std::move(plot));
      }
      figure.title += (figure.title.empty() ? "" : ", ") + in_sentence(panel.title);
      all.curves.insert(all.curves.end(), panel.curves.begin(), panel.curves.end());
    }
  }
  if (!figure.title.empty() && figure.title[0] >= 'a' && figure.title[0] <= 'z')
    figure.title[0] = static_cast<char>(figure.title[0] - 'a' + 'A');
  figure.caption = fmt::format("{} of {}, {}.{}", figure.title, make.words().run,
                               make.words().source, make.notes(all));
  return figure;
}

// Returns a figure for each choice, with a plot for each of its parts, or several if a part has
// channels of several units. Desired curves are added to their channels. Names and units of the
// channels are those of `panels`; a channel that no panel has is named after its topic. Parts
// without channels in the run are left out.
std::vector<Figure> channel_figures(Maker& make, const Channels& channels,
                                    const std::vector<Plot>& panels,
                                    const std::vector<ChosenFigure>& chosen) {
  for (const ChosenFigure& one : chosen) make.finish(figure_of(make, channels, panels, one));
  return std::move(make.list);
}

// Adds the path of a foot. `leg` is empty for a machine with one leg.
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
    return make.in_numbers(
        {.label = label, .kind = kind, .x_channel = {topic, "x"}, .y_channel = {topic, "y"}}, unit,
        unit);
  };
  make.over(leg.empty() ? "foot-path" : "foot-path-" + leg,
            leg.empty() ? "Foot path" : "Foot path of leg " + leg, axis_of("x forward", unit),
            axis_of("y up", unit),
            {path("actual", which, Kind::computed), once(path("desired", desired, Kind::desired))},
            true,
            which == measured
                ? " Of the ankle about the first joint, from measured angles; the desired one once."
                : " Of the ankle about the first joint, as simulated; the desired one once.");
}

void add_chart(Maker& make, const Plot& chart) {
  double x_size = 0;
  for (const Curve& c : chart.curves)
    x_size = std::max({x_size, size_of(c.xs), make.largest(c.x_channel)});
  const ShownUnit x = make.unit(chart.x.unit, x_size);
  const ShownUnit y = make.unit(chart.y.unit, make.largest(chart.curves));
  std::vector<Curve> curves;
  for (const Curve& c : chart.curves) {
    Curve curve = make.in_numbers(c, x, y);
    // Points without a label belong to the line before them.
    if (!curves.empty() && curve.label.empty() && curve.xs == curves.back().xs)
      curves.back().style = Curve::Style::marked;
    else
      curves.push_back(std::move(curve));
  }
  make.over(file_name_of(chart.title), chart.title, axis_of(in_sentence(chart.x.name), x),
            axis_of(in_sentence(chart.y.name), y), std::move(curves), false, "");
}

}  // namespace

std::vector<Span> stance_of(const analysis::Record& record, const analysis::Machine& machine) {
  std::vector<Span> out;
  for (const analysis::PhaseSpan& s : record.phase_spans()) {
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
  if (machine.robot.legs.empty()) make.shade(stance_of(record, machine));  // legs differ in stance
  if (record.rows() > 0) make.shade(machine.faults, record.time(record.rows() - 1));
  if (!stand_of_run.empty()) {
    const signals::Times& time = *channels.find(stand_of_run.length).time_ns;
    if (!time.empty()) make.shade(machine.faults, seconds_of(time.back()));
  }
  const std::vector<Plot> all = panels(channels, machine);
  if (!options.channels.empty()) return channel_figures(make, channels, all, options.channels);
  for (const Plot& panel : all) make.panel(panel);
  for (const robot::LegParts& leg : robot::legs_of(machine.robot))
    add_foot_path(make, channels, leg.name);
  if (machine.stand)
    for (const Plot& chart : stand_charts(channels, stand_of_run)) add_chart(make, chart);
  return std::move(make.list);
}

}  // namespace sinew::report
