// robot/boards.h - assignment of joints and sensors to the boards of the low level. A machine has
// as many boards as it needs, numbered from 1. Each has room for 8 joints and a converter of 32
// channels, which converts one of them per tick, and runs its own scan.
//
// A joint is on a board with its muscles' valves, and with the sensors of the joint and of these
// muscles. Two joints that share a muscle are on one board, because their laws share its duties. An
// air cylinder in a loop counts as one more joint, the last one of its board.
//
//   board = 2     in [joint.…], in [cylinder] and in the [sensor.…] of a fixed quantity
//   no board      in the order of the file: the board of the joint before it, or the next one
//                 if that is full; a fixed sensor: the first one with room
#pragma once

#include <cstddef>
#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::robot {

// Returns whether an air cylinder is in a loop. It is then the low level's last joint, after the
// robot's.
inline bool has_cylinder_joint(const Robot& robot) {
  return robot.cylinder.present && robot.cylinder.mode == Cylinder::Mode::valves;
}

// A board's parts, as indices in the robot's lists, ascending.
struct Board {
  std::vector<int> joints, muscles, sensors;
  bool cylinder = false;  // its loop, or only its sensor

  bool empty() const { return joints.empty() && sensors.empty() && !cylinder; }
};

// Returns the boards by their numbers, from 1 on; at least one. Parts with invalid names are on the
// first one. Also accepts a robot with contradictions: a board may then be too full, or empty.
std::vector<Board> boards_of(const Robot&);

// Return the number of the board of a joint or a sensor, from 1.
int board_of_joint(const std::vector<Board>& boards, int joint);
int board_of_sensor(const std::vector<Board>& boards, int sensor);

// Returns a robot with only this board's joints, muscles and sensors, in order; with a single
// board, the robot itself. It is the description for one board, not a complete machine.
Robot only_board(const Robot&, const std::vector<Board>& boards, std::size_t board);

// Reports boards that are too full, board numbers that are left out, and muscles on two boards.
void check_boards(const Robot&, std::vector<Contradiction>& out);

}  // namespace sinew::robot
