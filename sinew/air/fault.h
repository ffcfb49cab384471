// air/fault.h - faults of a machine's air and their times: inputs of the air, as its valves are.
//
//   stuck_open, stuck_shut  the valve stays there, whatever its coil does; a 3-way valve joins its
//                           muscle to the supply or to the room
//   seat_leak               the valve does not seal: `share` of its area stays open, and `leak`
//                           bypasses it, open or not
//   hole                    the muscle loses air to the room, in addition to its own leak
//   blocked                 nothing passes the hose between the muscle and its valves
//   supply                  the line to the inlets has `pressure`; a tank is cut off from it
//
// A fault begins and ends at instants that are nodes, like the effective edges of valves: real
// numbers, never rounded to ticks. If one fault ends at the instant at which another begins, the
// end is applied first. The list of faults is part of the model; the set of active ones is state.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "sinew/gas/leak.h"

namespace sinew::air {

// One fault with its begin and end.
struct AirFault {
  // Names the kind: a valve is stuck, either way, or leaks at its seat; a muscle has a hole; a hose
  // is blocked; the supply has another pressure.
  enum class What { stuck_open, stuck_shut, seat_leak, hole, blocked, supply };

  What what = What::stuck_open;
  int of = 0;        // valve as numbered by AirNetwork, or muscle; 0 for the supply
  double begin = 0;  // [s]
  double end = std::numeric_limits<double>::infinity();  // [s]
  double share = 0;                                      // seat_leak: of the valve's area [-]
  gas::Leak leak;                                        // seat_leak, hole
  double pressure = 0;                                   // supply: absolute [Pa]

  // Returns whether the fault is of a valve, else of a muscle, its hose, or the supply.
  bool of_valve() const { return what <= What::seat_leak; }
};

// Returns whether the fault changes the open share of a valve's area and nothing else.
inline bool is_share_of_valve(const AirFault& f) {
  return f.of_valve() && !(f.leak.area > 0) && !(f.leak.conductance > 0);
}

// Returns the open area share of a valve that does not seal: its shutter covers the rest [-].
constexpr double open_share(double seat, double shutter) { return seat + (1.0 - seat) * shutter; }

// The active faults: the state of a schedule.
struct ActingFaults {
  std::uint64_t acting = 0;  // a bit for each fault
  std::int32_t passed = 0;   // number of instants passed in the schedule

  // Returns whether any fault is active.
  bool any() const { return acting != 0; }
};

// All faults of a machine; determines which are active at an instant.
class FaultSchedule {
 public:
  static constexpr std::size_t capacity = 64;

  FaultSchedule() = default;

  // Throws std::invalid_argument for more faults than `capacity` and for a fault that ends before
  // it begins.
  explicit FaultSchedule(std::span<const AirFault> faults) : faults_(faults.begin(), faults.end()) {
    if (faults_.size() > capacity) throw std::invalid_argument("at most 64 faults of the air");
    for (std::size_t i = 0; i < faults_.size(); ++i) {
      const AirFault& f = faults_[i];
      if (!(f.end > f.begin)) throw std::invalid_argument("a fault that ends before it begins");
      instants_.push_back({f.begin, i, true});
      if (f.end < std::numeric_limits<double>::infinity()) instants_.push_back({f.end, i, false});
    }
    std::ranges::stable_sort(instants_, [](const Instant& a, const Instant& b) {
      return a.at < b.at || (a.at == b.at && !a.begins && b.begins);
    });
  }

  bool empty() const noexcept { return faults_.empty(); }
  // Returns all faults in the given order.
  const std::vector<AirFault>& all() const noexcept { return faults_; }

  // Returns the next instant at which a fault begins or ends, or infinity [s].
  double next(const ActingFaults& now) const noexcept {
    const auto i = static_cast<std::size_t>(now.passed);
    return i < instants_.size() ? instants_[i].at : std::numeric_limits<double>::infinity();
  }

  // Passes all instants up to t in order and calls report(fault, begins) for each.
  template <class Report>
  void advance(double t, ActingFaults& now, Report report) const noexcept {
    while (next(now) <= t) {
      const Instant& instant = instants_[static_cast<std::size_t>(now.passed++)];
      const std::uint64_t bit = std::uint64_t{1} << instant.fault;
      now.acting = instant.begins ? now.acting | bit : now.acting & ~bit;
      report(faults_[instant.fault], instant.begins);
    }
  }

  // Calls visit(number, fault) for each active fault in order.
  template <class Visit>
  void each(const ActingFaults& now, Visit visit) const noexcept {
    for (std::size_t i = 0; i < faults_.size() && now.acting >> i != 0; ++i)
      if ((now.acting >> i & 1) != 0) visit(i, faults_[i]);
  }

  // Returns the share of its area that a valve with a leaking seat leaves open, else 0 [-].
  double seat(int valve, const ActingFaults& now) const noexcept {
    double share = 0;
    if (now.any())
      each(now, [&](std::size_t, const AirFault& f) {
        if (f.what == AirFault::What::seat_leak && f.of == valve) share = f.share;
      });
    return share;
  }

 private:
  struct Instant {
    double at = 0;  // [s]
    std::size_t fault = 0;
    bool begins = false;
  };

  std::vector<AirFault> faults_;
  std::vector<Instant> instants_;
};

}  // namespace sinew::air
