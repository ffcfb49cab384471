// gas/delay.h - when a solenoid valve really opens and closes, 3.4 and 4.3.
//
// An electrical edge at t moves the shutter at t + opening_delay or t + closing_delay: a
// real-valued instant, never rounded to a tick. An edge that comes before the last one took effect
// cancels it:
//
//   delivered pulse = D - opening_delay + closing_delay   if D > opening_delay, else 0
//   delivered gap   = G - closing_delay + opening_delay   if G > closing_delay, else 0
//
// so effective instants are never reordered, and 50 % at 25 and 50 Hz through the thesis's 4 ms and
// 1 ms are the 42.5 % and 35 % of figure 3-13. Profiles:
//
//   ideal      no delays
//   dead_time  the area jumps at the instant
//   ramp       from the instant on the area moves at 1/opening_ramp, 1/closing_ramp until it is
//   full or
//              zero, or until the opposite instant: nodes where it starts and where it ends
//
// A delay may depend on the pressure difference over the valve at the edge,
//
//   delay(dp) = max(0, delay + slope dp)
//
// and a shutter with a maximum frequency f stays at least 1/(2 f) where it went: a change that is
// due sooner waits until then, and is cancelled like any other if the coil is switched back in the
// meantime. So no pulse or gap is shorter than 1/(2 f), and of a square wave faster than f edges
// are lost (4.3: above 400 Hz for the inlet, 350 Hz for the exhaust at 90 psi). The delays alone do
// the same: with 1.43 ms of closing delay no gap of a 350 Hz wave is seen.
//
// A jammed shutter stays where it is held, whatever its coil says; freed, it goes from there to
// where the coil then says, after that edge's delay.
//
// Valid where the delays do not depend on temperature or how long the coil was off.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "sinew/gas/valve.h"

namespace sinew::gas {

// Those of the valve's drive, at no pressure difference.
constexpr Delays delays(const Valve& valve) {
  if (valve.profile == Valve::Profile::ideal) return {};
  if (valve.drive == Valve::Drive::speed_up) return valve.speed_up;
  return {valve.opening_delay, valve.closing_delay};
}

// delay(dp), dp from the higher side as the valve is built in  [s].
constexpr double delay_at(const Valve& valve, bool open, double pressure_difference) {
  const Delays d = delays(valve);
  const double slope = open ? valve.opening_delay_slope : valve.closing_delay_slope;
  const double delay = (open ? d.opening : d.closing) + slope * pressure_difference;
  return delay > 0 ? delay : 0.0;
}

// Where a valve's shutter stands, and when it will move.
struct Shutter {
  // Shut, command off.
  Shutter() = default;
  explicit Shutter(const Valve& valve) noexcept;

  // The coil's current is switched at t. Edges come in the order of time, none earlier than the
  // last advance; they may come ahead of it, up to `capacity` instants. An unchanged command is no
  // edge.
  void electrical(double t, bool open) noexcept {
    electrical(t, open, open ? opening_delay_ : closing_delay_);
  }

  // The same with this edge's own delay.
  void electrical(double t, bool open, double delay) noexcept;

  // Next instant at which the piece of fraction() in force ends, or +inf.
  double next() const noexcept;

  // Puts all instants <= t in force.
  void advance(double t) noexcept;

  // Open share of the area, 0..1, on the piece in force since the last advance. Between two nodes
  // it is linear; at a node it is the left limit before the advance and the right limit after it.
  double fraction(double t) const noexcept;

  // From t on it stands at `share` and follows no edge; what was to come is forgotten.
  void jam(double t, double share) noexcept;

  // From t on it follows its coil again, from where it was held: if that is not where the coil
  // wants it, it sets off after the delay of an edge at t.
  void free(double t) noexcept { free(t, command_ ? opening_delay_ : closing_delay_); }

  // Sets off after this delay instead. `lifts` false: the coil cannot open it, its command is lost.
  void free(double t, double delay, bool lifts = true) noexcept;

  bool command() const noexcept { return command_; }  // of the coil: true is on
  // Is it held where it stands, by a fault?
  bool jammed() const noexcept { return jammed_; }

  // More instants were waiting than fit: the oldest was taken too early.
  bool overrun() const noexcept { return overrun_; }

  static constexpr std::size_t capacity = 8;

  // Edge and instant count as simultaneous within this, so that rounding does not decide whether a
  // pulse of exactly the opening delay opens  [s].
  static constexpr double simultaneous = 1e-9;

 private:
  struct Piece {
    double start = 0, from = 0, to = 0, duration = 0;

    double at(double t) const noexcept {
      if (!(duration > 0)) return to;
      const double share = (t - start) / duration;
      return from + (to - from) * (share < 0 ? 0 : share > 1 ? 1 : share);
    }
  };
  struct Change {
    double instant = 0;
    bool open = false;
  };

  void begin(const Change& change) noexcept;
  const Change& pending(std::size_t i) const noexcept { return queue_[(head_ + i) % capacity]; }

  double opening_delay_ = 0, closing_delay_ = 0, opening_ramp_ = 0, closing_ramp_ = 0;
  double shortest_ = 0;  // stay [s]

  bool command_ = false;
  bool jammed_ = false;
  bool overrun_ = false;
  Piece piece_;     // in force
  Piece previous_;  // before the last change that took effect
  double changed_ = -std::numeric_limits<double>::infinity();  // when that was
  double moved_ = changed_, moved_before_ = changed_;          // the same, never forgotten

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

inline void Shutter::electrical(double t, bool open, double delay) noexcept {
  if (open == command_) return;
  command_ = open;
  if (jammed_) return;

  // The last change has not happened yet: it never will, and the shutter stays where it is.
  if (count_ > 0 && pending(count_ - 1).instant >= t - simultaneous) {
    --count_;
    return;
  }

  // It happens at this very moment and was put in force already: undone.
  if (count_ == 0 && changed_ >= t - simultaneous) {
    piece_ = previous_;
    changed_ = -std::numeric_limits<double>::infinity();
    moved_ = moved_before_;
    return;
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

// The shutter sets off from where it is.
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
