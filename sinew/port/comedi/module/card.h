// port/comedi/module/card.h - what the module with libcomedi in it offers: a card's converter and
// its digital outputs. The program opens it for `comedi:` alone.
#pragma once

#include <cstdint>

extern "C" {

// What a card has.
struct SinewCardFacts {
  char board[64];
  int input;          // subdevice of the converter; -1: none
  int inputs;         // its channels
  std::uint32_t top;  // its highest count
  int range;          // the narrowest that covers what was asked for; -1: none
  double low, high;   // of that, or of the widest in volts [V]
  int output;         // subdevice with the outputs; -1: none
  int outputs;        // its channels
};

// Functions return false where the card failed; `words` says why.
struct SinewCard {
  void* (*open)(const char* device);  // nullptr: failed
  void (*close)(void* card);
  // Looks for a converter with a range over 0 .. volts, and for that many outputs in one subdevice,
  // else for the subdevice that has the most.
  bool (*look)(void* card, double volts, int outputs, SinewCardFacts* out);
  // Nobody else may write to the subdevice from now on.
  bool (*own)(void* card, int subdevice);
  bool (*make_output)(void* card, int subdevice, int channel);
  // In the loop: no memory is taken.
  bool (*convert)(void* card, int subdevice, int channel, int range, std::uint32_t* count);
  bool (*write)(void* card, int subdevice, std::uint32_t mask, std::uint32_t bits);
  const char* (*words)();
};

const SinewCard* sinew_card_1();  // the number is the version of the struct

}  // extern "C"
