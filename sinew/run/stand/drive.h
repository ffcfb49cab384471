// run/stand/drive.h - the stand's controller, tick by tick, in the loop of run/simulation/loop.h.
//
// At the start of each period it decides how long the valves are open in it (drive_laws.h); the
// last ticks of a period belong to the conversions, one tick each, so that the next period's law
// knows the newest readings. It sees counts and ticks and never the stand.
#pragma once

#include <span>
#include <vector>

#include "sinew/actuator/bundle.h"
#include "sinew/control/joint/seen.h"
#include "sinew/experiment/rig/rig.h"
#include "sinew/mechanism/driven/schedule.h"
#include "sinew/run/stand/drive_laws.h"
#include "sinew/signals/port.h"

namespace sinew::rig {

// What the loop's high level says for a period.
struct Wish {
  double length = 0;  // desired [m]
  double duty = 0;    // of pwm [-]
};

// Of schedules, at the start of each period.
class Wishes {
 public:
  // Takes the schedules of the experiment's drive.
  explicit Wishes(const Experiment& experiment);

  // Returns what is wished for the period that starts at t.
  template <class Seen>
  Wish update(const Seen&, signals::Tick t) noexcept {
    const double at = static_cast<double>(t) * signals::tick_seconds;
    return {length_.at(at), duty_.at(at)};
  }
  // Never: a run of the stand ends by its time.
  bool finished() const noexcept { return false; }

 private:
  plant::Schedule length_, duty_;
};

// Holds what the stand's controller knows at the end of a period.
struct DriveSeen {
  control::Phase phase = control::Phase::running;
  Wish wish;
  Shares shares;                          // of the period
  std::vector<signals::Reading> reading;  // of each transducer
  signals::Status fault = signals::Status::ok;
};

// Opens and shuts the stand's valves by the law of its drive.
class Controller {
 public:
  // `end` is the tick at which the run is over.
  Controller(const Experiment& experiment, signals::Tick end);

  // Returns which transducer is converted when; and what was read of them.
  const signals::Scan& scan() const noexcept { return scan_; }
  const DriveSeen& seen() const noexcept { return seen_; }

  // The loop's side. A period's command decides its edges.
  void command(const Wish& wish) noexcept;
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;
  const signals::Conversion* due(signals::Tick t) noexcept;
  void take(const signals::Conversion& c, signals::Reading reading, signals::Tick t) noexcept;
  signals::Tick next_event(signals::Tick t) const noexcept;
  void missed(signals::Tick) noexcept {}
  void shut_down(signals::Tick) noexcept {}

 private:
  Shares decide(const Wish& wish) noexcept;
  Shares feed_forward(double length) noexcept;
  Shares feedback(double length) noexcept;
  double hold(double length) const noexcept;
  void set(std::uint8_t valve, signals::Tick at, bool open) noexcept;
  void pulse(std::uint8_t valve, double share) noexcept;

  Drive drive_;
  actuator::Bundle bundle_;
  gas::Valve inlet_, exhaust_;
  gas::Air air_;
  double supply_ = 0;
  bool three_way_ = false;
  plant::Transducer length_sensor_;
  int sensor_ = -1;

  signals::Scan scan_;
  std::vector<signals::Conversion> conversions_;
  DriveSeen seen_;
  signals::Tick period_start_ = 0;
  bool first_ = true;
  double believed_air_ = 0;  // feed-forward by doses [kg]

  std::vector<signals::Edge> planned_;  // single pulses, ascending
  std::size_t next_planned_ = 0;
  std::vector<signals::Edge> pending_;  // of this period, ascending
  std::size_t next_pending_ = 0;
  bool open_[2] = {false, false};  // last told
};

}  // namespace sinew::rig
