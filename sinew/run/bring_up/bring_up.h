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

}  // namespace sinew::run
