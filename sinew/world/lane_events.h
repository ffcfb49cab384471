// world/lane_events.h - W plain machines side by side from event to event: chains whose muscles are
// filled through valves from a constant supply.
//
// The nodes are integrated in lanes (lane_nodes.h); readings and true values extrapolate from the
// lanes. Each machine has its own steps, edges and failures. They run in lockstep by node, not by
// time: a machine that waits is still computed in its lane, and the result is discarded.
//
// Machines has the parts of each machine that are not in lanes; its functions, for lane k:
//
//   mechanism(k), senses(k)           its ChainMechanism and its sensors
//   lag(k, channel), ended(k), end(k) as in World
//   valves(k), valve_count(k)         positions of its valves, and their number
//   command(k, edge, t, pressure)     applies an edge; `pressure`: of the valve's muscle [Pa]
//   move_valves(k, t)                 moves its shutters
//   supply(k)                         pressures of its supply
//   moves(k)                          notes that a node of its lane is committed
//
// chain_lanes.h has Worlds as Machines, flat_leg.h a single machine that is copied as bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "sinew/air/failure.h"
#include "sinew/mechanism/planar/chain_body.h"
#include "sinew/signals/port.h"
#include "sinew/world/kernel/reading.h"
#include "sinew/world/lane_nodes.h"

namespace sinew::plant {

template <int N, int W, class Machines>
class LaneEvents {
 protected:
  static constexpr auto lanes = static_cast<std::size_t>(W);

 public:
  using Instants = std::array<double, lanes>;
  static constexpr int width = W;

  // Commits every node of machine k up to until[k]  [s].
  void advance(const Instants& until) noexcept;

  // The functions of Port and World, for machine k.
  signals::Status drive(int k, const signals::Edge& edge) noexcept;
  signals::Reading read(int k, signals::Channel channel, signals::Tick now) noexcept;
  signals::Status stop(int k) noexcept;
  void truth(int k, double t, Truth& out) noexcept;
  // Writes the true values that follow from the motion alone (machine.h).
  void true_motion(int k, double t, Truth& out) noexcept;
  bool took_air(int k) const noexcept;
  void advance(int k, double t) noexcept;
  const air::Failure& failure(int k) const noexcept {
    return failure_[static_cast<std::size_t>(k)];
  }
  std::int64_t nodes(int k) const noexcept { return times_[static_cast<std::size_t>(k)].nodes; }

  // Returns whether machine k has nodes to commit up to an instant [s].
  bool waits(int k, double until) const noexcept { return !failure(k) && next_node(k) <= until; }

 protected:
  using Integrated = LaneNodes<N, W>;
  using S = units::Pack<W>;
  using Mask = units::PackMask<W>;

  // Takes the machines, and their models in lanes: body(machines) and air(machines).
  template <class Body, class Air>
  LaneEvents(Machines machines, const Body& body, const Air& air)
      : machines_(std::move(machines)), nodes_of_all_(body(machines_), air(machines_)) {}

  // Machine k as its senses use it (planar/planar_mechanism.h): the interface of World, with the
  // values of its lane.
  class LaneView;

  // Return the instant of the next node of machine k [s], and a mask of its lane alone.
  double next_node(int k) const noexcept;
  Mask only(int k) const noexcept;
  void update_step_preview(int k) noexcept;
  // Commits the next node of the machines in `active`.
  void commit(const Mask& active) noexcept;
  void move_valves(const Mask& active) noexcept;
  void note_failures(const Mask& active, const std::array<int, W>& failed) noexcept;

  // Copies the state of a World with this body step to lane k.
  template <class WorldState>
  void take(int k, const WorldState& s, double body_step) noexcept;
  // Calls put(values of all lanes, values of one) for each per-muscle array of a lane and a World.
  template <class Packed, class One, class Put>
  void each_number(Packed& packed, One& one, const Put& put) const noexcept;

  Machines machines_;
  Integrated nodes_of_all_;
  typename Integrated::State state_;

  // As World::State's, for each machine.
  std::array<NodeTimes, lanes> times_{};
  Instants step_{}, change_{};  // body steps; instants of the next valve changes [s]
  std::array<air::Failure, lanes> failure_{};

  typename Integrated::StepPreview step_preview_;  // whole steps, used by evaluations between nodes
  std::uint32_t has_step_preview_ = 0;  // bit k: it is valid for the present node of machine k
};

template <int N, int W, class Machines>
class LaneEvents<N, W, Machines>::LaneView {
 public:
  LaneView(LaneEvents& all, int k) : b_(all), k_(k), l_(static_cast<std::size_t>(k)) {}

  void advance(double t) noexcept { b_.advance(k_, t); }
  const air::Failure& failure() const noexcept { return b_.failure_[l_]; }
  bool ended() const noexcept { return b_.machines_.ended(k_); }

  const ChainMechanism<N>& mechanism() const noexcept { return b_.machines_.mechanism(k_); }
  typename ChainBody<N>::Arms arms() const noexcept { return {}; }
  // A chain computes its loads at the time of the preview.
  typename ChainBody<N>::Load load() const noexcept { return {}; }
  double friction_bound(int muscle) const noexcept {
    return b_.state_.first.air.friction_bound[muscle][k_];
  }
  double bound(int contact) const noexcept { return b_.nodes_of_all_.body().bound(contact)[k_]; }

  GeneralizedState<N> preview_motion(double t) noexcept {
    b_.update_step_preview(k_);
    const auto a = units::lane_of<GeneralizedVector<N>>(b_.step_preview_.acceleration, k_);
    GeneralizedState<N> motion = units::lane_of<GeneralizedState<N>>(b_.state_.now.motion, k_);
    mechanism().extrapolate(motion, t - b_.times_[l_].time, a);
    return motion;
  }
  struct StepPreview {
    typename ChainBody<N>::Acceleration acceleration;
    typename ChainBody<N>::Forces held;
  };
  StepPreview step_preview() const noexcept {
    return {units::lane_of<GeneralizedVector<N>>(b_.step_preview_.acceleration, k_),
            units::lane_of<std::array<double, N + 2>>(b_.step_preview_.held, k_)};
  }

  // State and evaluation at t, with the interface of World's.
  struct Preview {
    struct Air {
      std::array<double, chain_muscles> mass, in, out;
    };
    struct Moving {
      GeneralizedState<N> motion;
      Air air;
    };
    struct Pull {
      std::array<double, chain_muscles> tension, pressure;
    };
    struct Ends {
      std::array<double, chain_muscles> length;
      double travel = 0;
    };
    struct Evaluation {
      Pull air;
      Ends ends;
      typename ChainBody<N>::Arms arms;
    };
    Moving state;
    Evaluation evaluation;
  };

  // Returns the tension and pressure of one muscle; those of the others are not set.
  Preview preview_muscle(double t, int i) noexcept {
    Preview p;
    b_.update_step_preview(k_);
    if (is_past(t)) {
      write_node(i, p);
    } else {
      p.state.motion = preview_motion(t);
      write_muscle(t, i, ends_of(t, p.state.motion), p);
    }
    return p;
  }
  // Returns the motion of the preview.
  GeneralizedState<N> motion_at(double t) noexcept {
    return is_past(t) ? units::lane_of<GeneralizedState<N>>(b_.state_.now.motion, k_)
                      : preview_motion(t);
  }
  // Returns the whole preview.
  Preview preview(double t) noexcept {
    Preview p;
    b_.update_step_preview(k_);
    const int muscles = b_.nodes_of_all_.air().muscles();
    p.state.motion = motion_at(t);
    if (is_past(t)) {
      for (int i = 0; i < muscles; ++i) write_node(i, p);
    } else {
      const typename ChainBody<N>::Ends ends = ends_of(t, p.state.motion);
      for (int i = 0; i < muscles; ++i) write_muscle(t, i, ends, p);
    }
    return p;
  }

  // The accounts of the air, as AirNetwork's: nothing leaks, and there is no cylinder.
  struct Accounts {
    air::SupplyState supply;
    int muscles;

    air::Account account(const typename Preview::Air& air, int i) const noexcept {
      const auto m = static_cast<std::size_t>(i);
      return {.mass = air.mass[m], .in = air.in[m], .out = air.out[m]};
    }
    template <class State, class Evaluation>
    air::SupplyState supply_state(const State&, const Evaluation&) const noexcept {
      return supply;
    }
    double total_mass(const typename Preview::Air& air, double) const noexcept {
      double sum = 0;
      for (int i = 0; i < muscles; ++i) sum += air.mass[static_cast<std::size_t>(i)];
      return sum;
    }
    air::Account cylinder_account(const typename Preview::Air&, int) const noexcept { return {}; }
    template <class Evaluation>
    double cylinder_pressure(const Evaluation&, int) const noexcept {
      return 0;
    }
  };
  Accounts air() const noexcept {
    return {b_.machines_.supply(k_), b_.nodes_of_all_.air().muscles()};
  }

 private:
  bool is_past(double t) const noexcept { return !(t > b_.times_[l_].time) || failure(); }
  typename ChainBody<N>::Ends ends_of(double t, const GeneralizedState<N>& motion) const noexcept {
    typename ChainBody<N>::Ends ends;
    typename ChainBody<N>::Arms no_arms;
    mechanism().route(t, motion, ends, no_arms);
    return ends;
  }
  // Writes a muscle at the node.
  void write_node(int i, Preview& p) const noexcept {
    const auto m = static_cast<std::size_t>(i);
    const auto& s = b_.state_;
    p.evaluation.air.tension[m] = s.first.air.tension[i][k_];
    p.evaluation.air.pressure[m] = s.first.air.pressure[i][k_];
    p.evaluation.ends.length[m] = s.first.ends.length[i][k_];
    p.state.air.mass[m] = s.now.air.mass[i][k_];
    p.state.air.in[m] = s.now.air.in[i][k_];
    p.state.air.out[m] = s.now.air.out[i][k_];
  }
  // Writes a muscle with these ends at t.
  void write_muscle(double t, int i, const typename ChainBody<N>::Ends& ends,
                    Preview& p) const noexcept {
    const auto m = static_cast<std::size_t>(i);
    const auto& s = b_.state_;
    const auto muscle =
        b_.nodes_of_all_.air().preview(k_, i, ends.length[i], ends.rate[i], t - b_.times_[l_].time,
                                       s.now.air, s.valves, s.memory, s.first.air);
    p.evaluation.air.tension[m] = muscle.tension;
    p.evaluation.air.pressure[m] = muscle.pressure;
    p.evaluation.ends.length[m] = ends.length[i];
    p.state.air.mass[m] = muscle.mass;
    p.state.air.in[m] = muscle.in;
    p.state.air.out[m] = muscle.out;
  }

 private:
  LaneEvents& b_;
  int k_;
  std::size_t l_;
};

template <int N, int W, class Machines>
double LaneEvents<N, W, Machines>::next_node(int k) const noexcept {
  const auto l = static_cast<std::size_t>(k);
  return times_[l].next(step_[l], 0, change_[l]);
}

template <int N, int W, class Machines>
auto LaneEvents<N, W, Machines>::only(int k) const noexcept -> Mask {
  Mask mask = S(0.0) > 0.0;
  mask.set(k, true);
  return mask;
}

template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::advance(const Instants& until) noexcept {
  for (;;) {
    Mask active = S(0.0) > 0.0;
    bool any = false;
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(k);
      const bool one = !failure_[l] && next_node(k) <= until[l];
      active.set(k, one);
      any = any || one;
    }
    if (!any) return;
    commit(active);
  }
}

template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::advance(int k, double t) noexcept {
  while (!failure_[static_cast<std::size_t>(k)] && next_node(k) <= t) commit(only(k));
}

// Commits the next node of the machines in `active`.
template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::commit(const Mask& active) noexcept {
  S h = 0;
  Mask steps = active;
  bool any = false;
  for (int k = 0; k < W; ++k) {
    if (!active[k]) continue;
    const auto l = static_cast<std::size_t>(k);
    const double next = next_node(k);
    const bool later = next > times_[l].time;
    h.set(k, later ? next - times_[l].time : 0.0);
    steps.set(k, later);
    any = any || later;
    times_[l].pass(next, step_[l]);
    machines_.moves(k);
    has_step_preview_ &= ~(1u << k);
  }
  if (any) nodes_of_all_.step(steps, h, state_);
  move_valves(active);
  std::array<int, W> failed;
  if (!nodes_of_all_.prepare(active, state_, failed)) note_failures(active, failed);
}

template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::move_valves(const Mask& active) noexcept {
  for (int k = 0; k < W; ++k) {
    const auto l = static_cast<std::size_t>(k);
    if (!active[k] || change_[l] > times_[l].time) continue;
    machines_.move_valves(k, times_[l].time);
    change_[l] = machines_.valves(k).next_change;
    nodes_of_all_.air().update_shares(k, machines_.valves(k), state_.valves);
  }
}

template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::note_failures(const Mask& active,
                                               const std::array<int, W>& failed) noexcept {
  for (std::size_t k = 0; k < W; ++k) {
    const int lane = static_cast<int>(k);
    if (!active[lane]) continue;
    double places = state_.now.motion.x[lane];
    for (int j = 0; j < N; ++j) places += state_.now.motion.angle[j][lane];
    if (failed[k] >= 0)
      failure_[k] = {.of = air::Failure::Of::air,
                     .muscle = failed[k],
                     .length = state_.first.ends.length[failed[k]][lane],
                     .time = times_[k].time};
    else if (!air::is_position(places))
      failure_[k] = {.of = air::Failure::Of::motion, .time = times_[k].time};
  }
}

// Computes the friction of a whole step from each machine's node, for all lanes when any requires
// it.
template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::update_step_preview(int k) noexcept {
  if ((has_step_preview_ >> k & 1u) != 0) return;
  S h;
  for (int i = 0; i < W; ++i) h.set(i, step_[static_cast<std::size_t>(i)]);
  nodes_of_all_.preview_step(h, state_, step_preview_);
  has_step_preview_ = (1u << W) - 1;
}

template <int N, int W, class Machines>
signals::Status LaneEvents<N, W, Machines>::drive(int k, const signals::Edge& edge) noexcept {
  const auto l = static_cast<std::size_t>(k);
  if (machines_.ended(k)) return signals::Status::ended;
  if (failure_[l]) return signals::Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= machines_.valve_count(k) || t < times_[l].time)
    return signals::Status::invalid;
  while (!failure_[l] && next_node(k) < t) commit(only(k));
  const int muscle = edge.valve.index / 2;
  const bool fills = muscle < nodes_of_all_.air().muscles();
  machines_.command(k, edge, t, fills ? state_.first.air.pressure[muscle][k] : 0.0);
  change_[l] = machines_.valves(k).next_change;
  return signals::Status::ok;
}

template <int N, int W, class Machines>
signals::Reading LaneEvents<N, W, Machines>::read(int k, signals::Channel channel,
                                                  signals::Tick now) noexcept {
  LaneView view(*this, k);
  return reading(view, machines_.senses(k), channel, now - machines_.lag(k, channel));
}

template <int N, int W, class Machines>
signals::Status LaneEvents<N, W, Machines>::stop(int k) noexcept {
  machines_.end(k);
  return failure_[static_cast<std::size_t>(k)] ? signals::Status::fault : signals::Status::ok;
}

template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::truth(int k, double t, Truth& out) noexcept {
  advance(k, t);
  LaneView view(*this, k);
  const double at = times_[static_cast<std::size_t>(k)].time;
  machines_.senses(k).truth(view, t < at ? at : t, out);
}

template <int N, int W, class Machines>
void LaneEvents<N, W, Machines>::true_motion(int k, double t, Truth& out) noexcept {
  advance(k, t);
  LaneView view(*this, k);
  machines_.mechanism(k).write_motion(view.motion_at(t), out);
}

template <int N, int W, class Machines>
bool LaneEvents<N, W, Machines>::took_air(int k) const noexcept {
  bool any = false;
  for (int i = 0; i < nodes_of_all_.air().muscles(); ++i) any = any || state_.now.air.in[i][k] > 0;
  return any;
}

template <int N, int W, class Machines>
template <class Packed, class One, class Put>
void LaneEvents<N, W, Machines>::each_number(Packed& packed, One& one,
                                             const Put& put) const noexcept {
  each_of_air(packed.now.air, one.now.air, put);
  each_of_evaluation(packed.first, one.first, put);
  put(packed.memory.y, one.memory.reference.y);
  put(packed.memory.inverse_sigma, one.memory.reference.inverse_sigma);
}

template <int N, int W, class Machines>
template <class WorldState>
void LaneEvents<N, W, Machines>::take(int k, const WorldState& s, double body_step) noexcept {
  const auto l = static_cast<std::size_t>(k);
  units::put_lane(s.now.motion, k, state_.now.motion);
  units::put_lane(s.held, k, state_.held);
  state_.trolley_bound.set(k, s.trolley_bound);
  each_number(state_, s, [&](auto& packed, const auto& one) {
    for (int i = 0; i < nodes_of_all_.air().muscles(); ++i) packed[i].set(k, one[i]);
  });
  nodes_of_all_.air().set_shares(k, s.valves, state_.valves);
  times_[l] = s.times;
  change_[l] = s.valves.next_change;
  step_[l] = body_step;
  failure_[l] = s.failure;
  has_step_preview_ &= ~(1u << k);
  nodes_of_all_.prepare_friction(state_);
}

}  // namespace sinew::plant
