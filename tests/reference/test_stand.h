// Chapter 3's test stand: a mass that hangs on one actuator, [36], [37], with the air of the muscle
// bank. In the units of reference.json: in, s, psia, lbf.
#pragma once

#include <cmath>
#include <vector>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"
#include "sinew/muscle/bank.h"
#include "sinew/units/constants.h"

namespace sinew::reference {

// What differs between the text's equations and the code's constants.
struct Reading {
  bool absolute_effectiveness = false;
  double coulomb_length = 0.0044;  // [in]
  double supply = 114.7;           // [psia]
  double braid_damping = 0.7;      // [lbf s/in]
  double efficiency = 0.85;        // of the valve
  double flow = 1;                 // times the exact flow
  bool pushes = false;             // below b/sqrt 3: appendix A's line 5 F + 10 F_damping
};

struct Stand {
  Reading reading;
  double load = 0;             // [lbf]
  double external_volume = 0;  // [in^3]
  double frequency = 0;        // of the 3-way valve [Hz]; 0: air trapped
  double open = 0;             // per period, from its start [s]
};

struct Sample {
  double t = 0, length = 0, velocity = 0, pressure = 0, force = 0;
};

class TestStand {
 public:
  explicit TestStand(const Stand& stand)
      : stand_(stand), bank_(std::vector{muscle(stand)}, gas::Air{}, supply(stand.reading)) {
    actuator_ = muscle(stand).actuator;
    actuator_.short_end = {};  // of the stop's law, without a stop: as if there were no end
    shortest_ = actuator::shortest_length(actuator_.braid);
    mass_ = stand.load * units::pound_force / units::standard_gravity;
  }

  static muscle::Muscle muscle(const Stand& stand) {
    const Reading& r = stand.reading;
    muscle::Muscle m;
    m.actuator = actuator::thesis_actuator();
    auto& e = m.actuator.effectiveness;
    if (r.absolute_effectiveness) e.argument = actuator::Effectiveness::Argument::absolute;
    e.valid_from = -1e6, e.valid_to = 1e7;  // appendix A has no bounds
    m.actuator.short_end = {.law = actuator::ShortEnd::Law::zero};
    m.actuator.loss.coulomb_length = r.coulomb_length * units::inch;
    m.actuator.long_end.damping = r.braid_damping * units::pound_force / units::inch;
    m.external_volume = stand.external_volume * std::pow(units::inch, 3);
    m.inlet.kind = stand.frequency > 0 ? gas::Valve::Kind::three_way : gas::Valve::Kind::two_way;
    m.inlet.profile = m.exhaust.profile = gas::Valve::Profile::ideal;
    m.inlet.flow = {.area = 1.8e-5 * units::foot * units::foot * r.flow,
                    .efficiency = r.efficiency,
                    .linear_below = 1e-6};
    m.exhaust.flow = m.inlet.flow;
    return m;
  }

  static gas::Supply supply(const Reading& r) { return {.pressure = r.supply * units::psi}; }

  // Air of `pressure` [psia] at `sealed_at` [in]; set free at `length` [in].
  std::vector<Sample> run(double length, double pressure, double sealed_at, double seconds) {
    State x{.length = length * units::inch,
            .velocity = 0,
            .air = bank_.mass_at(0, pressure * units::psi, sealed_at * units::inch)};
    std::vector<Sample> samples;
    if (stand_.frequency > 0) bank_.electrical(0, 0.0, true);
    const auto steps = static_cast<long>(std::lround(seconds / step));
    const long period = stand_.frequency > 0 ? std::lround(1 / stand_.frequency / step) : 0;
    const long open = std::lround(stand_.open / step);
    int sign = 0;
    for (long n = 0; n < steps; ++n) {
      const double t = static_cast<double>(n) * step;
      if (period > 0 && n % period == 0) bank_.electrical(0, t, true);
      if (period > 0 && n % period == open) bank_.electrical(0, t, false);
      bank_.node(t);
      pull(t, x);
      bank_.follow(pull_.drift);
      if (sign == 0) sign = direction(t, x);
      samples.push_back({t, x.length / units::inch, x.velocity / units::inch,
                         pull_.pressure[0] / units::psi, force(x, sign) / units::pound_force});
      advance(t, step, sign, x);
    }
    return samples;
  }

  // When the velocity changed its sign  [s].
  const std::vector<double>& reversals() const { return reversals_; }

  static constexpr double step = 2e-5;  // [s]; errors of the means are below 1e-5 of them

 private:
  struct State {
    double length = 0, velocity = 0, air = 0;
  };

  void pull(double t, const State& x) {
    muscle::Lanes l{}, v{}, m{};
    for (int i = 0; i < muscle::lanes; ++i) l[i] = x.length, v[i] = x.velocity, m[i] = x.air;
    bank_.evaluate(t, l, v, m, pull_);
  }

  // [33] with the sign of the velocity; nothing at all below the shortest length, [31], or
  // appendix A's commented line.
  double force(const State& x, int sign) const {
    if (x.length >= shortest_) return pull_.tension[0] + sign * pull_.mesh[0];
    if (!stand_.reading.pushes) return 0.0;
    const double gauge = pull_.pressure[0] - units::atmosphere;
    const auto& a = actuator_;
    const double pull = actuator::tension(a, x.length, 0, gauge, units::atmosphere);
    const double secant = actuator::secant_stiffness(a, x.length, gauge, units::atmosphere);
    const double damping = a.loss.viscous * x.velocity + sign * a.loss.coulomb_length * secant;
    return 5 * (pull + damping) + 10 * damping;
  }

  // At rest: where it sets off to, or 0 while sign(v) flips faster than any step: it stays.
  int direction(double t, const State& x) {
    pull(t, x);
    const double weight = mass_ * units::standard_gravity;
    if (weight - force(x, 1) > 0) return 1;
    return weight - force(x, -1) < 0 ? -1 : 0;
  }

  State slope(double t, const State& x, int sign) {
    pull(t, x);
    const double a = units::standard_gravity - force(x, sign) / mass_;
    return {sign == 0 ? 0.0 : x.velocity, sign == 0 ? 0.0 : a, pull_.inflow[0] - pull_.outflow[0]};
  }

  State rk4(double t, double h, int sign, const State& x) {
    const auto plus = [](const State& a, const State& b, double s) {
      return State{a.length + s * b.length, a.velocity + s * b.velocity, a.air + s * b.air};
    };
    const State k1 = slope(t, x, sign), k2 = slope(t, plus(x, k1, h / 2), sign);
    const State k3 = slope(t, plus(x, k2, h / 2), sign), k4 = slope(t, plus(x, k3, h), sign);
    return plus(plus(plus(plus(x, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
  }

  // One step, restarted where the velocity changes its sign.
  void advance(double t, double h, int& sign, State& x) {
    State next = rk4(t, h, sign, x);
    if (sign != 0 && next.velocity * sign < 0) {
      double low = 0, high = h;
      for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2;
        (rk4(t, middle, sign, x).velocity * sign < 0 ? high : low) = middle;
      }
      x = rk4(t, high, sign, x);
      x.velocity = 0;
      reversals_.push_back(t + high);
      sign = direction(t + high, x);
      next = rk4(t + high, h - high, sign, x);
    }
    x = next;
  }

  Stand stand_;
  muscle::Bank bank_;
  muscle::Pull pull_{};
  actuator::Actuator actuator_;
  double shortest_ = 0, mass_ = 0;
  std::vector<double> reversals_;
};

}  // namespace sinew::reference
