// world/machine.h - simulation of a machine: the mechanism and the air that suit its description,
// behind one interface. Robots that are chains use chain_body.h, all others the first size of
// body_mechanism.h that has room for them, a test stand slide_mechanism.h.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "sinew/air/network.h"
#include "sinew/mechanism/planar/body_mechanism.h"
#include "sinew/world/batch.h"
#include "sinew/world/chain_world.h"
#include "sinew/world/stand.h"

namespace sinew::plant {

// Sizes for links, discs and muscles; sizes up to four have exactly that number of links (body.h).
template <int N, int D, int M>
using SizedBodyWorld = World<BodyMechanism<N, D, M>, air::AirNetwork<M>>;
using BodyWorld = SizedBodyWorld<8, 8, 8>;
using LargeBodyWorld = SizedBodyWorld<most_joints, robot::max_discs, most_muscles>;  // any robot

extern template class World<BodyMechanism<2, 4, 8>, air::AirNetwork<8>>;
extern template class World<BodyMechanism<3, 2, 4>, air::AirNetwork<4>>;
extern template class World<BodyMechanism<4, 4, 8>, air::AirNetwork<8>>;
extern template class World<BodyMechanism<8, 8, 8>, air::AirNetwork<8>>;
extern template class World<BodyMechanism<most_joints, robot::max_discs, most_muscles>,
                            air::AirNetwork<most_muscles>>;

using AnyWorld =
    std::variant<ChainWorld<1>, ChainWorld<2>, SizedBodyWorld<2, 4, 8>, SizedBodyWorld<3, 2, 4>,
                 SizedBodyWorld<4, 4, 8>, BodyWorld, LargeBodyWorld, LegLane, Stand>;

// True values of a robot or a test stand; the other member is not used.
using AnySetup = std::variant<Setup, StandSetup>;
struct Truths {
  Truth robot;
  StandTruth stand;
};

class Machine {
 public:
  // The setup must be free of contradictions (robot::contradictions). A stand throws
  // std::invalid_argument if it is not.
  explicit Machine(const AnySetup& setup);
  // Wraps a lane of a batch, which must outlive it.
  explicit Machine(const LegLane& lane);

  // Returns the machine's interface for a controller.
  signals::Port& port() noexcept;

  // The functions of World, for a robot or a stand; the second only for a robot.
  void truth(double t, Truths& out) noexcept;
  Truth truth(double t) noexcept;
  // Writes at least those true values that follow from the motion alone: positions and rates of the
  // trolley and the joints. For a plain leg in a lane this is cheaper than truth().
  void true_motion(double t, Truths& out) noexcept;
  void advance(double t) noexcept;
  double time() const noexcept;
  std::int64_t nodes() const noexcept;
  double air_mass() const noexcept;
  bool took_air() const noexcept;
  double shortest_step() const noexcept;
  const air::Failure& failure() const noexcept;

  // Save and restore the state at the last node, with the commands since, as state_size() bytes for
  // one build of the library. A machine of an equal setup continues from it with the same bits.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  AnyWorld world_;
};

}  // namespace sinew::plant
