// run/controllers/drive.h - the high level of a test stand: the law of its drive.
//
// At the start of each period it decides how long the valves are open in it (drive_laws.h), from
// the setpoints of its schedules and the newest readings. The stand's board opens and shuts them
// (control/setup/boards.h). It has access to counts and ticks only, never to the stand.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sinew/actuator/bundle.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/run/controllers/drive_laws.h"
#include "sinew/signals/port.h"
#include "sinew/signals/schedule.h"

namespace sinew::run {

// Setpoint of one period.
struct DriveSetpoint {
  double length = 0;  // desired [m]
  double duty = 0;    // used by pwm [-]
};

// Decides when the stand's valves open and shut.
class Drive {
 public:
  // Takes law and schedules of the experiment's drive.
  explicit Drive(const experiment::Experiment& experiment);

  // Returns the openings of the period that starts at t.
  const MachineCommand& update(const MachineState& state, signals::Tick t) noexcept;
  // Returns false, since a run of a stand ends by its duration.
  bool finished() const noexcept { return false; }

  // Return the setpoint of the period, and the shares of the period that were decided.
  const DriveSetpoint& setpoint() const noexcept { return state_.setpoint; }
  const DriveShares& shares() const noexcept { return state_.shares; }
  // Returns the largest number of edges that it can decide for a valve before the tick `end`.
  std::size_t most_edges(signals::Tick end) const noexcept {
    return 4 * static_cast<std::size_t>(end / period_ + 2) + planned_.size();
  }

  // The complete state, copied as bytes.
  struct State {
    DriveSetpoint setpoint;
    DriveShares shares;
    bool first = true;                       // nothing has been measured yet
    double assumed_air = 0;                  // integrated by feed-forward with doses [kg]
    std::size_t next = 0;                    // index of the first planned edge of later periods
    std::array<bool, 2> open{false, false};  // state of the valves after the earlier planned edges
  };
  const State& state() const noexcept { return state_; }
  void restore(const State& state) noexcept { state_ = state; }

 private:
  DriveShares decide(const MachineState& state) noexcept;
  DriveShares feed_forward(double length) noexcept;
  DriveShares feedback(double length, const MachineState& state) const noexcept;
  double hold(double length) const noexcept;
  control::Opening opening(double share) const noexcept;
  void plan_openings(signals::Tick t) noexcept;

  experiment::Stand::Drive drive_;
  signals::Schedule length_, duty_;
  actuator::Bundle bundle_;
  gas::Valve inlet_, exhaust_;
  gas::Air air_;
  double supply_ = 0;
  bool three_way_ = false;
  robot::Transducer length_sensor_;
  std::size_t sensor_ = 0;
  signals::Tick period_ = 0;
  std::vector<signals::Edge> planned_;  // single pulses, ascending

  State state_;
  MachineCommand command_;
};

}  // namespace sinew::run
