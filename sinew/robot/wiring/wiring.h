// robot/wiring/wiring.h - wiring of a robot: the terminal block, the converter's channels and the
// two output ports that switch the valves (B.1, table C-1).
//
// Valves use bits 0 to 7 of port 0, and 8 to 15, which are port 1. Two sources number them: B.1's
// masks, which are the `bit`s of the robot's muscles and cylinder, and the table's, which are the
// bits here. `bits` selects one of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/robot/robot.h"
#include "sinew/signals/table.h"

namespace sinew::robot {

// Wires of a terminal block.
struct Wiring {
  enum class Polarity { low_opens, high_opens };  // effect of a port's bit
  // Source of the output bits' numbers: the robot's file or the table.
  enum class Bits { robot, table };

  // A sensor's wire, by the sensor's name.
  struct Signal {
    std::string name;
    int pin = 0, ground = 0;  // pins of the terminal block
    int channel = -1;         // channel of the converter; -1: not in the table
    bool spare = false;       // a wire without a sensor
  };
  struct Line {
    int pin = 0, common = 0;
    int bit = 0;  // 0 to 15
  };
  // Valves of one chamber.
  struct Valve {
    std::string name;
    std::string of;    // a muscle, or cylinder_up, cylinder_down
    int plumbing = 0;  // number of its hose
    Line inlet, exhaust;
  };
  struct Power {
    std::string name;
    int pin = 0;
  };

  bool present = false;
  Polarity polarity = Polarity::low_opens;
  Bits bits = Bits::robot;
  std::vector<Signal> signals;
  std::vector<Valve> valves;
  std::vector<Power> power;
};

// Returns the contradictions: two wires on one pin, two valves on one bit, two signals on one
// channel, unknown names, a bit of the robot without a pin, a channel that differs from the robot's
// file. For a robot without wiring only two valves on one bit are reported.
std::vector<Contradiction> contradictions(const Wiring&, const Robot&);

// A valve, its topic in a log and its bit.
struct ValveBit {
  std::string of;
  std::string which;  // "inlet" or "exhaust"
  int bit = 0;        // bit of its board's ports
  int board = 1;
  std::string topic;  // /valve/<of>/<which>/open, after /leg/<name> for a leg
};
std::vector<ValveBit> bits_of(const Robot&, const Wiring&);

// State of one board's ports from this time until the next entry.
struct PortBytes {
  std::int64_t time_ns = 0;
  std::array<std::uint8_t, board_bits / 8> port{};
};

// Returns the bytes that the edges of these valves wrote in a run, first at time 0 with all valves
// shut, with an entry for each change of a byte. All valves must be of one board.
std::vector<PortBytes> port_bytes(const signals::Table& table, const std::vector<ValveBit>& bits,
                                  Wiring::Polarity polarity);

}  // namespace sinew::robot
