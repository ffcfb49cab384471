#include "sinew/report/page/content.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sinew/robot/legs.h"

namespace sinew::report {
namespace {

enum class Style { measured, desired, hidden };

// Converts "hip_flexor" to "hip flexor".
std::string words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

// Returns whether a channel has finite values. Others, such as the desired path of a plan without a
// path, are not shown.
bool has_number(const Samples& samples) {
  return std::ranges::any_of(*samples.values, [](double v) { return std::isfinite(v); });
}

class Panels {
 public:
  Panels(const Channels& channels, const robot::Robot& robot) : channels_(channels), robot_(robot) {
    for (const robot::Joint& j : robot.joints) {
      joints_.push_back(j.name);
      if (j.kind == robot::Joint::Kind::passive) passive_.insert(joints_.size() - 1);
    }
    for (const robot::Muscle& m : robot.muscles) muscles_.push_back(m.name);
  }

  // Begins a panel. `unit` replaces the channels' unit, which does not distinguish shares from
  // other numbers.
  void open(std::string group, std::string title, std::string unit = "") {
    list.push_back(
        {.title = std::move(title), .y = {.unit = std::move(unit)}, .group = std::move(group)});
  }
  // Adds a line if the channel has values. Topics are those of a machine with one leg.
  void line(std::string label, Channel channel, int color, Style style = Style::measured) {
    channel.topic = robot::logged_topic(robot_, channel.topic);
    const Samples samples = channels_.find(channel);
    if (!samples) return;
    claimed_.insert(channel.topic);
    if (!has_number(samples)) return;
    Plot& panel = list.back();
    if (panel.y.unit.empty()) panel.y.unit = samples.unit;
    // A hidden line is shown if the line that it would be hidden behind is missing.
    const bool alone = std::ranges::none_of(panel.curves, [&](const Curve& c) {
      return c.color == color && c.kind != Curve::Kind::desired && !c.hidden;
    });
    panel.curves.push_back(
        {.label = std::move(label),
         .kind = style == Style::desired ? Curve::Kind::desired : Curve::Kind::computed,
         .color = color,
         .y_channel = std::move(channel),
         .hidden = style == Style::hidden && !alone});
  }
  void per_joint(const std::string& before, const std::string& after, const std::string& note = "",
                 Style style = Style::measured) {
    per(joints_, before, after, note, style);
  }
  // Adds a line per joint for a quantity of its muscles, which a passive joint does not have.
  void per_driven(const std::string& before, const std::string& after, const std::string& note = "",
                  Style style = Style::measured) {
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (passive_.contains(i))
        claimed_.insert(robot::logged_topic(robot_, before + joints_[i] + after));
      else
        one_of(joints_, i, before, after, note, style);
  }
  void per_muscle(const std::string& before, const std::string& after, const std::string& note = "",
                  Style style = Style::measured) {
    per(muscles_, before, after, note, style);
  }
  // Adds the stand's transducers that read in `unit`, with the true values as hidden lines.
  void per_sensor(const std::string& unit);
  void others(const std::string& group);

  std::vector<Plot> list;

 private:
  void per(const std::vector<std::string>& names, const std::string& before,
           const std::string& after, const std::string& note, Style style) {
    for (std::size_t i = 0; i < names.size(); ++i) one_of(names, i, before, after, note, style);
  }
  void one_of(const std::vector<std::string>& names, std::size_t i, const std::string& before,
              const std::string& after, const std::string& note, Style style) {
    line(words(names[i]) + note, {before + names[i] + after}, static_cast<int>(i), style);
  }
  bool shown_elsewhere(const std::string& topic) const;

  const Channels& channels_;
  const robot::Robot& robot_;
  std::vector<std::string> joints_, muscles_;
  std::set<std::size_t> passive_;  // joints
  std::set<std::string> claimed_;
};

void joints(Panels& p) {
  p.open("Joints", "Joint angles");
  p.per_joint("/joint/", "/angle");
  p.per_joint("/desired/joint/", "/angle", " desired", Style::desired);
  p.per_joint("/true/joint/", "/angle", " true", Style::hidden);
  p.open("Joints", "Joint stiffness");
  p.per_joint("/joint/", "/stiffness");
  p.per_joint("/desired/joint/", "/stiffness", " desired", Style::desired);
  p.per_driven("/true/joint/", "/stiffness", " true", Style::hidden);
  p.open("Joints", "Joint torque");
  p.per_driven("/joint/", "/torque");
  p.per_driven("/true/joint/", "/torque", " true", Style::hidden);
  p.open("Joints", "Angle error");
  p.per_joint("/joint/", "/error");
  p.per_joint("/joint/", "/oscillation", " oscillation", Style::hidden);
  p.open("Joints", "Joint velocity");
  p.per_joint("/joint/", "/velocity_estimate", " estimated");
  p.per_joint("/true/joint/", "/velocity", " true", Style::hidden);
}

void muscles(Panels& p) {
  p.open("Muscles", "Tension");
  p.per_muscle("/muscle/", "/tension");
  p.per_muscle("/true/muscle/", "/tension", " true", Style::hidden);
  // Few machines have sensors for these. Without one, the true line is shown.
  for (const auto& [title, after] :
       {std::pair("Pressure", "/pressure"), std::pair("Length", "/length")}) {
    p.open("Muscles", title);
    p.per_muscle("/muscle/", after);
    const bool measured = !p.list.back().curves.empty();
    p.per_muscle("/true/muscle/", after, measured ? " true" : "", Style::hidden);
  }
}

void valves(Panels& p) {
  p.open("Valves", "Inlet duty", "share");
  p.per_muscle("/muscle/", "/inlet_duty");
  p.line("cylinder up", {"/cylinder/up/inlet_duty"}, 4);
  p.line("cylinder down", {"/cylinder/down/inlet_duty"}, 5);
  p.open("Valves", "Exhaust duty", "share");
  p.per_muscle("/muscle/", "/exhaust_duty");
  p.line("cylinder up", {"/cylinder/up/exhaust_duty"}, 4);
  p.line("cylinder down", {"/cylinder/down/exhaust_duty"}, 5);
  p.open("Valves", "Passive share", "share");
  p.per_muscle("/muscle/", "/passive");
  p.open("Valves", "Regulator set point", "share");
  p.per_muscle("/valve/", "/inlet/set_point");
}

// Adds the lines of one leg's foot, prefixed with the leg's name if it has one.
void foot(Panels& p, const robot::Foot& foot, const std::string& leg) {
  const auto line = [&](const std::string& label, const std::string& topic,
                        const std::string& field, int color, Style style = Style::measured) {
    p.line(leg.empty() ? label : leg + " " + label, {robot::topic_of_leg(leg, topic), field}, color,
           style);
  };
  const std::string of = leg.empty() ? "" : " " + leg;
  p.open("Foot", "Foot position" + of);
  for (const auto& [axis, color] : {std::pair{"x", 0}, std::pair{"y", 1}}) {
    line(std::string(axis) + " true", "/true/foot/position", axis, color);
    line(std::string(axis) + " measured", "/foot/position", axis, color, Style::hidden);
    line(std::string(axis) + " desired", "/desired/foot/position", axis, color, Style::desired);
  }
  p.open("Foot", "Ground reaction" + of);
  for (const auto& [axis, color] : {std::pair{"x", 0}, std::pair{"y", 1}}) {
    line(std::string(axis) + " true", "/true/foot/force", axis, color);
    line(std::string(axis) + " from torques", "/foot/force", axis, color, Style::hidden);
  }
  p.open("Foot", "Load of the sole" + of);
  int color = 0;
  for (const robot::Foot::Point& point : foot.points)
    line(words(point.name), "/true/foot/" + point.name + "/load", "value", color++);
  p.open("Foot", "Slip velocity" + of);
  line("slip", "/true/foot/slip", "value", 0);
}

void body(Panels& p) {
  p.open("Body", "Trolley position");
  p.line("true", {"/true/trolley/position"}, 0);
  p.line("from torques", {"/trolley/position"}, 1, Style::hidden);
  p.open("Body", "Trolley velocity");
  p.line("true", {"/true/trolley/velocity"}, 0);
  p.line("from torques", {"/trolley/velocity"}, 1, Style::hidden);
  p.open("Body", "Cylinder travel");
  p.line("measured", {"/cylinder/position"}, 0);
  p.line("desired", {"/desired/cylinder/position"}, 0, Style::desired);
  p.line("true", {"/true/cylinder/position"}, 1, Style::hidden);
  p.open("Body", "Cylinder pressure");
  p.line("up", {"/true/cylinder/up/pressure"}, 0);
  p.line("down", {"/true/cylinder/down/pressure"}, 1);
  p.open("Body", "Load of the rollers");
  p.line("front", {"/true/roller/front/load"}, 0);
  p.line("rear", {"/true/roller/rear/load"}, 1);
}

void air(Panels& p) {
  p.open("Air", "Air taken in");
  p.per_muscle("/true/muscle/", "/air_in");
  p.line("cylinder up", {"/true/cylinder/up/air_in"}, 4);
  p.line("cylinder down", {"/true/cylinder/down/air_in"}, 5);
  p.open("Air", "Air in the muscles");
  p.per_muscle("/true/muscle/", "/mass");
  p.open("Air", "Supply pressure");
  p.line("line", {"/true/supply/pressure"}, 0);
  p.line("tank", {"/true/supply/tank_pressure"}, 1);
}

void Panels::per_sensor(const std::string& unit) {
  int color = 0;
  for (const signals::Table* table : channels_.tables())
    for (const signals::Series& series : table->series) {
      const std::string& topic = series.topic.name;
      if (!topic.starts_with("/sensor/") || !topic.ends_with("/value")) continue;
      const Channel channel{topic};
      if (channels_.find(channel).unit != unit) continue;
      constexpr std::size_t before = 8, after = 6;  // lengths of "/sensor/" and "/value"
      line(words(topic.substr(before, topic.size() - before - after)) + " read", channel, color++);
    }
}

void stand(Panels& p, const std::string& element) {
  const std::string muscle = "/true/muscle/" + element;
  p.open("Stand", "Length");
  p.per_sensor("m");
  p.line("desired", {"/desired/length"}, 0, Style::desired);
  p.line("true", {"/true/stand/length"}, 0, Style::hidden);
  p.open("Stand", "Tension");
  p.per_sensor("N");
  p.line("true", {"/true/stand/force"}, 0, Style::hidden);
  p.line("load", {"/draw/stand/weight"}, 1, Style::desired);
  p.line("dry friction", {"/true/stand/friction"}, 2);
  p.open("Stand", "Pressure");
  p.line("true", {muscle + "/pressure"}, 0);
  p.open("Stand", "Pressure read, gauge", "Pa diff");
  p.per_sensor("Pa");
  p.open("Stand", "Velocity");
  p.line("true", {"/true/stand/velocity"}, 0);
  p.open("Stand", "Acceleration");
  p.per_sensor("m/s^2");
  p.line("true", {"/true/stand/acceleration"}, 0, Style::hidden);
}

void stand_valves(Panels& p, const std::string& element) {
  const std::string muscle = "/muscle/" + element, valve = "/true/valve/" + element;
  p.open("Valves", "Duty", "share");
  p.line("inlet", {muscle + "/inlet_duty"}, 0);
  p.line("exhaust", {muscle + "/exhaust_duty"}, 1);
  p.open("Valves", "Open share of the area", "share");
  p.line("inlet", {valve + "/inlet"}, 0);
  p.line("exhaust", {valve + "/exhaust"}, 1);
  p.open("Air", "Air");
  p.line("in the element", {"/true" + muscle + "/mass"}, 0);
  p.line("taken in", {"/true" + muscle + "/air_in"}, 1);
  p.line("let out", {"/true" + muscle + "/air_out"}, 2);
  p.line("leaked", {"/true" + muscle + "/air_leaked"}, 3);
  p.open("Air", "Supply pressure");
  p.line("line", {"/true/supply/pressure"}, 0);
  p.line("tank", {"/true/supply/tank_pressure"}, 1);
}

// Returns whether a topic is in a panel or shown otherwise: edges are lights in the drawing, the
// plan's phase is the plots' background.
bool Panels::shown_elsewhere(const std::string& topic) const {
  return claimed_.contains(topic) || topic.ends_with("/open") ||
         topic.find("/plan/") != topic.npos || topic.starts_with("/draw/") ||
         topic.starts_with("/trolley/by_plan/") || topic.starts_with("/sweep/") ||
         topic.starts_with("/true/sweep/") || topic.ends_with("/air_out");
}

std::string title_of(const std::string& unit) {
  static constexpr std::pair<const char*, const char*> titles[] = {
      {"count", "As converted"}, {"N", "Forces"}, {"m", "Lengths"},  {"Pa", "Pressures"},
      {"m/s", "Velocities"},     {"kg", "Air"},   {"rad", "Angles"}, {"N/m", "Stiffness"}};
  for (const auto& [of, title] : titles)
    if (unit == of) return title;
  return "Other channels";
}

void Panels::others(const std::string& group) {
  std::map<std::string, Plot> by_unit;
  for (const signals::Table* table : channels_.tables())
    for (const signals::Series& series : table->series) {
      if (shown_elsewhere(series.topic.name)) continue;
      for (const signals::Field& field : series.topic.fields) {
        const Samples samples = channels_.find({series.topic.name, field.name});
        if (!samples || !has_number(samples)) continue;
        Plot& panel = by_unit[field.unit];
        const std::string name = series.topic.name.substr(1);
        panel.curves.push_back({.label = field.name == "value" ? name : name + " " + field.name,
                                .color = static_cast<int>(panel.curves.size()),
                                .y_channel = {series.topic.name, field.name}});
      }
    }
  for (auto& [unit, panel] : by_unit) {
    panel.group = group;
    panel.title = title_of(unit);
    panel.y.unit = unit;
    list.push_back(std::move(panel));
  }
}

std::vector<Plot> not_empty(std::vector<Plot> list) {
  std::erase_if(list, [](const Plot& panel) { return panel.curves.empty(); });
  return list;
}

}  // namespace

std::vector<Plot> panels(const Channels& channels, const analysis::Machine& machine) {
  const robot::Robot& robot = machine.robot;
  Panels p(channels, robot);
  if (machine.stand) {
    stand(p, machine.stand->element.name);
    stand_valves(p, machine.stand->element.name);
  } else {
    joints(p);
    muscles(p);
    const std::vector<robot::LegParts> legs = robot::legs_of(robot);
    for (std::size_t l = 0; l < legs.size(); ++l) foot(p, robot::foot_of(robot, l), legs[l].name);
    body(p);
    valves(p);
    air(p);
  }
  p.others("Other");
  return not_empty(std::move(p.list));
}

}  // namespace sinew::report
