#include "sinew/identify/motion/free_decay.h"

#include <cmath>
#include <numbers>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/units/stages.h"

namespace sinew::identify {

namespace {

using actuator::Loss;

struct State {
  double length = 0, velocity = 0;
};

class Motion {
 public:
  Motion(const Hanging& h, double rest) : h_(h) {
    const double volume = actuator::volume(h.actuator.braid, rest) + h.external_volume;
    air_ = h.pressure * std::pow(volume, h.polytropic_exponent);
  }

  double pressure(double length) const {
    const double volume = actuator::volume(h_.actuator.braid, length) + h_.external_volume;
    return air_ / std::pow(volume, h_.polytropic_exponent);
  }

  // What moves the mass if nothing rubs  [N].
  double drive(const State& s, double gauge) const {
    return h_.mass * h_.gravity -
           actuator::clamped_tension(h_.actuator, s.length, s.velocity, gauge, h_.atmosphere);
  }

  double bound(double length, double pressure) const {
    const bool sealed = h_.actuator.loss.coulomb_scale == Loss::Scale::sealed;
    const double stiffness =
        sealed ? actuator::stiffness_sealed(h_.actuator, length, pressure, h_.atmosphere,
                                            h_.external_volume, h_.polytropic_exponent)
               : 0;
    return actuator::coulomb_bound(h_.actuator, length, pressure - h_.atmosphere, h_.atmosphere,
                                   stiffness);
  }

  // Friction acts against `direction`, +1 or -1  [m/s^2].
  double acceleration(const State& s, double direction) const {
    const double p = pressure(s.length);
    return (drive(s, p - h_.atmosphere) - direction * bound(s.length, p)) / h_.mass;
  }

  // Where a mass at rest goes: +1, -1, or 0 if the friction holds it.
  double way(double length) const {
    const double p = pressure(length);
    const double force = drive({length, 0}, p - h_.atmosphere);
    if (std::abs(force) <= bound(length, p)) return 0;
    return force > 0 ? 1 : -1;
  }

  bool inside(const State& s) const {
    return s.length > 0 && s.length < h_.actuator.braid.thread_length && std::isfinite(s.velocity);
  }

  State step(const State& s, double direction, double dt) const {
    const auto slope = [&](const State& at) {
      return State{at.velocity, acceleration(at, direction)};
    };
    const auto moved = [&](const State& by, double t) {
      return State{s.length + t * by.length, s.velocity + t * by.velocity};
    };
    State k[4] = {slope(s)};
    for (int i = 1; i < 4; ++i) k[i] = slope(moved(k[i - 1], i < 3 ? dt / 2 : dt));
    const units::StageMean mean(dt);
    return {s.length + mean([&](int i) { return k[i].length; }),
            s.velocity + mean([&](int i) { return k[i].velocity; })};
  }

  // The part of dt after which the speed is zero: between `s` and `next` it changes sides. By false
  // position with halved ends, which brackets.
  double standstill(const State& s, double direction, double dt, const State& next) const {
    double low = 0, at_low = s.velocity, high = dt, at_high = next.velocity;
    if (at_low == 0) return dt;
    double last_side = 0;
    for (int i = 0; i < 60 && high - low > 1e-12 * dt; ++i) {
      const double middle = (low * at_high - high * at_low) / (at_high - at_low);
      const double v = step(s, direction, middle).velocity;
      if (std::abs(v) < 1e-14) return middle;
      if (v * direction > 0) {
        low = middle;
        at_low = v;
        if (last_side > 0) at_high /= 2;
        last_side = 1;
      } else {
        high = middle;
        at_high = v;
        if (last_side < 0) at_low /= 2;
        last_side = -1;
      }
    }
    return high;
  }

 private:
  const Hanging& h_;
  double air_ = 0;  // P V^n
};

// Cubic through lengths and speeds at both ends of a step.
double between(const State& a, const State& b, double dt, double t) {
  const double u = t / dt;
  const double rise = b.length - a.length;
  return a.length + u * (dt * a.velocity + u * (3 * rise - dt * (2 * a.velocity + b.velocity) +
                                                u * (dt * (a.velocity + b.velocity) - 2 * rise)));
}

}  // namespace

std::optional<double> rest_length(const Hanging& h) {
  const double weight = h.mass * h.gravity, gauge = h.pressure - h.atmosphere;
  const auto excess = [&](double length) {
    return actuator::clamped_tension(h.actuator, length, 0, gauge, h.atmosphere) - weight;
  };
  double low = actuator::shortest_length(h.actuator.braid);
  double high = h.actuator.braid.thread_length;
  if (excess(low) > 0 || excess(high) < 0) return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

double sealed_frequency(const Hanging& h, double length) {
  const double k =
      actuator::stiffness_sealed(h.actuator, length, h.pressure, h.atmosphere, h.external_volume,
                                 h.polytropic_exponent) +
      actuator::passive_stiffness(h.actuator, length, h.pressure - h.atmosphere, h.atmosphere);
  return k > 0 ? std::sqrt(k / h.mass) : 0;
}

bool free_decay(const Hanging& h, double length, double velocity, std::span<const double> times,
                std::span<double> lengths, int steps_per_period) {
  const auto rest = rest_length(h);
  if (!rest || times.empty()) return rest.has_value();
  const double frequency = sealed_frequency(h, *rest);
  if (!(frequency > 0)) return false;
  const double longest = 2 * std::numbers::pi / frequency / steps_per_period;

  const Motion motion(h, *rest);
  State s{length, velocity};
  double t = times[0];
  double direction = velocity > 0 ? 1 : velocity < 0 ? -1 : motion.way(length);
  std::size_t next = 0;
  while (next < times.size()) {
    if (!motion.inside(s)) return false;
    if (direction == 0) {
      for (; next < times.size(); ++next) lengths[next] = s.length;
      break;
    }
    double dt = longest;
    State after = motion.step(s, direction, dt);
    const bool turns = after.velocity * direction <= 0;
    if (turns) {
      dt = motion.standstill(s, direction, dt, after);
      after = motion.step(s, direction, dt);
      after.velocity = 0;
    }
    for (; next < times.size() && times[next] <= t + dt; ++next)
      lengths[next] = between(s, after, dt, times[next] - t);
    t += dt;
    s = after;
    if (turns) direction = motion.way(s.length);
  }
  return true;
}

}  // namespace sinew::identify
