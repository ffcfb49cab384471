#include "sinew/run/simulation/card_place.h"

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/control/supervise/output_stage.h"
#include "sinew/host/realtime.h"
#include "sinew/robot/wiring/wiring.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/remote_boards.h"

namespace sinew::run {

namespace {

using Output = plant::CardMachine::Output;

// Returns the machine's number of a valve that bits_of() names.
std::size_t number_of(const robot::Robot& robot, const robot::ValveBit& b) {
  const std::size_t which = b.which == "inlet" ? 0 : 1;
  const int muscle = robot::find_muscle(robot, b.of);
  if (muscle >= 0) return 2 * static_cast<std::size_t>(muscle) + which;
  return 2 * robot.muscles.size() + (b.of == "cylinder_up" ? 0 : 2) + which;
}

void refuse_levels(const experiment::Experiment& e, const control::Board& board,
                   const std::string& place) {
  for (std::size_t j = 0; j < board.joint_controller.joints; ++j)
    if (board.joint_controller.joint[j].kind == control::JointKind::regulated)
      config::fail({e.path, 0, 0}, "joint." + e.robot.joints[board.joint[j]].name,
                   "pressure regulators",
                   fmt::format("valves that open and shut, to run it at {}: a digital output sets "
                               "no pressure",
                               place));
}

}  // namespace

plant::CardMachine card_machine(const experiment::Experiment& e, const std::string& place) {
  const control::Board board = only_board(e);
  refuse_levels(e, board, place);
  const robot::Converter& converter = e.robot.converter;
  plant::CardMachine out{
      .full_scale = converter.full_scale,
      .top = converter.top(),
      .active_low = !e.wiring.present || e.wiring.polarity == robot::Wiring::Polarity::low_opens,
      .vent = static_cast<signals::Tick>(board.joint_controller.shutdown_vent)};
  for (const robot::Sensor& s : e.robot.sensors) out.inputs.push_back({s.name, s.channel});

  out.outputs.resize(2 * e.robot.muscles.size() + 4);
  for (const robot::ValveBit& b : robot::bits_of(e.robot, e.wiring)) {
    Output& valve = out.outputs[number_of(e.robot, b)];
    valve.valve = b.of + " " + b.which;
    valve.bit = b.bit;
    valve.inlet = b.which == "inlet";
  }
  const control::OutputStage stage(board.joint_controller, 0);
  for (std::size_t i = 0; i < board.valve.size(); ++i) {
    Output& valve = out.outputs[board.valve[i]];
    valve.inverted = (stage.inverted() >> i & 1u) != 0;
    valve.vents = (stage.exhausts() >> i & 1u) != 0;
  }
  return out;
}

CardPlace::CardPlace(const std::string& device, const experiment::Experiment& e,
                     const std::string& place)
    : port(device, card_machine(e, place), beat) {
  const host::RealTime real_time;
  latency = host::measure_latency(1);
  not_permitted = host::problems(real_time);
}

std::vector<std::string> CardPlace::messages() const {
  std::vector<std::string> out{"timer " + host::in_words(latency)};
  out.insert(out.end(), not_permitted.begin(), not_permitted.end());
  if (host::class_of(latency) == host::LatencyClass::unfit)
    out.emplace_back(
        "this computer wakes too late for a tick of 100 us: expect missed ticks; see sinew doctor");
  return out;
}

}  // namespace sinew::run
