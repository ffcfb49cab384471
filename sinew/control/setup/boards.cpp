#include "sinew/control/setup/boards.h"

#include <stdexcept>

#include "sinew/control/setup/supervision.h"

namespace sinew::control {

static_assert(robot::board_joints == static_cast<int>(max_joints));
static_assert(robot::board_channels == static_cast<int>(max_channels));
static_assert(robot::max_boards * robot::board_channels <= 256);
static_assert(2 * robot::max_muscles + 4 <= 256);

namespace {

std::vector<std::uint8_t> numbers(const std::vector<int>& list) {
  std::vector<std::uint8_t> out;
  for (const int i : list) out.push_back(static_cast<std::uint8_t>(i));
  return out;
}

}  // namespace

std::vector<Board> boards(const Installation& in) {
  const std::vector<robot::Board> parts = robot::boards_of(in.robot);
  std::vector<Board> out;
  Installation of_board = in;
  for (std::size_t b = 0; b < parts.size(); ++b) {
    of_board.robot = robot::only_board(in.robot, parts, b);
    Board board{.joint_controller = joint_controller_config(of_board),
                .limits = supervise_config(of_board)};
    board.joint = numbers(parts[b].joints);
    board.channel = numbers(parts[b].sensors);
    for (const int muscle : parts[b].muscles)
      for (const int which : {0, 1})
        board.valve.push_back(static_cast<std::uint8_t>(2 * muscle + which));
    if (has_cylinder_joint(of_board.robot)) {
      board.joint.push_back(static_cast<std::uint8_t>(in.robot.joints.size()));
      for (std::size_t which = 0; which < 4; ++which)
        board.valve.push_back(static_cast<std::uint8_t>(2 * in.robot.muscles.size() + which));
    }
    out.push_back(std::move(board));
  }
  return out;
}

Board stand_board(const robot::Stand& stand, bool three_way, std::uint16_t period) {
  Board out;
  out.joint_controller.period = period;
  out.joint_controller.timing = signals::identity_timing(period);
  if (stand.charge.mode == robot::Stand::Charge::Mode::valves) {
    JointConfig& joint = out.joint_controller.joint[out.joint_controller.joints++];
    joint.kind = three_way ? JointKind::timed_three_way : JointKind::timed;
    joint.flexor.inlet = {0};
    joint.flexor.exhaust = {1};
    joint.extensor.present = false;
    out.joint = {0};
    out.valve = three_way ? numbers({0}) : numbers({0, 1});
  }
  const std::size_t sensors = stand.sensors.size();
  if (sensors > max_conversions || sensors + 1 >= period)
    throw std::invalid_argument("a board converts at most 32 transducers, one in a tick");
  for (std::size_t i = 0; i < sensors; ++i) {
    const auto read = static_cast<std::uint16_t>(period - (sensors - i));
    const auto channel = static_cast<std::uint8_t>(i);
    out.channel.push_back(channel);
    out.joint_controller.conversion[out.joint_controller.conversions++] = {
        {channel}, static_cast<std::uint16_t>(read - 1), read};
  }
  if (const char* wrong = problem(out.joint_controller)) throw std::invalid_argument(wrong);
  return out;
}

}  // namespace sinew::control
