// run/simulation/place.h - the place of an experiment's joint controllers: in the simulation, on a
// board at a serial line, on a board in an emulator, or in this computer with a machine at a card.
//
//   simulated                   no board: nothing is opened
//   serial:DEVICE[@RATE]        a board; the default rate is that of the firmware
//   lock-step:FILE              firmware/'s lock-step.elf in QEMU with the simulated machine: the
//                               results of the simulation, bit for bit
//   emulated:FILE               the application of firmware/ for mps2-an386 in QEMU, at its serial
//                               line, with the simulated machine at its wires, as on a bench
//   comedi:DEVICE               this computer, in real time, with the machine at a card
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/emulated_board.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Returns a message about an invalid place; "" if it is valid or empty.
std::string problem_of_place(const std::string& place);

// Returns whether the place is not the simulation.
bool is_outside_simulation(const std::string& place);

// Returns whether the place has a machine or an emulator whose clock cannot be paced.
bool has_own_clock(const std::string& place);

// Returns the machine as a card drives it. Throws config::Error if no card can drive it.
plant::CardMachine card_machine(const experiment::Experiment& experiment, const std::string& place);

class Place {
 public:
  // Opens the place. Throws plant::BoardError, plant::CardError, or config::Error for an
  // experiment that cannot run there.
  Place(const std::string& place, const experiment::Experiment& experiment);
  ~Place();
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  // Prepares the board for a run: configures and arms it, and reports its earlier fault. Throws
  // plant::BoardError, also for a fault that requires attention unless `clear_fault` is set, and
  // plant::BoardStopped if `stop`, which must outlive this object, is set meanwhile.
  void prepare(bool clear_fault = false, const std::atomic<bool>* stop = nullptr);
  // Makes a run with these options use the place.
  void apply(RunOptions& options) const;
  // Returns the identity of the board and its firmware, and its place; empty if nothing was opened.
  const std::string& who() const noexcept { return who_; }
  // Returns the messages about the place before the run, as lines.
  const std::vector<std::string>& messages() const noexcept { return messages_; }
  // Returns the board; nullptr in the simulation.
  plant::RemoteBoard* board() const noexcept { return board_; }
  int lead() const noexcept { return lead_; }
  // Returns whether the place keeps its own time, independent of the requested pace.
  bool board_keeps_time() const noexcept { return keeps_time_; }

 private:
  struct Card;
  struct Serial;
  template <class Emulated>
  struct AtMachine;

  void open_card(const std::string& device, const experiment::Experiment& experiment,
                 const std::string& place);

  std::unique_ptr<Serial> serial_;
  std::unique_ptr<AtMachine<plant::EmulatedBoard>> emulated_;
  std::unique_ptr<AtMachine<plant::LockStepBoard>> lock_step_;
  std::unique_ptr<Card> card_;
  plant::RemoteBoard* board_ = nullptr;
  int lead_ = 1;
  bool keeps_time_;
  std::string place_, who_;
  std::vector<std::string> messages_;
  link::Configuration configuration_;
};

}  // namespace sinew::run
