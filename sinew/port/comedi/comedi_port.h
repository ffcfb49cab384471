// port/comedi/comedi_port.h - a machine at a data acquisition card in this computer, as the thesis
// had its leg (5.2): the card's converter reads the sensors, its digital outputs switch the valves.
//
// A conversion is started and awaited by one call, at the tick at which it is read: the sampled
// instant is a tick later than in a simulation. One that takes longer than a tick is late.
//
//   count = top (low + (high - low) n / n_top) / full_scale, held within 0 .. top
//
// where n is what the card's converter says in its range low .. high [V]. A card of the robot's
// resolution and range hands on its own counts. A finer one is scaled, a coarser one refused.
//
// Three scans without a good conversion of a channel are a fault, whatever the robot's hold_limit
// allows a simulation: nothing drives a machine blind.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/host/realtime.h"
#include "sinew/port/comedi/module/card.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// Says why a card cannot be opened or driven, and what to do.
class CardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The machine as a card has it before it.
struct CardMachine {
  // A sensor's wire.
  struct Input {
    std::string sensor;
    int channel = 0;  // of the converter
  };
  struct Output {
    std::string valve;      // "hip_flexor inlet", for a message
    int bit = -1;           // of the digital outputs; -1: no such valve
    bool inlet = false;     // it lets air in
    bool vents = false;     // it lets a muscle's air out
    bool inverted = false;  // its coil shuts it
  };
  std::vector<Input> inputs;    // by the machine's channels
  std::vector<Output> outputs;  // by the machine's valves
  double full_scale = 5;        // [V]
  int top = 4095;               // the robot's highest count
  bool active_low = true;       // a bit that is 0 gives its coil current
  signals::Tick vent = 0;       // how long the exhausts stay open before all is shut
};

// The functions of the card's module. Throws CardError where this program was built without.
const SinewCard& card_functions();

class ComediPort final : public signals::Port {
 public:
  // Opens the card and leaves no coil with current. Throws CardError for a card that there is not,
  // or that does not fit the machine. `beat` is the loop's clock, and outlives this.
  ComediPort(const std::string& device, CardMachine machine, const host::Beat& beat);
  // No coil has current afterwards, whatever came before.
  ~ComediPort();
  ComediPort(const ComediPort&) = delete;
  ComediPort& operator=(const ComediPort&) = delete;

  signals::Status start(const signals::Scan&) noexcept override;
  signals::Status drive(signals::Edge) noexcept override;
  signals::Reading read(signals::Channel, signals::Tick) noexcept override;
  // Vents for as long as the machine needs, unless it has just been done, and shuts everything. No
  // signal ends it.
  signals::Status stop(signals::Tick) noexcept override;

  // Returns the card's name.
  const std::string& board() const noexcept { return board_; }
  // Why it failed in the loop; empty where it did not.
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
  const host::Beat* beat_;
  void* card_ = nullptr;
  SinewCardFacts facts_{};
  double offset_ = 0, gain_ = 1;         // of the counts, as above
  std::uint32_t bits_ = 0, inlets_ = 0;  // of the card's outputs
  std::uint32_t vent_ = 0;               // coils with current while it vents
  std::uint32_t coils_ = 0;              // with current now
  std::vector<std::uint16_t> last_;      // good counts, by channel
  bool started_ = false, vented_ = false, stopped_ = false;
  signals::Tick venting_since_ = -1;
  Why why_ = Why::nothing;
  std::vector<int> bad_in_a_row_;  // conversions, by channel
  int dead_ = -1;                  // the channel that ended the run; sticky
};

}  // namespace sinew::plant
