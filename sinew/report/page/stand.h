// report/page/stand.h - the test stand as a drawing: an element that hangs from a beam, what pulls
// it and what feeds it. The page places it by `length` from the beam downwards and knows no more.
//
// True channels where the log has them, else what the sensors read; a log without a length has no
// drawing.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/report/page/channels.h"
#include "sinew/report/page/charts.h"
#include "sinew/signals/table.h"

namespace sinew::report {

struct Stand {
  enum class Load { hanging, driven, clamped };  // clamped: driven, at one length
  // Where the element's air comes from.
  enum class Air {
    sealed,
    regulated,
    valves,
    three_way
  };  // three_way: one valve joins to supply or room

  std::string element;  // its name in the topics
  int count = 1;        // actuators side by side
  double turns = 0;     // of the braid's threads [-]; 0: not known
  double bore = 0, rod = 0,
         stroke = 0;  // of an air cylinder in the muscle's place; 0: a muscle [m]
  Load load = Load::hanging;
  Air air = Air::sealed;
  double shortest = 0, longest = 0;      // what the element allows; 0: not known [m]
  double least = 0, most = 0;            // lengths of the run [m]
  double heaviest = 0, weight_step = 0;  // greatest load, and what it changes by; 0: never [N]
  Channel length, diameter, pressure;    // [m], [m], absolute [Pa]
  Channel desired;                       // length [m]
  Channel tension, weight;               // on the load; what hangs, with its other forces [N]
  Channel inlet, exhaust;                // valve edges
  std::string drawn_from;

  bool empty() const { return length.none(); }
};

// Returns the drawing of a stand. `drawn` receives the series that are drawn and not logged:
// /draw/….
Stand stand(const Channels& channels, const analysis::Machine& machine, signals::Table& drawn);

// One quantity against another: loops of tension, pressure and length, or what a sweep settled at.
std::vector<Chart> stand_charts(const Channels& channels, const Stand& stand);

}  // namespace sinew::report
