// A load hangs on one braided muscle. The integration loop is our own; Sinew's air::AirNetwork has
// the air part of the equations: it takes length, rate and air mass, and returns tension and flows.
//
//   x' = v      M v' = M g - F(x, v, m)      m' = inflow - outflow      x downward, length = x
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sinew/actuator/braid.h"
#include "sinew/air/network.h"
#include "sinew/units/literals.h"

namespace {

using namespace sinew;
using namespace sinew::units::literals;
using Air = air::AirNetwork<4>;  // for one muscle, or up to four

constexpr double load = 10.0_lb;
constexpr double step = 0.5_ms;
constexpr double hoses = 0.495_in3;

// Two-way valves; both closed seal the muscle. They follow the current with delays of milliseconds.
gas::Valve valve(double area) {
  gas::Valve v;
  v.flow.area = area;
  v.profile = gas::Valve::Profile::dead_time;
  v.opening_delay = 4.0_ms;
  v.closing_delay = 1.0_ms;
  return v;
}

air::Muscle one_muscle() {
  air::Muscle m;
  m.actuator.braid = {.thread_length = 4.2_in, .turns = 2.3};
  m.actuator.effectiveness = {.c0 = 0.95};
  m.actuator.long_end = {.length = 3.9_in, .stiffness = 8.8e4, .damping = 120};
  m.actuator.short_end = {.stiffness = 8.8e4, .damping = 120};
  m.actuator.loss.viscous = 40;
  m.external_volume = hoses;
  m.inlet = valve(3.0e-6_ft2);
  m.exhaust = valve(1.0e-5_ft2);
  return m;
}

struct State {
  double length, velocity, mass;
};

class HangingMass {
 public:
  HangingMass(const air::Muscle& m, const gas::Air& air, const gas::Supply& supply)
      : air_(std::array{m}, air, supply), valves_(air_.valves_at_rest()) {
    // Without air the load hangs in the stretched threads.
    state_.length = m.actuator.long_end.length + weight / m.actuator.long_end.stiffness;
    state_.velocity = 0;
    state_.mass = air_.mass_at(0, air.atmosphere, state_.length);
    memory_ = air_.memory_at_rest(air.atmosphere, lanes(state_.length));
    update_memory();
  }

  void inlet(bool open) {
    air_.command({.valve = {0}, .open = open}, time_, evaluate(time_, state_), valves_);
  }

  // Steps of RK4. They end where a valve moves, since the slope jumps there.
  void run_until(double end) {
    while (time_ < end) {
      const double next = std::min({time_ + step, valves_.next_change, end});
      rk4(next - time_);
      time_ = next;
      air_.move_valves(time_, evaluate(time_, state_), valves_);
      update_memory();
    }
  }

  double time() const { return time_; }
  const State& state() const { return state_; }
  Air::Evaluation evaluation() const { return evaluate(time_, state_); }

 private:
  static constexpr double weight = load * units::standard_gravity;

  // The network computes in lanes, one per muscle; unused lanes have copies of the last muscle.
  static Air::Lanes lanes(double value) {
    Air::Lanes l;
    l.of.fill(value);
    return l;
  }

  static Air::State air_state(const State& s) {
    Air::State air{};
    air.mass = lanes(s.mass);
    return air;
  }

  Air::Evaluation evaluate(double t, const State& s) const {
    Air::Evaluation out{};
    air_.evaluate(t, {lanes(s.length), lanes(s.velocity)}, air_state(s), valves_, memory_, out);
    return out;
  }

  void update_memory() { air_.update_memory(evaluate(time_, state_), air_state(state_), memory_); }

  State slope(double t, const State& s) const {
    const Air::Evaluation a = evaluate(t, s);
    return {s.velocity, (weight - a.tension[0]) / load, a.inflow[0] - a.outflow[0]};
  }

  static State add(const State& s, double h, const State& k) {
    return {s.length + h * k.length, s.velocity + h * k.velocity, s.mass + h * k.mass};
  }

  void rk4(double h) {
    const State k1 = slope(time_, state_);
    const State k2 = slope(time_ + h / 2, add(state_, h / 2, k1));
    const State k3 = slope(time_ + h / 2, add(state_, h / 2, k2));
    const State k4 = slope(time_ + h, add(state_, h, k3));
    state_ = add(add(state_, h / 6, k1), h / 3, k2);
    state_ = add(add(state_, h / 3, k3), h / 6, k4);
  }

  Air air_;
  Air::Valves valves_;
  Air::Memory memory_;
  State state_{};
  double time_ = 0;
};

void print(const HangingMass& world, const gas::Air& air) {
  const Air::Evaluation pull = world.evaluation();
  const double gauge = units::gauge(pull.pressure[0], air.atmosphere);
  std::printf("%8.0f %12.2f %14.1f %11.2f %11.3f\n", 1e3 * world.time(), 1e3 * world.state().length,
              gauge / 1e3, pull.tension[0], 1e6 * world.state().mass);
}

}  // namespace

int main() {
  const gas::Air air;
  gas::Supply supply;
  supply.pressure = units::absolute(100.0_psi, air.atmosphere);

  HangingMass world(one_muscle(), air, supply);
  std::printf("time [ms]  length [mm] gauge [kPa]  tension [N]  air [mg]\n");
  print(world, air);

  world.inlet(true);
  world.run_until(25.0_ms);
  print(world, air);
  world.run_until(50.0_ms);
  print(world, air);

  world.inlet(false);  // sealed from here on, once the valve has followed
  for (const double t : {75.0_ms, 100.0_ms, 150.0_ms, 200.0_ms, 300.0_ms, 500.0_ms, 1000.0_ms}) {
    world.run_until(t);
    print(world, air);
  }
}
