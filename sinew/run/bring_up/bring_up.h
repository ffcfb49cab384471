// run/bring_up/bring_up.h - the first day of a machine at the bench: step by step from "is a board
// there" to a stop in an emergency, with a person who looks and answers. Each step is kept when it
// is done, so that after a mended wire it goes on where it was.
//
//   <folder>/bring-up.json   steps that are done, and what was measured
//   <folder>/bring-up-before.json  the same of another robot, board or firmware, that was there
//   before <folder>/robot.toml      the robot with what was learned of its sensors
//   <folder>/wiring.svg      which wire goes where
//   <folder>/bench.toml      an experiment in which the robot hangs empty and does nothing
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

// The person at the bench.
struct Person {
  std::function<void(const std::string&)> tell;
  // Yes, no, or nobody who answers.
  std::function<std::optional<bool>(const std::string&)> ask;
  // Called with true before valves move and with false after it; may be empty.
  std::function<void(bool)> moves = {};
  // Asked in each period in which they move: is there a stop? May be empty.
  std::function<bool()> stops = {};
};

// Returns an experiment in which a robot hangs empty and does nothing, for its board's constants
// and for a simulated bench: bench.toml, which it writes into the folder. Throws config::Error.
experiment::Experiment bench_of(const std::string& robot, const std::filesystem::path& folder,
                                const std::vector<std::string>& sets);

class BringUp {
 public:
  // `lead` is that of commands (remote_boards.h); all of these outlive this. Throws config::Error
  // where the folder has the steps of another robot, or cannot be used.
  BringUp(const experiment::Experiment& bench, std::string robot, plant::RemoteBoard& board,
          int lead, Person person, const std::filesystem::path& folder);
  ~BringUp();

  // Works off the steps that are not done. False: one of them found something wrong, and said it,
  // or nobody answered. Throws plant::BoardError where the board is not there.
  bool go();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The steps of a bring-up that are done, in a file.

// Holds what a channel reads while nothing moves.
struct Learned {
  double at_rest = 0, noise = 0;  // mean and standard deviation [count]
  int readings = 0;
};

// Of a joint, pulled to its ends by its muscles [count].
struct Stroke {
  double lowest = 0, highest = 0;
};

// Holds the steps that are done, and what they found.
struct Progress {
  std::string robot, board;
  std::string machine;                                   // stands for all of the robot's values
  std::map<std::string, std::vector<std::string>> done;  // by the step's name: what it said
  std::map<std::string, Learned> learned;                // by the sensor's name
  std::map<std::string, Stroke> strokes;                 // by the joint's name
};

// Returns what is in the file, or nothing done where there is none. Throws config::Error for a file
// that is none of ours, or of another robot.
Progress read_progress(const std::filesystem::path& file, const std::string& robot);

// Replaces the file as a whole. Throws config::Error.
void write_progress(const Progress& progress, const std::filesystem::path& file);

// Returns the robot's file with the sensors' rest counts that were measured, over the one at
// `base`, for a file in `folder`.
std::string learned_robot(const Progress& progress, const std::filesystem::path& base,
                          const std::filesystem::path& folder);

}  // namespace sinew::run
