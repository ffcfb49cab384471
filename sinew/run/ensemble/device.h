// run/ensemble/device.h - device that runs the machines of an ensemble: the cores of the processor,
// or a graphics card. The figures have the same bits.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace sinew::run {

class Card;  // run/card/on_card.h

struct Device {
  enum class Kind {
    automatic,  // a card where one is usable and the runs are so many that it is faster
    cpu,        // the processor
    gpu,        // this card; the processor makes the runs that a card cannot
  };
  Kind kind = Kind::automatic;
  int number = 0;                   // number of the card, from 0
  std::shared_ptr<Card> card = {};  // once it has been chosen; copies use the same one

  bool operator==(const Device& other) const {
    return kind == other.kind && number == other.number;
  }
};

// Parses "auto", "cpu", "gpu" or "gpu:1". Throws config::Error that begins with "device".
Device parse_device(std::string_view text);

// Returns the device with its card. An automatic one becomes the first usable card, else the
// processor. Throws std::runtime_error if the device is a card that this computer or this build
// cannot use.
Device chosen(const Device& device);

// Returns the name of a chosen device's card, "NVIDIA H200 (card 0)"; empty for the processor.
std::string name_of(const Device& device);

}  // namespace sinew::run
