#include "sinew/identify/motion/free_decay.h"

#include <cmath>
#include <numbers>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/world/stand.h"

namespace sinew::identify {

namespace {

using Motion = plant::Stand::Motion;

// Returns the stand for the simulation. Its steps are a share of the period at rest; the accuracy
// limit is wider, so that the number of steps does not depend on the parameters.
plant::StandSetup stand_of(const Hanging& h, double rest, double frequency, int steps_per_period) {
  const double turn = 2 * std::numbers::pi / steps_per_period;
  plant::StandSetup s;
  s.muscle.actuator = h.actuator;
  s.muscle.actuator.loss.stick = true;
  s.muscle.external_volume = h.external_volume;
  s.air = {.atmosphere = h.atmosphere, .polytropic_exponent = h.polytropic_exponent};
  s.load.mass = h.mass;
  s.load.gravity = h.gravity;
  s.start = {.pressure = h.pressure, .length = rest};
  s.step = turn / frequency;
  s.accuracy = std::pow(1.5 * turn, 4) / 120;
  return s;
}

// Returns the length at `t` within a piece of `dt`, from the cubic through lengths and speeds at
// its ends.
double between(const Motion& a, const Motion& b, double dt, double t) {
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

  const plant::StandSetup setup = stand_of(h, *rest, frequency, steps_per_period);
  plant::Stand stand(setup);
  stand.set_motion({length, velocity});
  std::size_t next = 0;
  const auto fill_in = [&](double from, const Motion& a, double to, const Motion& b) {
    for (; next < times.size() && times[next] - times[0] <= to; ++next)
      lengths[next] = between(a, b, to - from, times[next] - times[0] - from);
  };
  for (int step = 1; next < times.size(); ++step) {
    const Motion& m = stand.motion();
    if (stand.failure() || !(m.length > 0 && m.length < h.actuator.braid.thread_length))
      return false;
    stand.advance(step * setup.step, fill_in);
  }
  return true;
}

}  // namespace sinew::identify
