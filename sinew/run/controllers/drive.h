// run/controllers/drive.h - the controller of a test stand, tick by tick, in the loop of
// run/simulation/loop.h.
//
// At the start of each period it decides how long the valves are open in it (drive_laws.h); the
// last ticks of a period belong to the conversions, one tick each, so that the next period's law
// has the newest readings. It sees counts and ticks and never the stand.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sinew/actuator/bundle.h"
#include "sinew/control/joint/seen.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/drive_laws.h"
#include "sinew/signals/port.h"
#include "sinew/signals/schedule.h"

namespace sinew::run {

// Setpoint of one period.
struct DriveSetpoint {
  double length = 0;  // desired [m]
  double duty = 0;    // of pwm [-]
};

// The stand's high level: setpoints by the schedules of its drive.
class DriveSchedule {
 public:
  // Takes the schedules of the experiment's drive.
  explicit DriveSchedule(const experiment::Experiment& experiment);

  // Returns the setpoint of the period that starts at t.
  template <class Seen>
  DriveSetpoint update(const Seen&, signals::Tick t) noexcept {
    const double at = static_cast<double>(t) * signals::tick_seconds;
    return {length_.at(at), duty_.at(at)};
  }
  // Returns false: a run of the stand ends by its time.
  bool finished() const noexcept { return false; }

 private:
  signals::Schedule length_, duty_;
};

// The values of the stand's controller at the end of a period.
struct DriveSeen {
  control::Phase phase = control::Phase::running;
  DriveSetpoint setpoint;
  DriveShares shares;  // of the period
  signals::Status fault = signals::Status::ok;
  signals::Channel fault_channel;
};

// Opens and shuts the stand's valves by the law of its drive.
class Drive {
 public:
  // `end` is the tick at which the run is over.
  Drive(const experiment::Experiment& experiment, signals::Tick end);

  // Returns which transducer is converted when, what was decided, and what a transducer read.
  const signals::Scan& scan() const noexcept { return scan_; }
  const DriveSeen& seen() const noexcept { return state_.seen; }
  const signals::Reading& reading(std::size_t transducer) const noexcept {
    return reading_[transducer];
  }
  // Returns how many edges of a valve it can decide before the tick `end`.
  std::size_t most_edges(signals::Tick end) const noexcept {
    return 4 * static_cast<std::size_t>(end / scan_.period + 2) + planned_.size();
  }

  // For the loop. A period's command decides its edges.
  void command(const DriveSetpoint& setpoint) noexcept;
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;
  const signals::Conversion* due(signals::Tick t) noexcept;
  void take(const signals::Conversion& c, signals::Reading reading, signals::Tick t) noexcept;
  signals::Tick next_event(signals::Tick t) const noexcept;
  void missed(signals::Tick) noexcept {}
  void shut_down(signals::Tick) noexcept {}

  // Everything that its future depends on, copied like bytes: how many they are, and both ways.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  DriveShares decide(const DriveSetpoint& setpoint) noexcept;
  DriveShares feed_forward(double length) noexcept;
  DriveShares feedback(double length) noexcept;
  double hold(double length) const noexcept;
  void set(std::uint8_t valve, signals::Tick at, bool open) noexcept;
  void pulse(std::uint8_t valve, double share) noexcept;
  // Returns the edges that are decided and not yet given out, ascending.
  std::span<const signals::Edge> waiting() const noexcept;

  experiment::Stand::Drive drive_;
  actuator::Bundle bundle_;
  gas::Valve inlet_, exhaust_;
  gas::Air air_;
  double supply_ = 0;
  bool three_way_ = false;
  robot::Transducer length_sensor_;
  int sensor_ = -1;

  signals::Scan scan_;
  std::vector<signals::Conversion> conversions_;
  std::vector<signals::Edge> planned_;  // single pulses, ascending

  struct State {
    DriveSeen seen;
    signals::Tick period_start = 0;
    bool first = true;
    double assumed_air = 0;                  // feed-forward by doses [kg]
    std::size_t next = 0, pending = 0;       // first edge that waits; edges of this period
    std::array<signals::Edge, 4> of_period;  // ascending
    std::array<bool, 2> open{false, false};  // last commanded
  };
  State state_;
  std::vector<signals::Reading> reading_;  // of each transducer
};

}  // namespace sinew::run
