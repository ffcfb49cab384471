// run/ensemble/device.h - what runs the machines of an ensemble: the cores of the processor, or a
// graphics card. The figures have the same bits.
#pragma once

#include <string>
#include <string_view>

namespace sinew::run {

struct Device {
  enum class Kind {
    automatic,  // a card where one is usable and the runs are so many that it is faster
    cpu,        // the processor
    gpu,        // this card; runs that it does not hold are made by the processor
  };
  Kind kind = Kind::automatic;
  int number = 0;  // number of the card, from 0

  bool operator==(const Device&) const = default;
};

// Parses "auto", "cpu", "gpu" or "gpu:1". Throws config::Error that begins with "device".
Device parse_device(std::string_view text);

// Throws std::runtime_error if the device is a card that this computer or this build cannot use.
void require_card(const Device& device);

}  // namespace sinew::run
