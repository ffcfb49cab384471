// control/supervise/output_stage.h - the last thing before the valves: which of them are open, as
// one word, whatever was asked for.
//
// It knows valves, not laws. An inlet never opens while its muscle's exhaust is open or asked to
// be, whoever made the mistake; the chambers of an air cylinder may be open to both sides, for a
// balance of pressures (appendix B). A valve that has just shut stays shut for its refractory time.
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

// Bit i stands for the board's valve i: 1 is open, air flows through it.
using OpenMask = std::uint32_t;

// The coils that are to have current so that these valves are open: the one place where polarity is
// known. An inverted valve is shut by its coil; a driver that is active low has 0 for current.
constexpr std::uint32_t drive_word(OpenMask open, OpenMask inverted, bool active_low) noexcept {
  const std::uint32_t current = open ^ inverted;
  return active_low ? ~current : current;
}

// Without any current: after a reset, without power, in a dump.
constexpr std::uint32_t rest_word(bool active_low) noexcept { return active_low ? ~0u : 0u; }

class OutputStage {
 public:
  // All valves shut. A machine's valves are below max_valves (safety_problem).
  OutputStage() noexcept = default;
  OutputStage(const JointControllerConfig& machine, std::uint32_t refractory) noexcept;

  // As the controller says; closing edges of a tick come first.
  void drive(const signals::Edge& edge) noexcept;
  void shut_all() noexcept;
  // Inlets shut and exhausts open, at once.
  void vent(signals::Tick now) noexcept;

  // What is open from now on; to be asked once a tick.
  OpenMask at(signals::Tick now) noexcept;

  // Returns which valves their coils shut; and which are exhausts.
  OpenMask inverted() const noexcept { return inverted_; }
  OpenMask exhausts() const noexcept { return exhausts_; }
  // Set point of a regulator, by its valve.
  std::uint16_t level(std::size_t valve) const noexcept { return level_[valve]; }

  std::uint32_t interlocks() const noexcept { return interlocks_; }      // inlets kept shut
  std::uint32_t refractories() const noexcept { return refractories_; }  // valves kept shut

 private:
  struct Pair {
    OpenMask inlet = 0, exhaust = 0;
  };

  std::array<Pair, 2 * max_joints> pair_{};  // of which never both are open
  std::size_t pairs_ = 0;
  OpenMask inverted_ = 0, exhausts_ = 0;
  std::uint32_t refractory_ = 0;  // [ticks]

  OpenMask asked_ = 0, worked_off_ = 0, open_ = 0;
  OpenMask kept_ = 0, locked_ = 0;  // of those asked for, as of the last tick
  std::array<signals::Tick, max_valves> shut_at_{};
  OpenMask has_shut_ = 0;  // that have been open
  std::array<std::uint16_t, max_valves> level_{};
  std::uint32_t interlocks_ = 0, refractories_ = 0;
};

}  // namespace sinew::control
