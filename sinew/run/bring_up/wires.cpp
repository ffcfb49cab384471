#include "sinew/run/bring_up/wires.h"

#include <algorithm>

#include <fmt/format.h>

#include "sinew/report/page/page.h"

namespace sinew::run {

namespace {

constexpr int row = 30, top = 70, left_edge = 230, right_edge = 590, width = 860;

std::string text(int x, int y, const std::string& anchor, const std::string& words,
                 const std::string& style = "") {
  return fmt::format(R"(<text x="{}" y="{}" text-anchor="{}"{}>{}</text>)"
                     "\n",
                     x, y, anchor, style.empty() ? "" : fmt::format(R"( class="{}")", style),
                     report::escaped(words));
}

std::string drawn(const Wire& wire, int y, bool sensor) {
  const int side = sensor ? left_edge : right_edge, outer = sensor ? side - 40 : side + 40;
  const int inward = sensor ? 10 : -10;
  std::string out = fmt::format(R"(<line x1="{}" y1="{}" x2="{}" y2="{}"/>)"
                                "\n",
                                side, y, outer, y);
  out += fmt::format(R"(<circle cx="{}" cy="{}" r="4"/>)"
                     "\n",
                     side, y);
  out += text(side + inward, y + 4, sensor ? "start" : "end", wire.at);
  out += text(outer + (sensor ? -6 : 6), y, sensor ? "end" : "start", wire.name);
  out +=
      text(outer + (sensor ? -6 : 6), y + 11, sensor ? "end" : "start", wire.robot_wiring, "small");
  return out;
}

}  // namespace

std::string wiring_drawing(const experiment::Experiment& e, const control::Board& board,
                           const Pins* pins) {
  const std::vector<Wire> sensors = sensor_wires(e, board, pins);
  std::vector<Wire> valves = valve_wires(e, board, pins);
  std::erase_if(valves, [](const Wire& wire) { return !wire.driven; });
  const int rows = static_cast<int>(std::max(sensors.size(), valves.size()));
  const int bottom = top + row * rows, height = bottom + 100;
  std::string out = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}">
<style>text {{ font: 13px sans-serif; fill: #222; }} .small {{ font-size: 10px; fill: #666; }} .head {{ font-weight: bold; }}
line {{ stroke: #555; }} circle {{ fill: #555; }} rect {{ fill: #f4f4f0; stroke: #555; }}</style>
<rect x="0" y="0" width="{0}" height="{1}" style="fill: white; stroke: none"/>
)",
      width, height);
  out += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" rx="6"/>)"
                     "\n",
                     left_edge, top - 45, right_edge - left_edge, bottom - top + 50);
  out +=
      text((left_edge + right_edge) / 2, top - 25, "middle",
           pins ? fmt::format("{}, serial line {}", pins->board, pins->line) : "controller board",
           "head");
  out += text(left_edge - 46, top - 25, "end", "sensors", "head");
  out += text(right_edge + 46, top - 25, "start", "valves, each behind a driver", "head");
  int y = top;
  for (const Wire& wire : sensors) out += drawn(wire, std::exchange(y, y + row), true);
  y = top;
  for (const Wire& wire : valves) out += drawn(wire, std::exchange(y, y + row), false);
  out += fmt::format(R"(<rect x="{}" y="{}" width="260" height="46" rx="6"/>)"
                     "\n",
                     right_edge - 60, bottom + 40);
  out += text(right_edge + 70, bottom + 59, "middle", "supply's dump valve");
  out += text(right_edge + 70, bottom + 75, "middle",
              "lets the air out when its coil has no current", "small");
  out +=
      fmt::format(R"(<polyline points="{0},{1} {0},{2} {3},{2}" style="fill: none; stroke: #555"/>)"
                  "\n",
                  right_edge - 120, bottom + 5, bottom + 63, right_edge - 60);
  out += text(right_edge - 128, bottom + 59, "end",
              fmt::format("supply output{}, in series with the emergency stop",
                          pins ? fmt::format(" ({})", pins->supply) : ""));
  if (e.wiring.present)
    out += text(right_edge - 128, bottom + 75, "end",
                fmt::format("a coil has current where its output is {}, the supply's too",
                            e.wiring.polarity == robot::Wiring::Polarity::low_opens ? 0 : 1),
                "small");
  return out + "</svg>\n";
}

namespace {

std::string pins_of(const experiment::Experiment& e, const std::string& of, bool inlet) {
  for (const robot::Wiring::Valve& v : e.wiring.valves)
    if (e.wiring.present && v.of == of) {
      const robot::Wiring::Line& line = inlet ? v.inlet : v.exhaust;
      return fmt::format(", pins {} and {}", line.pin, line.common);
    }
  return "";
}

// Returns the owner of a valve. Muscle m has the valves 2 m (inlet) and 2 m + 1 (exhaust); the four
// of a cylinder follow those of all muscles.
std::string owner_of(const robot::Robot& robot, std::size_t valve) {
  const std::size_t of_muscles = 2 * robot.muscles.size();
  if (valve < of_muscles) return robot.muscles[valve / 2].name;
  return valve - of_muscles < 2 ? "cylinder_up" : "cylinder_down";
}

// Returns a bit for each output that drives a valve. The exhaust of a 3-way valve and the
// outputs of a regulator drive none.
std::uint32_t driven_outputs(const control::JointControllerConfig& joint_controller) {
  using control::JointKind;
  std::uint32_t out = 0;
  for (std::size_t j = 0; j < joint_controller.joints; ++j) {
    const control::JointConfig& c = joint_controller.joint[j];
    if (c.kind == JointKind::passive || c.kind == JointKind::regulated) continue;
    for (const control::MuscleConfig* m : {&c.flexor, &c.extensor}) {
      if (!m->present) continue;
      out |= 1u << m->inlet.index;
      if (c.kind != JointKind::three_way) out |= 1u << m->exhaust.index;
    }
  }
  return out;
}

}  // namespace

std::vector<Wire> sensor_wires(const experiment::Experiment& e, const control::Board& board,
                               const Pins* pins) {
  std::vector<Wire> out;
  for (std::size_t i = 0; i < board.channel.size(); ++i) {
    const robot::Sensor& s = e.robot.sensors[board.channel[i]];
    Wire wire{s.name, fmt::format("input {}{}", i, pins ? in_brackets(pins->inputs, i) : ""),
              fmt::format("channel {}", s.channel)};
    for (const robot::Wiring::Signal& signal : e.wiring.signals)
      if (e.wiring.present && signal.name == s.name)
        wire.robot_wiring += fmt::format(", pins {} and {}", signal.pin, signal.ground);
    out.push_back(std::move(wire));
  }
  return out;
}

std::vector<Wire> valve_wires(const experiment::Experiment& e, const control::Board& board,
                              const Pins* pins) {
  const std::vector<robot::ValveBit> bits = robot::bits_of(e.robot, e.wiring);
  const std::uint32_t driven = driven_outputs(board.joint_controller);
  std::vector<Wire> out;
  for (std::size_t i = 0; i < board.valve.size(); ++i) {
    const std::string of = owner_of(e.robot, board.valve[i]);
    const bool inlet = board.valve[i] % 2 == 0;
    const std::string which = inlet ? "inlet" : "exhaust";
    const auto bit = std::ranges::find_if(
        bits, [&](const robot::ValveBit& b) { return b.of == of && b.which == which; });
    out.push_back(
        {of + " " + which, fmt::format("output {}{}", i, pins ? in_brackets(pins->outputs, i) : ""),
         (bit == bits.end() ? "no bit" : fmt::format("bit {}", bit->bit)) + pins_of(e, of, inlet),
         (driven >> i & 1u) != 0});
  }
  return out;
}

}  // namespace sinew::run
