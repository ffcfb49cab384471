#include "sinew/report/figures/channel_figures.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::report {
namespace {

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

}  // namespace

std::vector<Figure> channel_figures(Maker& make, const Channels& channels,
                                    const std::vector<Panel>& panels,
                                    const std::vector<ChosenFigure>& chosen) {
  for (const ChosenFigure& one : chosen) make.finish(figure_of(make, channels, panels, one));
  return std::move(make.list);
}

}  // namespace sinew::report
