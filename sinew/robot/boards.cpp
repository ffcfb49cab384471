#include "sinew/robot/boards.h"

#include <algorithm>
#include <array>

namespace sinew::robot {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Returns the joint whose board a sensor is on; -1 if it measures no joint or muscle.
int joint_of(const Robot& robot, const Sensor& sensor) {
  if (sensor.kind == Sensor::Kind::angle || sensor.kind == Sensor::Kind::velocity)
    return find_joint(robot, sensor.of);
  if (sensor.kind != Sensor::Kind::tension && sensor.kind != Sensor::Kind::pressure) return -1;
  const int muscle = find_muscle(robot, sensor.of);
  return muscle < 0 ? -1 : find_joint(robot, robot.muscles[at(muscle)].joint);
}

bool measures_cylinder(const Sensor& sensor) { return sensor.kind == Sensor::Kind::cylinder; }

// Assigns each joint, the cylinder and each sensor to a board.
class BoardAssignment {
 public:
  explicit BoardAssignment(const Robot& robot)
      : robot_(robot),
        joint_(robot.joints.size(), 0),
        sensor_(robot.sensors.size(), 0),
        channels_(robot.joints.size(), 0) {
    for (const Sensor& s : robot.sensors) {
      if (const int j = joint_of(robot, s); j >= 0) ++channels_[at(j)];
      cylinder_channels_ += measures_cylinder(s);
    }
    place_joints();
    place_sensors();
  }

  std::vector<Board> boards() const {
    int most = std::max(1, cylinder_);
    for (const int b : joint_) most = std::max(most, b);
    for (const int b : sensor_) most = std::max(most, b);
    std::vector<Board> out(at(most));
    for (std::size_t j = 0; j < joint_.size(); ++j)
      out[at(joint_[j] - 1)].joints.push_back(static_cast<int>(j));
    for (std::size_t m = 0; m < robot_.muscles.size(); ++m) {
      const int j = find_joint(robot_, robot_.muscles[m].joint);
      out[j < 0 ? 0 : at(joint_[at(j)] - 1)].muscles.push_back(static_cast<int>(m));
    }
    for (std::size_t s = 0; s < sensor_.size(); ++s)
      out[at(sensor_[s] - 1)].sensors.push_back(static_cast<int>(s));
    if (cylinder_ > 0) out[at(cylinder_ - 1)].cylinder = true;
    return out;
  }

 private:
  struct Load {
    int joints = 0, channels = 0;
  };

  // Returns the joints tied to this one by muscles over two joints, including itself.
  std::vector<std::size_t> tied(std::size_t joint) const {
    std::vector<std::size_t> group{joint};
    const auto add = [&](int j) {
      if (j >= 0 && std::ranges::count(group, at(j)) == 0) group.push_back(at(j));
    };
    for (std::size_t k = 0; k < group.size(); ++k)
      for (const Muscle& m : robot_.muscles) {
        const std::string& name = robot_.joints[group[k]].name;
        if (m.second.joint.empty() || (m.joint != name && m.second.joint != name)) continue;
        add(find_joint(robot_, m.joint));
        add(find_joint(robot_, m.second.joint));
      }
    return group;
  }

  void place(std::size_t joint, int board) {
    joint_[joint] = board;
    take(board, {1, channels_[joint]});
  }
  void take(int board, Load more) {
    Load& there = load_[at(std::clamp(board, 1, max_boards))];
    there.joints += more.joints;
    there.channels += more.channels;
  }
  bool fits(int board, Load more) const {
    const Load& there = load_[at(board)];
    return there.joints + more.joints <= board_joints &&
           there.channels + more.channels <= board_channels;
  }
  // Returns the first board from `from` on that has room; `from` itself if there is no such board.
  int next_with_room(int from, Load more) const {
    for (int b = from; b <= max_boards; ++b)
      if (fits(b, more)) return b;
    return from;
  }

  // Places the joints that name a board first, with the joints tied to them.
  void place_joints() {
    for (std::size_t j = 0; j < joint_.size(); ++j)
      if (robot_.joints[j].board > 0) place(j, robot_.joints[j].board);
    for (std::size_t j = 0; j < joint_.size(); ++j)
      if (robot_.joints[j].board > 0)
        for (const std::size_t k : tied(j))
          if (joint_[k] == 0) place(k, robot_.joints[j].board);

    int current = 1;
    for (std::size_t j = 0; j < joint_.size(); ++j) {
      if (joint_[j] == 0) {
        const std::vector<std::size_t> group = tied(j);
        Load load;
        for (const std::size_t k : group) ++load.joints, load.channels += channels_[k];
        const int board = next_with_room(current, load);
        for (const std::size_t k : group) place(k, board);
      }
      current = std::min(joint_[j], max_boards);
    }
    const bool loop = has_cylinder_joint(robot_);
    if (!loop && cylinder_channels_ == 0) return;
    const Load load{loop ? 1 : 0, cylinder_channels_};
    cylinder_ = robot_.cylinder.board > 0 ? robot_.cylinder.board : next_with_room(current, load);
    take(cylinder_, load);
  }

  void place_sensors() {
    for (std::size_t s = 0; s < sensor_.size(); ++s) {
      const Sensor& sensor = robot_.sensors[s];
      if (const int j = joint_of(robot_, sensor); j >= 0) sensor_[s] = joint_[at(j)];
      if (measures_cylinder(sensor)) sensor_[s] = cylinder_;
      if (sensor_[s] > 0) continue;
      sensor_[s] = sensor.board > 0 ? sensor.board : next_with_room(1, {0, 1});
      take(sensor_[s], {0, 1});
    }
  }

  const Robot& robot_;
  std::vector<int> joint_, sensor_;  // boards; 0: not placed yet
  int cylinder_ = 0;
  std::vector<int> channels_;  // number of channels of each joint's sensors
  int cylinder_channels_ = 0;
  std::array<Load, static_cast<std::size_t>(max_boards) + 1> load_{};
};

bool has(const std::vector<int>& list, int index) { return std::ranges::count(list, index) > 0; }

// Returns the key of the first joint, sensor or cylinder that makes a board too full.
std::string board_key(const Robot& robot, const Board& board, std::size_t joints) {
  if (joints < board.joints.size())
    return "joint." + robot.joints[at(board.joints[joints])].name + ".board";
  return "cylinder.board";
}

// Returns the key of the first part that names a board beyond this one.
std::string key_beyond(const Robot& robot, int board) {
  for (const Joint& j : robot.joints)
    if (j.board > board) return "joint." + j.name + ".board";
  for (const Sensor& s : robot.sensors)
    if (s.board > board) return "sensor." + s.name + ".board";
  return "cylinder.board";
}

}  // namespace

std::vector<Board> boards_of(const Robot& robot) { return BoardAssignment(robot).boards(); }

int board_of_joint(const std::vector<Board>& boards, int joint) {
  for (std::size_t b = 0; b < boards.size(); ++b)
    if (has(boards[b].joints, joint)) return static_cast<int>(b) + 1;
  return 1;
}

int board_of_sensor(const std::vector<Board>& boards, int sensor) {
  for (std::size_t b = 0; b < boards.size(); ++b)
    if (has(boards[b].sensors, sensor)) return static_cast<int>(b) + 1;
  return 1;
}

Robot only_board(const Robot& robot, const std::vector<Board>& boards, std::size_t board) {
  if (boards.size() == 1) return robot;
  const Board& it = boards[board];
  Robot out = robot;
  out.legs.clear();
  out.links.clear();
  out.joints.clear();
  out.muscles.clear();
  out.sensors.clear();
  for (const int j : it.joints) out.joints.push_back(robot.joints[at(j)]);
  for (const int m : it.muscles) out.muscles.push_back(robot.muscles[at(m)]);
  for (const int s : it.sensors) out.sensors.push_back(robot.sensors[at(s)]);
  if (!it.cylinder) out.cylinder.present = false;
  return out;
}

void check_boards(const Robot& robot, std::vector<Contradiction>& out) {
  const std::vector<Board> boards = boards_of(robot);
  for (const Muscle& m : robot.muscles) {
    const int first = find_joint(robot, m.joint), second = find_joint(robot, m.second.joint);
    if (first < 0 || second < 0) continue;
    const int a = board_of_joint(boards, first), b = board_of_joint(boards, second);
    if (a == b) continue;
    out.push_back({"muscle." + m.name + ".second.joint",
                   "joint " + m.joint + " on board " + std::to_string(a) + ", joint " +
                       m.second.joint + " on board " + std::to_string(b),
                   "both joints of a muscle on one board, where their laws share its duties",
                   "joint." + m.second.joint + ".board = " + std::to_string(a)});
  }
  for (std::size_t i = 0; i < boards.size(); ++i) {
    const Board& board = boards[i];
    const std::string number = std::to_string(i + 1);
    const bool loop = board.cylinder && has_cylinder_joint(robot);
    const std::size_t joints = board.joints.size() + (loop ? 1 : 0);
    if (board.empty() && boards.size() > 1)
      out.push_back({key_beyond(robot, static_cast<int>(i) + 1),
                     "a board " + std::to_string(boards.size()) + " and no board " + number,
                     "numbers from 1 on with none left out", "board = " + number});
    if (joints > static_cast<std::size_t>(board_joints))
      out.push_back({board_key(robot, board, at(board_joints)),
                     std::to_string(joints) + " joints on board " + number +
                         (loop ? ", the cylinder's loop included" : ""),
                     "at most " + std::to_string(board_joints) + " joints on a board",
                     "another board, or no board: then the next with room is taken"});
    if (board.sensors.size() > static_cast<std::size_t>(board_channels))
      out.push_back({"sensor." + robot.sensors[at(board.sensors[at(board_channels)])].name,
                     std::to_string(board.sensors.size()) + " sensors on board " + number,
                     "at most " + std::to_string(board_channels) + " channels on a board",
                     "some of its joints on another board"});
  }
}

}  // namespace sinew::robot
