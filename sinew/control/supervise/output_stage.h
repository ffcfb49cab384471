// control/supervise/output_stage.h - final stage before the valves: the set of open valves as one
// word, with safety rules for all requests.
//
// It handles valves, not laws. An inlet never opens while its muscle's exhaust is open or should
// open, even if the request is wrong; the chambers of an air cylinder may be open to both sides,
// for a balance of pressures (appendix B). A valve that has just shut stays shut for its refractory
// time.
//
// Embedded core.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/config.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::control {

inline constexpr std::size_t max_valves = 4 * max_joints;

// Bit i is 1 if the board's valve i is open, so that air flows through it.
using OpenMask = std::uint32_t;

// Returns the level of each output so that these valves are open. Polarity is handled here only: an
// inverted valve is shut by its coil's current; an active-low driver gives current at level 0.
constexpr std::uint32_t drive_word(OpenMask open, OpenMask inverted, bool active_low) noexcept {
  const std::uint32_t current = open ^ inverted;
  return active_low ? ~current : current;
}

// Returns the levels without any current: after a reset, without power, in a dump.
constexpr std::uint32_t rest_word(bool active_low) noexcept { return active_low ? ~0u : 0u; }

class OutputStage {
 public:
  // All valves are shut. A machine's valves must be below max_valves (safety_problem).
  OutputStage() noexcept = default;
  OutputStage(const JointControllerConfig& machine, std::uint32_t refractory) noexcept;

  // Takes an edge of the controller; closing edges of a tick come first.
  void drive(const signals::Edge& edge) noexcept;
  void shut_all() noexcept;
  // Shuts inlets and opens exhausts at once.
  void vent(signals::Tick now) noexcept;

  // Returns the valves that are open from now on; to be called once per tick.
  OpenMask at(signals::Tick now) noexcept;

  // Return the valves that their coils shut, and the valves that are exhausts.
  OpenMask inverted() const noexcept { return inverted_; }
  OpenMask exhausts() const noexcept { return exhausts_; }
  // Returns the setpoint of a regulator, by its valve.
  std::uint16_t level(std::size_t valve) const noexcept { return level_[valve]; }

  std::uint32_t interlocks() const noexcept { return interlocks_; }      // inlets kept shut
  std::uint32_t refractories() const noexcept { return refractories_; }  // valves kept shut

 private:
  struct Pair {
    OpenMask inlet = 0, exhaust = 0;
  };

  std::array<Pair, 2 * max_joints> pair_{};  // inlets and exhausts that are never open together
  std::size_t pairs_ = 0;
  OpenMask inverted_ = 0, exhausts_ = 0;
  std::uint32_t refractory_ = 0;  // [ticks]

  OpenMask requested_ = 0, processed_ = 0, open_ = 0;
  OpenMask kept_ = 0, locked_ = 0;  // requested valves that were kept shut in the last tick
  std::array<signals::Tick, max_valves> shut_at_{};
  OpenMask has_shut_ = 0;  // valves that have been open
  std::array<std::uint16_t, max_valves> level_{};
  std::uint32_t interlocks_ = 0, refractories_ = 0;
};

}  // namespace sinew::control
