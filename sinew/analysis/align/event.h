// analysis/align/event.h - the instant at which something happens in a recording: a channel crosses
// a level, or begins to move.
//
//   crossing   first t with u(t) = level, u below before it and above after it (">"; "<":
//   reversed),
//              on the straight line between the two samples around
//   motion     first t with |u(t) - u_0| = band that is followed by two more samples beyond it;
//              u_0 is the median of the first five samples
//   band       max(5 % of range, 8 sigma), the greater one of both recordings (signal.h)
//   se(t)      max(sigma/|slope there|, step/sqrt(12)): how well a recording knows the instant
//
// Without a wish the channel is taken whose instants are the surest: least se_a^2 + se_b^2.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "sinew/analysis/align/signal.h"

namespace sinew::analysis {

// An instant and how sure it is; both in s.
struct Instant {
  double time = 0, uncertainty = 0;
};

// The first crossing of a level; nothing where there is none.
std::optional<Instant> first_crossing(const Signal& signal, double level, bool upwards);

// The first motion out of a band about where the signal begins; nothing where it stays, or where it
// is on its way from the first samples on.
std::optional<Instant> first_motion(const Signal& signal, double band);

// A channel crosses a level, as people write it: "/joint/elbow/angle > 10 deg".
struct Event {
  std::string channel;
  bool upwards = true;
  std::string level;  // with its unit, "10 deg"
};
// Throws config::Error where the text is none.
Event parse_event(const std::string& text);

// One event in two recordings.
struct EventPair {
  Instant first, other;
  std::string words;  // "/joint/elbow/angle moves by 0.05 rad"
  // Returns by how much later the other one has it, and how sure that is  [s].
  double shift() const { return other.time - first.time; }
  double uncertainty() const;
};

// A channel of two recordings, by name and SI unit.
struct Pair {
  Signal first, other;
  std::string unit;
};

// The surest first motion; nothing where no channel stands still and then moves in both.
std::optional<EventPair> surest_motion(std::span<const Pair> pairs);

}  // namespace sinew::analysis
