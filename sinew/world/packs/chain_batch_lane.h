// world/packs/chain_batch_lane.h - members of ChainBatch: what is asked of one of its machines, and
// how all of them go on, each by its own loop.
#pragma once

#include "sinew/world/packs/chain_batch_members.h"
#include "sinew/world/reading.h"

namespace sinew::plant {

template <int N, int W>
class ChainBatch<N, W>::Sensed {
 public:
  Sensed(ChainBatch& batch, int k) : b_(batch), k_(k), l_(static_cast<std::size_t>(k)) {}

  void advance(double t) noexcept { b_.advance(k_, t); }
  const air::Failure& failure() const noexcept { return b_.failure_[l_]; }
  bool ended() const noexcept { return b_.worlds_[l_]->ended(); }

  const ChainMechanism<N>& mechanism() const noexcept { return b_.worlds_[l_]->mechanism(); }
  typename ChainBody<N>::Arms arms() const noexcept { return {}; }
  double friction_bound(int muscle) const noexcept {
    return b_.first_.air.friction_bound[muscle][k_];
  }
  double bound(int contact) const noexcept { return b_.body_.bound(contact)[k_]; }

  GeneralizedState<N> peek_motion(double t) noexcept {
    const auto a = units::lane_of<GeneralizedVector<N>>(b_.glance(k_).acceleration, k_);
    GeneralizedState<N> motion = units::lane_of<GeneralizedState<N>>(b_.now_.motion, k_);
    mechanism().glide(motion, t - b_.time_[l_], a);
    return motion;
  }
  struct Glanced {
    std::array<double, N + 2> held;
  };
  Glanced glanced() const noexcept {
    return {units::lane_of<std::array<double, N + 2>>(b_.glance_.held, k_)};
  }

  // A muscle's own tension and pressure; those of the others are not set.
  struct Peek {
    struct {
      struct {
        std::array<double, chain_muscles> tension, pressure;
      } air;
    } look;
  };
  Peek peek_muscle(double t, int i) noexcept {
    const auto m = static_cast<std::size_t>(i);
    Peek p;
    (void)b_.glance(k_);
    if (!(t > b_.time_[l_]) || failure()) {
      p.look.air.tension[m] = b_.first_.air.tension[i][k_];
      p.look.air.pressure[m] = b_.first_.air.pressure[i][k_];
      return p;
    }
    typename ChainBody<N>::Ends ends;
    typename ChainBody<N>::Arms no_arms;
    mechanism().route(t, peek_motion(t), ends, no_arms);
    const auto seen = b_.air_.ahead(k_, i, ends.length[i], ends.rate[i], t - b_.time_[l_],
                                    b_.now_.air, b_.shares_, b_.memory_, b_.first_.air);
    p.look.air.tension[m] = seen.tension;
    p.look.air.pressure[m] = seen.pressure;
    return p;
  }

 private:
  ChainBatch& b_;
  int k_;
  std::size_t l_;
};

template <int N, int W>
auto ChainBatch<N, W>::only(int k) const noexcept -> Mask {
  Mask mask = S(0.0) > 0.0;
  mask.set(k, true);
  return mask;
}

// Where somebody has driven the World itself, or it has gone on, its lane follows.
template <int N, int W>
void ChainBatch<N, W>::follow(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  if (behind_[l]) return;
  change_[l] = worlds_[l]->state().valves.next_change;
  if (worlds_[l]->nodes() != nodes_[l]) take(k);
}

template <int N, int W>
template <class Turn>
int ChainBatch<N, W>::go(const Turn& turn) noexcept {
  for (int k = 0; k < W; ++k) follow(k);
  for (;;) {
    Mask goes = S(0.0) > 0.0;
    bool any = false;
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(k);
      if (parked_[l]) continue;
      while (failure_[l] || !(next_node(k) <= until_[l])) {
        until_[l] = turn(k);
        if (until_[l] < over) continue;
        park(k);
        return k;
      }
      goes.set(k, true);
      any = true;
    }
    if (!any) return -1;
    commit(goes);
  }
}

template <int N, int W>
void ChainBatch<N, W>::advance(int k, double t) noexcept {
  follow(k);
  while (!failure_[static_cast<std::size_t>(k)] && next_node(k) <= t) commit(only(k));
}

// The friction of a whole step from each machine's node: of all at once, where one is asked for.
template <int N, int W>
auto ChainBatch<N, W>::glance(int k) noexcept -> const Glance& {
  if (glanced_[static_cast<std::size_t>(k)]) return glance_;
  S h;
  for (int i = 0; i < W; ++i) h.set(i, step_[static_cast<std::size_t>(i)]);
  glance_.held = body_.hold(h, held_);
  glance_.acceleration = body_.accelerate(first_.acceleration, glance_.held);
  glanced_.fill(true);
  return glance_;
}

template <int N, int W>
signals::Status ChainBatch<N, W>::start(int k, const signals::Scan& scan) noexcept {
  return worlds_[static_cast<std::size_t>(k)]->start(scan);
}

template <int N, int W>
signals::Status ChainBatch<N, W>::drive(int k, const signals::Edge& edge) noexcept {
  const auto l = static_cast<std::size_t>(k);
  World& world = *worlds_[l];
  follow(k);
  if (world.ended()) return signals::Status::ended;
  if (failure_[l]) return signals::Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= world.air().valves() || t < time_[l]) return signals::Status::invalid;
  while (!failure_[l] && next_node(k) < t) commit(only(k));
  typename World::State& s = world.borrow();
  for (int i = 0; i < air_.muscles(); ++i) s.first.air.pressure[i] = first_.air.pressure[i][k];
  world.air().command(edge, t, s.first.air, s.valves);
  change_[l] = s.valves.next_change;
  return signals::Status::ok;
}

template <int N, int W>
signals::Reading ChainBatch<N, W>::read(int k, signals::Channel channel,
                                        signals::Tick now) noexcept {
  const World& world = *worlds_[static_cast<std::size_t>(k)];
  Sensed sensed(*this, k);
  return reading(sensed, world.senses(), channel, now - world.lag(channel));
}

template <int N, int W>
signals::Status ChainBatch<N, W>::stop(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  worlds_[l]->borrow().ended = true;
  return failure_[l] ? signals::Status::fault : signals::Status::ok;
}

template <int N, int W>
Truth ChainBatch<N, W>::truth(int k, double t) noexcept {
  advance(k, t);
  return world(k).truth(t);
}

}  // namespace sinew::plant
