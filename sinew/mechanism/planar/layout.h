// mechanism/planar/layout.h - constants of a planar world from a robot's description.
#pragma once

#include <array>

#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/chain.h"
#include "sinew/mechanism/planar/setup.h"

namespace sinew::plant {

inline constexpr int chain_muscles = 4;  // a pair at each of at most two joints

// Routes of muscles with constant moment arms. Muscle i acts on joint `joint[i]`; moment_arm[i] is
// positive if tension raises the angle: L = mount - moment_arm (theta - rest), torque = moment_arm
// * tension. S is a double, or a pack over several machines whose muscles act on the same joints.
template <class S>
struct ChainRoutingOf {
  int count = 0, padded = 0;  // padded to whole lanes by repeating the last

  std::array<int, chain_muscles> joint{};
  air::Lanes<chain_muscles, S> mount{}, moment_arm{};  // [m]
};
using ChainRouting = ChainRoutingOf<double>;

// Returns the routes of a chain's muscles.
ChainRouting chain_routing_of(const robot::Robot& robot);

// Returns lengths, masses and inertias of a chain.
template <int N>
ChainConstants<N> chain_of(const robot::Robot& robot) {
  ChainConstants<N> k;
  k.gravity = robot.gravity;

  // Mass beyond link i, from the tip inwards.
  double beyond = robot.foot.present ? robot.foot.mass : 0.0;
  for (int i = N - 1; i >= 0; --i) {
    const robot::Link& link = robot.links[static_cast<std::size_t>(i)];
    const double l = link.length, r = link.center_of_mass;
    k.length[i] = l;
    k.first_moment[i] = link.mass * r + l * beyond;
    k.inertia[i][i] = link.inertia + link.mass * r * r + l * l * beyond;
    beyond += link.mass;
  }
  for (int i = 0; i < N; ++i)
    for (int j = i + 1; j < N; ++j)
      k.inertia[i][j] = k.inertia[j][i] = k.length[i] * k.first_moment[j];

  if (robot.trolley.present) {
    k.total_mass = robot.trolley.moving_mass();
    k.inverse_total_mass = 1.0 / k.total_mass;
  }
  return k;
}

}  // namespace sinew::plant
