// port/comedi/comedi_port.h - a machine at a data acquisition card in this computer, like the
// leg of the thesis (5.2): the card's converter reads the sensors, its digital outputs switch the
// valves.
//
// One call starts a conversion and waits for it, at the tick at which it is read: the sampled
// instant is a tick later than in a simulation. A conversion that takes longer than a tick is late.
//
//   count = top (low + (high - low) n / n_top) / full_scale, held within 0 .. top
//
// n is the count of the card's converter in its range low .. high [V]. The counts of a card with
// the robot's resolution and range are passed on unchanged. Those of a finer card are scaled; a
// coarser card is refused.
//
// Three scans without a good conversion of a channel are a fault, even if the robot's hold_limit
// allows a simulation more: a machine is not driven without its sensors.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/host/realtime.h"
#include "sinew/port/comedi/module/card.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// Reports why a card cannot be opened or driven, and how to correct it.
class CardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Wiring of a machine to a card.
struct CardMachine {
  // A sensor's wire.
  struct Input {
    std::string sensor;
    int channel = 0;  // channel of the converter, from 0
  };
  struct Output {
    std::string valve;      // "hip_flexor inlet", for messages
    int bit = -1;           // digital output; -1: the valve does not exist
    bool inlet = false;     // it lets air in
    bool vents = false;     // it lets a muscle's air out
    bool inverted = false;  // current in its coil shuts it
  };
  std::vector<Input> inputs;    // in the order of the machine's channels
  std::vector<Output> outputs;  // in the order of the machine's valves
  double full_scale = 5;        // [V]
  int top = 4095;               // the robot's highest count
  bool active_low = true;       // bit 0 energizes the coil
  signals::Tick vent = 0;       // time for which the exhausts stay open before all valves shut
};

// Returns the functions of the card's module. Throws CardError if this program was built without
// it.
const SinewCard& card_functions();

class ComediPort final : public signals::Port {
 public:
  // Opens the card and switches off the current of all coils. Throws CardError if the card does not
  // exist or does not fit the machine. `beat` is the loop's clock and must outlive this object.
  ComediPort(const std::string& device, CardMachine machine, const host::TickTimer& beat);
  // Switches off the current of all coils, in every state.
  ~ComediPort();
  ComediPort(const ComediPort&) = delete;
  ComediPort& operator=(const ComediPort&) = delete;

  signals::Status start(const signals::Scan&) noexcept override;
  signals::Status drive(signals::Edge) noexcept override;
  signals::Reading read(signals::Channel, signals::Tick) noexcept override;
  // Vents for as long as the machine needs, unless it has just vented, and shuts all valves.
  // Signals do not interrupt it.
  signals::Status stop(signals::Tick) noexcept override;

  // Returns the card's name.
  const std::string& board() const noexcept { return board_; }
  // Returns why the card failed in the loop; empty if it did not fail.
  std::string problem() const;

 private:
  enum class Why { nothing, write, behind };

  void open();
  void fit();
  void fit_inputs(int channels);
  void take_outputs();
  void refuse(const std::string& what) const;
  bool write(std::uint32_t coils) noexcept;
  bool on_time() noexcept;
  signals::Reading bad(std::size_t channel, signals::Status status) noexcept;
  void watch_the_vent(signals::Tick at) noexcept;
  bool vent_and_rest() noexcept;

  const SinewCard* functions_;
  std::string device_, board_;
  CardMachine machine_;
  const host::TickTimer* beat_;
  void* card_ = nullptr;
  SinewCardFacts facts_{};
  double offset_ = 0, gain_ = 1;         // scale of the counts, see above
  std::uint32_t bits_ = 0, inlets_ = 0;  // masks of the card's outputs
  std::uint32_t vent_ = 0;               // coils that have current while the machine vents
  std::uint32_t coils_ = 0;              // coils that have current now
  std::vector<std::uint16_t> last_;      // last good counts, by channel
  bool started_ = false, vented_ = false, stopped_ = false;
  signals::Tick venting_since_ = -1;
  Why why_ = Why::nothing;
  std::vector<int> bad_in_a_row_;  // failed conversions, by channel
  int dead_ = -1;                  // channel that ended the run; kept until the next start
};

}  // namespace sinew::plant
