// report/page/stand.h - drawing of the test stand: an element that hangs from a beam, its load and
// its air supply. The page only places it by `length` from the beam downwards.
//
// It uses true channels if the log has them, else the sensors' readings; a log without a length has
// no drawing.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/report/page/plot.h"
#include "sinew/signals/table.h"

namespace sinew::report {

struct Stand {
  enum class Load { hanging, driven, clamped };  // clamped: driven, at one length
  // Source of the element's air.
  enum class Air {
    sealed,
    regulated,
    valves,
    three_way
  };  // three_way: one valve joins to supply or room

  std::string element;  // name of the element in the topics
  int count = 1;        // parallel actuators
  double turns = 0;     // turns of the braid's threads [-]; 0: unknown
  double bore = 0, rod = 0,
         stroke = 0;  // dimensions of an air cylinder used instead of a muscle; 0: a muscle [m]
  Load load = Load::hanging;
  Air air = Air::sealed;
  double shortest = 0, longest = 0;      // limits of the element's length; 0: unknown [m]
  double least = 0, most = 0;            // lengths of the run [m]
  double heaviest = 0, weight_step = 0;  // greatest load, its smallest change or 0 [N]
  Channel length, diameter, pressure;    // [m], [m], absolute [Pa]
  Channel desired;                       // desired length [m]
  Channel tension, weight;               // tension on the load; weight and external force [N]
  Channel inlet, exhaust;                // valve edges
  std::string drawn_from;

  bool empty() const { return length.is_empty(); }
};

// Returns the drawing of a stand. Series that are drawn but not logged are added to `drawn`:
// /draw/….
Stand stand(const Channels& channels, const analysis::Machine& machine, signals::Table& drawn);

// Returns the charts of a stand: loops of tension, pressure and length, or the settled values of a
// sweep.
std::vector<Plot> stand_charts(const Channels& channels, const Stand& stand);

}  // namespace sinew::report
