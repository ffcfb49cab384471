#include "sinew/report/figures/run_maker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sinew/config/node.h"

namespace sinew::report {
namespace {

using Kind = Curve::Kind;

constexpr int most_colors = 4;  // in one plot; more go into the next one below

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

}  // namespace

RunWords words_of(const Run& run, const std::string& title, const std::string& robot) {
  const bool simulated = is_simulated(run.analysis.table);
  RunWords out{.kind = simulated ? Kind::computed : Kind::measured};
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

Curve Maker::curve(const Line& line, const units::ShownUnit& unit, bool steps) const {
  Curve out{.label = line.label, .kind = about_.kind, .color = line.color, .source = about_.source};
  if (line.style == Line::Style::desired) out.kind = Kind::desired;
  if (steps) out.style = Curve::Style::steps;
  const Samples samples = channels_.find(line.channel);
  for (std::size_t i = 0; i < samples.values->size(); ++i) {
    const double t = seconds_of((*samples.time_ns)[i]);
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
                  const units::ShownUnit& x_unit, const units::ShownUnit& y_unit, Kind kind) const {
  Curve out{.label = label, .kind = kind, .source = about_.source};
  const Samples a = channels_.find(x), b = channels_.find(y);
  if (!a || !b) return out;
  const analysis::Column held = analysis::held(*b.time_ns, *b.values, *a.time_ns);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!shown(seconds_of((*a.time_ns)[i]))) continue;
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

Axis axis_of(std::string name, const units::ShownUnit& unit) {
  return {
      .name = std::move(name), .unit = unit.name.empty() ? "-" : unit.label(), .scale = unit.scale};
}

std::string in_sentence(std::string title) {
  if (title.size() > 1 && !(title[1] >= 'A' && title[1] <= 'Z')) title[0] |= 0x20;
  return title;
}

std::string Maker::notes(const Panel& panel) const {
  std::string out;
  if (std::ranges::any_of(panel.lines,
                          [](const Line& l) { return l.style == Line::Style::desired; }))
    out += " Dotted: desired.";
  if (!stance_.empty()) out += " Shaded: stance by plan.";
  if (!broken_.empty()) out += " Between red lines, broken on purpose: " + broken_ + ".";
  return out + meanings(panel);
}

std::vector<Plot> Maker::plots(const Panel& panel) const {
  double size = 0;
  for (const Line& line : panel.lines) size = std::max(size, largest(line.channel));
  const units::ShownUnit unit = this->unit(panel.unit, size);
  const bool steps = panel.group == "Valves";
  std::map<int, Plot> parts;
  for (const Line& line : panel.lines) {
    const int part = line.color / most_colors;
    Plot& plot = parts[part];
    plot.name = std::to_string(part + 1);
    plot.x = {"time", "s"};
    plot.y = axis_of(in_sentence(panel.title), unit);
    plot.spans = stance_;
    plot.spans.insert(plot.spans.end(), faults_.begin(), faults_.end());
    plot.curves.push_back(curve(line, unit, steps));
    if (plot.curves.back().xs.empty()) plot.curves.pop_back();
  }
  std::vector<Plot> out;
  for (auto& [part, plot] : parts)
    if (!plot.curves.empty()) out.push_back(std::move(plot));
  return out;
}

void Maker::panel(const Panel& all) {
  Panel panel = all;
  std::erase_if(panel.lines, [](const Line& l) { return l.style == Line::Style::hidden; });
  if (panel.lines.empty()) return;
  Figure figure{.name = file_name_of(panel.title), .title = panel.title};
  figure.caption = fmt::format("{} of {}, {}.", panel.title, about_.run, about_.source);
  figure.caption += notes(panel);
  figure.plots = plots(panel);
  if (figure.plots.size() == 1 && figure.plots[0].curves.size() == 1)
    figure.plots[0].curves[0].label.clear();  // its axis says it
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

}  // namespace sinew::report
