// robot/boards.h - which board of the low level drives what. A machine has as many boards as it
// needs, numbered from 1; each has places for 8 joints and a converter of 32 channels, which
// converts one of them per tick, and runs its own scan.
//
// A joint is on a board with its muscles' valves, and with the sensors of the joint and of these
// muscles; two joints that share a muscle are on one, because their laws share its duties. An air
// cylinder in a loop is one joint more, the last one of its board.
//
//   board = 2     in [joint.…], in [cylinder] and in the [sensor.…] of a quantity that is fixed
//   none          in the order of the file: the board of the joint before it, or the next one where
//                 that is full; a fixed sensor: the first one with room
#pragma once

#include <cstddef>
#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::robot {

// Is there an air cylinder in a loop? It is then the low level's last joint, behind the robot's.
inline bool has_cylinder_joint(const Robot& robot) {
  return robot.cylinder.present && robot.cylinder.mode == Cylinder::Mode::valves;
}

// A board's parts, by their positions in the robot's lists, ascending.
struct Board {
  std::vector<int> joints, muscles, sensors;
  bool cylinder = false;  // its loop, or nothing but its sensor

  bool empty() const { return joints.empty() && sensors.empty() && !cylinder; }
};

// Returns the boards by their numbers, from 1 on; at least one. What leads nowhere is on the first
// one. Also of a robot with contradictions: a board may then be too full, or empty.
std::vector<Board> boards_of(const Robot&);

// The number of the board that a joint or a sensor is on, from 1.
int board_of_joint(const std::vector<Board>& boards, int joint);
int board_of_sensor(const std::vector<Board>& boards, int sensor);

// A robot that has this board's joints, muscles and sensors alone, in their order; the machine as
// it is where it has one board. It is what one board is told, and no machine that could move.
Robot only_board(const Robot&, const std::vector<Board>& boards, std::size_t board);

// Finds what cannot be: a board that is too full, numbers that are left out, one muscle on two
// boards.
void check_boards(const Robot&, std::vector<Contradiction>& out);

}  // namespace sinew::robot
