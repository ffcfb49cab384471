// design/valve.h - valve for a muscle, 3.3 and 4.3: the flow that filling and venting in a time
// need, the delays that pulses allow, and which valves of a list have both.
//
//   C = C_1 t(C_1)/t_wanted        t is inverse in C for every law of flow: orifice.h
//   t_o < d_min/f                  the shortest pulse opens the valve
//   t_c < (1 - d_max)/f            the shortest gap shuts it
//   D = n R T m'(P)/V (d_min/f - t_o + t_c)          pressure step of the shortest pulse [Pa]
//
//   t       time of stroke.h with an open valve [s]        f      frequency of the pulses [Hz]
//   d       duty, from d_min to d_max [-]                  n      1 isothermal, 1.4 adiabatic
//   t_o, t_c  opening and closing delay, delay.h [s]       V      volume of muscle and hose [m3]
//
// All results are bounds: between the two limits of heat, the bounds of the volume, the order of
// the changes of volume and pressure, and the published bounds of a valve's values. Walls with a
// time constant of their own may be some percent slower than the slower limit (fill.h). The hose
// adds volume and no resistance. The critical ratio of a listed valve is the file's, with its
// range.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/stroke.h"
#include "sinew/gas/valve.h"

namespace sinew::design {

// Interval that contains a number.
struct Bounds {
  double low = 0, high = 0;
};

// Change of a muscle's air from one absolute pressure to another [Pa], in a time.
struct AirChange {
  double from = 0, to = 0;
  Bounds volume_from, volume_to;  // air of muscle and hose at both ends [m3]
  double time = 0;                // [s]; 0: any
};

// Task of a valve.
struct ValveTask {
  gas::Air air;
  double supply = 0;                    // absolute [Pa]
  std::optional<AirChange> fill, vent;  // changes of the air: from the supply, into the room
  double critical_ratio = 0.3;          // b of the valve that is looked for [-]
  double frequency = 0;                 // frequency of the pulses [Hz]; 0: without pulses
  Bounds duty = {0.1, 0.9};             // smallest and greatest duty that shall have an effect
  double step = 0;                      // largest pressure step of one pulse [Pa]; 0: any
};

// A valve as published: its values, their bounds, and which of them are not published.
struct PublishedValve {
  gas::Valve valve;
  Bounds flow = {1, 1};                    // bounds of the flow, over that of `valve` [-]
  bool is_flow_published = true;           // false: the flow of `valve` is a guess
  std::optional<Bounds> critical_ratio;    // b [-]; empty: that of `valve`
  std::optional<Bounds> fails_above;       // between them it is unknown [Pa]; empty: as in `valve`
  std::optional<Bounds> opening, closing;  // delays of its drive [s]; empty: not published
};

// Requirements that follow from the task; NaN where it has none.
struct ValveNeed {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  Bounds fill = {none, none}, vent = {none, none};  // sonic conductance, at least [m3/(s Pa)]
  double at_most = none;        // sonic conductance for the step, for equal delays [m3/(s Pa)]
  double opening_below = none;  // delays that the pulses allow [s]
  double closing_below = none;
  double pressure_difference = 0;  // largest one over the valve [Pa]
};

// Names how a valve meets the task: for all values within the bounds; for some; unknown, since a
// number is not published; not.
enum class Verdict { suffices, may_suffice, unknown, misses };

// A valve of the list, and what it does.
struct ValveChoice {
  std::string name;
  gas::Valve::Kind kind = gas::Valve::Kind::two_way;
  // C with the same choked flow, a guess if it is not published; and its bounds, then NaN
  // [m3/(s Pa)].
  double sonic_conductance = 0;
  Bounds conductance;
  Bounds fill = {ValveNeed::none, ValveNeed::none};  // times with the opening delay [s]
  Bounds vent = fill;
  Bounds step = fill;                      // pressure step of the shortest pulse [Pa]
  std::optional<Bounds> opening, closing;  // delays at the pressures of the task [s]
  Verdict verdict = Verdict::suffices;
  std::vector<std::string> remarks;  // requirements that it misses, and uncertain ones
};

// Share of the period for which a valve is open, for a duty.
struct DeliveredShare {
  double duty = 0;
  Bounds delivered;
};

// Returns the time of a change with the open valve between a muscle and a port [s].
Bounds change_time(const gas::Flow& flow, const gas::Air& air, double port,
                   const AirChange& change);

// Returns the sonic conductance with which the change takes its time, for a valve with this b
// [m3/(s Pa)].
Bounds conductance_for(const gas::Air& air, double port, const AirChange& change,
                       double critical_ratio);

// Returns the requirements of the task. Throws config::Error if no valve can meet it.
ValveNeed need_of(const ValveTask& task);

// Returns the valves in the order of preference: valves that suffice, valves that may suffice, ones
// with an unknown flow or delay, and ones that miss something. Each group has the least flow first:
// it gives the finest step and needs the least air. Throws config::Error as above.
std::vector<ValveChoice> choose_valves(const ValveTask& task,
                                       const std::vector<PublishedValve>& valves);

// Returns the delivered share at duties from 0 to 1 in a hundred steps; empty if the valve's delays
// are not known.
std::vector<DeliveredShare> delivered_shares(const ValveChoice& valve, double frequency);

}  // namespace sinew::design
