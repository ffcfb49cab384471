// run/simulation/place.h - where an experiment's joint controllers are: here, in the simulation; on
// a board at a serial line; on a board in an emulator; here, before a machine at a card.
//
//   simulated                   no board: nothing is opened
//   serial:DEVICE[@RATE]        a board; without a rate that of the firmware
//   lock-step:FILE              firmware/'s lock-step.elf in QEMU, around it the simulated machine:
//                               the simulation's bits
//   emulated:FILE               the application of firmware/ for mps2-an386 in QEMU, at its serial
//                               line, the same machine at its wires: as on a bench
//   comedi:DEVICE               here, in real time, before a card at whose ends the machine is
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/emulated_board.h"
#include "sinew/run/simulation/card_place.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Returns "" for a place in words as above, or none, else what is wrong with it.
std::string problem_of_place(const std::string& place);

// Is it a place other than the simulation?
bool is_elsewhere(const std::string& place);

// Is there a machine, or an emulator, whose clock goes on whatever pace is asked for?
bool keeps_its_own_time(const std::string& place);

class Place {
 public:
  // Opens what is there. Throws plant::BoardError, plant::CardError, or config::Error for an
  // experiment that cannot run there.
  Place(const std::string& place, const experiment::Experiment& experiment);
  ~Place();
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  // Has the board ready for a run: configured and armed. What its fault was is told. Throws
  // plant::BoardError, also for a fault that has to be looked into, unless it may be cleared, and
  // plant::BoardStopped where `stop`, which outlives this, is set meanwhile.
  void prepare(bool clear_fault = false, const std::atomic<bool>* stop = nullptr);
  // The run goes there.
  void apply(RunOptions& options) const;
  // Who answered, and where: its board and firmware; empty where nothing was opened.
  const std::string& who() const noexcept { return who_; }
  // What there is to be said of it before the run, in lines.
  const std::vector<std::string>& told() const noexcept { return told_; }
  // The board; nullptr in the simulation.
  plant::RemoteBoard* board() const noexcept { return board_; }
  int lead() const noexcept { return lead_; }
  // Does it keep its own time, whatever pace is asked for?
  bool board_keeps_time() const noexcept { return keeps_time_; }

 private:
  struct Serial;
  template <class Emulated>
  struct AtMachine;

  void open_card(const std::string& device, const experiment::Experiment& experiment,
                 const std::string& place);

  std::unique_ptr<Serial> serial_;
  std::unique_ptr<AtMachine<plant::EmulatedBoard>> emulated_;
  std::unique_ptr<AtMachine<plant::LockStepBoard>> lock_step_;
  std::unique_ptr<CardPlace> card_;
  plant::RemoteBoard* board_ = nullptr;
  int lead_ = 1;
  bool keeps_time_;
  std::string place_, who_;
  std::vector<std::string> told_;
  link::Configuration configuration_;
};

}  // namespace sinew::run
