// run/bring_up/bring_up.h - the bring-up of a machine at the bench: a sequence of steps from the
// first contact with its board to an emergency stop, with an operator who observes and replies to
// questions. Each completed step is stored, so that a later run continues after it.
//
//   <folder>/bring-up.json         completed steps and their measurements
//   <folder>/bring-up-before.json  the same for the robot, board or firmware that was used before
//   <folder>/robot.toml            the robot with the measured rest counts of its sensors
//   <folder>/wiring.svg            drawing of the wiring
//   <folder>/bench.toml            an experiment in which the robot hangs empty and does nothing
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/remote_board.h"

namespace sinew::run {

// The operator at the bench, as callbacks.
struct Operator {
  std::function<void(const std::string&)> inform;
  // Returns yes or no, or nothing if there is no reply.
  std::function<std::optional<bool>(const std::string&)> confirm;
  // Called with true before valves move and with false after it; may be empty.
  std::function<void(bool)> moves = {};
  // Returns whether the operator has requested a stop. Called in each period in which valves move;
  // may be empty.
  std::function<bool()> stops = {};
};

// Writes bench.toml into the folder and returns it: an experiment in which the robot hangs empty
// and does nothing. It gives the board its constants and describes a simulated bench. Throws
// config::Error.
experiment::Experiment bench_of(const std::string& robot, const std::filesystem::path& folder,
                                const std::vector<std::string>& sets);

class BringUp {
 public:
  // `lead` is the lead of commands (remote_boards.h). All arguments must outlive this object.
  // Throws config::Error if the folder has the steps of another robot or cannot be used.
  BringUp(const experiment::Experiment& bench, std::string robot, plant::RemoteBoard& board,
          int lead, Operator bench_operator, const std::filesystem::path& folder);
  ~BringUp();

  // Executes the steps that are not completed. Returns false if a step found a fault, which it has
  // reported, or if the operator did not reply or stopped it. Throws plant::BoardError if no board
  // is found.
  bool go();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The completed steps of a bring-up, in a file.

// Readings of a channel while nothing moves.
struct RestReadings {
  double at_rest = 0, noise = 0;  // mean and standard deviation [count]
  int readings = 0;
};

// Range of a joint's angle sensor when its muscles pull it to its ends [count].
struct Stroke {
  double lowest = 0, highest = 0;
};

// The completed steps and their results.
struct Progress {
  std::string robot, board;
  std::string machine;                                   // hash of all values of the robot
  std::map<std::string, std::vector<std::string>> done;  // keys: step names; values: reports
  std::map<std::string, RestReadings> rest_readings;     // keys: sensor names
  std::map<std::string, Stroke> strokes;                 // keys: joint names
};

// Returns the contents of the file, or no completed steps if it does not exist. Throws
// config::Error if the file is not a bring-up file or belongs to another robot.
Progress read_progress(const std::filesystem::path& file, const std::string& robot);

// Replaces the whole file. Throws config::Error.
void write_progress(const Progress& progress, const std::filesystem::path& file);

// Returns a robot file for `folder` that is based on the file `base` and contains the measured rest
// counts of the sensors.
std::string measured_robot(const Progress& progress, const std::filesystem::path& base,
                           const std::filesystem::path& folder);

}  // namespace sinew::run
