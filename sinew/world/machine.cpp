#include "sinew/world/machine.h"

#include <cstring>
#include <type_traits>

namespace sinew::plant {

namespace {

// Returns the first of these worlds that has room for the robot, or the last.
template <class First, class... Larger>
AnyWorld body_world_for(const Setup& s) {
  if constexpr (sizeof...(Larger) > 0)
    if (!First::Body::fits(s.robot)) return body_world_for<Larger...>(s);
  return AnyWorld(std::in_place_type<First>, s);
}

AnyWorld world_for(const AnySetup& any) {
  if (const auto* stand = std::get_if<StandSetup>(&any))
    return AnyWorld(std::in_place_type<Stand>, *stand);
  const Setup& s = std::get<Setup>(any);
  const bool chain = robot::is_chain(s.robot), one = s.robot.joints.size() == 1;
  using std::in_place_type;
  if (chain && one) return AnyWorld(in_place_type<ChainWorld<1>>, s);
  if (chain) return AnyWorld(in_place_type<ChainWorld<2>>, s);
  return body_world_for<SizedBodyWorld<2, 4, 8>, SizedBodyWorld<3, 2, 4>, SizedBodyWorld<4, 4, 8>,
                        BodyWorld, LargeBodyWorld>(s);
}

}  // namespace

Machine::Machine(const AnySetup& setup) : world_(world_for(setup)) {}

Machine::Machine(const LegLane& lane) : world_(lane) {}

signals::Port& Machine::port() noexcept {
  return *std::visit([](auto& world) -> signals::Port* { return &world; }, world_);
}

void Machine::truth(double t, Truths& out) noexcept {
  const auto put = [&](auto& world) {
    if constexpr (std::is_same_v<decltype(world), Stand&>)
      world.truth(t, out.stand);
    else
      world.truth(t, out.robot);
  };
  std::visit(put, world_);
}

Truth Machine::truth(double t) noexcept {
  Truths out;
  truth(t, out);
  return out.robot;
}

void Machine::true_motion(double t, Truths& out) noexcept {
  if (auto* const leg = std::get_if<LegLane>(&world_))
    leg->true_motion(t, out.robot);
  else
    truth(t, out);
}

void Machine::advance(double t) noexcept {
  std::visit([&](auto& world) { world.advance(t); }, world_);
}

double Machine::time() const noexcept {
  return std::visit([](const auto& world) { return world.time(); }, world_);
}

bool Machine::took_air() const noexcept {
  return std::visit([](const auto& world) { return world.took_air(); }, world_);
}

double Machine::air_mass() const noexcept {
  return std::visit([](const auto& world) { return world.air_mass(); }, world_);
}

std::int64_t Machine::nodes() const noexcept {
  return std::visit([](const auto& world) { return world.nodes(); }, world_);
}

double Machine::shortest_step() const noexcept {
  return std::visit([](const auto& world) { return world.shortest_step(); }, world_);
}

std::size_t Machine::state_size() const noexcept {
  return std::visit([](const auto& world) { return sizeof(world.state()); }, world_);
}

void Machine::save(std::span<std::byte> out) const noexcept {
  std::visit([&](const auto& world) { std::memcpy(out.data(), &world.state(), out.size()); },
             world_);
}

void Machine::restore(std::span<const std::byte> saved) noexcept {
  const auto from_bytes = [&](auto& world) {
    typename std::remove_reference_t<decltype(world)>::State state;
    std::memcpy(&state, saved.data(), sizeof state);
    world.restore(state);
  };
  std::visit(from_bytes, world_);
}

const air::Failure& Machine::failure() const noexcept {
  return *std::visit([](const auto& world) { return &world.failure(); }, world_);
}

// The worlds, compiled once.
template class World<ChainMechanism<1>, air::AirNetwork<chain_muscles>>;
template class World<ChainMechanism<2>, air::AirNetwork<chain_muscles>>;
template class BodyMechanism<2, 4, 8>;
template class BodyMechanism<3, 2, 4>;
template class BodyMechanism<4, 4, 8>;
template class World<BodyMechanism<2, 4, 8>, air::AirNetwork<8>>;
template class World<BodyMechanism<3, 2, 4>, air::AirNetwork<4>>;
template class World<BodyMechanism<4, 4, 8>, air::AirNetwork<8>>;
template class BodyMechanism<8, 8, 8>;
template class BodyMechanism<most_joints, robot::max_discs, most_muscles>;
template class World<BodyMechanism<8, 8, 8>, air::AirNetwork<8>>;
template class World<BodyMechanism<most_joints, robot::max_discs, most_muscles>,
                     air::AirNetwork<most_muscles>>;

}  // namespace sinew::plant
