// analysis/warnings.h - what went on in a run that its figures do not show, from its log alone.
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

// Holds what went on in a run that no figure shows, and when.
struct Warning {
  std::string text;
  std::vector<Span> spans;  // when; those less than 0.1 s apart are one
};

// Readings that the converter cut off. A slack muscle's 0 is none.
std::vector<Warning> clipped_sensors(const signals::Table&, const robot::Robot&);

// The same of the test stand, by the counts alone: its transducers have 12 bits. Zeros before the
// first other reading are none, unless there is no other: nothing was converted yet. A pressure's
// zero is the room's.
std::vector<Warning> clipped_transducers(const signals::Table&);

// Rollers that the leg lifted off the track, 7.2: from there on the trolley would have tipped.
std::vector<Warning> lifted_rollers(const signals::Table&);

// Valves that were told to stay open for whole periods, in more than a tenth of all: their law asks
// for more than there is. A jump of the plan does so for a few periods; that is none.
std::vector<Warning> saturated_duties(const signals::Table&, const robot::Robot&);

// Times at which a foot was asked to where it cannot go.
std::vector<Warning> unreachable_targets(const signals::Table&, const robot::Robot&);

// Laws that took longer than their interrupt may, 5.2.
std::vector<Warning> overruns(const signals::Table&);

// Readings that the low level did not believe, or that repeated themselves while they were driven.
std::vector<Warning> disbelieved_sensors(const signals::Table&, const robot::Robot&);

// Commands that the supervisor did not follow, and ticks that came later than it was told.
std::vector<Warning> rejected_commands(const signals::Table&);

// A log that ends before its run did.
std::vector<Warning> cut_logs(const signals::Table&);

// --- A robot that does nothing, or that can go no further ---

// Valves that let through less than a tenth of what they are commanded, as their pulses are shorter
// than they take to open: one warning for the muscles with the same valve.
std::vector<Warning> unopened_valves(const signals::Table&, const Machine&);

// Plans that moved a joint, or opened an inlet, while no muscle took any air.
std::vector<Warning> unused_air(const signals::Table&, const Machine&);

// A trolley that reached the end of its track before its sequence was over.
std::vector<Warning> ended_tracks(const signals::Table&, const Machine&);

// Joints that turned by more than a whole turn, or until a muscle would be shorter than its caps or
// longer than its thread by a tenth: no cord runs so far.
std::vector<Warning> overturned_joints(const signals::Table&, const Machine&);

// ---

// All of these but cut_logs(), of which a summary has a key; of a test stand those that apply to
// it.
std::vector<Warning> warnings(const signals::Table&, const Machine&);

// Returns their words alone.
std::vector<std::string> texts(const std::vector<Warning>&);

}  // namespace sinew::analysis
