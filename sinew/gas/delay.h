// gas/delay.h - instants at which a solenoid valve opens and closes, 3.4 and 4.3.
//
// An electrical edge at t moves the shutter at t + opening_delay or t + closing_delay, a real
// number that is never rounded to a tick. If an edge comes before the previous one has taken
// effect, it cancels that one:
//
//   delivered pulse = D - opening_delay + closing_delay   if D > opening_delay, else 0
//   delivered gap   = G - closing_delay + opening_delay   if G > closing_delay, else 0
//
// so effective instants are never reordered, and 50 % at 25 and 50 Hz through the thesis's 4 ms and
// 1 ms are the 42.5 % and 35 % of figure 3-13. Profiles:
//
//   ideal      no delays
//   dead_time  the area jumps at the instant
//   ramp       from the instant on the area moves at 1/opening_ramp, 1/closing_ramp until full or
//              zero, or until the opposite instant: nodes where it starts and where it ends
//
// A delay may depend on the pressure difference over the valve at the edge,
//
//   delay(dp) = max(0, delay + slope dp)
//
// A shutter with a maximum frequency f stays open or shut for at least 1/(2 f). A change that is
// due sooner is postponed, and is cancelled like any other if the coil is switched back in the
// meantime. So no pulse or gap is shorter than 1/(2 f), and a square wave faster than f loses edges
// (4.3: above 400 Hz for the inlet, 350 Hz for the exhaust at 90 psi). The delays alone have the
// same effect: with 1.43 ms of closing delay a 350 Hz wave has no gaps.
//
// A jammed shutter stays at its share, whatever its coil does; when freed, it moves from there to
// its coil's command, after that edge's delay.
//
// Valid if the delays do not depend on temperature or on how long the coil was off.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "sinew/gas/valve.h"

namespace sinew::gas {

// Returns the delays of the valve's drive at zero pressure difference.
constexpr Delays delays(const Valve& valve) {
  if (valve.profile == Valve::Profile::ideal) return {};
  if (valve.drive == Valve::Drive::speed_up) return valve.speed_up;
  return {valve.opening_delay, valve.closing_delay};
}

// The delays of a valve, with their slopes over the pressure difference.
struct DelayLaw {
  Delays at_zero;                               // [s]
  double opening_slope = 0, closing_slope = 0;  // [s/Pa]
};

// Returns the delays of the valve's drive.
constexpr DelayLaw delay_law(const Valve& valve) {
  return {delays(valve), valve.opening_delay_slope, valve.closing_delay_slope};
}

// Return delay(dp); dp is positive from the higher side as the valve is built in [s].
constexpr double delay_at(const DelayLaw& law, bool open, double pressure_difference) {
  const double slope = open ? law.opening_slope : law.closing_slope;
  const double delay =
      (open ? law.at_zero.opening : law.at_zero.closing) + slope * pressure_difference;
  return delay > 0 ? delay : 0.0;
}
constexpr double delay_at(const Valve& valve, bool open, double pressure_difference) {
  return delay_at(delay_law(valve), open, pressure_difference);
}

// Position of a valve's shutter and its pending changes.
struct Shutter {
  // Starts shut, with its command off.
  Shutter() = default;
  explicit Shutter(const Valve& valve) noexcept;

  // Switches the coil's current at t. Edges must come in order of time, none earlier than the last
  // advance(); up to `capacity` instants may be pending. An unchanged command has no effect.
  // Returns whether a change that was already applied at t is undone: fraction(t) differs from then
  // on, although no instant is pending.
  bool electrical(double t, bool open) noexcept {
    return electrical(t, open, open ? opening_delay_ : closing_delay_);
  }

  // Switches with a delay for this edge.
  bool electrical(double t, bool open, double delay) noexcept;

  // Returns the next instant at which the current piece of fraction() ends, or infinity.
  double next() const noexcept;

  // Applies all instants <= t.
  void advance(double t) noexcept;

  // Returns the open share of the area, 0..1, on the piece that is valid since the last advance().
  // It is linear between two nodes; at a node it is the left limit before advance() and the right
  // limit after.
  double fraction(double t) const noexcept;
  // Returns its rate from t on, while the shutter moves gradually [1/s].
  double rate(double t) const noexcept { return piece_.rate(t); }

  // Holds the shutter at `share` from t on: it follows no edge, and pending changes are discarded.
  void jam(double t, double share) noexcept;

  // Lets the shutter follow its coil again from t on. If its position differs from the command, it
  // starts to move after the delay of an edge at t.
  void free(double t) noexcept { free(t, command_ ? opening_delay_ : closing_delay_); }

  // Uses this delay instead. If `lifts` is false, the coil cannot open it and the command is lost.
  void free(double t, double delay, bool lifts = true) noexcept;

  bool command() const noexcept { return command_; }  // coil command: true is on
  // Returns whether a fault holds it.
  bool jammed() const noexcept { return jammed_; }

  // Returns whether more instants were pending than fit, so that the oldest was applied too early.
  bool overrun() const noexcept { return overrun_; }

  static constexpr std::size_t capacity = 8;

  // Edge and instant count as simultaneous within this time, so that rounding does not decide
  // whether a pulse of exactly the opening delay opens the valve [s].
  static constexpr double simultaneous = 1e-9;

 private:
  struct Piece {
    double start = 0, from = 0, to = 0, duration = 0;

    double at(double t) const noexcept {
      if (!(duration > 0)) return to;
      const double share = (t - start) / duration;
      return from + (to - from) * (share < 0 ? 0 : share > 1 ? 1 : share);
    }
    double rate(double t) const noexcept {
      return t >= start && t < start + duration ? (to - from) / duration : 0.0;
    }
  };
  struct Change {
    double instant = 0;
    bool open = false;
  };

  void begin(const Change& change) noexcept;
  const Change& pending(std::size_t i) const noexcept { return queue_[(head_ + i) % capacity]; }

  double opening_delay_ = 0, closing_delay_ = 0, opening_ramp_ = 0, closing_ramp_ = 0;
  double shortest_ = 0;  // minimum time open or shut [s]

  bool command_ = false;
  bool jammed_ = false;
  bool overrun_ = false;
  Piece piece_;     // current
  Piece previous_;  // before the last change that took effect
  double changed_ = -std::numeric_limits<double>::infinity();  // time of that change
  double moved_ = changed_, moved_before_ = changed_;  // times of the last two movements [s]

  std::array<Change, capacity> queue_{};  // ring, instants ascending
  std::size_t head_ = 0, count_ = 0;
};

inline Shutter::Shutter(const Valve& valve) noexcept {
  opening_delay_ = delays(valve).opening;
  closing_delay_ = delays(valve).closing;
  if (valve.max_frequency > 0) shortest_ = 0.5 / valve.max_frequency;

  if (valve.profile != Valve::Profile::ramp) return;
  opening_ramp_ = valve.opening_ramp;
  closing_ramp_ = valve.closing_ramp;
}

inline bool Shutter::electrical(double t, bool open, double delay) noexcept {
  if (open == command_) return false;
  command_ = open;
  if (jammed_) return false;

  // The last change is still pending: it is cancelled, and the shutter keeps its position.
  if (count_ > 0 && pending(count_ - 1).instant >= t - simultaneous) {
    --count_;
    return false;
  }

  // The last change was applied at this instant: it is undone.
  if (count_ == 0 && changed_ >= t - simultaneous) {
    piece_ = previous_;
    changed_ = -std::numeric_limits<double>::infinity();
    moved_ = moved_before_;
    return true;
  }

  if (count_ == capacity) {
    overrun_ = true;
    advance(pending(0).instant);
  }
  double instant = t + delay;
  const double since = count_ > 0 ? pending(count_ - 1).instant : moved_;
  if (instant < since + shortest_) instant = since + shortest_;
  queue_[(head_ + count_) % capacity] = {instant, open};
  ++count_;
  return false;
}

inline void Shutter::jam(double t, double share) noexcept {
  jammed_ = true;
  count_ = 0;
  moved_ = t;
  changed_ = -std::numeric_limits<double>::infinity();  // an edge at t undoes nothing
  piece_ = {.start = t, .from = share, .to = share};
}

inline void Shutter::free(double t, double delay, bool lifts) noexcept {
  if (!jammed_) return;
  jammed_ = false;
  command_ = command_ && lifts;
  if (piece_.to != (command_ ? 1.0 : 0.0)) {
    const double earliest = moved_ + shortest_, instant = t + delay;
    queue_[head_] = {instant < earliest ? earliest : instant, command_};
    count_ = 1;
  }
}

inline double Shutter::next() const noexcept {
  const double ramp_end = piece_.duration > 0 ? piece_.start + piece_.duration
                                              : std::numeric_limits<double>::infinity();
  return count_ > 0 && pending(0).instant < ramp_end ? pending(0).instant : ramp_end;
}

inline void Shutter::advance(double t) noexcept {
  while (count_ > 0 && pending(0).instant <= t) {
    begin(pending(0));
    head_ = (head_ + 1) % capacity;
    --count_;
  }
  if (piece_.duration > 0 && piece_.start + piece_.duration <= t) {
    piece_ = {.start = piece_.start + piece_.duration, .from = piece_.to, .to = piece_.to};
  }
}

inline double Shutter::fraction(double t) const noexcept { return piece_.at(t); }

// Starts a movement from the current position.
inline void Shutter::begin(const Change& change) noexcept {
  previous_ = piece_;
  changed_ = change.instant;
  moved_before_ = moved_;
  moved_ = change.instant;

  const double from = piece_.at(change.instant);
  const double to = change.open ? 1.0 : 0.0;
  const double way = change.open ? to - from : from - to;
  const double ramp = change.open ? opening_ramp_ : closing_ramp_;
  piece_ = {.start = change.instant, .from = from, .to = to, .duration = way * ramp};
}

}  // namespace sinew::gas
