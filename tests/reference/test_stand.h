// Chapter 3's set-ups on our test stand, in the units of reference.json: in, s, psia, lbf.
#pragma once

#include <cmath>
#include <vector>

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/units/constants.h"
#include "sinew/world/stand.h"

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
  explicit TestStand(const Stand& stand) : stand_(stand) {}

  static air::Muscle muscle(const Stand& stand) {
    const Reading& r = stand.reading;
    air::Muscle m;
    m.actuator = actuator::thesis_actuator();
    auto& e = m.actuator.effectiveness;
    if (r.absolute_effectiveness) e.argument = actuator::Effectiveness::Argument::absolute;
    e.valid_from = -1e6, e.valid_to = 1e7;  // appendix A has no bounds
    using Law = actuator::ShortEnd::Law;
    m.actuator.short_end = {.law = r.pushes ? Law::empirical : Law::zero};
    m.actuator.loss.coulomb_length = r.coulomb_length * units::inch;
    m.actuator.long_end.damping = r.braid_damping * units::pound_force / units::inch;
    m.external_volume = stand.external_volume * std::pow(units::inch, 3);
    m.inlet.kind = gas::Valve::Kind::three_way;
    m.inlet.profile = gas::Valve::Profile::ideal;
    m.inlet.flow = {.area = 1.8e-5 * units::foot * units::foot * r.flow,
                    .efficiency = r.efficiency,
                    .linear_below = 1e-6};
    return m;
  }

  // Air of `pressure` [psia] at `sealed_at` [in]; set free at `length` [in].
  std::vector<Sample> run(double length, double pressure, double sealed_at, double seconds) {
    const bool pulsed = stand_.frequency > 0;
    using Mode = robot::Stand::Charge::Mode;
    plant::Stand stand({.muscle = muscle(stand_),
                        .supply = {.pressure = stand_.reading.supply * units::psi},
                        .load = {.mass = stand_.load * units::pound_mass},
                        .charge = {.mode = pulsed ? Mode::valves : Mode::sealed},
                        .start = {.pressure = pressure * units::psi,
                                  .length = sealed_at * units::inch,
                                  .displacement = (length - sealed_at) * units::inch}});
    std::vector<Sample> samples;
    const auto steps = std::lround(seconds / step);
    const long tick = std::lround(signals::tick_seconds / step);
    const long period = pulsed ? std::lround(1 / stand_.frequency / step) : 0;
    const long open = std::lround(stand_.open / step);
    for (long n = 0; n < steps; ++n) {
      if (period > 0 && n % period == 0) stand.drive({.at = n / tick, .open = true});
      if (period > 0 && n % period == open) stand.drive({.at = n / tick, .open = false});
      const plant::StandTruth x = stand.truth(static_cast<double>(n) * step);
      samples.push_back({static_cast<double>(n) * step, x.length / units::inch,
                         x.velocity / units::inch, x.pressure / units::psi,
                         x.force / units::pound_force});
      if (n > 0) note_reversal(samples[samples.size() - 2], samples.back());
    }
    return samples;
  }

  // When the velocity changed its sign  [s].
  const std::vector<double>& reversals() const { return reversals_; }

  static constexpr double step = 1e-4;  // between samples [s]

 private:
  void note_reversal(const Sample& before, const Sample& now) {
    const int sign = now.velocity > 0 ? 1 : now.velocity < 0 ? -1 : 0;
    if (sign == 0) return;
    if (direction_ != 0 && sign != direction_) {
      const double share = before.velocity / (before.velocity - now.velocity);
      reversals_.push_back(before.t + share * step);
    }
    direction_ = sign;
  }

  Stand stand_;
  int direction_ = 0;
  std::vector<double> reversals_;
};

}  // namespace sinew::reference
