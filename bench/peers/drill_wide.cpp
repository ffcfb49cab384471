// Drill in lanes. Compiled once for each width, SINEW_LANES.
#include "bench/peers/drill.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "sinew/air/plain_air.h"

namespace sinew::bench {

namespace {

constexpr int W = SINEW_LANES;
using Pack = units::Pack<W>;
using Network = air::AirNetwork<drill_muscles>;
using Air = air::PlainAir<drill_muscles, W>;

// Lengths and rates at the beginning, the middle and the end of each machine's step.
struct Places {
  Pack length[3], rate[3];

  // Sets all machines to a step that begins at half step `half`.
  void all(const Drill& d, std::size_t half) {
    for (std::size_t n = 0; n < 3; ++n) {
      length[n] = d.rest + d.stroke[half + n];
      rate[n] = d.speed[half + n];
    }
  }
  // Sets one machine to a step that is `wide` times as long.
  void one(const Drill& d, int lane, std::size_t half, std::size_t wide) {
    for (std::size_t n = 0; n < 3; ++n) {
      length[n].set(lane, d.rest + d.stroke[half + n * wide]);
      rate[n].set(lane, d.speed[half + n * wide]);
    }
  }
};

// W machines from `first` on.
class Machines {
 public:
  Machines(const Drill& d, int first) : first_(first) {
    const std::vector<air::Muscle> muscles(drill_muscles, d.muscle);
    std::array<const Network*, W> each;
    for (std::size_t k = 0; k < W; ++k) {
      networks_[k] = std::make_unique<Network>(muscles, d.air, d.supply);
      each[k] = networks_[k].get();
    }
    air_ = std::make_unique<Air>(each);
    const double mass = each[0]->mass_at(0, d.start, d.rest + d.stroke[0]);
    const double density = mass / each[0]->volume(0, d.rest + d.stroke[0]);
    for (int i = 0; i < drill_muscles; ++i) {
      state_.mass[i] = mass;
      state_.in[i] = state_.out[i] = 0.0;
      memory_.y[i] = each[0]->braids().exact_y(density);
      memory_.inverse_sigma[i] = 1.0 / density;
    }
  }

  void command(const Switching& s) {
    const int lane = s.machine - first_;
    if (lane < 0 || lane >= W) return;
    const double share = s.open ? 1.0 : 0.0;
    air_->set_shares(lane, s.muscle, s.exhaust ? shares_.inlet[s.muscle][lane] : share,
                     s.exhaust ? share : shares_.exhaust[s.muscle][lane], shares_);
  }

  // RK4, as world/kernel/nodes.h has it.
  void step(const Places& p, const Pack& h) {
    constexpr int at[] = {0, 1, 1, 2};
    evaluate(p, 0, state_, evaluations_[0]);
    air_->update_memory(Pack(0.0) < Pack(1.0), evaluations_[0], memory_);
    for (int s = 0; s < 3; ++s) {
      air_->move(stage_, state_, s == 2 ? h : Pack(0.5 * h), evaluations_[s], shares_, {});
      evaluate(p, at[s + 1], stage_, evaluations_[s + 1]);
    }
    const Air::Evaluation* evaluations[4] = {&evaluations_[0], &evaluations_[1], &evaluations_[2],
                                             &evaluations_[3]};
    air_->finish(state_, h, evaluations, shares_, {});
  }

  // Writes the pressures of one machine at the beginning of the current step.
  void write_pressures(int lane, int tick, Pressures& out) const {
    for (int i = 0; i < drill_muscles; ++i)
      out[static_cast<std::size_t>(((first_ + lane) * drill_muscles + i) * drill_samples +
                                   tick / drill_sampling)] = evaluations_[0].pressure[i][lane];
  }

  // Returns the square roots of one stage. One flow suffices if some muscles fill, others empty,
  // and none
  // does both.
  double roots() const {
    double sum = 0;
    for (int i = 0; i < drill_muscles; ++i) {
      const auto fills = shares_.inlet[i] > 0.0, empties = shares_.exhaust[i] > 0.0;
      const bool in = units::any(fills), out = units::any(empties);
      sum += in && out && !units::any(fills & empties) ? 1 : (in ? 1 : 0) + (out ? 1 : 0);
    }
    return sum;
  }

 private:
  void evaluate(const Places& p, int n, const Air::State& state, Air::Evaluation& out) {
    for (int i = 0; i < drill_muscles; ++i) {
      ends_.length[i] = p.length[n];
      ends_.rate[i] = p.rate[n];
    }
    air_->evaluate(0, ends_, state, shares_, memory_, out);
  }

  int first_;
  std::array<std::unique_ptr<Network>, W> networks_;
  std::unique_ptr<Air> air_;
  Air::Ends ends_;
  Air::State state_, stage_;
  Air::Shares shares_{};
  Air::Memory memory_;
  Air::Evaluation evaluations_[4];
};

// Runs all machines with the same steps, of one tick or a part of a tick.
void by_ticks(const Drill& d, int, Machines& machines, Pressures* pressures, Counts& counts) {
  const double h = 1e-4 / d.parts;
  auto next = d.switchings.begin();
  Places places;
  std::size_t half = 0;
  for (int tick = 0; tick < drill_ticks; ++tick) {
    for (; next != d.switchings.end() && next->tick <= tick; ++next) machines.command(*next);
    for (int part = 0; part < d.parts; ++part, half += 2) {
      places.all(d, half);
      machines.step(places, h);
      for (int k = 0; pressures && k < W && part == 0 && tick % drill_sampling == 0; ++k)
        machines.write_pressures(k, tick, *pressures);
    }
    counts.steps += 1.0 * W * drill_muscles * d.parts;
    counts.divisions += 4.0 * drill_muscles * d.parts;
    counts.roots += 4.0 * machines.roots() * d.parts;
  }
}

// Progress of one machine in the drill.
struct MachineDrill {
  std::vector<Switching> switchings;  // those of this machine
  std::size_t next = 0;
  int tick = 0, to = 0;  // beginning and end of the current step
};

// Runs each machine with its own nodes, in lockstep by node; a machine that has reached its end
// waits.
void by_nodes(const Drill& d, int first, Machines& machines, Pressures* pressures, Counts& counts) {
  std::array<MachineDrill, W> machine_drills;
  for (const Switching& s : d.switchings)
    if (s.machine >= first && s.machine < first + W)
      machine_drills[static_cast<std::size_t>(s.machine - first)].switchings.push_back(s);
  Places places;
  Pack h = 0.0;
  for (bool goes = true; goes;) {
    goes = false;
    for (int k = 0; k < W; ++k) {
      MachineDrill& c = machine_drills[static_cast<std::size_t>(k)];
      c.tick = c.to;
      h.set(k, 0.0);
      if (c.tick >= drill_ticks) continue;
      goes = true;
      for (; c.next < c.switchings.size() && c.switchings[c.next].tick <= c.tick; ++c.next)
        machines.command(c.switchings[c.next]);
      c.to = (c.tick / d.stride + 1) * d.stride;
      if (c.next < c.switchings.size()) c.to = std::min(c.to, c.switchings[c.next].tick);
      const auto wide = static_cast<std::size_t>(c.to - c.tick);
      places.one(d, k, 2 * static_cast<std::size_t>(c.tick), wide);
      h.set(k, 1e-4 * static_cast<double>(wide));
      counts.steps += drill_muscles;
    }
    if (!goes) break;
    machines.step(places, h);
    for (int k = 0; pressures && k < W; ++k) {
      const int tick = machine_drills[static_cast<std::size_t>(k)].tick;
      if (tick < drill_ticks && tick % drill_sampling == 0)
        machines.write_pressures(k, tick, *pressures);
    }
  }
}

Counts run(const Drill& d, Pressures* pressures) {
  Counts counts{.seconds = 1e-4 * drill_ticks * drill_machines * drill_muscles};
  for (int first = 0; first < drill_machines; first += W) {
    Machines machines(d, first);
    (d.stride > 1 ? by_nodes : by_ticks)(d, first, machines, pressures, counts);
  }
  return counts;
}

// Uses sixteen independent packs, so that no operation waits for the previous result.
double divide(std::int64_t divisions, std::int64_t roots) {
  constexpr int beside = 16;
  Pack x[beside];
  for (int i = 0; i < beside; ++i) x[i] = 1.5 + 0.01 * i;
  const Pack over = 2.0;
  for (std::int64_t k = 0; k < divisions; k += beside)
    for (Pack& one : x) one = over / one;
  for (std::int64_t k = 0; k < roots; k += beside)
    for (Pack& one : x) one = units::sqrt(one);
  double sum = 0;
  for (const Pack& one : x) sum += one[0];
  return sum;
}

}  // namespace

#if SINEW_LANES == 2
Wide wide_2() { return {W, run, divide}; }
#elif SINEW_LANES == 4
Wide wide_4() { return {W, run, divide}; }
#else
Wide wide_8() { return {W, run, divide}; }
#endif

}  // namespace sinew::bench
