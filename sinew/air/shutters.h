// air/shutters.h - valves that are open or shut: commands of their coils, and their shutters from
// node to node. valve_bank.h adds faults, regulators and gradual openings.
//
// Everything here is copied as bytes, so that a whole machine can be (world/flat_leg.h).
#pragma once

#include <cstddef>
#include <limits>

#include "sinew/air/fault.h"
#include "sinew/air/state.h"
#include "sinew/gas/delay.h"
#include "sinew/signals/port.h"

namespace sinew::air {

inline constexpr double never = std::numeric_limits<double>::infinity();

// Law of a valve that is open or shut.
struct ShutterLaw {
  gas::DelayLaw delay;
  double fails_above = 0;  // pressure difference that the coil cannot lift; 0: none [Pa]
  bool opposite = false;   // second entry of a 3-way valve: open while the first one is not
};

// Returns the law of a valve at this index of the machine. A 3-way valve has one coil, and opens to
// the atmosphere when it leaves the supply.
inline ShutterLaw shutter_law(const gas::Valve& valve, std::size_t index) {
  return {gas::delay_law(valve), valve.fails_above,
          index % 2 == 1 && valve.kind == gas::Valve::Kind::three_way};
}

// Returns the next instant at which a valve or its set point changes, or infinity [s].
template <class Valve>
double next_of(const Valve& valve) noexcept {
  const double moves = valve.shutter.next();
  return valve.next_set_at < moves ? valve.next_set_at : moves;
}

// Applies an electrical edge at t to the shutter of a valve. `difference`: pressure difference that
// the valve holds back [Pa]. Returns the next instant at which the valve changes, or infinity: t
// itself if the edge undoes a change that was already applied at t, so that the open shares are
// renewed there [s].
template <class Valve>
double command_shutter(const ShutterLaw& law, double t, bool open, double difference,
                       Valve& valve) noexcept {
  const bool is_lost =
      law.opposite || (open && law.fails_above > 0 && difference > law.fails_above);
  const bool is_undone =
      !is_lost && valve.shutter.electrical(t, open, gas::delay_at(law.delay, open, difference));
  return is_undone ? t : next_of(valve);
}

// Finds the next change of `count` valves and of the rest of the machine [s].
template <int Most>
void find_next_change(std::size_t count, double of_rest, AirValves<Most>& valves) noexcept {
  double next = of_rest;
  for (std::size_t v = 0; v < count; ++v)
    if (valves.next_of[v] < next) next = valves.next_of[v];
  valves.next_change = next;
}

// Updates the next change after a command of valve v, which changes next at `after`. The command
// can also cancel the next change of all; only then all valves are searched. of_rest() returns the
// next change of the rest [s].
template <int Most, class Rest>
void note_command(std::size_t v, double after, std::size_t count, const Rest& of_rest,
                  AirValves<Most>& valves) noexcept {
  const double before = valves.next_of[v];
  valves.next_of[v] = after;
  if (after <= valves.next_change)
    valves.next_change = after;
  else if (before <= valves.next_change)
    find_next_change(count, of_rest(), valves);
}

// Returns the open share of the area of valve v with a tight seat, by its shutter.
template <int Most>
double shutter_fraction(bool opposite, std::size_t v, double t,
                        const AirValves<Most>& valves) noexcept {
  return opposite ? 1.0 - valves[v - 1].shutter.fraction(t) : valves[v].shutter.fraction(t);
}

// Adds a valve to the list of those that pass air.
template <int Most>
void add_open(std::size_t v, AirValves<Most>& valves) noexcept {
  const auto n = static_cast<std::size_t>(valves.open_count++);
  valves.open[n] = {static_cast<int>(v), valves[v].share};
}

// Moves valves without faults whose shutters jump to t. A command can also have moved a shutter
// back, so all shares are renewed. law(v) returns the law of valve v.
template <int Most, class Law>
void move_shutters(double t, std::size_t count, const Law& law, AirValves<Most>& valves) noexcept {
  valves.open_count = 0;
  for (std::size_t v = 0; v < count; ++v) {
    typename AirValves<Most>::Valve& valve = valves[v];
    if (valves.next_of[v] <= t) {
      valve.shutter.advance(t);
      valves.next_of[v] = next_of(valve);
    }
    valve.share = air::open_share(0.0, shutter_fraction(law(v).opposite, v, t, valves));
    if (valve.share > 0) add_open(v, valves);
  }
  find_next_change(count, never, valves);
}

}  // namespace sinew::air
