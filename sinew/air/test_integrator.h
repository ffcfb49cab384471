// air/test_integrator.h - a simple RK4 integrator of a network's state along a given motion.
#pragma once

#include <cmath>
#include <functional>
#include <utility>

#include "sinew/air/network.h"
#include "sinew/units/constants.h"

namespace sinew::air {

using Air = AirNetwork<8>;
using Motion = Air::Ends;  // lengths and travel as given functions of time, with their rates

// Returns the motion with all muscles at rest at one length.
inline Motion still_at(double length) {
  Motion m{};
  m.length.of.fill(length);
  return m;
}

// Returns a motion around one length: each muscle oscillates by itself, and a piston moves.
inline Motion swaying(double length, double t) {
  Motion m = still_at(length);
  for (int i = 0; i < 8; ++i) {
    m.length[i] += 0.3 * units::inch * std::sin(9 * t + i);
    m.rate[i] = 2.7 * units::inch * std::cos(9 * t + i);
  }
  m.travel = 0.5 * units::inch * (1 + std::sin(5 * t));
  m.travel_rate = 2.5 * units::inch * std::cos(5 * t);
  return m;
}

struct TestIntegrator {
  const Air& network;
  std::function<Motion(double)> motion;
  Air::State state{};
  double t = 0;
  Air::Evaluation now{};
  Air::Valves valves;
  Air::Memory memory{};

  TestIntegrator(const Air& n, std::function<Motion(double)> m, double pressure)
      : network(n), motion(std::move(m)), valves(n.valves_at_rest()) {
    const Motion start = motion(0);
    memory = n.memory_at_rest(pressure, start.length);
    state = n.initial(pressure, start.length, start.travel);
    evaluate(0, state, now);
    network.update_memory(now, state, memory);
    evaluate(0, state, now);
  }

  void evaluate(double at, const Air::State& s, Air::Evaluation& out) const {
    network.evaluate(at, motion(at), s, valves, memory, out);
  }

  // Return the masses that have entered through inlets and left through exhausts and leaks [kg].
  double entered() const {
    double sum = state.piston_in[0] + state.piston_in[1];
    for (int i = 0; i < network.muscles(); ++i) sum += state.in[i];
    return sum;
  }
  double left() const {
    double sum = state.piston_out[0] + state.piston_out[1];
    for (int i = 0; i < network.muscles(); ++i) sum += state.out[i] + state.leak[i];
    return sum;
  }

  // Takes a step of RK4; `ahead`: quick bodies are integrated ahead of it.
  void step(double h, bool ahead = false) {
    Air::Evaluation later[3];
    const Air::Evaluation* evaluations[4] = {&now, &later[0], &later[1], &later[2]};
    Air::State stage = state;
    Air::QuickMasses quick_masses{};
    if (ahead) network.plan(t, h, motion(t), state, valves, memory, quick_masses);
    for (int s = 0; s < 3; ++s) {
      const double part = s == 2 ? h : 0.5 * h;
      network.move(stage, state, part, *evaluations[s], valves, quick_masses);
      evaluate(t + part, stage, later[s]);
    }
    network.finish(state, h, evaluations, valves, quick_masses);
    t += h;
    evaluate(t, state, now);
    network.update_memory(now, state, memory);
  }

  // Steps to `until` with nodes at multiples of h and where a valve changes, as a world does.
  void run_until(double until, double h, bool ahead = false) {
    while (t < until - 1e-12) {
      double next = t + h < until ? t + h : until;
      if (valves.next_change < next) next = valves.next_change;
      if (next > t) step(next - t, ahead);
      t = next;
      node(next);
    }
    evaluate(t, state, now);
  }

  // Makes a node: moves valves, set points and faults there.
  void node(double at) {
    network.move_valves(at, now, valves);
    evaluate(at, state, now);
  }

  void edge(int valve, double at, bool open) {
    network.command({.valve = {static_cast<std::uint8_t>(valve)}, .open = open}, at, now, valves);
  }
  void level(int valve, double at, double share) {
    const double level = share * signals::max_level + 0.5;
    network.command({.valve = {static_cast<std::uint8_t>(valve)},
                     .level = static_cast<decltype(signals::Edge::level)>(level)},
                    at, now, valves);
  }

  void electrical(int valve, bool open) {
    edge(valve, t, open);
    node(t);
  }
};

}  // namespace sinew::air
