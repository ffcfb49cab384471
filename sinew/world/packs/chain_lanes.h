// world/packs/chain_lanes.h - chains of machines side by side: W bodies as one of packs.
#pragma once

#include <array>
#include <cstddef>

#include "sinew/mechanism/planar/chain_body.h"
#include "sinew/units/pack.h"

namespace sinew::plant {

// Do the muscles of both pull the same joints? Only then can they stand side by side.
inline bool alike(const ChainRouting& a, const ChainRouting& b) {
  return a.count == b.count && a.joint == b.joint;
}

// All routes must be alike.
template <std::size_t W>
ChainRoutingOf<units::Pack<W>> side_by_side(const std::array<const ChainRouting*, W>& each) {
  ChainRoutingOf<units::Pack<W>> out;
  out.count = each[0]->count;
  out.padded = each[0]->padded;
  out.joint = each[0]->joint;
  for (int i = 0; i < out.padded; ++i)
    for (std::size_t k = 0; k < W; ++k) {
      out.mount[i].set(static_cast<int>(k), each[k]->mount[i]);
      out.moment_arm[i].set(static_cast<int>(k), each[k]->moment_arm[i]);
    }
  return out;
}

// Returns W bodies as one, each in its lane.
template <int N, std::size_t W>
ChainBody<N, units::Pack<W>> side_by_side(const std::array<const ChainBody<N>*, W>& each) {
  std::array<ChainModel<N>, W> models;
  std::array<const ChainRouting*, W> routes;
  for (std::size_t k = 0; k < W; ++k) {
    models[k] = each[k]->model();
    routes[k] = &each[k]->routes();
  }
  return {units::side_by_side<ChainModel<N, units::Pack<W>>>(models), side_by_side(routes)};
}

}  // namespace sinew::plant
