// robot/wiring/wiring.h - which wire goes where: the terminal block, the converter's channels and
// the two output ports that switch the valves (B.1, table C-1).
//
// Valves take bits 0 to 7 of port 0, and 8 to 15, which is port 1. Two sources number them: B.1's
// masks, which are the `bit`s of the robot's muscles and cylinder, and the table's, which are the
// bits here. `bits` says which are used.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/robot/robot.h"
#include "sinew/signals/table.h"

namespace sinew::robot {

// Which wire of a terminal block leads where.
struct Wiring {
  enum class Polarity { low_opens, high_opens };  // what a port's bit does
  // Whose numbers of output bits count: the robot's file's or the table's.
  enum class Bits { robot, table };

  // A sensor's wire, by the sensor's name.
  struct Signal {
    std::string name;
    int pin = 0, ground = 0;  // of the terminal block
    int channel = -1;         // of the converter; -1: the table does not say
    bool spare = false;       // a wire without a sensor
  };
  struct Line {
    int pin = 0, common = 0;
    int bit = 0;  // 0 to 15
  };
  // The valves of one chamber.
  struct Valve {
    std::string name;
    std::string of;    // a muscle, or cylinder_up, cylinder_down
    int plumbing = 0;  // the number that its hose has
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

// What cannot be: two wires on one pin, two valves on one bit, two signals on one channel, names
// that lead nowhere, a bit of the robot that no pin carries, a channel that the robot's file has
// otherwise. Empty for a robot without wiring, but for two valves on one bit.
std::vector<Contradiction> contradictions(const Wiring&, const Robot&);

// A valve, its topic in a log and its bit.
struct ValveBit {
  std::string of;
  std::string which;  // "inlet" or "exhaust"
  int bit = 0;        // of its board's ports
  int board = 1;
  std::string topic;  // /valve/<of>/<which>/open, behind /leg/<name> where it is a leg's
};
std::vector<ValveBit> bits_of(const Robot&, const Wiring&);

// One board's ports from one tick until the next entry.
struct PortBytes {
  std::int64_t time_ns = 0;
  std::array<std::uint8_t, board_bits / 8> port{};
};

// The bytes that the edges of these valves wrote in a run, first at time 0 with all valves shut; an
// entry where a byte changes. The valves are those of one board.
std::vector<PortBytes> port_bytes(const signals::Table& table, const std::vector<ValveBit>& bits,
                                  Wiring::Polarity polarity);

}  // namespace sinew::robot
