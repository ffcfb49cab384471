// analysis/warnings.h - events of a run that its figures do not show, found in its log alone.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

class Summary;

// A stretch of time.
struct Span {
  double from = 0, to = 0;  // [s]
};

// An event of a run that no figure shows, and when it happened.
struct Warning {
  std::string text;
  std::vector<Span> spans;  // events less than 0.1 s apart form one span
};

// Returns a warning for each sensor whose readings the converter clipped. A tension of 0 is not
// clipped: the muscle is slack.
std::vector<Warning> clipped_sensors(const signals::Table&, const robot::Robot&);

// Returns the same for a test stand, by the counts alone: its transducers have 12 bits. Zeros
// before the first other reading do not count, because nothing was converted yet, unless all
// readings are zero. A pressure of zero counts is the room's and not clipped.
std::vector<Warning> clipped_transducers(const signals::Table&);

// Warns of rollers whose load became negative, 7.2: the real trolley would have tipped there.
std::vector<Warning> lifted_rollers(const signals::Table&);

// Warns of valves whose duty is 100 % in more than a tenth of all periods: their control law is
// saturated. Fewer periods are left out, because a jump of the plan saturates a few.
std::vector<Warning> saturated_duties(const signals::Table&, const robot::Robot&);

// Warns of samples in which the desired position of a foot was out of reach.
std::vector<Warning> unreachable_targets(const signals::Table&, const robot::Robot&);

// Warns of control laws that took longer than their interrupt may, 5.2.
std::vector<Warning> overruns(const signals::Table&);

// Warns of readings that the low level rejected, and of sensors whose reading did not change while
// their muscles were driven.
std::vector<Warning> implausible_sensors(const signals::Table&, const robot::Robot&);

// Warns of commands that the supervisor rejected, and of ticks that came later than announced.
std::vector<Warning> rejected_commands(const signals::Table&);

// Warns of valves whose pulses are not in the log, as it was made from rows too far apart.
std::vector<Warning> coarse_valves(const signals::Table&);

// Warns of a log that ends before its run did.
std::vector<Warning> cut_logs(const signals::Table&);

// --- A robot that does nothing, or that can go no further ---

// Warns of valves that are open for at most a tenth of the commanded time, as their pulses are
// hardly longer than they take to open. Muscles with the same valve share one warning.
std::vector<Warning> unopened_valves(const signals::Table&, const Machine&);

// Warns of a plan that moved a joint or opened an inlet while no muscle took any air. Adds the
// topics from which this follows to `read`.
std::vector<Warning> unused_air(const signals::Table&, const Machine&,
                                signals::TopicNames* read = nullptr);

// Warns of a trolley that reached the end of its track before its sequence was over.
std::vector<Warning> ended_tracks(const signals::Table&, const Machine&);

// Warns of joints that turned by more than a whole turn, or until a muscle would be shorter than
// its caps or longer than its thread by a tenth, which no tendon allows.
std::vector<Warning> joints_beyond_range(const signals::Table&, const Machine&);

// ---

// Returns all of these but cut_logs(), for which a summary has a key; for a test stand those that
// apply to it.
std::vector<Warning> warnings(const signals::Table&, const Machine&);

// Returns the texts of warnings.
std::vector<std::string> texts(const std::vector<Warning>&);

}  // namespace sinew::analysis
