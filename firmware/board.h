// firmware/board.h - interface between the application and a board: the functions that a port
// implements, and the three that its interrupts call. docs/how-to/hardware.md describes them in
// order.
//
//   interrupt of the timer, 10 kHz, the lower priority:   tick()
//   interrupts of the line, the higher priority:          received(byte), next_to_send(byte)
//   interrupt of an edge, above both, if the board has it: outputs what drive() left (edges.h)
//   everything else:                                      run() on the main stack, for ever
//
// "Anywhere" means from the interrupts and from run(). Times are bounds for a processor at 100 MHz.
#pragma once

#include <cstdint>

#include "sinew/control/supervise/output_stage.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::firmware {

// --- functions of the application ----------------------------------------------------------------

// Runs the application and never returns. Called once by start-up code, after memory is cleared and
// the FPU is on.
[[noreturn]] void run();

// Runs a tick. Called by the timer's interrupt, which has cleared its request. It is not reentrant.
void tick();

// Stores a byte; called by the line's interrupts. If there is no room, the byte and its frame are
// lost.
void received(std::uint8_t byte);
// Returns false if there is nothing to send until wake_sender().
bool next_to_send(std::uint8_t& byte);

// --- functions of a board ------------------------------------------------------------------------

namespace hardware {

// State of the valves from this tick on.
struct Drive {
  signals::Tick tick = -1;     // tick of the run, -1 outside a run; for an emulated machine
  control::OpenMask open = 0;  // valves that are open; for a machine without wires
  std::uint32_t coils = 0;     // a bit for each output pin, with polarity applied
  bool current = true;         // false: all coils are without current
  bool supply = false;         // current in the supply's dump valve; without it, air is let out
};

// run() calls these once, in this order.
void start();              // clocks and pins; first of all, coils without current. <= 1 s, or reset
const char* name();        // up to 15 characters
bool reset_by_watchdog();  // returns whether the watchdog has reset the board
std::uint32_t nonce();     // a different number after each reset
bool active_low();         // whether level 0 gives a coil current (level.h); reported to hosts
void start_line(std::uint32_t baud);  // 8 bits, no parity, 1 stop bit; with its interrupts
std::uint32_t longest_pause();        // longest pause within a frame [ticks]; a longer one ends it
void start_watchdog();  // resets the board if it is not fed for about 20 ms; cannot be stopped
void start_ticks();     // makes the timer call tick() every 100 us

// tick() calls these, each at most once per tick. All but reading() take less than 1 us.
std::uint32_t
ticks_passed();  // since the last call: 1; more if ticks were missed; 0 (tick_count.h)
void start_conversion(signals::Channel channel);  // samples now, does not wait
signals::Reading reading(signals::Tick run);  // result of the last conversion; late: not finished
// Sets the valves. Called when something has changed; all pins of a port change at once. A run's
// word is output at a fixed instant of its tick if the board has a compare (edges.h), and at once
// otherwise. A word without current, supply or run is always output at once, and a waiting word is
// dropped.
void drive(const Drive& drive);
void feed_watchdog();

// run() calls these repeatedly.
void block_ticks();  // for about 10 us; the line's interrupts stay enabled
void allow_ticks();
void wake_sender();  // makes the line call next_to_send() until it returns false
void idle();         // waits until an interrupt

}  // namespace hardware
}  // namespace sinew::firmware
