// mechanism/planar/planar_mechanism.h - what all planar mechanisms are to world/kernel/world.h
// alike.
#pragma once

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/senses.h"
#include "sinew/mechanism/planar/setup.h"

namespace sinew::plant {

// For at most M muscles.
template <int M>
struct PlanarMechanism {
  static constexpr bool cuts_steps = false;

  using Setup = plant::Setup;
  using Senses = PlanarSenses;
  using Ends = air::Ends<M>;

  // The air of a machine: air/network.h.
  template <class Air>
  static Air make_air(const Setup& s) {
    return Air(s.muscles, s.air, s.supply, s.cylinder, s.faults);
  }
  template <class Air>
  static auto start_air(const Air& air, const Setup& s, const Ends& ends) {
    return air.initial(s.start.pressure, ends.length, s.start.lift);
  }
  template <class Air>
  static auto start_memory(const Air& air, const Setup& s, const Ends& ends) {
    return air.memory_at_rest(s.start.pressure, ends.length);
  }
};

}  // namespace sinew::plant
