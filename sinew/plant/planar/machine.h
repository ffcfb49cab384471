// plant/planar/machine.h - a planar machine in simulation: the mechanism and the air that suit its
// description, behind one face. Robots that a chain holds go by chain_mechanism.h, and what of them
// has only air that a bank holds by muscle/bank.h.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "sinew/muscle/air.h"
#include "sinew/plant/planar/body_mechanism.h"
#include "sinew/plant/planar/chain_mechanism.h"
#include "sinew/plant/planar/world.h"

namespace sinew::plant {

template <int N>
using ChainWorld = World<ChainMechanism<N>, muscle::BankAir>;
template <int N>
using ChainPlumbingWorld = World<ChainMechanism<N>, muscle::PlumbingAir>;
// By links and discs; up to four links are just so many (body.h).
template <int N, int D>
using SizedBodyWorld = World<BodyMechanism<N, D>, muscle::PlumbingAir>;
using BodyWorld = SizedBodyWorld<8, 8>;
using LargeBodyWorld = SizedBodyWorld<robot::max_joints, robot::max_discs>;  // holds every robot

extern template class World<ChainMechanism<1>, muscle::BankAir>;
extern template class World<ChainMechanism<2>, muscle::BankAir>;
extern template class World<ChainMechanism<1>, muscle::PlumbingAir>;
extern template class World<ChainMechanism<2>, muscle::PlumbingAir>;
extern template class World<BodyMechanism<2, 4>, muscle::PlumbingAir>;
extern template class World<BodyMechanism<3, 4>, muscle::PlumbingAir>;
extern template class World<BodyMechanism<4, 4>, muscle::PlumbingAir>;
extern template class World<BodyMechanism<8, 8>, muscle::PlumbingAir>;
extern template class World<BodyMechanism<robot::max_joints, robot::max_discs>,
                            muscle::PlumbingAir>;

using AnyWorld = std::variant<ChainWorld<1>, ChainWorld<2>, ChainPlumbingWorld<1>,
                              ChainPlumbingWorld<2>, SizedBodyWorld<2, 4>, SizedBodyWorld<3, 4>,
                              SizedBodyWorld<4, 4>, BodyWorld, LargeBodyWorld>;

class Machine {
 public:
  // The setup must be free of contradictions (robot::contradictions).
  explicit Machine(const Setup& setup);

  signals::Port& port() noexcept;

  // As World's.
  Truth truth(double t) noexcept;
  void advance(double t) noexcept;
  double time() const noexcept;
  std::int64_t nodes() const noexcept;
  double air_mass() const noexcept;
  double shortest_step() const noexcept;
  const muscle::Failure& failure() const noexcept;

  // The machine's state at the last node, with the commands since, as bytes of one build of the
  // library; state_size() of them. A machine of an equal setup goes on from there: the same bits.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  AnyWorld world_;
};

}  // namespace sinew::plant
