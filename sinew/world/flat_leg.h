// world/flat_leg.h - a plain leg (lane_events.h) as one block of bytes without pointers: model,
// state and intermediate values. It can be copied as bytes, also to a graphics card (run/card), and
// its results have the bits of a World's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "sinew/air/shutters.h"
#include "sinew/signals/short_list.h"
#include "sinew/world/chain_lanes.h"

namespace sinew::plant {

// Parts of a plain chain that are not in its lane, for LaneEvents with one lane, number 0.
template <int N>
class FlatMachine {
 public:
  static constexpr std::size_t most_sensors = 32, most_valves = 2 * chain_muscles + 4;

  // Takes a machine at its start.
  FlatMachine(const ChainWorld<N>& world, const Setup& setup)
      : mechanism_(world.mechanism()),
        senses_(setup),
        valves_(world.state().valves),
        supply_(world.air().supply_state(world.state().now.air, world.state().first.air)),
        atmosphere_(setup.air.atmosphere) {
    for (int v = 0; v < world.air().valves(); ++v) laws_.push_back(world.air().shutter_law(v));
  }

  // The functions that lane_events.h calls.
  const ChainMechanism<N>& mechanism(int) const noexcept { return mechanism_; }
  const auto& senses(int) const noexcept { return senses_; }
  signals::Tick lag(int, signals::Channel channel) const noexcept { return lag_[channel.index]; }
  bool ended(int) const noexcept { return ended_; }
  void end(int) noexcept { ended_ = true; }
  void moves(int) const noexcept {}

  // Valves and supply; `pressure`: that of the valve's muscle at the node [Pa].
  const air::AirValves<chain_muscles>& valves(int) const noexcept { return valves_; }
  int valve_count(int) const noexcept { return static_cast<int>(laws_.size()); }
  void command(int, const signals::Edge& edge, double t, double pressure) noexcept {
    const std::size_t v = edge.valve.index;
    const double difference = v % 2 == 0 ? supply_.line - pressure : pressure - atmosphere_;
    const double after = air::command_shutter(laws_[v], t, edge.open, difference, valves_[v]);
    air::note_command(
        v, after, laws_.size(), [] { return air::never; }, valves_);
  }
  void move_valves(int, double t) noexcept {
    if (valves_.next_change > t) return;
    air::move_shutters(
        t, laws_.size(), [&](std::size_t v) -> const air::ShutterLaw& { return laws_[v]; },
        valves_);
  }
  air::SupplyState supply(int) const noexcept { return supply_; }

  // Takes the scan; returns Status::invalid for a channel without a sensor.
  signals::Status start(const signals::Scan& scan) noexcept {
    for (const signals::Conversion& c : scan.conversions) {
      if (c.channel.index >= senses_.channels()) return signals::Status::invalid;
      lag_[c.channel.index] = static_cast<std::uint16_t>(c.read - c.start);
    }
    return signals::Status::ok;
  }

 private:
  ChainMechanism<N> mechanism_;
  PlanarSensesOf<signals::ShortList<SensorSource, most_sensors>> senses_;
  air::AirValves<chain_muscles> valves_;
  signals::ShortList<air::ShutterLaw, most_valves> laws_;
  air::SupplyState supply_;
  double atmosphere_ = 0;  // [Pa]
  std::array<std::uint16_t, most_sensors> lag_{};
  bool ended_ = false;
};

// A chain of N links with the functions of Port and World.
template <int N>
class FlatChain : public LaneEvents<N, 1, FlatMachine<N>> {
  using Events = LaneEvents<N, 1, FlatMachine<N>>;

 public:
  // Returns whether this machine can be a FlatChain.
  static bool fits(const Setup& setup) {
    if (!is_plain_chain<N>(setup) || setup.robot.sensors.size() > FlatMachine<N>::most_sensors)
      return false;
    for (const air::Muscle& muscle : setup.muscles)
      if (muscle.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed) return false;
    return true;
  }

  // Takes a machine at its start, which fits().
  explicit FlatChain(const Setup& setup)
      : FlatChain(*std::make_unique<const ChainWorld<N>>(setup), setup) {}

  // The functions of Port and World.
  signals::Status start(const signals::Scan& scan) noexcept { return this->machines_.start(scan); }
  signals::Status drive(const signals::Edge& edge) noexcept { return Events::drive(0, edge); }
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept {
    return Events::read(0, channel, now);
  }
  signals::Status stop(signals::Tick) noexcept { return Events::stop(0); }
  void truth(double t, Truth& out) noexcept { Events::truth(0, t, out); }
  void true_motion(double t, Truth& out) noexcept { Events::true_motion(0, t, out); }
  bool took_air() const noexcept { return Events::took_air(0); }
  void advance(double t) noexcept { Events::advance(0, t); }
  const air::Failure& failure() const noexcept { return Events::failure(0); }
  std::int64_t nodes() const noexcept { return Events::nodes(0); }

  // Returns whether it has nodes to commit up to an instant [s]; commits the next node.
  bool waits(double until) const noexcept { return Events::waits(0, until); }
  void commit_next() noexcept { this->commit(this->only(0)); }

 private:
  FlatChain(const ChainWorld<N>& world, const Setup& setup)
      : Events(
            FlatMachine<N>(world, setup),
            [](const FlatMachine<N>& machine) {
              return side_by_side(std::array<const ChainBody<N>*, 1>{&machine.mechanism(0)});
            },
            [&](const FlatMachine<N>&) {
              return typename Events::Integrated::Air(
                  std::array<const air::AirNetwork<chain_muscles>*, 1>{&world.air()});
            }) {
    this->take(0, world.state(), world.body_step());
  }
};

using FlatLeg = FlatChain<2>;
static_assert(std::is_trivially_copyable_v<FlatLeg>);

}  // namespace sinew::plant
