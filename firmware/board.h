// firmware/board.h - all that the application wants of a board: the functions that a port writes,
// and the three that its interrupts call. docs/how-to/hardware.md goes through them in order.
//
//   interrupt of the timer, 10 kHz, the lower priority:   tick()
//   interrupts of the line, the higher priority:          received(byte), next_to_send(byte)
//   interrupt of an edge, above both, where there is one:  puts what drive() left (edges.h)
//   everything else:                                      run() on the main stack, for ever
//
// "Anywhere" means: from the interrupts and from run(). Times are bounds for a processor of 100
// MHz.
#pragma once

#include <cstdint>

#include "sinew/control/supervise/output_stage.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::firmware {

// --- what the application has for a board --------------------------------------------------------

// From start-up code, once, when memory is cleared and the FPU is on. Never returns.
[[noreturn]] void run();

// From the timer's interrupt, whose request it has cleared. It never calls itself.
void tick();

// From the line's interrupts. A byte that finds no room is lost, and its frame with it.
void received(std::uint8_t byte);
// false: there is nothing to send, until wake_sender().
bool next_to_send(std::uint8_t& byte);

// --- what a board has for the application --------------------------------------------------------

namespace hardware {

// What the valves are to do from this tick on.
struct Drive {
  signals::Tick tick = -1;     // of the run, -1 while there is none: for an emulated machine
  control::OpenMask open = 0;  // which of them: for a machine without wires
  std::uint32_t coils = 0;     // a bit for each output pin, polarity and all
  bool current = true;         // false: no coil is to have any
  bool supply = false;         // current in the supply's dump valve; without, air is let out
};

// Called by run(), once, in this order.
void start();        // clocks and pins; before anything else no coil gets current. <= 1 s, or reset
const char* name();  // up to 15 letters
bool bitten();       // was it the watchdog that has reset the board?
std::uint32_t nonce();  // another number after each reset
bool active_low();      // does 0 at an output give a coil current (level.h)? Told to hosts
void start_line(std::uint32_t baud);  // 8 bits, no parity, 1 stop bit; its interrupts come
std::uint32_t longest_pause();        // [ticks] of the line within a frame; a longer one ends it
void start_watchdog();  // bites unless it is fed within 20 ms, or so; cannot be stopped again
void start_ticks();     // every 100 us tick() is called, from here on

// Called by tick(), at most once in each. All are done within 1 us but reading().
std::uint32_t ticks_passed();  // since the last call: 1, or more where some were missed
void start_conversion(signals::Channel channel);  // samples now, does not wait
signals::Reading reading(signals::Tick run);      // of the conversion started last; late: not done
// Whenever something has changed; all pins of a port at once. A run's word reaches them at one
// instant of its tick where the board has a compare (edges.h), and without one now; a word without
// current, supply or run always now, and whatever waited is forgotten.
void drive(const Drive& drive);
void feed_watchdog();

// Called by run(), again and again.
void keep_ticks_away();  // for 10 us, or so; the line's interrupts come nevertheless
void let_ticks_come();
void wake_sender();  // there may be bytes to send: have next_to_send() asked until it says false
void idle();         // until an interrupt comes

}  // namespace hardware
}  // namespace sinew::firmware
