// port/hardware/emulator.h - a board's program in QEMU with a body at its wires: the emulator
// stands still while the body's side answers (control/board/lock_step.h has the records).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sinew/signals/port.h"

namespace sinew::plant {

// What befalls the program of a board itself, for tests: it stands still for so many ticks, as one
// that hangs where they are more than its watchdog waits, or is reset.
struct Mishap {
  // Names it: nothing; the board hangs for so many ticks; it is reset.
  enum class What : std::uint8_t { none, stall, reset } what = What::none;
  std::uint16_t ticks = 0;
};

// What the board's valves and its converter are connected to, in the board's numbers and the run's
// ticks; -1 while nothing runs.
struct Wires {
  // Valves have changed: bit i is open now. Without current all coils are at rest.
  std::function<void(signals::Tick tick, std::uint32_t open, bool current)> valves;
  std::function<signals::Reading(signals::Channel, signals::Tick tick)> read;
  // Asked before each reading, of an application only; empty: nothing ever does.
  std::function<Mishap(signals::Tick tick)> mishap = {};
};

class Emulator {
 public:
  struct Gone {};  // it has ended, or says what it should not

  // Starts a program of firmware/. Its serial line is at `line`, a socket of which the emulator has
  // the other end; -1: it has none. Throws BoardError where that does not go.
  Emulator(const std::string& image, Wires wires, int line);
  ~Emulator() { quit(); }
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  // Serves the wires until a record of another kind comes, and returns its letter. This and the
  // two below throw Gone.
  std::uint8_t next_record();
  std::int64_t number(int bytes);
  void put(std::span<const std::uint8_t> bytes);

  // Ends the process at once: whoever waits for a record gets Gone.
  void kill() noexcept;

 private:
  void start(const std::string& image, int line);
  void open_pipes();
  void quit() noexcept;
  bool fill();
  std::uint8_t byte();
  void valves();
  void reading();
  bool suffers(signals::Tick tick);

  Wires wires_;
  std::string folder_, from_path_, to_path_;
  pid_t process_ = -1;
  int from_ = -1, to_ = -1;
  std::vector<std::uint8_t> buffer_;
  std::size_t first_ = 0;
};

}  // namespace sinew::plant
