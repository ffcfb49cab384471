// muscle/test_integrator.h - a plumbing moved by hand: RK4 over its state, with what has left it.
#pragma once

#include <functional>

#include "sinew/muscle/plumbing.h"

namespace sinew::muscle {

// Lengths and travel as given functions of time, with their rates.
struct Motion {
  Lanes length{}, rate{};
  double travel = 0, travel_rate = 0;
};

struct Hand {
  Plumbing& plumbing;
  std::function<Motion(double)> motion;
  AirState state{};
  double t = 0;
  double entered = 0, left = 0;  // through inlets; through exhausts and leaks [kg]
  AirPull now{};
  Plumbing::Valves valves;

  Hand(Plumbing& p, std::function<Motion(double)> m, double pressure)
      : plumbing(p), motion(std::move(m)), valves(p.valves_at_rest()) {
    const Motion start = motion(0);
    state = p.initial(pressure, start.length, start.travel);
    look(0, state, now);
  }

  AirState look(double at, const AirState& s, AirPull& out) {
    const Motion m = motion(at);
    AirState derivative{};
    plumbing.evaluate(at, m.length, m.rate, m.travel, m.travel_rate, s, valves, out, derivative);
    return derivative;
  }

  // Flows summed over the machine.
  static void sum(const AirPull& pull, int muscles, double weight, double& in, double& out) {
    for (int i = 0; i < muscles; ++i) {
      in += weight * pull.inflow[i];
      out += weight * (pull.outflow[i] + pull.leak[i]);
    }
    for (std::size_t s = 0; s < 2; ++s) {
      in += weight * pull.cylinder_inflow[s];
      out += weight * pull.cylinder_outflow[s];
    }
  }

  void step(double h) {
    AirState k[4];
    const double parts[4] = {0, 0.5 * h, 0.5 * h, h}, weights[4] = {h / 6, h / 3, h / 3, h / 6};
    AirState sum_of = state;
    for (int s = 0; s < 4; ++s) {
      AirState stage = state;
      for (int i = 0; s > 0 && i < plumbing.states(); ++i) stage[i] += parts[s] * k[s - 1][i];
      AirPull pull{};
      k[s] = look(t + parts[s], stage, pull);
      for (int i = 0; i < plumbing.states(); ++i) sum_of[i] += weights[s] * k[s][i];
      sum(pull, plumbing.muscles(), weights[s], entered, left);
    }
    state = sum_of;
    t += h;
    look(t, state, now);
    plumbing.remember(now, state);
  }

  // Nodes at multiples of h and where a valve changes, as a world does it.
  void go(double until, double h) {
    while (t < until - 1e-12) {
      double next = t + h < until ? t + h : until;
      if (valves.next_change < next) next = valves.next_change;
      if (next > t) step(next - t);
      t = next;
      plumbing.node(t, now, valves);
    }
    look(t, state, now);
  }

  void electrical(int valve, bool open) {
    plumbing.electrical(valve, t, open, now, valves);
    plumbing.node(t, now, valves);
    look(t, state, now);
  }
};

}  // namespace sinew::muscle
