#include "sinew/run/bring_up/clicks.h"

#include <fmt/format.h>

#include "sinew/run/bring_up/wires.h"

namespace sinew::run {

using control::Duties;
using control::JointKind;

namespace {

std::string in_words(const Wire& wire) {
  const std::size_t space = wire.name.rfind(' ');
  return fmt::format("the {} of {} ({})", wire.name.substr(space + 1), wire.name.substr(0, space),
                     wire.in_words());
}

}  // namespace

std::vector<BenchValve> bench_valves(const experiment::Experiment& e, const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles, const Pins* pins) {
  const std::vector<Wire> wires = valve_wires(e, board, pins);
  std::vector<BenchValve> out;
  const auto add = [&](std::size_t joint, signals::Valve valve, std::int32_t Duties::*duty) {
    if (wires[valve.index].driven) out.push_back({in_words(wires[valve.index]), joint, duty});
  };
  for (const BenchMuscle& m : muscles) {
    const control::JointConfig& c = board.spine.joint[m.board_joint];
    const control::MuscleConfig& muscle = m.flexor ? c.flexor : c.extensor;
    add(m.board_joint, muscle.inlet, m.flexor ? &Duties::flexor_inlet : &Duties::extensor_inlet);
    if (m.has_exhaust)
      add(m.board_joint, muscle.exhaust,
          m.flexor ? &Duties::flexor_exhaust : &Duties::extensor_exhaust);
  }
  for (std::size_t j = 0; j < board.spine.joints; ++j) {
    const control::JointConfig& c = board.spine.joint[j];
    if (c.kind != JointKind::cylinder) continue;
    add(j, c.flexor.inlet, &Duties::flexor_inlet);
    add(j, c.flexor.exhaust, &Duties::flexor_exhaust);
    add(j, c.extensor.inlet, &Duties::extensor_inlet);
    add(j, c.extensor.exhaust, &Duties::extensor_exhaust);
  }
  return out;
}

std::vector<Stage> clicks_of(const BenchValve& valve, std::size_t joints) {
  std::vector<Duties> open(joints);
  open[valve.board_joint].*valve.duty = 100;
  std::vector<Stage> out;
  for (int i = 0; i < 5; ++i) {
    out.push_back({0.15, open});
    out.push_back({0.25, {}});
  }
  return out;
}

std::vector<std::string> not_tried(const experiment::Experiment& e, const control::Board& board) {
  std::vector<std::string> out;
  for (std::size_t j = 0; j < board.spine.joints; ++j) {
    const JointKind kind = board.spine.joint[j].kind;
    if (kind == JointKind::cylinder) out.emplace_back("the cylinder with air");
    if (kind == JointKind::regulated)
      out.push_back(fmt::format("the regulators of {}",
                                e.robot.joints[static_cast<std::size_t>(board.joint[j])].name));
  }
  return out;
}

}  // namespace sinew::run
