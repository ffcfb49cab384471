// mechanism/slide/senses.h - readings of the stand's transducers, and its true values, from
// previews of world/kernel/world.h.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/mechanism/slide/setup.h"
#include "sinew/robot/sensing.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// Readings and true values of a stand.
class StandSenses {
 public:
  using Truth = StandTruth;

  // Takes the stand's transducers.
  explicit StandSenses(const StandSetup& setup)
      : transducers_(setup.transducers), atmosphere_(setup.air.atmosphere), seed_(setup.seed) {}

  // Returns the number of transducers.
  std::size_t channels() const noexcept { return transducers_.size(); }

  // Returns the quantity that the transducer measures at t; for a conversion that began before the
  // last node, the values of that node.
  template <class World>
  double quantity(World& world, std::size_t index, double t) const noexcept {
    using Of = Transducer::Of;
    world.advance(t);
    StandTruth now;
    truth(world, t, now);
    switch (transducers_[index].of) {
      case Of::length:
        return now.length;
      case Of::force:
        return now.force;
      case Of::pressure:
        return now.pressure - atmosphere_;
      case Of::acceleration:
        return now.acceleration;
    }
    return 0;
  }

  // Returns the counts of a transducer for a value.
  std::uint16_t counts(std::size_t index, double value, signals::Tick sampled) const noexcept {
    const Transducer& t = transducers_[index];
    const auto channel = static_cast<std::uint8_t>(index);
    const double added_noise = t.noise > 0 ? robot::noise(seed_, channel, sampled) : 0.0;
    return robot::counts(t, value, added_noise);
  }

  // Writes the true values at t.
  template <class World>
  void truth(World& world, double t, StandTruth& out) const noexcept {
    const auto& mechanism = world.mechanism();
    const auto& air = world.air();
    const auto p = world.preview(t);
    const auto& load = p.evaluation.load;
    const auto& g = world.step_preview();
    const double dry = mechanism.dry(load, g.held);
    const auto account = air.element(p.state.air);
    const auto supply = air.supply_state(p.state.air, p.evaluation.air);
    out = {.length = p.state.motion.length,
           .velocity = p.state.motion.velocity,
           .acceleration = g.acceleration,
           .force = load.force + dry,
           .friction = dry,
           .sticks = mechanism.rests(g.held),
           .load = mechanism.driven() ? 0.0 : load.mass,
           .pressure = air.pressure(p.evaluation.air),
           .air = account.mass,
           .all_air = air.total_mass(p.state.air, p.evaluation.ends.travel),
           .air_in = account.in,
           .air_out = account.out,
           .air_leaked = account.leak,
           .inlet = air.open_share(0, t, world.state().valves),
           .exhaust = air.open_share(1, t, world.state().valves),
           .supply_pressure = supply.line,
           .tank_pressure = supply.tank};
  }

 private:
  std::vector<Transducer> transducers_;
  double atmosphere_ = 0;  // [Pa]
  std::uint64_t seed_ = 1;
};

}  // namespace sinew::plant
