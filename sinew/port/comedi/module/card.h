// port/comedi/module/card.h - interface of the module that wraps libcomedi: a card's converter and
// its digital outputs. The program loads the module only for `comedi:`.
#pragma once

#include <cstdint>

extern "C" {

// Properties of a card.
struct SinewCardFacts {
  char board[64];
  int input;          // subdevice of the converter; -1: none
  int inputs;         // number of its channels
  std::uint32_t top;  // its highest count
  int range;          // narrowest range that covers the requested volts; -1: none
  double low, high;   // limits of that range, or of the widest one in volts [V]
  int output;         // subdevice with the outputs; -1: none
  int outputs;        // number of its channels
};

// Functions return false if the card failed; `error_text` returns the reason.
struct SinewCard {
  void* (*open)(const char* device);  // nullptr: failed
  void (*close)(void* card);
  // Finds a converter with a range over 0 .. volts, and a subdevice with at least that many
  // outputs, or else the one with the most.
  bool (*find_subdevices)(void* card, double volts, int outputs, SinewCardFacts* out);
  // Reserves the subdevice: other programs can no longer write to it.
  bool (*own)(void* card, int subdevice);
  bool (*make_output)(void* card, int subdevice, int channel);
  // These are called in the loop and allocate no memory.
  bool (*convert)(void* card, int subdevice, int channel, int range, std::uint32_t* count);
  bool (*write)(void* card, int subdevice, std::uint32_t mask, std::uint32_t bits);
  const char* (*error_text)();
};

const SinewCard* sinew_card_1();  // the number is the version of the struct

}  // extern "C"
