#include "sinew/run/bring_up/wires.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::run {

namespace {

std::string pins_of(const experiment::Experiment& e, const std::string& of, bool inlet) {
  for (const robot::Wiring::Valve& v : e.wiring.valves)
    if (e.wiring.present && v.of == of) {
      const robot::Wiring::Line& line = inlet ? v.inlet : v.exhaust;
      return fmt::format(", pins {} and {}", line.pin, line.common);
    }
  return "";
}

// A machine's valves are numbered by muscles, 2 m its inlet and 2 m + 1 its exhaust, with the
// cylinder's four behind them.
std::string owner_of(const robot::Robot& robot, std::size_t valve) {
  const std::size_t of_muscles = 2 * robot.muscles.size();
  if (valve < of_muscles) return robot.muscles[valve / 2].name;
  return valve - of_muscles < 2 ? "cylinder_up" : "cylinder_down";
}

// A bit for each output that drives a valve: a 3-way valve empties its muscle by itself, and what
// sets a regulator is none.
std::uint32_t driven_outputs(const control::JointControllerConfig& spine) {
  using control::JointKind;
  std::uint32_t out = 0;
  for (std::size_t j = 0; j < spine.joints; ++j) {
    const control::JointConfig& c = spine.joint[j];
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
        wire.elsewhere += fmt::format(", pins {} and {}", signal.pin, signal.ground);
    out.push_back(std::move(wire));
  }
  return out;
}

std::vector<Wire> valve_wires(const experiment::Experiment& e, const control::Board& board,
                              const Pins* pins) {
  const std::vector<robot::ValveBit> bits = robot::bits_of(e.robot, e.wiring);
  const std::uint32_t driven = driven_outputs(board.spine);
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
