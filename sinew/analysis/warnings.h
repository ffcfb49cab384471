// analysis/warnings.h - what went on in a run that its figures do not show, from its log alone.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/machine.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

struct Span {
  double from = 0, to = 0;  // [s]
};

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

// Valves that were told to stay open for a whole period: their law asked for more than there is.
std::vector<Warning> saturated_duties(const signals::Table&, const robot::Robot&);

// Times at which the foot was asked to where it cannot go.
std::vector<Warning> unreachable_targets(const signals::Table&);

// Laws that took longer than their interrupt may, 5.2.
std::vector<Warning> overruns(const signals::Table&);

// Readings that the low level did not believe, or that repeated themselves while they were driven.
std::vector<Warning> disbelieved_sensors(const signals::Table&, const robot::Robot&);

// A log that ends before its run did.
std::vector<Warning> cut_logs(const signals::Table&);

// All of these.
std::vector<Warning> warnings(const signals::Table&, const Machine&);

}  // namespace sinew::analysis
