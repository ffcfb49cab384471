// run/controllers/drive.h - the high level of a test stand: the law of its drive.
//
// At the start of each period it decides how long the valves are open in it, from the setpoints of
// its schedules and the newest readings. The stand's board opens and shuts them
// (control/setup/boards.h). It has access to counts and ticks only, never to the stand.
#pragma once

#include <array>
#include <vector>

#include "sinew/actuator/bundle.h"
#include "sinew/experiment/experiment.h"
#include "sinew/gas/orifice.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/signals/port.h"
#include "sinew/signals/schedule.h"

namespace sinew::run {

// --- opening time of a valve of the stand in one period ---
//
//   steady duty   d = m'_out/(m'_in + m'_out) at the pressure P          no mean flow, 3-way valve
//   commanded     d + (opening delay - closing delay)/T                  figure 3-13, backwards
//   holding P     F(L, P) = load                                         [31], static
//   dosing        t = (m(L', P') - m(L, P))/m'                           two 2-way valves
//   on-off        e > dead band: all of the period; within: none
//   proportional  d = d_hold + K e, in 0 ... 1; two 2-way valves: |K e|, none within the dead band
//
//   e = L - desired [m]: a muscle that is too long needs air
//
// All functions are pure. The delivered pulse is calculated in gas/pulse.h.

// Share of the period for each valve; a 3-way valve uses `inlet` only.
struct DriveShares {
  double inlet = 0, exhaust = 0;
};

// Limits a share to its range.
constexpr double within_0_and_1(double x) { return x < 0 ? 0.0 : x > 1 ? 1.0 : x; }

// Returns the duty of a valve between supply and room that keeps the mean pressure [-].
inline double steady_duty(const gas::Flow& in, const gas::Flow& out, const gas::Air& air,
                          double supply, double pressure) {
  const double filling = gas::mass_flow(in, air, supply, pressure);
  const double venting = gas::mass_flow(out, air, pressure, air.atmosphere);
  if (!(filling > 0)) return 1.0;
  return within_0_and_1(venting / (filling + venting));
}

// Returns the commanded duty that delivers it; 0 and 1 stay unchanged.
constexpr double commanded_duty(double delivered, double opening_delay, double closing_delay,
                                double period) {
  if (delivered <= 0 || delivered >= 1) return within_0_and_1(delivered);
  return within_0_and_1(delivered + (opening_delay - closing_delay) / period);
}

// Returns the pressure at which the bundle holds a load at a length, `most` at the highest [Pa],
// absolute.
inline double holding_pressure(const actuator::Bundle& bundle, double length, double load,
                               double atmosphere, double most) {
  double low = atmosphere, high = most;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    const double f = actuator::clamped_tension(bundle, length, 0, middle - atmosphere, atmosphere);
    (f < load ? low : high) = middle;
  }
  return high;
}

// Returns the mass of air in the bundle [kg].
inline double air_at(const actuator::Bundle& bundle, const gas::Air& air, double length,
                     double pressure) {
  return gas::density(air, pressure) * actuator::volume(bundle, length);
}

// Return the shares for an error of the length [m]; `before` is the last share of a 3-way valve,
// `hold` the share with which it keeps the length.
constexpr DriveShares on_off(double error, double dead_band, bool three_way, double before) {
  const bool in = error > dead_band, out = error < -dead_band;
  if (three_way) return {in ? 1.0 : out ? 0.0 : before, 0.0};
  return {in ? 1.0 : 0.0, out ? 1.0 : 0.0};
}
constexpr DriveShares proportional(double error, double gain, double dead_band, bool three_way,
                                   double hold) {
  const double wanted = gain * error;
  if (three_way) return {within_0_and_1(hold + wanted), 0.0};
  if (error <= dead_band && error >= -dead_band) return {};
  return {within_0_and_1(wanted), within_0_and_1(-wanted)};
}

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
