#include "bench/peers/drill.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/peers/experiments.h"
#include "bench/peers/pow_muscle.h"
#include "sinew/air/network.h"
#include "sinew/run/setup/machine_setup.h"

namespace sinew::bench {

namespace {

// Pulses of one muscle: in each period of 100 ticks one valve is open for the first 0 to 59 ticks.
void pulse(int machine, int muscle, std::vector<Switching>& out) {
  for (int period = 0; period * 100 < drill_ticks; ++period) {
    const std::uint64_t of[] = {static_cast<std::uint64_t>(machine * drill_muscles + muscle),
                                static_cast<std::uint64_t>(period)};
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const std::uint64_t x : of) {
      hash = (hash ^ x) * 0xff51afd7ed558ccdu;
      hash ^= hash >> 32;
    }
    const int open = static_cast<int>(hash % 60);
    const bool exhaust = (hash >> 32 & 1u) != 0;
    if (open == 0) continue;
    out.push_back({100 * period, machine, muscle, exhaust, true});
    out.push_back({100 * period + open, machine, muscle, exhaust, false});
  }
}

// The muscles of one machine between its ticks.
class Muscles {
 public:
  explicit Muscles(const Drill& d)
      : network_(std::vector<air::Muscle>(drill_muscles, d.muscle), d.air, d.supply),
        valves_(network_.valves_at_rest()) {
    for (int i = 0; i < drill_muscles; ++i) ends_.length[i] = d.rest + d.stroke[0];
    state_ = network_.initial(d.start, ends_.length, 0);
    memory_ = network_.memory_at_rest(d.start, ends_.length);
    network_.evaluate(0, ends_, state_, valves_, memory_, evaluations_[0]);
  }

  void command(const Switching& s) {
    const auto valve = static_cast<std::uint8_t>(2 * s.muscle + (s.exhaust ? 1 : 0));
    network_.command({.at = s.tick, .valve = {valve}, .open = s.open}, 1e-4 * s.tick,
                     evaluations_[0], valves_);
  }
  void move_valves(double t) { network_.move_valves(t, evaluations_[0], valves_); }

  // RK4, as world/kernel/world.h has it.
  void step(const Drill& d, std::size_t half, std::size_t wide, double h) {
    evaluate(d, half, state_, evaluations_[0]);
    network_.update_memory(evaluations_[0], state_, memory_);
    for (int s = 0; s < 3; ++s) {
      network_.move(stage_, state_, s == 2 ? h : 0.5 * h, evaluations_[s], valves_, quick_masses_);
      evaluate(d, half + (s == 2 ? 2 : 1) * wide, stage_, evaluations_[s + 1]);
    }
    const Air::Evaluation* evaluations[4] = {&evaluations_[0], &evaluations_[1], &evaluations_[2],
                                             &evaluations_[3]};
    network_.finish(state_, h, evaluations, valves_, quick_masses_);
  }
  double pressure(const Drill& d, std::size_t half, int muscle) {
    evaluate(d, half, state_, evaluations_[0]);
    return evaluations_[0].pressure[muscle];
  }

 private:
  using Air = air::AirNetwork<drill_muscles>;

  void evaluate(const Drill& d, std::size_t half, const Air::State& state, Air::Evaluation& out) {
    // Writes whole lanes, since a wide load would wait for narrow stores.
    ends_.length.four(0) = d.rest + d.stroke[half] + air::Four{};
    ends_.rate.four(0) = d.speed[half] + air::Four{};
    network_.evaluate(0, ends_, state, valves_, memory_, out);
  }

  Air network_;
  Air::Valves valves_;
  Air::Ends ends_{};
  Air::State state_{}, stage_{};
  Air::Memory memory_;
  Air::QuickMasses quick_masses_;
  Air::Evaluation evaluations_[4];
};

std::size_t place(int machine, int muscle, int tick) {
  return static_cast<std::size_t>((machine * drill_muscles + muscle) * drill_samples +
                                  tick / drill_sampling);
}

// Runs the drill of one machine: calls `command` at each of its switchings, `sample` when one is
// due, and `step` with the index in the tables of half steps and half the step's length in them.
template <class Command, class Sample, class Step>
void go_through(const Drill& d, int machine, const Command& command, const Sample& sample,
                const Step& step) {
  auto next = d.switchings.begin();
  const auto find_own = [&] {
    while (next != d.switchings.end() && next->machine != machine) ++next;
  };
  find_own();
  for (int tick = 0; tick < drill_ticks;) {
    for (; next != d.switchings.end() && next->tick <= tick; find_own()) command(*next++);
    const auto half = static_cast<std::size_t>(2 * d.parts * tick);
    sample(tick, half);
    int to = (tick / d.stride + 1) * d.stride;
    if (next != d.switchings.end()) to = std::min(to, next->tick);
    if (d.parts == 1)
      step(half, static_cast<std::size_t>(to - tick));
    else
      for (int part = 0; part < d.parts; ++part) step(half + 2 * static_cast<std::size_t>(part), 1);
    tick = to;
  }
}

constexpr double seconds = 1e-4 * drill_ticks * drill_machines * drill_muscles;

}  // namespace

Drill drill(int parts, int stride) {
  const plant::Setup leg = run::planar_setup(walk());
  Drill d{.muscle = leg.muscles.front(), .air = leg.air, .supply = leg.supply};
  d.parts = parts;
  d.stride = stride;
  d.muscle.inlet.profile = d.muscle.exhaust.profile = gas::Valve::Profile::ideal;
  d.rest = 0.98 * leg.robot.muscles.front().mount_length;
  d.start = 2.5 * leg.air.atmosphere;
  const double turn = 2.0 * std::numbers::pi * 1.5, half = 0.5e-4 / parts;  // [1/s], [s]
  for (int k = 0; k <= 2 * parts * drill_ticks; ++k) {
    d.stroke.push_back(2e-3 * std::sin(turn * half * k));
    d.speed.push_back(2e-3 * turn * std::cos(turn * half * k));
  }
  for (int machine = 0; machine < drill_machines; ++machine)
    for (int muscle = 0; muscle < drill_muscles; ++muscle) pulse(machine, muscle, d.switchings);
  std::ranges::stable_sort(d.switchings, {}, &Switching::tick);
  return d;
}

Counts by_pow(const Drill& d, Pressures* pressures) {
  Counts counts{.seconds = seconds};
  double pulled = 0;
  for (int machine = 0; machine < drill_machines; ++machine) {
    std::vector<PowMuscle> muscles(drill_muscles, PowMuscle(d.muscle, d.air, d.supply));
    for (PowMuscle& m : muscles) m.fill(d.start, d.rest + d.stroke[0]);
    double share[drill_muscles][2] = {};
    go_through(
        d, machine,
        [&](const Switching& s) { share[s.muscle][s.exhaust ? 1 : 0] = s.open ? 1.0 : 0.0; },
        [&](int tick, std::size_t half) {
          if (!pressures || tick % drill_sampling != 0) return;
          for (int i = 0; i < drill_muscles; ++i)
            (*pressures)[place(machine, i, tick)] =
                muscles[static_cast<std::size_t>(i)].pressure(d.rest + d.stroke[half]);
        },
        [&](std::size_t half, std::size_t wide) {
          const double h = 1e-4 / d.parts * static_cast<double>(wide);
          const std::size_t end = half + 2 * wide;
          const PowMuscle::Lengths l{d.rest + d.stroke[half], d.rest + d.stroke[half + wide],
                                     d.rest + d.stroke[end]};
          for (int i = 0; i < drill_muscles; ++i) {
            PowMuscle& m = muscles[static_cast<std::size_t>(i)];
            m.step(h, l, share[i][0], share[i][1]);
            pulled += m.pull(l.end, d.speed[end], m.pressure(l.end)).tension;
          }
          counts.steps += drill_muscles;
        });
  }
  if (!(pulled > 0)) counts.steps = 0;  // uses the tensions, so that they are not optimized away
  return counts;
}

Counts by_network(const Drill& d, Pressures* pressures) {
  Counts counts{.seconds = seconds};
  for (int machine = 0; machine < drill_machines; ++machine) {
    Muscles muscles(d);
    go_through(
        d, machine, [&](const Switching& s) { muscles.command(s); },
        [&](int tick, std::size_t half) {
          muscles.move_valves(1e-4 * tick);
          if (!pressures || tick % drill_sampling != 0) return;
          for (int i = 0; i < drill_muscles; ++i)
            (*pressures)[place(machine, i, tick)] = muscles.pressure(d, half, i);
        },
        [&](std::size_t half, std::size_t wide) {
          muscles.step(d, half, wide, 1e-4 / d.parts * static_cast<double>(wide));
          counts.steps += drill_muscles;
        });
  }
  return counts;
}

std::vector<Wide> widths() {
  std::vector<Wide> out{wide_2()};
#if defined(SINEW_BENCH_WIDE)
  if (__builtin_cpu_supports("avx2")) out.push_back(wide_4());
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    out.push_back(wide_8());
#endif
  return out;
}

}  // namespace sinew::bench
